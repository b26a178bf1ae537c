/* Lengths by the largest curvature at each vertex, then bounds on how fast they grow. */
#include "remesh/sizing.h"

#include "base/priority_queue.h"
#include "op/laplace.h"
#include "op/voronoi_area.h"
#include "space/bvh.h"

typedef struct sums {
	mr_v3 *laplacian; /* sum_j w_ij (p_j - p_i) */
	double *angle;    /* of the faces at the vertex */
	double *area;
} sums;

static void
add_face(const mr_mesh *m, size_t f, sums *s)
{
	const uint32_t *v = m->t[f].v;
	mr_v3 p[3] = { m->p[v[0]], m->p[v[1]], m->p[v[2]] };
	double cot[3];

	mr_cotangents(p[0], p[1], p[2], cot);
	for (int k = 0; k < 3; k++) {
		int i = (k + 1) % 3, j = (k + 2) % 3;
		mr_v3 e = mr_mul(cot[k] / 2, mr_sub(p[j], p[i]));
		s->laplacian[v[i]] = mr_add(s->laplacian[v[i]], e);
		s->laplacian[v[j]] = mr_sub(s->laplacian[v[j]], e);
		s->angle[v[k]] += mr_angle(mr_sub(p[i], p[k]), mr_sub(p[j], p[k]));
	}
}

/* max |kappa| = |H| + sqrt(H^2 - K) */
static double
curvature(const sums *s, size_t v)
{
	double h, k;

	if (!(s->area[v] > 0))
		return 0;
	h = mr_norm(s->laplacian[v]) / (2 * s->area[v]);
	k = (2 * MR_PI - s->angle[v]) / s->area[v];
	return h + sqrt(h * h > k ? h * h - k : 0);
}

/* The angle by which the curve through v turns over the length of an edge. */
static double
curvature_along(const mr_dyn *d, uint32_t v)
{
	uint32_t end[2];
	mr_v3 in, out;

	mr_dyn_along(d, v, end);
	in = mr_sub(d->p[v], d->p[end[0]]);
	out = mr_sub(d->p[end[1]], d->p[v]);
	return 2 * mr_angle(in, out) / (mr_norm(in) + mr_norm(out));
}

/* Corners stay whatever the lengths. */
static double
largest_curvature(const mr_dyn *d, const sums *s, uint32_t v)
{
	switch ((mr_kind)d->kind[v]) {
	case MR_SMOOTH:
		return curvature(s, v);
	case MR_CURVE:
		return curvature_along(d, v);
	case MR_CORNER:
	case MR_DEAD:
		break;
	}
	return 0;
}

/* The bound of b, given a. */
static bool
limit(const mr_mesh *m, double *length, uint32_t a, uint32_t b)
{
	double most = length[a] + 0.5 * mr_dist(m->p[a], m->p[b]);

	if (!(length[b] > most))
		return false;
	length[b] = most;
	return true;
}

typedef struct front {
	double length;
	uint32_t v;
} front;

static bool
is_before(const void *a, const void *b)
{
	const front *x = a, *y = b;

	return x->length < y->length || (x->length == y->length && x->v < y->v);
}

typedef struct grader {
	mr_ctx *ctx;
	const mr_mesh *m;
	double *length;
	front *queue;
	size_t n, room;
} grader;

static void
put(grader *w, uint32_t v)
{
	MR_RESERVE(w->ctx, w->queue, w->n, 1, &w->room);
	mr_queue_push(w->queue, w->n++, sizeof *w->queue, &(front){ w->length[v], v }, is_before);
}

/* Lengths grow along edges from the shortest on, each vertex's once and for all (Dijkstra 1959). */
void
mr_sizing_grade(mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, double *length)
{
	grader w = { .ctx = ctx, .m = m, .length = length };

	for (uint32_t v = 0; v < m->nv; v++)
		if (topo->out[v] != MR_NONE)
			put(&w, v);
	while (w.n > 0) {
		front f;
		uint32_t h;
		mr_queue_pop(w.queue, w.n--, sizeof f, &f, is_before);
		if (f.length > length[f.v])
			continue;
		h = topo->out[f.v];
		do {
			uint32_t side[2] = { mr_he_to(m, h), mr_he_from(m, mr_he_prev(h)) };
			for (int i = 0; i < 2; i++)
				if (limit(m, length, f.v, side[i]))
					put(&w, side[i]);
			h = mr_he_ccw(topo, h);
		} while (h != MR_NONE && h != topo->out[f.v]);
	}
}

/* The length of an edge whose middle is `error` away from an arc of that curvature. */
static double
length_for(double curvature, double error, double shortest, double longest)
{
	double squared = 6 * error / curvature - 3 * error * error;

	return squared > shortest * shortest ? fmin(sqrt(squared), longest) : shortest;
}

/* Relative to the uniform length; without it some edges sharper than 40 degrees are lost. */
static const double OFF = 0.125, SHORTEST = 1.0 / 8;

void
mr_sizing_curves(
    mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, const mr_dyn *d, double uniform, double **length)
{
	double *own = MR_NEW(ctx, m->nv, double);
	bool shorter = false;

	for (uint32_t v = 0; v < m->nv; v++) {
		bool sharp = d->kind[v] == MR_CURVE && !mr_dyn_on_boundary(d, v);
		own[v] = !sharp
		             ? uniform
		             : length_for(curvature_along(d, v), OFF * uniform, SHORTEST * uniform, uniform);
		shorter |= own[v] < uniform;
	}
	if (shorter)
		mr_sizing_grade(ctx, m, topo, own);
	*length = shorter ? own : NULL;
}

void
mr_sizing_field(mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, const mr_dyn *d, double error,
    double shortest, double longest, double *length)
{
	MR_SCOPE(ctx);
	sums s = { MR_NEW_ZERO(ctx, m->nv, mr_v3), MR_NEW_ZERO(ctx, m->nv, double),
		MR_NEW(ctx, m->nv, double) };

	mr_voronoi_areas(ctx, m, s.area);
	for (size_t f = 0; f < m->nf; f++)
		add_face(m, f, &s);
	for (uint32_t v = 0; v < m->nv; v++)
		length[v] = length_for(largest_curvature(d, &s, v), error, shortest, longest);
	mr_sizing_grade(ctx, m, topo, length);
}
