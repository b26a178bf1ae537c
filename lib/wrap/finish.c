/* The last steps of a wrap that is near the points: onto them, without folds, and not through itself. */
#include "base/sort.h"
#include "measure/gaps.h"
#include "mesh/guarded_move.h"
#include "mesh/zorder.h"
#include "remesh/remesh.h"
#include "remesh/unfold.h"
#include "space/self_intersect.h"
#include "wrap/parts.h"

enum { ITERATIONS = 4 /* by default */, PARTINGS = 3, AROUND = 24 };

/* Densities beside the mean from and up to which edges are shorter: chance makes up to twice as many. */
static const double DENSE = 2, DENSEST = 10;

/* At most about so many edges along the diagonal: few points need no fewer faces. */
static const double LEAST_EDGES = 10;

double
mr_wrap_length(const mr_wrap_cloud *cloud, const mr_wrap_opts *o)
{
	mr_v3 size = mr_sub(cloud->box.max, cloud->box.min);

	if (o->resolution)
		return fmax(size.x, fmax(size.y, size.z)) / (double)o->resolution;
	/* faces of sqrt(3) / 4 l^2, two points for each */
	return fmin(2.07 * sqrt(cloud->area / (double)cloud->n), cloud->diagonal / LEAST_EDGES);
}

mr_status
mr_wrap_dyn(mr_ctx *ctx, const mr_mesh *m, mr_dyn *d)
{
	mr_topology topo;

	MR_TRY(mr_topology_build(ctx, m, &topo));
	return mr_dyn_build(ctx, m, &topo, NULL, 180, d);
}

/* Edges are shorter where points are denser; NULL where they are nowhere. */
static mr_status
find_lengths(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_mesh *m, double length, const double **lengths)
{
	double *own = MR_NEW(ctx, m->nv, double), mean2 = cloud->area / (double)cloud->n;
	uint32_t *near = MR_NEW(ctx, AROUND * m->nv, uint32_t);
	bool shorter = false;

	MR_TRY(mr_near_query(ctx, cloud->near, m->p, m->nv, AROUND, near, NULL));
	for (size_t v = 0; v < m->nv; v++) {
		double sum = 0, share;
		size_t i = AROUND * v, count = 0;
		for (; count < AROUND && near[i + count] != MR_NONE; count++)
			sum += mr_square(cloud->own[near[i + count]]);
		share = sum / ((double)count * mean2);
		own[v] = length * (share < 1 / DENSE ? sqrt(fmax(1 / DENSEST, share)) : 1);
		shorter |= own[v] < length;
	}
	*lengths = shorter ? own : NULL;
	return MR_OK;
}

mr_status
mr_wrap_remesh(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *opts, const mr_mesh *m, mr_dyn *d)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_places map;
	mr_mesh out;

	o.length = mr_wrap_length(cloud, opts);
	o.rounds = 1;
	o.area_passes = 0;
	if (!opts->resolution)
		MR_TRY(find_lengths(ctx, cloud, m, o.length, &o.lengths));
	MR_TRY(mr_remesh(ctx, m, &o, NULL, &out, &map, NULL));
	return mr_wrap_dyn(ctx, &out, d);
}

/* Looks at some of n places, at equal strides: adds places far from the surface to c->unreached, the farthest
 * to c->at; *distance: of the `some`, the caller's. */
static void
look_at_places(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_bvh *bvh, const mr_v3 *p, size_t n,
    size_t some, double *distance, double *farthest, mr_wrap_cover *c)
{
	mr_v3 *q = MR_NEW(ctx, some, mr_v3), *sorted = MR_NEW(ctx, some, mr_v3);
	size_t far = 0;

	mr_at_strides(p, n, some, q);
	mr_zorder_points(ctx, q, some, sorted); /* what close ones look up is in the cache */
	mr_bvh_distances(ctx, bvh, sorted, some, distance);
	for (size_t i = 0; i < some; i++) {
		far += distance[i] > MR_WRAP_LACKS * cloud->spacing;
		if (distance[i] > *farthest) {
			*farthest = distance[i];
			c->at = sorted[i];
		}
	}
	c->unreached += some ? far * n / some : 0;
}

static size_t
at_most(size_t n, size_t most)
{
	return n < most ? n : most;
}

mr_status
mr_wrap_measure(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_mesh *m, size_t samples, mr_wrap_cover *c)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t outliers = cloud->sampling.outliers, some = at_most(cloud->n, samples);
	mr_gap_cloud places = { cloud->p, cloud->own, cloud->near, cloud->n, cloud->spacing };
	double *distance = MR_NEW(ctx, samples, double), farthest = 0;
	mr_bvh *bvh;

	*c = (mr_wrap_cover){ 0 };
	mr_bvh_build(ctx, m, &bvh);
	look_at_places(
	    ctx, cloud, bvh, cloud->outlier, outliers, at_most(outliers, samples), distance, &farthest, c);
	look_at_places(ctx, cloud, bvh, cloud->p, cloud->n, some, distance, &farthest, c);
	c->gaps.points = mr_gap_of(distance, some);
	mr_self_intersections(ctx, bvh, m, NULL, &c->crossings);
	MR_TRY(mr_gap_of_surface(ctx, m, &places, samples, &c->gaps, NULL));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_wrap_assess(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_wrap *w)
{
	mr_mesh m = mr_dyn_view(&w->d, "control");

	w->folds = mr_count_folds(ctx, &m, w->d.twin);
	return mr_wrap_measure(ctx, cloud, &m, MR_WRAP_SAMPLES, &w->cover);
}

typedef struct crossing {
	const mr_dyn *d;
	bool *crosses; /* each face */
	bool *touched; /* each vertex: by such a face */
} crossing;

static mr_status
find_crossings(mr_ctx *ctx, void *arg)
{
	const crossing *w = arg;
	mr_mesh m = mr_dyn_view(w->d, "control");
	size_t count;

	mr_self_intersections(ctx, NULL, &m, w->crosses, &count);
	memset(w->touched, 0, m.nv * sizeof *w->touched);
	for (size_t h = 0; h < 3 * m.nf; h++)
		if (w->crosses[h / 3])
			w->touched[m.t[h / 3].v[h % 3]] = true;
	return MR_OK;
}

/* Faces around those that cross, too: else sheets of which one has settled into the next are left with folds.
 */
static bool
is_near_crossing(const void *arg, uint32_t f)
{
	const crossing *w = arg;
	const uint32_t *v = w->d->v + 3 * (size_t)f;

	return w->touched[v[0]] || w->touched[v[1]] || w->touched[v[2]];
}

mr_status
mr_wrap_part(mr_ctx *ctx, const mr_v3 *home, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	crossing w = { d, MR_NEW(ctx, d->nf, bool), MR_NEW(ctx, d->nv, bool) };
	mr_guard g = { .t = mr_dyn_view(d, "control").t,
		.topo = { d->twin, d->out },
		.nv = d->nv,
		.nf = d->nf,
		.halves = 2,
		.look = find_crossings,
		.is_bad = is_near_crossing,
		.arg = &w };

	MR_TRY(mr_guarded_move(ctx, &g, home, d->p));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_wrap_finish(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *w)
{
	mr_v3 *home = MR_NEW(ctx, w->d.nv, mr_v3);

	memcpy(home, w->d.p, w->d.nv * sizeof *home);
	w->found.iterations = o->iterations ? o->iterations : ITERATIONS;
	MR_TRY(mr_wrap_settle(ctx, cloud, o, w->found.iterations, &w->d));
	for (int round = 0;; round++) {
		mr_unfold(&w->d);
		MR_TRY(mr_wrap_assess(ctx, cloud, w));
		if (w->cover.crossings == 0 || round == PARTINGS)
			return MR_OK;
		MR_TRY(mr_wrap_part(ctx, home, &w->d));
	}
}
