/* Control meshes for points: of how many faces, and what errors on parts weigh by how densely points lie
 * there. */
#include "simplify/simplify.h"
#include "space/near.h"

enum { ROUNDS = 4, ENOUGH = 2 /* points a vertex */ };

/*
 * Faces by the points, but at least so many as follow limbs and handles, or one for every so many points
 * where that is less; and never fewer than an icosahedron has: the limit surface of those is small within
 * them, and a fit to points as few would have to blow them up.
 */
enum { POINTS_A_FACE = 32, LIMBS = 300, LEAST_POINTS_A_FACE = 4, ROUND = 20 };
/* The faces that a thin or jagged surface may have. */
enum { MOST_POINTS_A_FACE = 8 };

/* Densities beyond these shares of the mean are cut off: gaps and outliers are no surface. */
static const double LEAST = 0.1, MOST = 10;

/* Sums at vertices become means over the faces around, round after round. */
static void
spread(mr_ctx *ctx, const mr_mesh *m, double *sum)
{
	mr_mark mark = mr_mark_take(ctx);
	double *to = MR_NEW(ctx, m->nv, double), *faces = MR_NEW_ZERO(ctx, m->nv, double);

	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++)
			faces[m->t[f].v[k]] += 3;
	for (int round = 0; round < ROUNDS; round++) {
		memset(to, 0, m->nv * sizeof *to);
		for (size_t f = 0; f < m->nf; f++) {
			const uint32_t *v = m->t[f].v;
			double all = sum[v[0]] + sum[v[1]] + sum[v[2]];
			for (int k = 0; k < 3; k++)
				to[v[k]] += all / faces[v[k]];
		}
		memcpy(sum, to, m->nv * sizeof *to);
	}
	mr_mark_release(ctx, mark);
}

/* How many of n points, or of enough of them at equal strides, are nearest to each vertex; *used: of how
 * many. */
static mr_status
count_points(mr_ctx *ctx, const mr_mesh *m, const mr_v3 *point, size_t n, double *count, size_t *used)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t some = n < ENOUGH * m->nv ? n : ENOUGH * m->nv;
	uint32_t *nearest = MR_NEW(ctx, some, uint32_t);
	mr_v3 *q = MR_NEW(ctx, some, mr_v3);

	mr_at_strides(point, n, some, q);
	MR_TRY(mr_near_once(ctx, m->p, m->nv, q, some, 1, nearest, NULL));
	for (size_t i = 0; i < some; i++)
		count[nearest[i]]++;
	*used = some;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static size_t
least_faces(size_t n)
{
	size_t least = n / LEAST_POINTS_A_FACE;

	return least < ROUND ? ROUND : least < LIMBS ? least : LIMBS;
}

size_t
mr_simplify_faces_for(mr_ctx *ctx, size_t n)
{
	size_t count = n / POINTS_A_FACE, least = least_faces(n);

	if (count >= least)
		return count;
	mr_note(ctx, "%zu faces for %zu points, as one for every %d would be too few", least, n,
	    (int)POINTS_A_FACE);
	return least;
}

size_t
mr_simplify_most_faces_for(size_t n)
{
	size_t most = n / MOST_POINTS_A_FACE, least = least_faces(n);

	return most > least ? most : least;
}

mr_status
mr_simplify_weigh(mr_ctx *ctx, const mr_mesh *m, const mr_v3 *point, size_t n, double *weight)
{
	mr_mark mark = mr_mark_take(ctx);
	double *count = MR_NEW_ZERO(ctx, m->nv, double), *area = MR_NEW_ZERO(ctx, m->nv, double), all = 0;
	size_t used;

	MR_TRY(count_points(ctx, m, point, n, count, &used));
	for (size_t f = 0; f < m->nf; f++) {
		double third = mr_norm(mr_face_cross(m, f)) / 6;
		all += 3 * third;
		for (int k = 0; k < 3; k++)
			area[m->t[f].v[k]] += third;
	}
	spread(ctx, m, count);
	spread(ctx, m, area);
	for (size_t v = 0; v < m->nv; v++) {
		double density = area[v] > 0 ? count[v] * all / (area[v] * (double)used) : 1;
		weight[v] = fmin(fmax(density, LEAST), MOST);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
