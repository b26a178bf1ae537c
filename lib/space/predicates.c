/*
 * Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
 * Predicates (1997): expansions, sums of doubles that do not overlap, smallest
 * first.  Only the first filter is taken from the paper's adaptive scheme; where
 * it fails the determinant is evaluated exactly.
 */
#include "space/predicates.h"

#include <float.h>

/* Largest expansions: a difference has 2 terms, a product of two 8, a minor 16, times a difference 64, three
 * of them 192. */
enum { DIFFERENCE = 2, PRODUCT = 8, MINOR = 16, TERM = 64, DETERMINANT = 192 };

static const double EPSILON = DBL_EPSILON / 2;

static int
sign(double x)
{
	return (x > 0) - (x < 0);
}

/* a + b = *high + *low */
static void
two_sum(double a, double b, double *high, double *low)
{
	double x = a + b, bv = x - a, av = x - bv;

	*low = (a - av) + (b - bv);
	*high = x;
}

static void
halves(double a, double *high, double *low)
{
	double c = 134217729.0 * a; /* 2^27 + 1 */

	*high = c - (c - a);
	*low = a - *high;
}

/* a b = *high + *low */
static void
two_product(double a, double b, double *high, double *low)
{
	double x = a * b, ah, al, bh, bl;

	halves(a, &ah, &al);
	halves(b, &bh, &bl);
	*low = al * bl - (((x - ah * bh) - al * bh) - ah * bl);
	*high = x;
}

/* h = e + b for one double; returns the terms of h, zeros left out.  h may be e, with room for one more. */
static int
grow(int n, const double *e, double b, double *h)
{
	double q = b, low;
	int m = 0;

	for (int i = 0; i < n; i++) {
		two_sum(q, e[i], &q, &low);
		if (low != 0)
			h[m++] = low;
	}
	if (q != 0)
		h[m++] = q;
	return m;
}

/* e += f; e has room for both */
static int
add(int n, double *e, int m, const double *f)
{
	for (int i = 0; i < m; i++)
		n = grow(n, e, f[i], e);
	return n;
}

/* h = e b: at most 2 n terms */
static int
scale(int n, const double *e, double b, double *h)
{
	int m = 0;

	for (int i = 0; i < n; i++) {
		double high, low;
		two_product(e[i], b, &high, &low);
		m = grow(m, h, low, h);
		m = grow(m, h, high, h);
	}
	return m;
}

/* h = e f: at most 2 n m terms */
static int
multiply(int n, const double *e, int m, const double *f, double *h)
{
	double part[MINOR * 2];
	int count = 0;

	for (int i = 0; i < m; i++)
		count = add(count, h, scale(n, e, f[i], part), part);
	return count;
}

/* An exact difference of two doubles. */
typedef struct difference {
	double e[DIFFERENCE];
	int n;
} difference;

static difference
subtract(double a, double b)
{
	double high, low;
	difference d = { { 0, 0 }, 0 };

	two_sum(a, -b, &high, &low);
	if (low != 0)
		d.e[d.n++] = low;
	if (high != 0)
		d.e[d.n++] = high;
	return d;
}

/* h = a d - b c */
static int
minor(const difference *a, const difference *b, const difference *c, const difference *d, double h[MINOR])
{
	double right[PRODUCT];
	int n = multiply(a->n, a->e, d->n, d->e, h), m = multiply(b->n, b->e, c->n, c->e, right);

	for (int i = 0; i < m; i++)
		right[i] = -right[i];
	return add(n, h, m, right);
}

static int
exact3d(mr_v3 a, mr_v3 b, mr_v3 c, mr_v3 d)
{
	difference x[3] = { subtract(a.x, d.x), subtract(b.x, d.x), subtract(c.x, d.x) };
	difference y[3] = { subtract(a.y, d.y), subtract(b.y, d.y), subtract(c.y, d.y) };
	difference z[3] = { subtract(a.z, d.z), subtract(b.z, d.z), subtract(c.z, d.z) };
	double sum[DETERMINANT], xy[MINOR], term[TERM];
	int n = 0;

	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3, k = (i + 2) % 3;
		int m = minor(&x[j], &x[k], &y[j], &y[k], xy);
		n = add(n, sum, multiply(m, xy, z[i].n, z[i].e, term), term);
	}
	return n ? -sign(sum[n - 1]) : 0; /* the largest term of an expansion has its sign */
}

bool
mr_orient3d_is_plain(mr_v3 a, mr_v3 b, mr_v3 c, mr_v3 d, int *side)
{
	mr_v3 u = mr_sub(a, d), v = mr_sub(b, d), w = mr_sub(c, d);
	double vxwy = v.x * w.y, wxvy = w.x * v.y, wxuy = w.x * u.y, uxwy = u.x * w.y, uxvy = u.x * v.y,
	       vxuy = v.x * u.y;
	double det = u.z * (vxwy - wxvy) + v.z * (wxuy - uxwy) + w.z * (uxvy - vxuy);
	double permanent = (fabs(vxwy) + fabs(wxvy)) * fabs(u.z) + (fabs(wxuy) + fabs(uxwy)) * fabs(v.z) +
	                   (fabs(uxvy) + fabs(vxuy)) * fabs(w.z);
	double bound = (7 + 56 * EPSILON) * EPSILON * permanent;

	*side = -sign(det);
	return det > bound || -det > bound;
}

int
mr_orient3d(mr_v3 a, mr_v3 b, mr_v3 c, mr_v3 d)
{
	int side;

	return mr_orient3d_is_plain(a, b, c, d, &side) ? side : exact3d(a, b, c, d);
}

/* The volume over the triangle, of a top above one corner. */
int
mr_orient2d(mr_v3 a, mr_v3 b, mr_v3 c, int dropped)
{
	mr_v3 p[3] = { a, b, c }, top;

	for (int i = 0; i < 3; i++)
		*(dropped == 0 ? &p[i].x : dropped == 1 ? &p[i].y : &p[i].z) = 0;
	top = p[2];
	*(dropped == 0 ? &top.x : dropped == 1 ? &top.y : &top.z) = 1;
	return mr_orient3d(p[0], p[1], p[2], top);
}
