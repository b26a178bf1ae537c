/*
 * solver.h -- one interface to every solver of sparse linear systems: matrix + right-hand sides -> x.
 *
 * Contract: a solver is set up once for a matrix and then solves for any number of
 * right-hand sides.  The arena of its set-up owns it.  Results do not depend on
 * the number of threads.  A new solver is one file and one line of the table in solver.c.
 */
#ifndef MR_SOLVE_SOLVER_H
#define MR_SOLVE_SOLVER_H

#include "solve/sparse.h"

typedef enum mr_solver_kind {
	MR_CHOLESKY,  /* A symmetric positive definite, only its lower triangle given */
	MR_CHOLMOD,   /* the same by CHOLMOD's supernodal factor */
	MR_LU,        /* A any square matrix, all of it given, as for those below */
	MR_CG,        /* A symmetric positive definite; with incomplete factors */
	MR_MULTIGRID, /* A = L (W L)^(k-1): conjugate gradients with k V-cycles on L */
	MR_VCYCLE     /* A = L (W L)^(k-1): V-cycles on A itself, as the paper has it */
} mr_solver_kind;

/* True for solvers that take the lower triangle of A alone. */
static inline bool
mr_solver_is_symmetric(mr_solver_kind kind)
{
	return kind <= MR_CHOLMOD;
}

/* True for solvers that approach the solution until a tolerance is met. */
static inline bool
mr_solver_iterates(mr_solver_kind kind)
{
	return kind >= MR_CG;
}

/* A coarser level of a multigrid hierarchy: n unknowns, and their interpolation to the finer level. */
typedef struct mr_coarser {
	mr_sparse prolong; /* a row for each unknown of the finer level, columns below n */
	size_t n;
} mr_coarser;

typedef struct mr_hierarchy {
	const mr_sparse *laplace; /* L, restricted to the unknowns: n x n */
	const double *weight;     /* the diagonal of W, of the unknowns */
	size_t order;             /* k */
	size_t count;             /* coarser levels, at least 1, finest first */
	const mr_coarser *level;
	const uint32_t *strip; /* unknowns near the constraints, ascending, to be solved exactly */
	size_t strip_count;    /* may be 0 */
} mr_hierarchy;

/* The system.  Iterative solvers borrow it: it must outlive them; direct ones do not. */
typedef struct mr_system {
	const mr_sparse *a;
	const int *part;               /* dissection (mr_dissect) for Cholesky, or NULL */
	const uint32_t *vertex;        /* of each row, for sentences; NULL: they name the row */
	const mr_hierarchy *hierarchy; /* for multigrid */
} mr_system;

typedef struct mr_solver_opts {
	mr_solver_kind kind;
	double tol;        /* iterative: |b - A x| <= tol |b| for each right-hand side */
	size_t iterations; /* iterative: at most so many, else MR_ENUMERIC */
	double memory;     /* bytes that factors may take; 0: no bound */
} mr_solver_opts;

#define MR_SOLVER_DEFAULTS                                                                                   \
	{                                                                                                    \
		.kind = MR_CHOLESKY, .tol = 1e-10, .iterations = 20000                                       \
	}

typedef struct mr_solver mr_solver;

/* Figures of the set-up and, for iterative solvers, of the last solution. */
typedef struct mr_solver_report {
	double seconds_analyse, seconds_factor;
	double rcond;      /* a cheap estimate of the reciprocal condition number; 0: none */
	double nnz_factor; /* entries of the factors, of all levels */
	size_t iterations; /* of the last solution, of the slowest right-hand side */
	double residual;   /* its |b - A x| / |b|, of the worst right-hand side */
} mr_solver_report;

/* A solver for no matrix yet.  It outlives what the arena gets, and releases, before it is opened. */
mr_solver *mr_solver_new(mr_ctx *ctx);

/*
 * Sets up a solver.  MR_ENUMERIC where A is singular or, for MR_CHOLESKY, not positive definite; MR_ERANGE
 * where factors would exceed the memory allowed, before it is taken.
 */
mr_status mr_solver_open(
    mr_ctx *ctx, mr_solver *solver, const mr_solver_opts *opts, const mr_system *system) MR_WARN_UNUSED;

/* The same for a direct solver with default options. */
mr_status mr_solver_direct(
    mr_ctx *ctx, mr_solver *solver, mr_solver_kind kind, const mr_sparse *a, const int *part) MR_WARN_UNUSED;

/*
 * Replaces the right-hand sides b (`columns` of them, one after another, n values each) by the solutions x.
 * MR_ENUMERIC with the residual reached where an iterative solver does not converge.
 */
mr_status mr_solver_solve(mr_ctx *ctx, mr_solver *solver, double *b, size_t columns) MR_WARN_UNUSED;

mr_solver_report mr_solver_reported(const mr_solver *solver);

/* For a process that calls no BLAS but by solvers: OpenBLAS's threads, which wait for work by turning round
 * for 25 ms each, end. */
void mr_serial_for_good(void);

#endif
