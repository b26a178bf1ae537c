/* Control meshes for points: of how many faces, and what errors on parts weigh by how densely points lie
 * there. */
#include "simplify/simplify.h"

enum { ROUNDS = 4 };

/*
 * Faces by the points, but at least so many as follow limbs and handles, or one for every so many points
 * where that is less; and never fewer than an icosahedron has: the limit surface of those is small within
 * them, and a fit to points as few would have to blow them up.
 */
enum { POINTS_A_FACE = 32, LIMBS = 300, LEAST_POINTS_A_FACE = 4, ROUND = 20 };
/* With at most 16 points a face level 3 has at most twice as many vertices as there are points; a surface
 * that needs more, thin or jagged, has so many that level 2 has more vertices than points. */
enum { MOST_POINTS_A_FACE = 17, FINE_POINTS_A_FACE = 5 };

/* Densities beyond these shares of the mean are cut off: gaps and outliers are no surface. */
static const double LEAST = 0.1, MOST = 10;

/* Values at vertices become means over the faces around, round after round. */
static void
spread(mr_ctx *ctx, const mr_mesh *m, double *value)
{
	MR_SCOPE(ctx);
	double *sum = MR_NEW(ctx, m->nv, double), *corners = MR_NEW(ctx, m->nv, double);

	for (int round = 0; round < ROUNDS; round++) {
		memset(sum, 0, m->nv * sizeof *sum);
		memset(corners, 0, m->nv * sizeof *corners);
		for (size_t f = 0; f < m->nf; f++) {
			const uint32_t *v = m->t[f].v;
			double all = value[v[0]] + value[v[1]] + value[v[2]];
			for (int k = 0; k < 3; k++) {
				sum[v[k]] += all;
				corners[v[k]] += 3;
			}
		}
		for (size_t v = 0; v < m->nv; v++)
			value[v] = corners[v] > 0 ? sum[v] / corners[v] : 1;
	}
}

static size_t
least_faces(size_t n)
{
	size_t least = n / LEAST_POINTS_A_FACE;

	return least < ROUND ? ROUND : least < LIMBS ? least : LIMBS;
}

static size_t
one_face_for(size_t points, size_t n)
{
	size_t count = n / points, least = least_faces(n);

	return count > least ? count : least;
}

size_t
mr_simplify_faces_for(size_t n)
{
	return one_face_for(POINTS_A_FACE, n);
}

size_t
mr_simplify_most_faces_for(size_t n)
{
	return one_face_for(MOST_POINTS_A_FACE, n);
}

size_t
mr_simplify_fine_faces_for(size_t n)
{
	return one_face_for(FINE_POINTS_A_FACE, n);
}

mr_status
mr_simplify_weigh(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, double *weight)
{
	MR_SCOPE(ctx);
	const mr_sampling *s = &c->sampling;
	uint32_t *nearest = MR_NEW(ctx, m->nv, uint32_t);
	double mean = s->area / (double)(s->places - s->outliers);

	MR_TRY(mr_near_query(ctx, c->near, m->p, m->nv, 1, nearest, NULL));
	for (size_t v = 0; v < m->nv; v++) {
		double own = s->spacing[nearest[v]];
		weight[v] = own > 0 ? fmin(fmax(mean / (own * own), LEAST), MOST) : 1;
	}
	spread(ctx, m, weight);
	return MR_OK;
}
