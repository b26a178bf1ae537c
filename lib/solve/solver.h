/*
 * solver.h -- one interface to every solver of sparse linear systems: matrix + right-hand sides -> x.
 *
 * Contract: a solver is set up once for a matrix and then solves for any number of
 * right-hand sides.  It is a handle over foreign memory: free it.  Results do not depend on
 * the number of threads.  A new solver is one file and one line of the table in solver.c.
 * Layer rule: solve includes base, mesh and op.
 */
#ifndef MR_SOLVER_H
#define MR_SOLVER_H

#include "op/sparse.h"

typedef enum mr_solver_kind {
	MR_CHOLESKY, /* A symmetric positive definite, only its lower triangle given */
	MR_LU        /* A any square matrix, all of it given */
} mr_solver_kind;

typedef struct mr_solver mr_solver;

/* What the set-up took and found. */
typedef struct mr_solver_report {
	double seconds_analyse, seconds_factor;
	double rcond;      /* a cheap estimate of the reciprocal condition number */
	double nnz_factor; /* entries of the factors */
} mr_solver_report;

/*
 * Sets up a solver for A, which is copied or factored: it need not outlive the call.  part: for each row the
 * part of a dissection that it is in (op/dissect.h), which a factorization eliminates in ascending order, or
 * NULL. MR_ENUMERIC where A is singular or, for MR_CHOLESKY, not positive definite.
 */
mr_status mr_solver_new(
    mr_ctx *ctx, mr_solver_kind kind, const mr_sparse *a, const int *part, mr_solver **solver) MR_WARN_UNUSED;

/* Replaces the right-hand sides b (`columns` of them, one after another, n values each) by the solutions x.
 */
mr_status mr_solver_solve(mr_ctx *ctx, mr_solver *solver, double *b, size_t columns) MR_WARN_UNUSED;

mr_solver_report mr_solver_reported(const mr_solver *solver);

/* Accepts NULL. */
void mr_solver_free(mr_solver *solver);

#endif
