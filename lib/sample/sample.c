/* Jeong, Kim 2001: Direct reconstruction of displaced subdivision surface from unorganized points,
 * section 5. */
#include "sample/sample.h"

#include "base/parallel.h"
#include "sample/parts.h"
#include "space/bvh.h"
#include "space/local_planes.h"
#include "space/outlier.h"
#include "space/surface_walk.h"

#include <float.h>

/* Heights that were filled in, as a share, without a warning. */
static const double FILLED_MOST = 0.25;

/* True where half-edges lie on a boundary. */
static bool
is_open(const mr_loop *l)
{
	for (size_t h = 0; h < 3 * l->nf; h++)
		if (l->topo.twin[h] == MR_NONE)
			return true;
	return false;
}

typedef struct placing {
	const mr_domain *d;
	const mr_bvh *bvh; /* of the level below, if there is one: sooner made, and a walk does the rest */
	size_t below;      /* 1, else 0 */
	mr_sample_cloud *c;
	double *off;
} placing;

/* The part of a face that a place on it is on, of the four of the next level. */
static uint32_t
part_at(mr_place at)
{
	return 4 * at.face + (at.bary.x > 0.5 ? 0 : at.bary.y > 0.5 ? 1 : at.bary.z > 0.5 ? 2 : 3);
}

static void
place_points(void *arg, size_t begin, size_t end)
{
	const placing *x = arg;
	const mr_topology *topo = &x->d->level[x->d->n].topo;

	for (size_t i = begin; i < end; i++) {
		mr_v3 q = x->c->p[i], n;
		mr_closest near = mr_bvh_closest(x->bvh, q);
		if (x->below)
			near = mr_project_walk(&x->d->m, topo, part_at(near.at), q);
		n = mr_unit(mr_face_cross(&x->d->m, near.at.face));
		x->c->face[i] = near.at.face;
		if (x->off)
			x->off[i] = sqrt(near.dist2);
		x->c->side[i] = (mr_v3f){ (float)n.x, (float)n.y, (float)n.z };
	}
}

void
mr_sample_place(mr_ctx *ctx, const mr_domain *d, mr_sample_cloud *c, double *off)
{
	uint32_t *face = MR_NEW(ctx, c->n, uint32_t);
	mr_v3f *side = MR_NEW(ctx, c->n, mr_v3f);
	mr_mark mark = mr_mark_take(ctx);
	size_t below = d->n > 0;
	const mr_loop *l = &d->level[d->n - below];
	mr_mesh m = { d->m.name, d->m.p, l->t, l->nv, l->nf };
	placing x = { .d = d, .below = below, .c = c, .off = off };
	mr_bvh *bvh;

	c->face = face;
	c->side = side;
	mr_bvh_build(ctx, &m, &bvh);
	x.bvh = bvh;
	mr_parallel(ctx, c->n, 256, place_points, &x);
	mr_mark_release(ctx, mark);
}

size_t
mr_sights_near_sheet(const mr_sample_cloud *c, mr_v3 n, mr_sight *s, size_t count)
{
	size_t kept = 0;

	for (size_t i = 0; i < count; i++)
		if (mr_same_side(c, s[i].index, n))
			s[kept++] = s[i];
	return kept;
}

static mr_status
check_points(mr_ctx *ctx, const mr_domain *d, const mr_sample_cloud *c)
{
	static const char *const shape[] = { "at one place", "on a line", "in a plane" };
	int extent = mr_cloud_dimensions(c->p, c->n);

	if (extent < 2 || (extent < 3 && !is_open(&d->level[d->n])))
		return mr_fail(ctx, MR_EMESH, "all %zu points lie %s: they make no surface%s", c->n,
		    shape[extent], extent == 2 ? " for a closed control mesh" : "");
	if (mr_near_distinct(c->near) < 4)
		return mr_fail(ctx, MR_EMESH, "%zu points at %zu places: a surface needs 4 at least", c->n,
		    mr_near_distinct(c->near));
	return MR_OK;
}

/* The points that stay, and their index. */
static mr_status
keep_points(mr_ctx *ctx, const bool *outlier, size_t kept, mr_sample_cloud *c)
{
	mr_v3 *p = MR_NEW(ctx, kept, mr_v3);
	double *spacing = MR_NEW(ctx, kept, double);
	mr_near *near;

	kept = 0;
	for (size_t i = 0; i < c->n; i++) {
		if (outlier[i])
			continue;
		p[kept] = c->p[i];
		spacing[kept] = c->spacing[i];
		c->face[kept] = c->face[i];
		c->side[kept++] = c->side[i];
	}
	MR_TRY(mr_near_build(ctx, p, kept, &near));
	c->near = near;
	c->p = p;
	c->spacing = spacing;
	c->n = kept;
	c->diagonal = mr_box_diagonal(mr_box_of(p, kept));
	return MR_OK;
}

/* Finds the place of each point, and takes out those that belong nowhere. */
static mr_status
place_cloud(mr_ctx *ctx, const mr_domain *d, const mr_sampling *s, mr_sample_cloud *c, mr_sample_result *r)
{
	double *off = MR_NEW(ctx, c->n, double);
	bool *outlier = MR_NEW(ctx, c->n, bool);

	mr_sample_place(ctx, d, c, off);
	mr_find_outliers(ctx, s, off, 0, outlier, &r->outliers);
	return r->outliers ? keep_points(ctx, outlier, c->n - r->outliers, c) : MR_OK;
}

/* Takes back the heights that stick out and fills in those that are missing. */
static mr_status
mend(mr_ctx *ctx, const mr_domain *d, mr_heights *e, bool *hit, double *height, mr_sample_result *r)
{
	mr_heights_new(ctx, &d->m, 1, e);
	mr_heights_drop_spikes(ctx, e, d->m.p, height, hit, &r->spikes);
	return mr_heights_fill(ctx, e, hit, height, &r->filled);
}

/* If points fit them later, the points' gaps decide whether heights are missing.  At the edges of a clean
 * gear many vertices find no point, but the surface is within 2 spacings. */
static void
report_filled(mr_ctx *ctx, const mr_domain *d, bool fitted, const mr_sample_result *r)
{
	if (!fitted && (double)r->filled > FILLED_MOST * (double)d->m.nv)
		mr_found(ctx,
		    &(mr_finding){ .kind = MR_FILLED, .count = r->filled, .of = d->m.nv, .what = "heights" });
}

/* Weights for points with noise, before the points set the fairness; a fairness of 1e3 ends farther from the
 * truth. */
static mr_fit_weights
noisy_weights(const mr_sample_cloud *c)
{
	return (mr_fit_weights){
		.fair = 1e4, .pull = 0.05, .scale = 1e-4 * c->diagonal, .robust = true, .steps = 300
	};
}

/* Share of outliers among the points: others, next to the surface, are not found, and draw triangles away
 * from the truth. */
static const double OUTLYING = 0.01;

static bool
is_noisy(const mr_sampling *s)
{
	return s->noise > MR_NOISY * s->usual || (double)s->outliers > OUTLYING * (double)s->places;
}

/* Takes back the heights at creases and beside them: triangles met there cut corners off.  Without this sharp
 * edges of fandisk are 0.10 % of the diagonal away, with it 0.04. */
static void
leave_creases(mr_ctx *ctx, const mr_domain *d, bool *hit)
{
	const mr_loop *l = &d->level[d->n];
	mr_mark mark = mr_mark_take(ctx);
	bool *on = MR_NEW_ZERO(ctx, l->nv, bool);

	for (size_t h = 0; l->crease && h < 3 * l->nf; h++)
		if (l->crease[h]) /* on both sides */
			on[l->t[h / 3].v[h % 3]] = true;
	for (size_t f = 0; l->crease && f < l->nf; f++) {
		const uint32_t *v = l->t[f].v;
		if (on[v[0]] || on[v[1]] || on[v[2]])
			hit[v[0]] = hit[v[1]] = hit[v[2]] = false;
	}
	mr_mark_release(ctx, mark);
}

/* By triangles, or, robust, by the fit alone. */
static mr_status
find_heights(mr_ctx *ctx, const mr_domain *d, const mr_sample_cloud *c, const mr_sample_opts *opts,
    bool robust, double *height, mr_sample_result *r)
{
	mr_fit_weights weights = { .fair = 0.2, .pull = 0.3, .scale = 5e-3 * c->diagonal, .steps = 10 };
	size_t distinct = mr_near_distinct(c->near),
	       k = opts->neighbours < distinct ? opts->neighbours : distinct;
	mr_mark mark = mr_mark_take(ctx);
	bool *hit = MR_NEW(ctx, d->m.nv, bool);
	uint32_t *nearest = robust ? NULL : MR_NEW(ctx, d->m.nv, uint32_t);
	mr_heights e;

	if (robust)
		weights = noisy_weights(c);
	memset(hit, 0, d->m.nv * sizeof *hit);
	memset(height, 0, d->m.nv * sizeof *height);
	if (!robust)
		MR_TRY(mr_sample_triangles(ctx, d, c, k, height, hit, nearest, r));
	leave_creases(ctx, d, hit);
	MR_TRY(mend(ctx, d, &e, hit, height, r));
	MR_TRY(mr_sample_refine(ctx, d, c, &weights, opts->refine, &e, hit, nearest, height, r));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static mr_status
sample_cloud(mr_ctx *ctx, const mr_domain *d, const mr_sampling *s, mr_sample_cloud *c,
    const mr_sample_opts *opts, double *height, mr_sample_result *r)
{
	bool robust = opts->method == MR_SAMPLE_ROBUST || (opts->method == MR_SAMPLE_AUTO && is_noisy(s));

	MR_TRY(place_cloud(ctx, d, s, c, r));
	MR_TRY(check_points(ctx, d, c));
	MR_TRY(find_heights(ctx, d, c, opts, robust, height, r));
	report_filled(ctx, d, opts->refine > 0, r);
	return MR_OK;
}

mr_status
mr_sample_points(mr_ctx *ctx, const mr_domain *d, const mr_v3 *point, size_t n, const mr_sampling *known,
    const mr_sample_opts *opts, double *height, mr_sample_result *result)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *sorted = MR_NEW(ctx, n, mr_v3);
	mr_sample_cloud c = { .p = sorted, .n = n, .diagonal = mr_box_diagonal(mr_box_of(point, n)) };
	mr_sampling sampling;
	mr_sample_result r;

	if (n == 0)
		return mr_fail(ctx, MR_EMESH, "no points to sample");
	MR_TRY(mr_sampling_find(ctx, point, n, known, &sampling));
	/* what close ones look up is in the cache */
	mr_sampling_sort(ctx, point, &sampling, sorted, &sampling);
	c.spacing = sampling.spacing;
	c.usual = sampling.usual;
	MR_TRY((sampling.places == n ? mr_near_build_distinct : mr_near_build)(ctx, sorted, n, &c.near));
	mr_unmeasured(&r, sizeof r);
	MR_TRY(sample_cloud(ctx, d, &sampling, &c, opts, height, &r));
	mr_mark_release(ctx, mark);
	if (result)
		*result = r;
	return MR_OK;
}

/* A vertex that no face has is not to be reached. */
static void
leave_isolated(mr_ctx *ctx, mr_sample_cloud *c)
{
	const mr_mesh *mesh = c->mesh;
	size_t count, n = 0;
	bool *used;
	mr_v3 *p;

	mr_vertices_used(ctx, mesh->t, mesh->nf, mesh->nv, &used, &count);
	p = MR_NEW(ctx, count, mr_v3);
	for (size_t v = 0; v < mesh->nv; v++)
		if (used[v]) {
			p[n] = mesh->p[v];
			c->face[n] = c->face[v];
			c->side[n++] = c->side[v];
		}
	c->p = p;
	c->n = n;
}

mr_status
mr_sample_mesh(mr_ctx *ctx, const mr_domain *d, const mr_mesh *mesh, const mr_sample_opts *opts,
    double *height, mr_sample_result *result)
{
	mr_sample_cloud c = { .p = mesh->p, .n = mesh->nv, .mesh = mesh, .diagonal = mr_mesh_diagonal(mesh) };
	mr_fit_weights weights = { .fair = 1e-2, .pull = 1, .scale = 1e-3 * c.diagonal, .steps = 50 };
	mr_mark mark = mr_mark_take(ctx);
	bool *hit = MR_NEW(ctx, d->m.nv, bool);
	mr_sample_result r;
	mr_heights e;

	mr_unmeasured(&r, sizeof r);
	mr_sample_place(ctx, d, &c, NULL);
	mr_sample_rays(ctx, d, mesh, &c, height, hit, &r);
	leave_isolated(ctx, &c);
	MR_TRY(mend(ctx, d, &e, hit, height, &r));
	MR_TRY(mr_sample_refine(ctx, d, &c, &weights, opts->refine, &e, hit, NULL, height, &r));
	report_filled(ctx, d, false, &r);
	mr_mark_release(ctx, mark);
	if (result)
		*result = r;
	return MR_OK;
}
