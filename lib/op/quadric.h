/* quadric.h -- sums of squared distances to planes (Garland, Heckbert 1997), as functions of the offset from
 * an origin that the holder knows: rounding is relative to the neighbourhood. */
#ifndef MR_OP_QUADRIC_H
#define MR_OP_QUADRIC_H

#include "base/vec.h"

/* Q(x) = x'A x + 2 b'x + c, and how much area has gone into it. */
typedef struct mr_quadric {
	double xx, xy, xz, yy, yz, zz; /* A */
	mr_v3 b;
	double c;
	double area;
} mr_quadric;

/* A x */
static inline mr_v3
mr_quadric_apply(const mr_quadric *q, mr_v3 x)
{
	return mr_vec(q->xx * x.x + q->xy * x.y + q->xz * x.z, q->xy * x.x + q->yy * x.y + q->yz * x.z,
	    q->xz * x.x + q->yz * x.y + q->zz * x.z);
}

/* Q(x), which is not negative but for rounding. */
static inline double
mr_quadric_at(const mr_quadric *q, mr_v3 x)
{
	double y = mr_dot(x, mr_add(mr_quadric_apply(q, x), mr_mul(2, q->b))) + q->c;

	return y > 0 ? y : 0;
}

/* Adds weight times the squared distance to the plane through the origin with unit normal n. */
static inline void
mr_quadric_add_plane(mr_quadric *q, mr_v3 n, double weight)
{
	q->xx += weight * n.x * n.x;
	q->xy += weight * n.x * n.y;
	q->xz += weight * n.x * n.z;
	q->yy += weight * n.y * n.y;
	q->yz += weight * n.y * n.z;
	q->zz += weight * n.z * n.z;
}

/* The same function of the offset from an origin that is d further: Q(d + x). */
static inline mr_quadric
mr_quadric_moved(const mr_quadric *q, mr_v3 d)
{
	mr_v3 ad = mr_quadric_apply(q, d);
	mr_quadric r = *q;

	r.c += mr_dot(d, mr_add(ad, mr_mul(2, q->b)));
	r.b = mr_add(q->b, ad);
	return r;
}

static inline mr_quadric
mr_quadric_sum(const mr_quadric *p, const mr_quadric *q)
{
	return (mr_quadric){ p->xx + q->xx, p->xy + q->xy, p->xz + q->xz, p->yy + q->yy, p->yz + q->yz,
		p->zz + q->zz, mr_add(p->b, q->b), p->c + q->c, p->area + q->area };
}

/* The factor L D L' of A + shift I, shift > 0; i0 to i2 are 1 / D. */
typedef struct mr_quadric_factor {
	double shift, l10, l20, l21, i0, i1, i2;
} mr_quadric_factor;

static inline mr_quadric_factor
mr_quadric_factor_of(const mr_quadric *q, double shift)
{
	mr_quadric_factor f = { .shift = shift, .i0 = 1 / (q->xx + shift) };
	double u;

	f.l10 = q->xy * f.i0;
	f.l20 = q->xz * f.i0;
	f.i1 = 1 / (q->yy + shift - f.l10 * q->xy);
	u = q->yz - f.l10 * q->xz;
	f.l21 = u * f.i1;
	f.i2 = 1 / (q->zz + shift - f.l20 * q->xz - f.l21 * u);
	return f;
}

/* (A + shift I)^-1 r */
static inline mr_v3
mr_quadric_solve(const mr_quadric_factor *f, mr_v3 r)
{
	double y = r.y - f->l10 * r.x, z = (r.z - f->l20 * r.x - f->l21 * y) * f->i2;

	y = y * f->i1 - f->l21 * z;
	return mr_vec(r.x * f->i0 - f->l10 * y - f->l20 * z, y, z);
}

#endif
