/*
 * The iterative solvers of stored matrices: conjugate gradients and V-cycles.
 * Each runs all right-hand sides at once, with scalars of their own: the matrix is read once for all.
 */
#include "solve/preconditioner.h"
#include "solve/solver_type.h"
#include "solve/sparse.h"

#include <math.h>

typedef struct krylov {
	mr_solver_opts opts;
	const mr_sparse *a; /* borrowed */
	mr_preconditioner b;
	/*
	 * Improves x, r = b - A x being its residual, until each column has |r| <= goal or no iterations are
	 * left.
	 */
	mr_status (*iterate)(mr_ctx *ctx, struct krylov *k, mr_multivector s, const double *goal, double *x,
	    double *r, size_t *iterations);
} krylov;

/* r = b - A x, and its largest share of b in any column */
static double
true_residual(const mr_ctx *ctx, const krylov *k, mr_multivector s, const double *b, const double *goal,
    const double *x, double *r)
{
	static const double minus[MR_WIDTH] = { -1, -1, -1, -1 };
	double norm2[MR_WIDTH], worst = 0;

	mr_sparse_apply(ctx, k->a, NULL, s.n, s.width, x, r);
	mr_multivector_add(ctx, s, MR_ONE, b, minus, r);
	mr_multivector_dot(ctx, s, r, r, norm2);
	for (size_t c = 0; c < s.width; c++) {
		double share = sqrt(norm2[c]) * k->opts.tol / goal[c];
		if (norm2[c] > 0 && !(share <= worst))
			worst = share;
	}
	return worst;
}

/* Solves one group of columns, as rows: x = A^-1 b. */
static mr_status
solve_rows(mr_ctx *ctx, krylov *k, mr_multivector s, const double *b, double *x, mr_solver_report *report)
{
	double *r = MR_NEW(ctx, s.n * s.width, double), goal[MR_WIDTH], before, after = INFINITY;
	size_t iterations = 0;

	mr_multivector_dot(ctx, s, b, b, goal);
	for (size_t c = 0; c < s.width; c++)
		goal[c] = k->opts.tol * sqrt(goal[c]);
	memset(x, 0, s.n * s.width * sizeof *x);
	memcpy(r, b, s.n * s.width * sizeof *r);
	do { /* from the true residual again, while that helps */
		before = after;
		MR_TRY(k->iterate(ctx, k, s, goal, x, r, &iterations));
		after = true_residual(ctx, k, s, b, goal, x, r);
	} while (after > k->opts.tol && after < 0.5 * before && iterations < k->opts.iterations);
	if (iterations > report->iterations)
		report->iterations = iterations;
	if (!(after <= report->residual))
		report->residual = after;
	if (!(after <= k->opts.tol))
		return mr_fail(ctx, MR_ENUMERIC,
		    "no convergence: a relative residual of %.2e after %zu iterations, not %.1e", after,
		    iterations, k->opts.tol);
	return MR_OK;
}

static mr_status
krylov_solve(mr_ctx *ctx, void *data, double *b, size_t columns, mr_solver_report *report)
{
	krylov *k = data;
	size_t n = (size_t)k->a->n;

	report->iterations = 0;
	report->residual = 0;
	for (size_t c = 0; c < columns; c += MR_WIDTH) {
		MR_SCOPE(ctx);
		mr_multivector s = { n, columns - c < MR_WIDTH ? columns - c : MR_WIDTH };
		double *rows = MR_NEW(ctx, n * s.width, double), *x = MR_NEW(ctx, n * s.width, double);
		mr_multivector_gather(s, b + c * n, rows);
		MR_TRY(solve_rows(ctx, k, s, rows, x, report));
		mr_multivector_scatter(s, x, b + c * n);
	}
	return MR_OK;
}

/* Conjugate gradients */

static mr_status
cg_iterate(
    mr_ctx *ctx, krylov *k, mr_multivector s, const double *goal, double *x, double *r, size_t *iterations)
{
	mr_cg g = {
		.s = s, .apply = mr_cg_apply, .a = k->a, .b = &k->b, .goal = goal, .most = k->opts.iterations
	};

	return mr_cg_improve(ctx, &g, x, r, iterations);
}

/* V-cycles alone */

static mr_status
cycle_iterate(
    mr_ctx *ctx, krylov *k, mr_multivector s, const double *goal, double *x, double *r, size_t *iterations)
{
	static const double minus[MR_WIDTH] = { -1, -1, -1, -1 }, most = 1e6;
	MR_SCOPE(ctx);
	size_t size = s.n * s.width;
	double *z = MR_NEW(ctx, size, double), *q = MR_NEW(ctx, size, double), rr[MR_WIDTH], begun[MR_WIDTH];

	mr_multivector_dot(ctx, s, r, r, rr);
	memcpy(begun, rr, sizeof rr);
	for (; *iterations < k->opts.iterations && !mr_multivector_within(s, rr, goal); ++*iterations) {
		bool diverges = false;
		MR_TRY(k->b.apply(ctx, k->b.data, s, r, z));
		mr_multivector_add(ctx, s, MR_ONE, z, MR_ONE, x);
		mr_sparse_apply(ctx, k->a, NULL, s.n, s.width, z, q);
		mr_multivector_add(ctx, s, minus, q, MR_ONE, r);
		mr_multivector_dot(ctx, s, r, r, rr);
		for (size_t c = 0; c < s.width; c++)
			diverges = diverges || !(rr[c] <= most * begun[c]);
		if (diverges)
			break;
	}
	return MR_OK;
}

/* The solvers */

static mr_status
krylov_setup(
    mr_ctx *ctx, const mr_solver_opts *opts, const mr_system *system, void *data, mr_solver_report *report)
{
	double start = mr_seconds();
	krylov *k = data;

	k->opts = *opts;
	k->a = system->a;
	k->iterate = opts->kind == MR_VCYCLE ? cycle_iterate : cg_iterate;
	if (opts->kind == MR_CG)
		MR_TRY(mr_incomplete_new(ctx, system->a, false, &k->b));
	else
		MR_TRY((opts->kind == MR_VCYCLE ? mr_vcycle_new : mr_multigrid_new)(
		    ctx, system->a, system->hierarchy, &k->b));
	*report = (mr_solver_report){ .seconds_factor = mr_seconds() - start, .nnz_factor = k->b.nnz };
	return MR_OK;
}

const mr_solver_type mr_cg_type = { "cg", sizeof(krylov), krylov_setup, krylov_solve, NULL };
const mr_solver_type mr_multigrid_type = { "multigrid", sizeof(krylov), krylov_setup, krylov_solve, NULL };
const mr_solver_type mr_vcycle_type = { "vcycle", sizeof(krylov), krylov_setup, krylov_solve, NULL };
