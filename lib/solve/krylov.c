/*
 * Conjugate gradients: Hestenes, Stiefel 1952.  BiCGSTAB: van der Vorst 1992.  Each runs all right-hand sides
 * at once, with scalars of their own: the matrix is read once for all.
 */
#include "op/laplace.h"
#include "solve/precondition.h"
#include "solve/solver_type.h"

#include <math.h>

typedef struct krylov {
	mr_ctx own; /* everything is here */
	mr_solver_opts opts;
	const mr_sparse *a; /* borrowed */
	mr_preconditioner b;
	/*
	 * Improves x, r = b - A x being its residual, until each column has |r| <= goal or no iterations are
	 * left.
	 */
	mr_status (*iterate)(mr_ctx *ctx, struct krylov *k, mr_columns s, const double *goal, double *x,
	    double *r, size_t *iterations);
} krylov;

static void
krylov_free(void *data)
{
	krylov *k = data;

	if (k->b.free)
		k->b.free(k->b.data);
	mr_ctx_free(&k->own);
	free(k);
}

/* r = b - A x, and its largest share of b in any column */
static double
true_residual(const mr_ctx *ctx, const krylov *k, mr_columns s, const double *b, const double *goal,
    const double *x, double *r)
{
	static const double minus[MR_WIDTH] = { -1, -1, -1, -1 };
	double norm2[MR_WIDTH], worst = 0;

	mr_sparse_apply(ctx, k->a, NULL, s.n, s.width, x, r);
	mr_columns_turn(ctx, s, minus, b, r);
	mr_columns_dot(ctx, s, r, r, norm2);
	for (size_t c = 0; c < s.width; c++) {
		double share = sqrt(norm2[c]) * k->opts.tol / goal[c];
		if (norm2[c] > 0 && !(share <= worst))
			worst = share;
	}
	return worst;
}

/* Solves one group of columns, as rows: x = A^-1 b. */
static mr_status
solve_rows(mr_ctx *ctx, krylov *k, mr_columns s, const double *b, double *x, mr_solver_report *report)
{
	double *r = MR_NEW(ctx, s.n * s.width, double), goal[MR_WIDTH], before, after = INFINITY;
	size_t iterations = 0;

	if (!r)
		return MR_EMEM;
	mr_columns_dot(ctx, s, b, b, goal);
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
	mr_mark mark = mr_mark_take(ctx);

	report->iterations = 0;
	report->residual = 0;
	for (size_t c = 0; c < columns; c += MR_WIDTH) {
		mr_columns s = { n, columns - c < MR_WIDTH ? columns - c : MR_WIDTH };
		double *rows = MR_NEW(ctx, n * s.width, double), *x = MR_NEW(ctx, n * s.width, double);
		if (!rows || !x)
			return MR_EMEM;
		mr_columns_gather(s, b + c * n, rows);
		MR_TRY(solve_rows(ctx, k, s, rows, x, report));
		mr_columns_scatter(s, x, b + c * n);
		mr_mark_release(ctx, mark);
	}
	return MR_OK;
}

static bool
reached(mr_columns s, const double *norm2, const double *goal)
{
	for (size_t c = 0; c < s.width; c++)
		if (norm2[c] > goal[c] * goal[c])
			return false;
	return true;
}

/* a / b; 0 for a column that is done or has broken down, which then stays as it is. */
static double
ratio(double a, double b)
{
	double q = a / b;

	return isfinite(q) ? q : 0;
}

static void
negate(mr_columns s, const double *f, double *minus)
{
	for (size_t c = 0; c < s.width; c++)
		minus[c] = -f[c];
}

/* Conjugate gradients */

static mr_status
cg_iterate(mr_ctx *ctx, krylov *k, mr_columns s, const double *goal, double *x, double *r, size_t *iterations)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t size = s.n * s.width;
	double *z = MR_NEW(ctx, size, double), *p = MR_NEW_ZERO(ctx, size, double),
	       *q = MR_NEW(ctx, size, double);
	double rz[MR_WIDTH], last[MR_WIDTH] = { 0 }, pq[MR_WIDTH], rr[MR_WIDTH], f[MR_WIDTH];

	if (!z || !p || !q)
		return MR_EMEM;
	mr_columns_dot(ctx, s, r, r, rr);
	for (; *iterations < k->opts.iterations && !reached(s, rr, goal); ++*iterations) {
		bool stuck = true;
		MR_TRY(k->b.apply(ctx, k->b.data, s, r, z)); /* z = B r */
		mr_columns_dot(ctx, s, r, z, rz);
		for (size_t c = 0; c < s.width; c++)
			f[c] = ratio(rz[c], last[c]); /* beta */
		mr_columns_turn(ctx, s, f, z, p);
		memcpy(last, rz, sizeof rz);
		mr_sparse_apply(ctx, k->a, NULL, s.n, s.width, p, q); /* q = A p */
		mr_columns_dot(ctx, s, p, q, pq);
		for (size_t c = 0; c < s.width; c++) {
			f[c] = pq[c] > 0 && rr[c] > 0 ? ratio(rz[c], pq[c]) : 0; /* alpha */
			stuck = stuck && f[c] == 0;
		}
		if (stuck)
			break;
		mr_columns_add(ctx, s, f, p, x);
		negate(s, f, f);
		mr_columns_add(ctx, s, f, q, r);
		mr_columns_dot(ctx, s, r, r, rr);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* BiCGSTAB, preconditioned from the right */

static mr_status
bicgstab_iterate(
    mr_ctx *ctx, krylov *k, mr_columns s, const double *goal, double *x, double *r, size_t *iterations)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t size = s.n * s.width;
	double *shadow = MR_NEW(ctx, size, double), *p = MR_NEW_ZERO(ctx, size, double);
	double *v = MR_NEW_ZERO(ctx, size, double), *z = MR_NEW(ctx, size, double),
	       *t = MR_NEW(ctx, size, double);
	double rho[MR_WIDTH], last[MR_WIDTH], alpha[MR_WIDTH] = { 0 }, omega[MR_WIDTH] = { 0 };
	double rr[MR_WIDTH], d[MR_WIDTH], e[MR_WIDTH], f[MR_WIDTH];

	if (!shadow || !p || !v || !z || !t)
		return MR_EMEM;
	memcpy(shadow, r, size * sizeof *r);
	mr_columns_dot(ctx, s, r, r, rr);
	for (size_t c = 0; c < s.width; c++)
		last[c] = 1;
	for (; *iterations < k->opts.iterations && !reached(s, rr, goal); ++*iterations) {
		bool stuck = true;
		mr_columns_dot(ctx, s, shadow, r, rho);
		negate(s, omega, e);
		mr_columns_add(ctx, s, e, v, p);
		for (size_t c = 0; c < s.width; c++)
			f[c] = ratio(rho[c] * alpha[c], last[c] * omega[c]); /* beta */
		mr_columns_turn(ctx, s, f, r, p);                            /* p = r + beta (p - omega v) */
		memcpy(last, rho, sizeof rho);
		MR_TRY(k->b.apply(ctx, k->b.data, s, p, z));
		mr_sparse_apply(ctx, k->a, NULL, s.n, s.width, z, v); /* v = A B p */
		mr_columns_dot(ctx, s, shadow, v, d);
		for (size_t c = 0; c < s.width; c++) {
			alpha[c] = rr[c] > goal[c] * goal[c] ? ratio(rho[c], d[c]) : 0;
			stuck = stuck && alpha[c] == 0;
		}
		if (stuck)
			break;
		mr_columns_add(ctx, s, alpha, z, x);
		negate(s, alpha, f);
		mr_columns_add(ctx, s, f, v, r);
		MR_TRY(k->b.apply(ctx, k->b.data, s, r, z));
		mr_sparse_apply(ctx, k->a, NULL, s.n, s.width, z, t); /* t = A B r */
		mr_columns_dot(ctx, s, t, r, d);
		mr_columns_dot(ctx, s, t, t, e);
		for (size_t c = 0; c < s.width; c++)
			omega[c] = alpha[c] != 0 ? ratio(d[c], e[c]) : 0;
		mr_columns_add(ctx, s, omega, z, x);
		negate(s, omega, f);
		mr_columns_add(ctx, s, f, t, r);
		mr_columns_dot(ctx, s, r, r, rr);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* V-cycles alone */

static mr_status
cycle_iterate(
    mr_ctx *ctx, krylov *k, mr_columns s, const double *goal, double *x, double *r, size_t *iterations)
{
	static const double one[MR_WIDTH] = { 1, 1, 1, 1 }, minus[MR_WIDTH] = { -1, -1, -1, -1 }, most = 1e6;
	mr_mark mark = mr_mark_take(ctx);
	size_t size = s.n * s.width;
	double *z = MR_NEW(ctx, size, double), *q = MR_NEW(ctx, size, double), rr[MR_WIDTH], begun[MR_WIDTH];

	if (!z || !q)
		return MR_EMEM;
	mr_columns_dot(ctx, s, r, r, rr);
	memcpy(begun, rr, sizeof rr);
	for (; *iterations < k->opts.iterations && !reached(s, rr, goal); ++*iterations) {
		bool diverges = false;
		MR_TRY(k->b.apply(ctx, k->b.data, s, r, z));
		mr_columns_add(ctx, s, one, z, x);
		mr_sparse_apply(ctx, k->a, NULL, s.n, s.width, z, q);
		mr_columns_add(ctx, s, minus, q, r);
		mr_columns_dot(ctx, s, r, r, rr);
		for (size_t c = 0; c < s.width; c++)
			diverges = diverges || !(rr[c] <= most * begun[c]);
		if (diverges)
			break;
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The solvers */

static mr_status
prepare(krylov *k, const mr_system *system)
{
	mr_ctx *own = &k->own;

	switch (k->opts.kind) {
	case MR_MULTIGRID:
		k->iterate = cg_iterate;
		return mr_multigrid_new(own, system->hierarchy, &k->b);
	case MR_VCYCLE:
		k->iterate = cycle_iterate;
		return mr_vcycle_new(own, system->a, system->hierarchy, &k->b);
	default:
		k->iterate = k->opts.kind == MR_CG ? cg_iterate : bicgstab_iterate;
		return k->opts.precondition == MR_JACOBI ? mr_jacobi_new(own, system->a, &k->b)
		                                         : mr_incomplete_new(own, system->a, &k->b);
	}
}

static mr_status
krylov_setup(
    mr_ctx *ctx, const mr_solver_opts *opts, const mr_system *system, void **data, mr_solver_report *report)
{
	krylov *k = calloc(1, sizeof *k);
	double start = mr_seconds();
	mr_status status;

	if (!k)
		return mr_fail(ctx, MR_EMEM, "no memory for a solver");
	mr_ctx_init(&k->own, ctx->threads);
	k->opts = *opts;
	k->a = system->a;
	status = prepare(k, system);
	if (status < 0) {
		status = mr_fail(ctx, status, "%s", k->own.error);
		krylov_free(k);
		return status;
	}
	*report = (mr_solver_report){ .seconds_factor = mr_seconds() - start,
		.nnz_factor = k->b.nnz,
		.bytes_factor = k->b.nnz * (sizeof(double) + sizeof(int)) };
	*data = k;
	return MR_OK;
}

const mr_solver_type mr_cg_type = { "cg", krylov_setup, krylov_solve, krylov_free };
const mr_solver_type mr_bicgstab_type = { "bicgstab", krylov_setup, krylov_solve, krylov_free };
const mr_solver_type mr_multigrid_type = { "multigrid", krylov_setup, krylov_solve, krylov_free };
const mr_solver_type mr_vcycle_type = { "vcycle", krylov_setup, krylov_solve, krylov_free };
