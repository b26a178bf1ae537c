/*
 * conjugate_gradients.h -- conjugate gradients with a matrix that need not be stored: it is what takes x to A
 * x.
 *
 * Contract: A is symmetric and positive semidefinite, the preconditioner B as well.  A column is a system of
 * its own, with the same A.  The same for every number of threads if A and B are.
 */
#ifndef MR_SOLVE_CONJUGATE_GRADIENTS_H
#define MR_SOLVE_CONJUGATE_GRADIENTS_H

#include "solve/preconditioner.h"

typedef struct mr_cg {
	mr_multivector s;
	void (*apply)(
	    const mr_ctx *ctx, const void *a, mr_multivector s, const double *x, double *y); /* y = A x */
	const void *a;
	const mr_preconditioner *b;
	const double *goal; /* of |r|, column by column; or NULL: */
	double tol;  /* how much sqrt(r' B r) may be of what it was at first: about the error's energy */
	size_t most; /* iterations */
} mr_cg;

/*
 * Improves x, r = b - A x being its residual, until the goal is reached in each column, *iterations is
 * `most`, or no column has a direction left that A sees.  x, r: s.n rows of s.width, the caller's; both are
 * changed. *iterations grows by those taken.
 */
mr_status mr_cg_improve(mr_ctx *ctx, const mr_cg *g, double *x, double *r, size_t *iterations);

#endif
