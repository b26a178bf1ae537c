/* The two steps of the paper, section 3.1.1; and the last steps, near the points: both at once, along
 * normals. */
#include "base/parallel.h"
#include "mesh/guarded_move.h"
#include "wrap/parts.h"

enum { GRAIN = 1024, NEAREST = 5 };

/* Height over longest edge of a face that would soon have no normal. */
static const double SLIVER = 0.02;

typedef struct step {
	const mr_dyn *d;
	double alpha, lambda;
	const mr_wrap_cloud *cloud;
	const uint32_t *nearest; /* NEAREST of each vertex; NULL: the points do not count */
	mr_v3 *to;
} step;

/* The mean level of sparse points is not the surface's, and over a hole there is none. */
static double
trust(const step *s, uint32_t v)
{
	double near = mr_dist(s->cloud->p[s->nearest[v * NEAREST]], s->d->p[v]) / (2 * s->cloud->spacing);

	return near > 1 ? 1 / (near * near) : 1;
}

/* How far to the mean level of the nearest points along n, by the weights 1 / (d^2 + s^2 / 16), s the
 * sampling distance. */
static double
level(const step *s, uint32_t v, mr_v3 n)
{
	double weights = 0, least = s->cloud->spacing * s->cloud->spacing / 16;
	mr_v3 to = { 0, 0, 0 };

	for (size_t i = 0; i < NEAREST && s->nearest[v * NEAREST + i] != MR_NONE; i++) {
		mr_v3 x = mr_sub(s->cloud->p[s->nearest[v * NEAREST + i]], s->d->p[v]);
		double w = 1 / (mr_norm2(x) + least);
		to = mr_axpy(w, x, to);
		weights += w;
	}
	return trust(s, v) * mr_dot(to, n) / weights;
}

/* v + lambda Lt + alpha of the way to the points' level: L = mean_j(v_j) - v over the ring, Lt = L - (L.n) n.
 * A boundary is not drawn in. */
static mr_v3
target(const step *s, uint32_t v)
{
	const mr_dyn *d = s->d;
	uint32_t h = d->out[v];
	mr_v3 p = d->p[v], n = { 0, 0, 0 }, l = { 0, 0, 0 };
	double count = 0;

	do {
		mr_v3 b = mr_sub(d->p[mr_dyn_to(d, h)], p), c = mr_sub(d->p[mr_dyn_apex(d, h)], p);
		n = mr_add(n, mr_cross(b, c));
		l = mr_add(l, b);
		count++;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	n = mr_unit(n);
	l = mr_mul(1 / count, l);
	if (h != MR_NONE)
		p = mr_axpy(s->lambda, mr_axpy(-mr_dot(l, n), n, l), p);
	return s->nearest ? mr_axpy(s->alpha * level(s, v, n), n, p) : p;
}

static void
target_body(void *arg, size_t begin, size_t end)
{
	step *s = arg;

	for (uint32_t v = (uint32_t)begin; v < end; v++)
		s->to[v] = s->d->kind[v] == MR_DEAD ? s->d->p[v] : target(s, v);
}

/* Moves d's vertices to `to`; guarded: but those that would turn a face. */
static mr_status
move(mr_ctx *ctx, bool guarded, mr_v3 *to, mr_dyn *d)
{
	mr_mesh m = mr_dyn_view(d, "control");

	if (guarded)
		MR_TRY(mr_move_unfolded(ctx, &m, &(mr_topology){ d->twin, d->out }, SLIVER, to));
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

mr_status
mr_wrap_smooth(mr_ctx *ctx, double lambda, bool guarded, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	step s = { .d = d, .lambda = lambda, .to = MR_NEW(ctx, d->nv, mr_v3) };

	mr_parallel(ctx, d->nv, GRAIN, target_body, &s);
	MR_TRY(move(ctx, guarded, s.to, d));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_wrap_settle(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, size_t iterations, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *nearest = MR_NEW(ctx, d->nv * NEAREST, uint32_t);
	step s = { d, o->alpha, o->lambda, cloud, nearest, MR_NEW(ctx, d->nv, mr_v3) };

	for (size_t i = 0; i < iterations; i++) {
		MR_TRY(mr_near_query(ctx, cloud->near, d->p, d->nv, NEAREST, nearest, NULL));
		mr_parallel(ctx, d->nv, GRAIN, target_body, &s);
		MR_TRY(move(ctx, true, s.to, d));
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
