/* Jeong, Kim 2001: Direct reconstruction of displaced subdivision surface from unorganized points, section 5;
 * Lee, Moreton, Hoppe 2000: Displaced subdivision surfaces. */
#include "subdivide/displaced.h"

#include "base/parallel.h"
#include "base/text.h"

void
mr_domain_on(mr_ctx *ctx, const mr_mesh *control, const mr_loop *level, size_t n, mr_domain *d)
{
	const mr_loop *l = &level[n];
	mr_v3 *limit = MR_NEW(ctx, l->nv, mr_v3), *normal = MR_NEW(ctx, l->nv, mr_v3), *p;
	MR_SCOPE(ctx);

	p = MR_NEW(ctx, l->nv, mr_v3);
	mr_loop_values(ctx, level, n, 3, (const double *)control->p, (double *)p);
	mr_loop_limit(ctx, l, p, limit, normal);
	*d = (mr_domain){ n, level, { control->name, limit, l->t, l->nv, l->nf }, normal };
}

mr_status
mr_domain_of(mr_ctx *ctx, mr_frame *f, const mr_mesh *control, size_t n, mr_domain *d)
{
	mr_loop *level = MR_NEW(ctx, n + 1, mr_loop);
	const uint8_t *mark;

	MR_TRY(mr_layer_crease(ctx, f, control->name, control->nf, &mark));
	MR_TRY(mr_loop_levels(ctx, control, 180, mark, n, level));
	mr_domain_on(ctx, control, level, n, d);
	return MR_OK;
}

mr_status
mr_level_cache_get(mr_level_cache *cache, mr_ctx *ctx, mr_frame *f, const mr_mesh *m, double crease, size_t n,
    const mr_loop **level)
{
	const mr_column *mark = mr_frame_find(f, m->name, "crease");
	uint64_t serial = mr_frame_find(f, m->name, "triangles")->serial,
		 mark_serial = mark ? mark->serial : 0;
	mr_ctx *keep = mr_keep(ctx, &cache->keep);
	const uint8_t *creases;
	mr_loop *l;

	*level = cache->level;
	if (cache->level && !f->key && serial && serial == cache->serial && n == cache->n &&
	    mark_serial == cache->mark_serial && crease == cache->crease &&
	    crease >= 180) /* creases move with the positions */
		return MR_OK;
	mr_ctx_free(keep);
	cache->level = NULL;
	MR_TRY(mr_layer_crease(ctx, f, m->name, m->nf, &creases));
	l = MR_NEW(keep, n + 1, mr_loop);
	MR_TRY(mr_fail_as(ctx, keep, mr_loop_levels(keep, m, crease, creases, n, l)));
	cache->n = n;
	cache->crease = crease;
	cache->serial = serial;
	cache->mark_serial = mark_serial;
	*level = cache->level = l;
	return MR_OK;
}

static mr_status
count_boundary(mr_ctx *ctx, const mr_mesh *m, size_t *n)
{
	MR_SCOPE(ctx);
	mr_topology topo;

	MR_TRY(mr_topology_build(ctx, m, &topo));
	*n = 0;
	for (size_t h = 0; h < 3 * m->nf; h++)
		*n += topo.twin[h] == MR_NONE;
	return MR_OK;
}

mr_status
mr_domain_level(mr_ctx *ctx, const mr_mesh *control, size_t count, size_t *n)
{
	double nearest = INFINITY;
	size_t boundary;

	MR_TRY(count_boundary(ctx, control, &boundary));
	for (size_t i = 0; i <= MR_LEVEL_MAX; i++) {
		size_t nv = mr_loop_count(control->nv, control->nf, boundary, i);
		double away = fabs(log((double)nv) - log((double)(count ? count : 1)));
		if (nv == SIZE_MAX || away >= nearest)
			break;
		nearest = away;
		*n = i;
	}
	return MR_OK;
}

typedef struct displacing {
	const mr_domain *d;
	const double *height;
	double gain;
	mr_v3 *p;
} displacing;

/* A height of zero keeps every bit of the domain. */
static void
displace(void *arg, size_t begin, size_t end)
{
	displacing *s = arg;

	for (size_t i = begin; i < end; i++) {
		double h = s->gain * s->height[i];
		s->p[i] = h == 0 ? s->d->m.p[i] : mr_axpy(h, s->d->normal[i], s->d->m.p[i]);
	}
}

void
mr_domain_displace(const mr_ctx *ctx, const mr_domain *d, const double *height, double gain, mr_v3 *p)
{
	mr_parallel(ctx, d->m.nv, 8192, displace, &(displacing){ d, height, gain, p });
}

static mr_status
stored_level(mr_ctx *ctx, mr_frame *f, size_t *n)
{
	const void *level;

	MR_TRY(mr_layer_get_rows(ctx, f, "displacement", "level", 1, &level));
	*n = *(const uint32_t *)level;
	if (*n > MR_LEVEL_MAX)
		return mr_fail(ctx, MR_ERANGE, "displacement: level %zu of at most %d", *n, MR_LEVEL_MAX);
	return MR_OK;
}

/* The heights, as many as their level of the control mesh has vertices. */
static mr_status
stored_heights(
    mr_ctx *ctx, mr_frame *f, const mr_mesh *control, size_t *n, const double **height, size_t *rows)
{
	size_t boundary, nv;
	const void *data;

	if (!mr_frame_has_layer(f, "displacement"))
		return mr_layer_missing(ctx, f, "displacement", "displacement");
	MR_TRY(stored_level(ctx, f, n));
	MR_TRY(mr_layer_get(ctx, f, "displacement", "height", &data, rows));
	MR_TRY(count_boundary(ctx, control, &boundary));
	nv = mr_loop_count(control->nv, control->nf, boundary, *n);
	if (*rows != nv)
		return mr_fail(ctx, MR_ERANGE,
		    "displacement: %zu heights, but level %zu of %s has %zu vertices", *rows, *n,
		    control->name, nv);
	*height = data;
	return MR_OK;
}

mr_status
mr_displacement_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *control, size_t *n, const double **height)
{
	size_t level, rows;
	const double *h;

	MR_TRY(stored_heights(ctx, f, control, &level, &h, &rows));
	for (size_t i = 0; i < rows; i++)
		if (!isfinite(h[i]))
			return mr_fail(ctx, MR_ERANGE, "displacement: height %zu is not finite", i);
	*n = level;
	*height = h;
	return MR_OK;
}

mr_status
mr_displacement_check(mr_ctx *ctx, mr_frame *f)
{
	const double *height;
	mr_mesh control;
	size_t n, rows;

	if (!mr_frame_has_layer(f, "displacement"))
		return MR_OK;
	MR_TRY(mr_prefix(ctx, mr_layer_mesh(ctx, f, "control", &control), "displacement"));
	return stored_heights(ctx, f, &control, &n, &height, &rows);
}

/* Columns of the displaced surface besides heights: a coarser level's are the first ones. */
static mr_status
fit_columns(mr_ctx *ctx, mr_frame *f, size_t nv)
{
	for (size_t i = f->count; i-- > 0;) {
		mr_column c = f->columns[i];
		if (strcmp(c.layer, "displacement") || c.shape.element != 'v' || c.rows == nv)
			continue;
		if (c.rows > nv) {
			MR_TRY(mr_column_decode(ctx, &c));
			MR_TRY(mr_frame_put(ctx, f, c.layer, c.name, c.shape, c.data, nv));
			continue;
		}
		if (strcmp(c.name, "height") != 0)
			mr_lost(ctx, "displacement", 1, c.name);
		mr_frame_drop(f, c.layer, c.name, 0);
	}
	return MR_OK;
}

mr_status
mr_displacement_put(mr_ctx *ctx, mr_frame *f, const mr_domain *d, const double *height)
{
	uint32_t *level = MR_NEW(ctx, 1, uint32_t);

	*level = (uint32_t)d->n;
	mr_frame_drop(f, "displacement", "range", 0);
	mr_frame_drop(f, "control", "encoded", 0);
	MR_TRY(fit_columns(ctx, f, d->m.nv));
	MR_TRY(mr_layer_put(ctx, f, "displacement", "height", height, d->m.nv));
	MR_TRY(mr_layer_put(ctx, f, "displacement", "level", level, 1));
	return mr_layer_worked(ctx, f, "displacement");
}
