/*
 * preconditioner.h -- approximate inverses for the iterative solvers.
 *
 * Contract: z = B r with B fixed, and symmetric positive definite where the matrix is so.  Everything is in
 * the arena of the context that set it up.
 */
#ifndef MR_SOLVE_PRECONDITIONER_H
#define MR_SOLVE_PRECONDITIONER_H

#include "solve/multivector.h"
#include "solve/solver.h"

typedef struct mr_preconditioner {
	mr_status (*apply)(mr_ctx *ctx, void *data, mr_multivector s, const double *r, double *z);
	void *data;
	double nnz; /* entries it holds */
} mr_preconditioner;

/* D^-1, which is given: n values, kept by the caller. */
mr_preconditioner mr_jacobi_of(double *inverse, size_t n);

/*
 * (L U)^-1, L and U with the entries of A only; of a symmetric matrix that is incomplete Cholesky.  The
 * diagonal is raised until all pivots are positive (Manteuffel 1980).  A Laplacian, with masses or not, is an
 * M-matrix but for obtuse triangles: where a pivot is not positive it is made one, and nothing raised.  A
 * scan of 438,000 vertices with 83 such pivots takes 126 iterations instead of 2305; of bilaplacians too
 * little is left.
 */
mr_status mr_incomplete_new(mr_ctx *ctx, const mr_sparse *a, bool laplacian, mr_preconditioner *b);

/*
 * For A = L (W L)^(k-1): mr_cycles_new's, between two solutions of the hierarchy's strip.  MR_ENUMERIC where
 * that is not positive definite.
 */
mr_status mr_multigrid_new(mr_ctx *ctx, const mr_sparse *a, const mr_hierarchy *h, mr_preconditioner *b);

/* (V W^-1)^(k-1) V, V a V-cycle on L: the inverse of A but for boundary conditions. */
mr_status mr_cycles_new(mr_ctx *ctx, const mr_hierarchy *h, mr_preconditioner *b);

/* A V-cycle on A = L (W L)^(k-1) itself. */
mr_status mr_vcycle_new(mr_ctx *ctx, const mr_sparse *a, const mr_hierarchy *h, mr_preconditioner *b);

/*
 * Conjugate gradients with a matrix that need not be stored: it is what takes x to A x.  A is symmetric and
 * positive semidefinite, the preconditioner B as well.  A column is a system of its own, with the same A. The
 * same for every number of threads if A and B are.
 */
typedef struct mr_cg {
	mr_multivector s;
	void (*apply)(
	    const mr_ctx *ctx, const void *a, mr_multivector s, const double *x, double *y); /* y = A x */
	const void *a;
	const mr_preconditioner *b;
	const double *goal; /* of |r|, column by column; or NULL: */
	double tol;         /* bound of sqrt(r' B r) relative to its start: about the error's energy */
	size_t most;        /* iterations */
} mr_cg;

/* For a matrix that is stored, a mr_sparse. */
void mr_cg_apply(const mr_ctx *ctx, const void *a, mr_multivector s, const double *x, double *y);

/*
 * Improves x, r = b - A x being its residual, until the goal is reached in each column, *iterations is
 * `most`, or no column has a direction left that A sees.  x, r: s.n rows of s.width, the caller's; both are
 * changed. *iterations grows by those taken.
 */
mr_status mr_cg_improve(mr_ctx *ctx, const mr_cg *g, double *x, double *r, size_t *iterations);

#endif
