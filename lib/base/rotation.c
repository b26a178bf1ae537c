/* Rodrigues' formula, and the nearest rotation by quaternions: Horn 1987, Closed-form solution of absolute
 * orientation using unit quaternions. */
#include "base/rotation.h"

mr_mat3
mr_rotation_exp(mr_v3 w)
{
	double angle = mr_norm(w), half, a, b; /* by sine and cosine of one angle, which come together */
	mr_mat3 r = mr_mat3_identity();

	if (angle == 0)
		return r;
	half = sin(angle / 2) / (angle / 2);
	a = half * cos(angle / 2); /* sin / angle */
	b = half * half / 2;       /* (1 - cos) / angle^2 */
	r.m[0] -= b * (w.y * w.y + w.z * w.z);
	r.m[4] -= b * (w.x * w.x + w.z * w.z);
	r.m[8] -= b * (w.x * w.x + w.y * w.y);
	r.m[1] = b * w.x * w.y - a * w.z;
	r.m[3] = b * w.x * w.y + a * w.z;
	r.m[2] = b * w.x * w.z + a * w.y;
	r.m[6] = b * w.x * w.z - a * w.y;
	r.m[5] = b * w.y * w.z - a * w.x;
	r.m[7] = b * w.y * w.z + a * w.x;
	return r;
}

/* A symmetric matrix: its rows from the diagonal on. */
typedef struct sym4 {
	double a00, a01, a02, a03, a11, a12, a13, a22, a23, a33;
} sym4;

/* Horn's matrix, whose largest eigenvalue is the largest tr(R^T A), shifted to make it the largest by its
 * amount too: the smallest is above -(that + 2 |A| / sqrt 3). */
static sym4
horn(const double m[9])
{
	double sum = 0, shift;

	for (int i = 0; i < 9; i++)
		sum += m[i] * m[i];
	shift = 0.6 * sqrt(sum);
	return (sym4){ m[0] + m[4] + m[8] + shift, m[7] - m[5], m[2] - m[6], m[3] - m[1],
		m[0] - m[4] - m[8] + shift, m[1] + m[3], m[2] + m[6], m[4] - m[0] - m[8] + shift, m[5] + m[7],
		m[8] - m[0] - m[4] + shift };
}

static double
norm2(const sym4 *s)
{
	return s->a00 * s->a00 + s->a11 * s->a11 + s->a22 * s->a22 + s->a33 * s->a33 +
	       2 * (s->a01 * s->a01 + s->a02 * s->a02 + s->a03 * s->a03 + s->a12 * s->a12 + s->a13 * s->a13 +
		       s->a23 * s->a23);
}

/* f s^2 */
static sym4
square(const sym4 *s, double f)
{
	return (sym4){
		f * (s->a00 * s->a00 + s->a01 * s->a01 + s->a02 * s->a02 + s->a03 * s->a03),
		f * (s->a00 * s->a01 + s->a01 * s->a11 + s->a02 * s->a12 + s->a03 * s->a13),
		f * (s->a00 * s->a02 + s->a01 * s->a12 + s->a02 * s->a22 + s->a03 * s->a23),
		f * (s->a00 * s->a03 + s->a01 * s->a13 + s->a02 * s->a23 + s->a03 * s->a33),
		f * (s->a01 * s->a01 + s->a11 * s->a11 + s->a12 * s->a12 + s->a13 * s->a13),
		f * (s->a01 * s->a02 + s->a11 * s->a12 + s->a12 * s->a22 + s->a13 * s->a23),
		f * (s->a01 * s->a03 + s->a11 * s->a13 + s->a12 * s->a23 + s->a13 * s->a33),
		f * (s->a02 * s->a02 + s->a12 * s->a12 + s->a22 * s->a22 + s->a23 * s->a23),
		f * (s->a02 * s->a03 + s->a12 * s->a13 + s->a22 * s->a23 + s->a23 * s->a33),
		f * (s->a03 * s->a03 + s->a13 * s->a13 + s->a23 * s->a23 + s->a33 * s->a33),
	};
}

/* The column of s with the largest diagonal. */
static void
largest_column(const sym4 *s, double q[4])
{
	const double column[4][4] = { { s->a00, s->a01, s->a02, s->a03 }, { s->a01, s->a11, s->a12, s->a13 },
		{ s->a02, s->a12, s->a22, s->a23 }, { s->a03, s->a13, s->a23, s->a33 } };
	int best = 0;

	for (int i = 1; i < 4; i++)
		if (column[i][i] > column[best][best])
			best = i;
	memcpy(q, column[best], sizeof column[best]);
}

/* The unit quaternion (scalar first, not negative) of the nearest rotation: squared again and again, the
 * matrix becomes the projection on its largest eigenvectors, its norm its trace.  Mostly six times do. */
static void
nearest(const double m[9], double q[4])
{
	enum { MOST = 44 };
	static const double one = 1 - 1e-15;
	sym4 s = horn(m);
	double trace = s.a00 + s.a11 + s.a22 + s.a33, length = 0;

	if (!(trace > 0)) {
		q[0] = 1;
		q[1] = q[2] = q[3] = 0;
		return;
	}
	s = square(&s, 1 / (trace * trace));
	for (int i = 0; i < MOST; i++) {
		trace = s.a00 + s.a11 + s.a22 + s.a33;
		if (norm2(&s) >= one * trace * trace)
			break;
		s = square(&s, 1 / (trace * trace));
	}
	largest_column(&s, q);
	for (int i = 0; i < 4; i++)
		length += q[i] * q[i];
	length = copysign(sqrt(length), q[0]);
	for (int i = 0; i < 4; i++)
		q[i] /= length;
}

mr_mat3
mr_rotation_nearest(const mr_mat3 *a)
{
	double q[4], x, y, z, w;

	nearest(a->m, q);
	w = q[0];
	x = q[1];
	y = q[2];
	z = q[3];
	return (mr_mat3){ { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
	    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y),
	    2 * (y * z + w * x), 1 - 2 * (x * x + y * y) } };
}

/* The angle of a rotation as good as none has no axis of its own: whole turns are then about `near`. */
mr_v3
mr_rotation_log(const mr_mat3 *a, mr_v3 near)
{
	static const double none = 1e-6;
	double q[4], angle, turns, sine;
	mr_v3 axis;

	nearest(a->m, q);
	axis = mr_vec(q[1], q[2], q[3]);
	sine = mr_norm(axis);
	angle = 2 * atan2(sine, q[0]);
	if (angle < none)
		return mr_axpy(
		    2 * MR_PI * round(mr_norm(near) / (2 * MR_PI)), mr_unit(near), mr_mul(2, axis));
	axis = mr_mul(1 / sine, axis);
	turns = round((mr_dot(axis, near) - angle) / (2 * MR_PI));
	return mr_mul(angle + 2 * MR_PI * turns, axis);
}
