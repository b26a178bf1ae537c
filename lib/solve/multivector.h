/*
 * multivector.h -- blocks of vectors: n rows of `width` values next to each other, a column for each
 * right-hand side.
 *
 * Contract: sums are taken in pieces of rows, then over the pieces in order: the same for every number of
 * threads.
 */
#ifndef MR_SOLVE_MULTIVECTOR_H
#define MR_SOLVE_MULTIVECTOR_H

#include "base/ctx.h"

#include <math.h>

enum { MR_WIDTH = 4 }; /* columns of a block, at most */

typedef struct mr_multivector {
	size_t n, width;
} mr_multivector;

/* dot[c] = sum over i of a[i, c] b[i, c] */
void mr_multivector_dot(const mr_ctx *ctx, mr_multivector s, const double *a, const double *b, double *dot);

/* y = f[c] x + g[c] y, column by column */
void mr_multivector_add(
    const mr_ctx *ctx, mr_multivector s, const double *f, const double *x, const double *g, double *y);

extern const double MR_ONE[MR_WIDTH];

/* x = x + f[c] p and r = r - f[c] q; rr[c] = sum over i of r[i, c]^2 */
void mr_multivector_step(const mr_ctx *ctx, mr_multivector s, const double *f, const double *p,
    const double *q, double *x, double *r, double *rr);

/* y = f[i] x, row by row */
void mr_multivector_scale(const mr_ctx *ctx, mr_multivector s, const double *f, const double *x, double *y);

/* Right-hand sides, one after another, to rows and back. */
void mr_multivector_gather(mr_multivector s, const double *b, double *rows);
void mr_multivector_scatter(mr_multivector s, const double *rows, double *b);

/* A start for the power method, which has something of every eigenvector: signs without a pattern.  x: n. */
void mr_rough_start(size_t n, double *x);

/* True where the squared norm of each column is not beyond its goal's square. */
static inline bool
mr_multivector_within(mr_multivector s, const double *norm2, const double *goal)
{
	for (size_t c = 0; c < s.width; c++)
		if (norm2[c] > goal[c] * goal[c])
			return false;
	return true;
}

/* a / b, what a column goes by; 0 for one that is done or has broken down, which then stays as it is. */
static inline double
mr_ratio(double a, double b)
{
	double q = a / b;

	return isfinite(q) ? q : 0;
}

#endif
