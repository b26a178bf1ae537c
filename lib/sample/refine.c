/* Heights by least squares: a point's distance N (q - sum b_i (v_i + h_i n_i)) from its nearest place is
 * linear in them.  Each pass minimises the sum, then looks for the places anew, by walking from the last
 * ones. */
#include "base/parallel.h"
#include "base/sort.h"
#include "measure/gaps.h"
#include "mesh/fold.h"
#include "op/voronoi_area.h"
#include "sample/parts.h"
#include "space/surface_walk.h"
#include "subdivide/loop_self_intersect.h"

enum { GRAIN = 512, SAMPLES = 1 << 14 };

typedef struct fit {
	mr_sample_result *found;
	const mr_domain *d;
	const mr_sample_cloud *c;
	const mr_fit_weights *weights;
	mr_heights *e;
	double *target; /* heights to be pulled to */
	float *pull;    /* how much each counts */
	bool *bad;      /* faces that fold or cross others */
	bool *crosses;  /* faces that cross others */
	mr_loop_tree *tree;
	bool *near;      /* vertices around such faces, which are fitted again */
	bool local;      /* only these */
	mr_mesh surface; /* the displaced one */
	mr_v3 *p;        /* its positions */
	mr_v3 *cross;    /* of its faces: twice the area along the normal */
	double *height;
	mr_wish *wish;   /* of each point */
	uint32_t *start; /* of each face's points in `order`: nf + 1 */
	uint32_t *order; /* points by face */
	double scale;    /* gaps beyond it count less */
	double fair;     /* where heights are bent as in the middle */
} fit;

static void
place_points(void *arg, size_t begin, size_t end)
{
	const fit *x = arg;
	const mr_topology *topo = &x->d->level[x->d->n].topo;

	for (size_t i = begin; i < end; i++) {
		mr_wish *w = &x->wish[i];
		mr_v3 q = x->c->p[i], b, normal, foot;
		mr_closest c;
		const uint32_t *v = x->surface.t[w->face].v;
		if (x->local && !x->near[v[0]] && !x->near[v[1]] && !x->near[v[2]])
			continue;
		c = mr_project_walk(&x->surface, topo, w->face, q);
		b = c.at.bary;
		v = x->surface.t[c.at.face].v;
		normal = mr_unit(mr_face_cross(&x->surface, c.at.face));
		foot = mr_place_point(&x->d->m, c.at);
		w->face = c.at.face;
		w->c[0] = b.x * mr_dot(x->d->normal[v[0]], normal);
		w->c[1] = b.y * mr_dot(x->d->normal[v[1]], normal);
		w->c[2] = b.z * mr_dot(x->d->normal[v[2]], normal);
		w->r = mr_dot(mr_sub(q, foot), normal);
		w->gap = copysign(sqrt(c.dist2), mr_dot(mr_sub(q, c.point), normal));
	}
}

static void
median_gap(mr_ctx *ctx, const fit *x, double *median)
{
	mr_mark mark = mr_mark_take(ctx);
	double *gap = MR_NEW(ctx, x->c->n, double);

	for (size_t i = 0; i < x->c->n; i++)
		gap[i] = fabs(x->wish[i].gap);
	*median = mr_kth(gap, x->c->n, x->c->n / 2);
	mr_mark_release(ctx, mark);
}

static void
weigh_points(fit *x)
{
	for (size_t i = 0; i < x->c->n; i++) {
		double u = fabs(x->wish[i].gap) / x->scale;
		double w = x->weights->robust ? 1 / ((1 + u * u) * (1 + u * u)) : u > 1 ? 1 / u : 1;
		x->wish[i].weight = (float)w;
	}
}

static void
sort_by_face(fit *x)
{
	size_t nf = x->surface.nf;

	memset(x->start, 0, (nf + 1) * sizeof *x->start);
	for (size_t i = 0; i < x->c->n; i++)
		x->start[x->wish[i].face]++;
	for (size_t f = 0, sum = 0; f <= nf; f++) {
		size_t count = x->start[f];
		x->start[f] = (uint32_t)(sum += count);
	}
	for (size_t i = x->c->n; i-- > 0;)
		x->order[--x->start[x->wish[i].face]] = (uint32_t)i;
}

/* The entry of row i of the adjacency that is column j. */
static size_t
entry_of(const mr_adjacency *adj, size_t i, uint32_t j)
{
	size_t k = adj->start[i];

	while (adj->adj[k] != j)
		k++;
	return k;
}

/* Adds the wishes of the points on face f, of which vertex i is corner k. */
static void
add_face(const fit *x, size_t i, uint32_t f, int k)
{
	int a = (k + 1) % 3, b = (k + 2) % 3;
	size_t to_a = entry_of(&x->e->adj, i, x->surface.t[f].v[a]);
	size_t to_b = entry_of(&x->e->adj, i, x->surface.t[f].v[b]);

	for (uint32_t at = x->start[f]; at < x->start[f + 1]; at++) {
		const mr_wish *w = &x->wish[x->order[at]];
		double c = (double)w->weight * w->c[k];
		x->e->diagonal[i] += c * w->c[k];
		x->e->beside[to_a] += c * w->c[a];
		x->e->beside[to_b] += c * w->c[b];
		x->e->b[i] += c * w->r;
	}
}

static void
assemble_rows(void *arg, size_t begin, size_t end)
{
	const fit *x = arg;
	const mr_topology *topo = &x->d->level[x->d->n].topo;

	for (size_t i = begin; i < end; i++) {
		double pull = (double)x->pull[i];
		uint32_t first = topo->out[i], h = first;
		if (x->local && !x->near[i])
			continue;
		x->e->diagonal[i] = pull;
		x->e->b[i] = pull * x->target[i];
		for (size_t k = x->e->adj.start[i]; k < x->e->adj.start[i + 1]; k++)
			x->e->beside[k] = 0;
		if (h == MR_NONE)
			continue;
		do {
			if (x->start[h / 3] < x->start[h / 3 + 1])
				add_face(x, i, h / 3, (int)(h % 3));
			h = mr_he_ccw(topo, h);
		} while (h != MR_NONE && h != first);
	}
}

static bool
beyond(mr_v3 a, mr_v3 b, double cosine)
{
	return !(mr_dot(a, b) > cosine * mr_norm(a) * mr_norm(b));
}

/* Whether the face, or one beside it, may have moved. */
static bool
is_due(const fit *x, uint32_t f)
{
	const uint32_t *twin = x->d->level[x->d->n].topo.twin;
	bool due = !x->local || x->bad[f] || x->crosses[f];

	for (uint32_t h = 3 * f; h < 3 * f + 3 && !due; h++)
		due = x->near[mr_he_from(&x->surface, h)] ||
		      (twin[h] != MR_NONE && x->near[mr_he_to(&x->surface, mr_he_next(twin[h]))]);
	return due;
}

/* True where the face has turned from the domain's, is folded against one beside it, or passes through one.
 */
static bool
is_bad(const fit *x, uint32_t f)
{
	static const double turned = 0.1;
	const uint32_t *twin = x->d->level[x->d->n].topo.twin;
	mr_v3 n = x->cross[f];

	if (x->crosses[f] || beyond(n, mr_face_cross(&x->d->m, f), turned))
		return true;
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
		if (twin[h] != MR_NONE && mr_folds(n, x->cross[twin[h] / 3], MR_FOLD))
			return true;
	return false;
}

static void
turn_faces(void *arg, size_t begin, size_t end)
{
	const fit *x = arg;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = x->surface.t[f].v;
		if (!x->local || x->near[v[0]] || x->near[v[1]] || x->near[v[2]])
			x->cross[f] = mr_face_cross(&x->surface, f);
	}
}

static void
look(void *arg, size_t begin, size_t end)
{
	const fit *x = arg;

	for (size_t f = begin; f < end; f++)
		if (is_due(x, (uint32_t)f))
			x->bad[f] = is_bad(x, (uint32_t)f);
}

static size_t
find_folds(mr_ctx *ctx, fit *x)
{
	size_t count = 0;

	mr_parallel(ctx, x->surface.nf, GRAIN, turn_faces, x);
	mr_parallel(ctx, x->surface.nf, GRAIN, look, x);
	for (size_t f = 0; f < x->surface.nf; f++)
		count += x->bad[f];
	return count;
}

/* A surface that folds or crosses itself has heights that are too large for its domain: they are pulled
 * towards it and made fairer, each time more. */
static void
press(fit *x)
{
	static const double shrink = 0.7, more = 3, least = 0.3, most = 300;
	double stiff = x->local ? fmax(1, x->fair) : 1;

	for (size_t f = 0; f < x->surface.nf; f++)
		for (int k = 0; k < 3 && x->bad[f]; k++) {
			uint32_t v = x->surface.t[f].v[k];
			x->target[v] = shrink * x->height[v];
			x->pull[v] = (float)fmin(
			    more * fmax((double)x->pull[v], least * stiff), most * stiff);
			x->e->fair[v] = fmin(more * x->e->fair[v], most * x->fair);
		}
}

static void
place_all(mr_ctx *ctx, fit *x)
{
	mr_domain_displace(ctx, x->d, x->height, 1, x->p);
	mr_parallel(ctx, x->c->n, GRAIN, place_points, x);
}

static mr_status
validate(mr_ctx *ctx, fit *x)
{
	double factor;

	MR_TRY(mr_fairness_validate(
	    ctx, x->e, x->wish, x->c->n, &x->surface, x->height, x->weights->steps, &factor));
	x->fair *= factor;
	return MR_OK;
}

static mr_status
fit_pass(mr_ctx *ctx, fit *x, bool validated)
{
	double median;

	place_all(ctx, x);
	median_gap(ctx, x, &median);
	x->scale = fmax(x->weights->scale, 3 * 1.4826 * median);
	weigh_points(x);
	sort_by_face(x);
	mr_parallel(ctx, x->d->m.nv, GRAIN, assemble_rows, x);
	if (validated)
		MR_TRY(validate(ctx, x));
	MR_TRY(mr_heights_minimise(ctx, x->e, 1e-3, x->weights->steps, x->height));
	return MR_OK;
}

/* The point that is farthest from the surface in spacings, beyond four deviations of most. */
static mr_gap_spot
widest_of_points(const mr_sample_cloud *c, const double *gap, double median)
{
	const double noise = 4 * 1.4826 * median;
	mr_gap_spot widest = { 0 };

	for (size_t i = 0; i < c->n; i++) {
		double wide = (gap[i] - noise) / fmax(c->usual, c->spacing[i]);
		if (wide > widest.wide)
			widest = (mr_gap_spot){ wide, c->p[i] };
	}
	return widest;
}

/* Between points and the surface, both ways. */
static mr_status
report_points(mr_ctx *ctx, const fit *x, const mr_gap_spot *of_points)
{
	const mr_sample_cloud *c = x->c;
	mr_gaps *gaps = &x->found->gaps;
	mr_gap_spot of_surface = { 0 };

	MR_TRY(mr_gap_of_surface(ctx, &x->surface,
	    &(mr_gap_cloud){ c->p, c->spacing, c->near, c->n, c->usual }, SAMPLES, gaps, &of_surface));
	mr_gap_spots_report(ctx, "displacement", gaps, &of_surface, of_points);
	return MR_OK;
}

/* Between the mesh and the surface, where its faces are too. */
static mr_status
report_mesh(mr_ctx *ctx, const fit *x)
{
	mr_mesh_gaps gaps;

	mr_gaps_to_mesh(ctx, &x->surface, x->c->mesh, SAMPLES, &gaps);
	x->found->gaps.surface = gaps.surface;
	mr_mesh_gaps_report(ctx, "displacement", &gaps, x->c->mesh);
	return MR_OK;
}

static mr_status
report_gaps(mr_ctx *ctx, const fit *x)
{
	mr_mark mark = mr_mark_take(ctx);
	const mr_sample_cloud *c = x->c;
	mr_gap_spot of_points = { 0 };
	mr_gaps *gaps = &x->found->gaps;
	double *gap = MR_NEW(ctx, c->n, double), median;

	for (size_t i = 0; i < c->n; i++)
		gap[i] = fabs(x->wish[i].gap);
	median_gap(ctx, x, &median);
	if (c->near)
		of_points = widest_of_points(c, gap, median);
	gaps->points = mr_gap_of(gap, c->n);
	x->found->gap_mean = gaps->points.mean / c->diagonal;
	x->found->gap_max = gaps->points.max / c->diagonal;
	mr_mark_release(ctx, mark);
	return c->mesh ? report_mesh(ctx, x) : report_points(ctx, x, &of_points);
}

/* Heights that follow noise make a surface of many spikes, and so much larger. */
static void
report_rough(mr_ctx *ctx, const fit *x, size_t folds)
{
	static const double SPIKY = 1.5;
	mr_finding f = { .kind = MR_ROUGH, .count = folds, .of = x->d->m.nf };

	x->found->folds = folds;
	x->found->area_ratio = mr_mesh_area(ctx, &x->surface) / mr_mesh_area(ctx, &x->d->m);
	if (folds > 0)
		f.what = mr_format(ctx,
		    "%zu of %zu triangles of the displaced surface fold over or pass through others", folds,
		    x->d->m.nf);
	else if (x->found->area_ratio > SPIKY && !x->weights->robust)
		f.what = mr_format(
		    ctx, "the displaced surface has %.3g times the area of its domain", x->found->area_ratio);
	if (f.what)
		mr_found(ctx, &f);
}

static void
fit_new(mr_ctx *ctx, const mr_domain *d, const mr_sample_cloud *c, fit *x)
{
	x->d = d;
	x->c = c;
	x->surface = d->m;
	x->surface.p = x->p = MR_NEW(ctx, d->m.nv, mr_v3);
	x->wish = MR_NEW(ctx, c->n, mr_wish);
	x->start = MR_NEW(ctx, d->m.nf + 1, uint32_t);
	x->order = MR_NEW(ctx, c->n, uint32_t);
	x->target = MR_NEW(ctx, d->m.nv, double);
	x->pull = MR_NEW(ctx, d->m.nv, float);
	x->cross = MR_NEW(ctx, d->m.nf, mr_v3);
	x->bad = MR_NEW(ctx, d->m.nf, bool);
	x->crosses = MR_NEW_ZERO(ctx, d->m.nf, bool);
	x->tree = mr_loop_tree_new(ctx, d->level, d->n);
	x->near = MR_NEW(ctx, d->m.nv, bool);
	for (size_t i = 0; i < c->n; i++)
		x->wish[i].face = c->face[i];
}

/* The vertices within a few rings of bad faces: x->near, and their list. */
static size_t
find_near(fit *x, uint32_t *list)
{
	enum { RINGS = 3 };
	const mr_adjacency *adj = &x->e->adj;
	size_t count = 0;

	memset(x->near, 0, x->d->m.nv * sizeof *x->near);
	for (size_t f = 0; f < x->surface.nf; f++)
		for (int k = 0; k < 3 && x->bad[f]; k++) {
			uint32_t v = x->surface.t[f].v[k];
			if (!x->near[v])
				list[count++] = v;
			x->near[v] = true;
		}
	for (size_t ring = 0, from = 0; ring < RINGS; ring++)
		for (size_t to = count; from < to; from++)
			for (size_t k = adj->start[list[from]]; k < adj->start[list[from] + 1]; k++) {
				uint32_t v = adj->adj[k];
				if (!x->near[v])
					list[count++] = v;
				x->near[v] = true;
			}
	return count;
}

/* A pass around bad faces alone. */
static mr_status
mend_pass(mr_ctx *ctx, fit *x)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *list = MR_NEW(ctx, x->d->m.nv, uint32_t);
	size_t count;

	count = find_near(x, list);
	mr_parallel(ctx, x->c->n, GRAIN, place_points, x);
	weigh_points(x);
	sort_by_face(x);
	mr_parallel(ctx, x->d->m.nv, GRAIN, assemble_rows, x);
	MR_TRY(mr_heights_minimise_some(ctx, x->e, list, count, 1e-3, x->weights->steps, x->height));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Displaces the domain and finds what folds or crosses, by what has moved alone after a local pass. */
static mr_status
find_bad(mr_ctx *ctx, fit *x, size_t *folds)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t roots = x->d->level[0].nf, parts = x->surface.nf / roots;
	bool *moved = x->local ? MR_NEW_ZERO(ctx, roots, bool) : NULL;

	for (size_t f = 0; moved && f < x->surface.nf; f++)
		for (int k = 0; k < 3; k++)
			moved[f / parts] |= x->near[x->surface.t[f].v[k]];
	mr_domain_displace(ctx, x->d, x->height, 1, x->p);
	mr_find_crossings(ctx, x->tree, x->p, moved, x->crosses);
	*folds = find_folds(ctx, x);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Passes around what folds or crosses, as long as there is any and it has become less of late. */
static mr_status
mend_all(mr_ctx *ctx, fit *x, size_t *folds)
{
	enum { MOST = 40, PATIENCE = 8 };
	size_t least = SIZE_MAX, vain = 0;

	for (size_t pass = 0;; pass++) {
		MR_TRY(find_bad(ctx, x, folds));
		vain = *folds < least ? 0 : vain + 1;
		least = *folds < least ? *folds : least;
		if (*folds == 0 || pass == MOST || vain == PATIENCE)
			break;
		x->local = true;
		press(x);
		MR_TRY(mend_pass(ctx, x));
		mr_progress(ctx, "mending", (double)(pass + 1) / MOST);
	}
	x->local = false;
	return MR_OK;
}

static mr_status
fit_all(mr_ctx *ctx, fit *x, size_t passes, size_t *folds)
{
	for (size_t pass = 0; pass < passes; pass++) {
		mr_domain_displace(ctx, x->d, x->height, 1, x->p);
		find_folds(ctx, x);
		if (x->weights->robust && pass > 0)
			mr_fairness_adapt(ctx, x->e, x->height, x->fair);
		press(x);
		MR_TRY(fit_pass(ctx, x, x->weights->robust && pass == 1));
		mr_progress(ctx, "refining", (double)(pass + 1) / (double)passes);
	}
	return passes > 0 ? mend_all(ctx, x, folds) : find_bad(ctx, x, folds);
}

/* A plate with more vertices than points is as stiff as one with a vertex for each point: of 54 uneven clouds
 * the mean distance is 0.088 % of the diagonal, without this 0.096. */
static void
set_weights(mr_ctx *ctx, const mr_domain *d, const bool *hit, const uint32_t *nearest, fit *x)
{
	mr_mark mark = mr_mark_take(ctx);
	double *area = MR_NEW(ctx, d->m.nv, double);

	if (nearest)
		mr_voronoi_areas(ctx, &d->m, area);
	for (size_t v = 0; v < d->m.nv; v++) {
		double own = nearest ? x->c->spacing[nearest[v]] * x->c->spacing[nearest[v]] : 0;
		double share = nearest && area[v] > 0 && area[v] < own ? area[v] / own : 1;
		x->target[v] = x->height[v];
		x->pull[v] = hit[v] ? (float)(x->weights->pull * share) : 0;
		x->e->fair[v] = x->fair / share;
	}
	mr_mark_release(ctx, mark);
}

mr_status
mr_sample_refine(mr_ctx *ctx, const mr_domain *d, const mr_sample_cloud *c, const mr_fit_weights *weights,
    size_t passes, mr_heights *e, const bool *hit, const uint32_t *nearest, double *height,
    mr_sample_result *r)
{
	mr_mark mark = mr_mark_take(ctx);
	fit x = { .found = r, .weights = weights, .e = e, .height = height, .fair = weights->fair };
	size_t folds;

	fit_new(ctx, d, c, &x);
	mr_heights_add_data(ctx, e);
	set_weights(ctx, d, hit, nearest, &x);
	MR_TRY(fit_all(ctx, &x, passes, &folds));
	place_all(ctx, &x);
	r->fairness = x.fair;
	MR_TRY(report_gaps(ctx, &x));
	report_rough(ctx, &x, folds);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
