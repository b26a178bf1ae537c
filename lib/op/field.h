/* field.h -- how far values over a surface are from each face's linear field (Hoppe 1999, with the best
 * values put in), relative to the holder's origin. */
#ifndef MR_OP_FIELD_H
#define MR_OP_FIELD_H

#include "op/quadric.h"

enum { MR_VALUES = 5 };

/* Faces that say value i is g.x + d: the sums of w (g.x + d)^2, of w (g.x + d), and of w. */
typedef struct mr_field {
	mr_quadric squares;
	mr_v3 g[MR_VALUES];
	double d[MR_VALUES], weight;
} mr_field;

/* The gradient of values at the corners of a triangle; false where it has no area, or they are not finite. */
static inline bool
mr_gradient(const mr_v3 p[3], const double x[3], mr_v3 *g)
{
	mr_v3 a = mr_sub(p[1], p[0]), b = mr_sub(p[2], p[0]), n = mr_cross(a, b);
	double n2 = mr_norm2(n), u = x[1] - x[0], v = x[2] - x[0];

	*g = mr_mul(1 / n2, mr_add(mr_mul(u, mr_cross(b, n)), mr_mul(v, mr_cross(n, a))));
	return n2 > 0 && isfinite(x[0] + u + v);
}

/* Adds a face by which value i is d at the origin. */
static inline void
mr_field_add(mr_field *f, size_t i, mr_v3 g, double d, double weight)
{
	mr_quadric_add_plane(&f->squares, g, weight);
	f->squares.b = mr_axpy(weight * d, g, f->squares.b);
	f->squares.c += weight * d * d;
	f->g[i] = mr_axpy(weight, g, f->g[i]);
	f->d[i] += weight * d;
}

static inline mr_field
mr_field_moved(const mr_field *f, mr_v3 by)
{
	mr_field r = *f;

	r.squares = mr_quadric_moved(&f->squares, by);
	for (int i = 0; i < MR_VALUES; i++)
		r.d[i] += mr_dot(f->g[i], by);
	return r;
}

static inline mr_field
mr_field_sum(const mr_field *a, const mr_field *b)
{
	mr_field r = { .squares = mr_quadric_sum(&a->squares, &b->squares), .weight = a->weight + b->weight };

	for (int i = 0; i < MR_VALUES; i++) {
		r.g[i] = mr_add(a->g[i], b->g[i]);
		r.d[i] = a->d[i] + b->d[i];
	}
	return r;
}

/* Adds to q the residual for the best values: the sum of squares minus the means'. */
static inline void
mr_field_rest(const mr_field *f, mr_quadric *q)
{
	if (!(f->weight > 0))
		return;
	*q = mr_quadric_sum(q, &f->squares);
	for (int i = 0; i < MR_VALUES; i++) {
		mr_quadric_add_plane(q, f->g[i], -1 / f->weight);
		q->b = mr_axpy(-f->d[i] / f->weight, f->g[i], q->b);
		q->c -= f->d[i] * f->d[i] / f->weight;
	}
}

#endif
