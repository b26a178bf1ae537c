/* The last steps, near the points: along normals, with guards. */
#include "base/parallel.h"
#include "wrap/parts.h"

enum { GRAIN = 1024, NEAREST = 5 };

typedef struct settle {
	mr_dyn *d;
	const mr_wrap_cloud *cloud;
	const mr_wrap_opts *o;
	const uint32_t *nearest; /* NEAREST of each vertex */
	mr_v3 *to;
} settle;

/* Where points are sparse their mean level is not the surface's, and over a hole there is none. */
static double
trust(const settle *s, uint32_t v)
{
	double near = mr_dist(s->cloud->p[s->nearest[v * NEAREST]], s->d->p[v]) / (2 * s->cloud->spacing);

	return near > 1 ? 1 / (near * near) : 1;
}

/*
 * Where v goes: along its normal by alpha of the way to the mean level of the nearest points, weighted by
 * 1 / (d^2 + s^2 / 16), s the sampling distance, and tangentially by lambda of the umbrella vector.
 */
static mr_v3
target(const settle *s, uint32_t v)
{
	const mr_dyn *d = s->d;
	uint32_t h = d->out[v];
	mr_v3 p = d->p[v], n = { 0, 0, 0 }, l = { 0, 0, 0 }, to = { 0, 0, 0 };
	double count = 0, weights = 0, least = s->cloud->spacing * s->cloud->spacing / 16;

	do {
		mr_v3 b = mr_sub(d->p[mr_dyn_to(d, h)], p), c = mr_sub(d->p[mr_dyn_apex(d, h)], p);
		n = mr_add(n, mr_cross(b, c));
		l = mr_add(l, b);
		count++;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	n = mr_unit(n);
	l = mr_mul(1 / count, l);
	for (size_t i = 0; i < NEAREST && s->nearest[v * NEAREST + i] != MR_NONE; i++) {
		mr_v3 x = mr_sub(s->cloud->p[s->nearest[v * NEAREST + i]], p);
		double w = 1 / (mr_norm2(x) + least);
		to = mr_axpy(w, x, to);
		weights += w;
	}
	l = h == MR_NONE ? mr_vec(0, 0, 0) : mr_axpy(-mr_dot(l, n), n, l); /* a boundary is not drawn in */
	return mr_axpy(s->o->alpha * trust(s, v) * mr_dot(to, n) / weights, n, mr_axpy(s->o->lambda, l, p));
}

static void
target_body(void *arg, size_t begin, size_t end)
{
	settle *s = arg;

	for (uint32_t v = (uint32_t)begin; v < end; v++)
		s->to[v] = s->d->kind[v] == MR_DEAD ? s->d->p[v] : target(s, v);
}

mr_status
mr_wrap_settle(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, size_t iterations, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *nearest = MR_NEW(ctx, d->nv * NEAREST, uint32_t);
	settle s = { d, cloud, o, nearest, MR_NEW(ctx, d->nv, mr_v3) };

	for (size_t i = 0; i < iterations; i++) {
		MR_TRY(mr_near_query(ctx, cloud->near, d->p, d->nv, NEAREST, nearest, NULL));
		mr_parallel(ctx, d->nv, GRAIN, target_body, &s);
		MR_TRY(mr_wrap_move(ctx, s.to, d));
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
