/* rotation.h -- 3x3 matrices, rotations, and their logarithms: vectors along the axis, as long as the angle.
 */
#ifndef MR_BASE_ROTATION_H
#define MR_BASE_ROTATION_H

#include "base/vec.h"

/* Row-major. */
typedef struct mr_mat3 {
	double m[9];
} mr_mat3;

static inline mr_mat3
mr_mat3_identity(void)
{
	return (mr_mat3){ { 1, 0, 0, 0, 1, 0, 0, 0, 1 } };
}

static inline mr_v3
mr_mat3_apply(const mr_mat3 *a, mr_v3 x)
{
	const double *m = a->m;
	return (mr_v3){ m[0] * x.x + m[1] * x.y + m[2] * x.z, m[3] * x.x + m[4] * x.y + m[5] * x.z,
		m[6] * x.x + m[7] * x.y + m[8] * x.z };
}

/* a b */
static inline mr_mat3
mr_mat3_multiply(const mr_mat3 *a, const mr_mat3 *b)
{
	mr_mat3 c;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			c.m[3 * i + j] = a->m[3 * i] * b->m[j] + a->m[3 * i + 1] * b->m[3 + j] +
			                 a->m[3 * i + 2] * b->m[6 + j];
	return c;
}

/* a^T b */
static inline mr_mat3
mr_mat3_multiply_transposed(const mr_mat3 *a, const mr_mat3 *b)
{
	mr_mat3 c;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			c.m[3 * i + j] = a->m[i] * b->m[j] + a->m[3 + i] * b->m[3 + j] +
			                 a->m[6 + i] * b->m[6 + j];
	return c;
}

/* y + s a */
static inline mr_mat3
mr_mat3_axpy(double s, const mr_mat3 *a, const mr_mat3 *y)
{
	mr_mat3 c;
	for (int i = 0; i < 9; i++)
		c.m[i] = y->m[i] + s * a->m[i];
	return c;
}

static inline double
mr_mat3_determinant(const mr_mat3 *a)
{
	const double *m = a->m;
	return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
	       m[2] * (m[3] * m[7] - m[4] * m[6]);
}

/* a + s y x^T */
static inline void
mr_mat3_add_product(mr_mat3 *a, double s, mr_v3 y, mr_v3 x)
{
	const double from[3] = { x.x, x.y, x.z }, to[3] = { y.x, y.y, y.z };

	for (int i = 0; i < 9; i++)
		a->m[i] += s * (to[i / 3] * from[i % 3]);
}

/* A^-T, by the cofactors. */
static inline mr_mat3
mr_mat3_inverse_transposed(const mr_mat3 *a)
{
	const double *m = a->m, det = mr_mat3_determinant(a);
	mr_mat3 c;

	for (int i = 0; i < 9; i++) {
		int p = (i / 3 + 1) % 3 * 3, q = (i / 3 + 2) % 3 * 3, d = (i + 1) % 3, e = (i + 2) % 3;
		c.m[i] = (m[p + d] * m[q + e] - m[p + e] * m[q + d]) / det;
	}
	return c;
}

/* The linear part of an affine map. */
static inline mr_mat3
mr_affine_linear(const mr_affine *t)
{
	const double *m = t->m;
	return (mr_mat3){ { m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10] } };
}

/* The rotation about w by |w| radians; the identity exactly for w = 0. */
mr_mat3 mr_rotation_exp(mr_v3 w);

/* The rotation R with the largest tr(R^T A), which is the nearest to A: never a reflection, and one of the
 * best where there are several. */
mr_mat3 mr_rotation_nearest(const mr_mat3 *a);

/* The logarithm w of that rotation that is nearest to `near`: so full turns are not lost. */
mr_v3 mr_rotation_log(const mr_mat3 *a, mr_v3 near);

#endif
