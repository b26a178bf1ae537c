/* The two steps of the paper, section 3.1.1. */
#include "base/parallel.h"
#include "wrap/parts.h"

enum { GRAIN = 2048 };

/* d's vertices to `to`. */
static mr_status
move(mr_ctx *ctx, bool guarded, mr_v3 *to, mr_dyn *d)
{
	if (guarded)
		return mr_wrap_move(ctx, to, d);
	memcpy(d->p, to, d->nv * sizeof *to);
	return MR_OK;
}

mr_status
mr_wrap_project(mr_ctx *ctx, const mr_wrap_cloud *cloud, double alpha, bool guarded, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *nearest = MR_NEW(ctx, d->nv, uint32_t);
	mr_v3 *to = MR_NEW(ctx, d->nv, mr_v3);

	MR_TRY(mr_near_query(ctx, cloud->near, d->p, d->nv, 1, nearest, NULL));
	for (size_t v = 0; v < d->nv; v++)
		to[v] = d->kind[v] == MR_DEAD ? d->p[v] : mr_lerp(alpha, d->p[v], cloud->p[nearest[v]]);
	MR_TRY(move(ctx, guarded, to, d));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

typedef struct smoothing {
	const mr_dyn *d;
	double lambda;
	mr_v3 *p;
} smoothing;

/* v + lambda Lt: L = mean_j(v_j) - v over the ring, Lt = L - (L.n) n */
static mr_v3
smoothed(const smoothing *s, uint32_t v)
{
	const mr_dyn *d = s->d;
	uint32_t h = d->out[v];
	mr_v3 p = d->p[v], n = { 0, 0, 0 }, l = { 0, 0, 0 };
	double count = 0;

	if (mr_dyn_on_boundary(d, v))
		return p;
	do {
		mr_v3 b = mr_sub(d->p[mr_dyn_to(d, h)], p), c = mr_sub(d->p[mr_dyn_apex(d, h)], p);
		n = mr_add(n, mr_cross(b, c));
		l = mr_add(l, b);
		count++;
		h = mr_dyn_ccw(d, h);
	} while (h != d->out[v]);
	l = mr_mul(1 / count, l);
	n = mr_unit(n);
	return mr_axpy(s->lambda, mr_axpy(-mr_dot(l, n), n, l), p);
}

static void
smooth_body(void *arg, size_t begin, size_t end)
{
	smoothing *s = arg;

	for (uint32_t v = (uint32_t)begin; v < end; v++)
		s->p[v] = s->d->kind[v] == MR_DEAD ? s->d->p[v] : smoothed(s, v);
}

mr_status
mr_wrap_smooth(mr_ctx *ctx, double lambda, bool guarded, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *p = MR_NEW(ctx, d->nv, mr_v3);

	mr_parallel(ctx, d->nv, GRAIN, smooth_body, &(smoothing){ d, lambda, p });
	MR_TRY(move(ctx, guarded, p, d));
	mr_mark_release(ctx, mark);
	return MR_OK;
}
