/* Lengths by the largest curvature at each vertex, then sweeps over the faces that bound how fast they grow.
 */
#include "remesh/sizing.h"

#include "op/laplace.h"
#include "op/voronoi_area.h"

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

static void
mark_boundary(const mr_mesh *m, const mr_topology *topo, double *length)
{
	for (uint32_t h = 0; h < 3 * m->nf; h++)
		if (topo->twin[h] == MR_NONE)
			length[mr_he_from(m, h)] = length[mr_he_to(m, h)] = INFINITY;
}

/* Where b may be at most, given a. */
static bool
limit(const mr_mesh *m, double *length, uint32_t a, uint32_t b)
{
	double most = length[a] + 0.5 * mr_dist(m->p[a], m->p[b]);

	if (!(length[b] > most))
		return false;
	length[b] = most;
	return true;
}

/* Sweeps over the faces until no length grows too fast: lengths only fall, so it ends. */
static void
grade(const mr_mesh *m, double *length)
{
	bool changed;

	do {
		changed = false;
		for (size_t f = 0; f < m->nf; f++)
			for (int k = 0; k < 3; k++) {
				uint32_t a = m->t[f].v[k], b = m->t[f].v[(k + 1) % 3];
				changed |= limit(m, length, a, b);
				changed |= limit(m, length, b, a);
			}
	} while (changed);
}

mr_status
mr_sizing_field(mr_ctx *ctx, const mr_mesh *m, double error, double shortest, double longest, double *length)
{
	mr_mark mark = mr_mark_take(ctx);
	sums s = { MR_NEW_ZERO(ctx, m->nv, mr_v3), MR_NEW_ZERO(ctx, m->nv, double),
		MR_NEW(ctx, m->nv, double) };
	mr_topology topo;

	if (!s.laplacian || !s.angle || !s.area)
		return MR_EMEM;
	MR_TRY(mr_topology_build(ctx, m, &topo));
	MR_TRY(mr_voronoi_areas(ctx, m, s.area));
	for (size_t f = 0; f < m->nf; f++)
		add_face(m, f, &s);
	for (size_t v = 0; v < m->nv; v++) {
		double squared = 6 * error / curvature(&s, v) - 3 * error * error;
		length[v] = squared > shortest * shortest ? fmin(sqrt(squared), longest) : shortest;
	}
	mark_boundary(m, &topo, length);
	grade(m, length);
	for (size_t v = 0; v < m->nv; v++)
		length[v] = fmin(length[v], longest); /* where the boundary is all there is */
	mr_mark_release(ctx, mark);
	return MR_OK;
}
