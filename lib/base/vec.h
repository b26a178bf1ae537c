/* vec.h -- vectors of three doubles, boxes, and affine maps. */
#ifndef MR_BASE_VEC_H
#define MR_BASE_VEC_H

#include "base/ctx.h"

#include <math.h>

/* An affine map: 3x4, row-major, acting on (x, y, z, 1). */
typedef struct mr_affine {
	double m[12];
} mr_affine;

static const double MR_PI = 3.14159265358979323846;

static inline mr_v3
mr_vec(double x, double y, double z)
{
	return (mr_v3){ x, y, z };
}

/* x, y or z: k is 0, 1 or 2. */
static inline double
mr_coordinate(mr_v3 p, int k)
{
	return k == 0 ? p.x : k == 1 ? p.y : p.z;
}

/* Which coordinate is the largest: the first of equal ones. */
static inline int
mr_largest(mr_v3 p)
{
	return p.x >= p.y && p.x >= p.z ? 0 : p.y >= p.z ? 1 : 2;
}

static inline mr_v3
mr_add(mr_v3 a, mr_v3 b)
{
	return (mr_v3){ a.x + b.x, a.y + b.y, a.z + b.z };
}

/* a + by; adding nothing keeps every bit, the sign of a zero too. */
static inline mr_v3
mr_moved(mr_v3 a, mr_v3 by)
{
	return (mr_v3){ by.x == 0 ? a.x : a.x + by.x, by.y == 0 ? a.y : a.y + by.y,
		by.z == 0 ? a.z : a.z + by.z };
}

static inline mr_v3
mr_sub(mr_v3 a, mr_v3 b)
{
	return (mr_v3){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline mr_v3
mr_mul(double s, mr_v3 a)
{
	return (mr_v3){ s * a.x, s * a.y, s * a.z };
}

/* y + s a */
static inline mr_v3
mr_axpy(double s, mr_v3 a, mr_v3 y)
{
	return (mr_v3){ y.x + s * a.x, y.y + s * a.y, y.z + s * a.z };
}

static inline double
mr_dot(mr_v3 a, mr_v3 b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline mr_v3
mr_cross(mr_v3 a, mr_v3 b)
{
	return (mr_v3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline double
mr_norm2(mr_v3 a)
{
	return mr_dot(a, a);
}

static inline double
mr_norm(mr_v3 a)
{
	return sqrt(mr_dot(a, a));
}

static inline double
mr_dist(mr_v3 a, mr_v3 b)
{
	return mr_norm(mr_sub(a, b));
}

/* The angle between a and b, in radians; 0 where either is zero. */
static inline double
mr_angle(mr_v3 a, mr_v3 b)
{
	return atan2(mr_norm(mr_cross(a, b)), mr_dot(a, b));
}

/* a / |a|; the zero vector stays zero. */
static inline mr_v3
mr_unit(mr_v3 a)
{
	double n = mr_norm(a);
	return n > 0 ? mr_mul(1 / n, a) : a;
}

static inline mr_v3
mr_lerp(double t, mr_v3 a, mr_v3 b)
{
	return mr_axpy(t, mr_sub(b, a), a);
}

/* Whether p parts the segment a b into two that are both shorter: not where rounding puts it on an end. */
static inline bool
mr_divides(mr_v3 p, mr_v3 a, mr_v3 b)
{
	double whole2 = mr_norm2(mr_sub(b, a));

	return mr_norm2(mr_sub(p, a)) < whole2 && mr_norm2(mr_sub(p, b)) < whole2;
}

static inline mr_v3
mr_mean3(mr_v3 a, mr_v3 b, mr_v3 c)
{
	return mr_mul(1.0 / 3, mr_add(a, mr_add(b, c)));
}

/* Whether barycentric coordinates lie within a triangle, but for rounding. */
static inline bool
mr_bary_within(mr_v3 w)
{
	const double rounding = 1e-6;

	return w.x >= -rounding && w.y >= -rounding && w.z >= -rounding &&
	       fabs(w.x + w.y + w.z - 1) <= rounding;
}

/* The point with barycentric coordinates w over the triangle a b c. */
static inline mr_v3
mr_bary_point(mr_v3 w, mr_v3 a, mr_v3 b, mr_v3 c)
{
	return mr_axpy(w.x, a, mr_axpy(w.y, b, mr_mul(w.z, c)));
}

static inline bool
mr_finite(mr_v3 a)
{
	return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

/* The first of n numbers that is not finite; n: all are.  Looked at by their exponents, so that it costs
 * little where nothing is wrong. */
static inline size_t
mr_first_infinite(const double *x, size_t n)
{
	uint64_t seen = 0, bits;
	size_t first = 0;

	for (size_t i = 0; i < n; i++) {
		memcpy(&bits, x + i, sizeof bits);
		seen |= (bits & (uint64_t)0x7ff << 52) + ((uint64_t)1 << 52);
	}
	if (!(seen >> 63))
		return n;
	while (isfinite(x[first]))
		first++;
	return first;
}

/* T a */
static inline mr_v3
mr_apply(const mr_affine *t, mr_v3 a)
{
	const double *m = t->m;
	return (mr_v3){ m[0] * a.x + m[1] * a.y + m[2] * a.z + m[3],
		m[4] * a.x + m[5] * a.y + m[6] * a.z + m[7], m[8] * a.x + m[9] * a.y + m[10] * a.z + m[11] };
}

static inline mr_affine
mr_identity(void)
{
	return (mr_affine){ { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 } };
}

static inline bool
mr_is_identity(const mr_affine *a)
{
	const mr_affine identity = mr_identity();

	for (int i = 0; i < 12; i++)
		if (a->m[i] != identity.m[i])
			return false;
	return true;
}

/* a after b: the map x -> a(b(x)) */
static inline mr_affine
mr_compose(const mr_affine *a, const mr_affine *b)
{
	mr_affine c;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 4; j++)
			c.m[4 * i + j] = a->m[4 * i] * b->m[j] + a->m[4 * i + 1] * b->m[4 + j] +
			                 a->m[4 * i + 2] * b->m[8 + j] + (j == 3 ? a->m[4 * i + 3] : 0);
	return c;
}

/* `some` of the n points p, some <= n, at equal strides. */
static inline void
mr_at_strides(const mr_v3 *p, size_t n, size_t some, mr_v3 *q)
{
	for (size_t i = 0; i < some; i++)
		q[i] = p[i * n / some];
}

static inline mr_box
mr_box_empty(void)
{
	return (mr_box){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
}

static inline void
mr_box_add(mr_box *b, mr_v3 p)
{
	b->min = mr_vec(p.x < b->min.x ? p.x : b->min.x, p.y < b->min.y ? p.y : b->min.y,
	    p.z < b->min.z ? p.z : b->min.z);
	b->max = mr_vec(p.x > b->max.x ? p.x : b->max.x, p.y > b->max.y ? p.y : b->max.y,
	    p.z > b->max.z ? p.z : b->max.z);
}

/* The bounding box of n points; empty (min > max) for none. */
static inline mr_box
mr_box_of(const mr_v3 *p, size_t n)
{
	mr_box b = mr_box_empty();
	for (size_t i = 0; i < n; i++)
		mr_box_add(&b, p[i]);
	return b;
}

/* Length of the diagonal; 0 for an empty box. */
static inline double
mr_box_diagonal(mr_box b)
{
	return b.min.x <= b.max.x ? mr_dist(b.min, b.max) : 0;
}

/* The largest size of a coordinate. */
static inline double
mr_box_largest(mr_box b)
{
	return fmax(fmax(-b.min.x, fmax(-b.min.y, -b.min.z)), fmax(b.max.x, fmax(b.max.y, b.max.z)));
}

/* How far apart doubles of that size are. */
static inline double
mr_box_grain(mr_box b)
{
	double largest = mr_box_largest(b);

	return nextafter(largest, INFINITY) - largest;
}

/* A share of the diagonal, or what a few operations round in there, if that is more. */
static inline double
mr_box_tolerance(mr_box b, double share)
{
	const double operations = 16;

	return fmax(share * mr_box_diagonal(b), operations * mr_box_grain(b));
}

static inline double
mr_square(double x)
{
	return x * x;
}

/* A hash of the bits of n numbers. */
static inline size_t
mr_hash_reals(const double *x, size_t n)
{
	uint64_t bits, h = 0;

	for (size_t k = 0; k < n; k++) {
		memcpy(&bits, x + k, sizeof bits);
		h = (h ^ bits) * 0x9e3779b97f4a7c15u;
		h ^= h >> 32;
	}
	return (size_t)h;
}

#endif
