/*
 * The iterative solvers of stored matrices: conjugate gradients, BiCGSTAB (van der Vorst 1992) and V-cycles.
 * Each runs all right-hand sides at once, with scalars of their own: the matrix is read once for all.
 */
#include "solve/conjugate_gradients.h"
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
	mr_multivector_turn(ctx, s, minus, b, r);
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
	mr_mark mark = mr_mark_take(ctx);

	report->iterations = 0;
	report->residual = 0;
	for (size_t c = 0; c < columns; c += MR_WIDTH) {
		mr_multivector s = { n, columns - c < MR_WIDTH ? columns - c : MR_WIDTH };
		double *rows = MR_NEW(ctx, n * s.width, double), *x = MR_NEW(ctx, n * s.width, double);
		mr_multivector_gather(s, b + c * n, rows);
		MR_TRY(solve_rows(ctx, k, s, rows, x, report));
		mr_multivector_scatter(s, x, b + c * n);
		mr_mark_release(ctx, mark);
	}
	return MR_OK;
}

static void
negate(mr_multivector s, const double *f, double *minus)
{
	for (size_t c = 0; c < s.width; c++)
		minus[c] = -f[c];
}

/* Conjugate gradients */

static void
apply_stored(const mr_ctx *ctx, const void *a, mr_multivector s, const double *x, double *y)
{
	mr_sparse_apply(ctx, a, NULL, s.n, s.width, x, y);
}

static mr_status
cg_iterate(
    mr_ctx *ctx, krylov *k, mr_multivector s, const double *goal, double *x, double *r, size_t *iterations)
{
	mr_cg g = {
		.s = s, .apply = apply_stored, .a = k->a, .b = &k->b, .goal = goal, .most = k->opts.iterations
	};

	return mr_cg_improve(ctx, &g, x, r, iterations);
}

/* BiCGSTAB, preconditioned from the right */

typedef struct bicgstab {
	double *shadow, *p, *v, *z, *t;
	double last[MR_WIDTH], alpha[MR_WIDTH], omega[MR_WIDTH];
} bicgstab;

static void
bicgstab_begin(mr_ctx *ctx, mr_multivector s, const double *r, bicgstab *b)
{
	size_t size = s.n * s.width;

	*b = (bicgstab){ MR_NEW(ctx, size, double), MR_NEW_ZERO(ctx, size, double),
		MR_NEW_ZERO(ctx, size, double), MR_NEW(ctx, size, double), MR_NEW(ctx, size, double),
		.last = { 1, 1, 1, 1 } };
	memcpy(b->shadow, r, size * sizeof *r);
}

/* The step of BiCG: false where it has broken down in every column. */
static mr_status
bicgstab_step(mr_ctx *ctx, krylov *k, mr_multivector s, const bool *done, bicgstab *b, double *x, double *r,
    bool *stuck)
{
	double rho[MR_WIDTH], d[MR_WIDTH], f[MR_WIDTH];

	mr_multivector_dot(ctx, s, b->shadow, r, rho);
	negate(s, b->omega, f);
	mr_multivector_add(ctx, s, f, b->v, b->p);
	for (size_t c = 0; c < s.width; c++)
		f[c] = mr_ratio(rho[c] * b->alpha[c], b->last[c] * b->omega[c]); /* beta */
	mr_multivector_turn(ctx, s, f, r, b->p); /* p = r + beta (p - omega v) */
	memcpy(b->last, rho, sizeof rho);
	MR_TRY(k->b.apply(ctx, k->b.data, s, b->p, b->z));
	mr_sparse_apply(ctx, k->a, NULL, s.n, s.width, b->z, b->v); /* v = A B p */
	mr_multivector_dot(ctx, s, b->shadow, b->v, d);
	*stuck = true;
	for (size_t c = 0; c < s.width; c++) {
		b->alpha[c] = done[c] ? 0 : mr_ratio(rho[c], d[c]);
		*stuck = *stuck && b->alpha[c] == 0;
	}
	mr_multivector_add(ctx, s, b->alpha, b->z, x);
	negate(s, b->alpha, f);
	mr_multivector_add(ctx, s, f, b->v, r);
	return MR_OK;
}

/* The step of steepest descent behind it. */
static mr_status
stabilize(mr_ctx *ctx, krylov *k, mr_multivector s, bicgstab *b, double *x, double *r)
{
	double d[MR_WIDTH], e[MR_WIDTH];

	MR_TRY(k->b.apply(ctx, k->b.data, s, r, b->z));
	mr_sparse_apply(ctx, k->a, NULL, s.n, s.width, b->z, b->t); /* t = A B r */
	mr_multivector_dot(ctx, s, b->t, r, d);
	mr_multivector_dot(ctx, s, b->t, b->t, e);
	for (size_t c = 0; c < s.width; c++)
		b->omega[c] = b->alpha[c] != 0 ? mr_ratio(d[c], e[c]) : 0;
	mr_multivector_add(ctx, s, b->omega, b->z, x);
	negate(s, b->omega, d);
	mr_multivector_add(ctx, s, d, b->t, r);
	return MR_OK;
}

static mr_status
bicgstab_iterate(
    mr_ctx *ctx, krylov *k, mr_multivector s, const double *goal, double *x, double *r, size_t *iterations)
{
	mr_mark mark = mr_mark_take(ctx);
	double rr[MR_WIDTH];
	bool stuck = false;
	bicgstab b;

	bicgstab_begin(ctx, s, r, &b);
	mr_multivector_dot(ctx, s, r, r, rr);
	for (; *iterations < k->opts.iterations && !mr_multivector_within(s, rr, goal) && !stuck;
	     ++*iterations) {
		bool done[MR_WIDTH];
		for (size_t c = 0; c < s.width; c++)
			done[c] = rr[c] <= goal[c] * goal[c];
		MR_TRY(bicgstab_step(ctx, k, s, done, &b, x, r, &stuck));
		MR_TRY(stabilize(ctx, k, s, &b, x, r));
		mr_multivector_dot(ctx, s, r, r, rr);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* V-cycles alone */

static mr_status
cycle_iterate(
    mr_ctx *ctx, krylov *k, mr_multivector s, const double *goal, double *x, double *r, size_t *iterations)
{
	static const double one[MR_WIDTH] = { 1, 1, 1, 1 }, minus[MR_WIDTH] = { -1, -1, -1, -1 }, most = 1e6;
	mr_mark mark = mr_mark_take(ctx);
	size_t size = s.n * s.width;
	double *z = MR_NEW(ctx, size, double), *q = MR_NEW(ctx, size, double), rr[MR_WIDTH], begun[MR_WIDTH];

	mr_multivector_dot(ctx, s, r, r, rr);
	memcpy(begun, rr, sizeof rr);
	for (; *iterations < k->opts.iterations && !mr_multivector_within(s, rr, goal); ++*iterations) {
		bool diverges = false;
		MR_TRY(k->b.apply(ctx, k->b.data, s, r, z));
		mr_multivector_add(ctx, s, one, z, x);
		mr_sparse_apply(ctx, k->a, NULL, s.n, s.width, z, q);
		mr_multivector_add(ctx, s, minus, q, r);
		mr_multivector_dot(ctx, s, r, r, rr);
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
precondition(mr_ctx *ctx, krylov *k, const mr_system *system)
{
	if (k->opts.kind == MR_VCYCLE)
		return mr_vcycle_new(ctx, system->a, system->hierarchy, &k->b);
	if (k->opts.kind == MR_BICGSTAB && k->opts.precondition == MR_VCYCLES) /* a strip makes it stall */
		return mr_cycles_new(ctx, system->hierarchy, &k->b);
	if (mr_solver_multigrid(&k->opts))
		return mr_multigrid_new(ctx, system->a, system->hierarchy, &k->b);
	if (k->opts.precondition == MR_JACOBI)
		return mr_jacobi_new(ctx, system->a, &k->b);
	return mr_incomplete_new(ctx, system->a, &k->b);
}

static mr_status
krylov_setup(
    mr_ctx *ctx, const mr_solver_opts *opts, const mr_system *system, void *data, mr_solver_report *report)
{
	double start = mr_seconds();
	krylov *k = data;

	k->opts = *opts;
	k->a = system->a;
	k->iterate = opts->kind == MR_VCYCLE     ? cycle_iterate
	             : opts->kind == MR_BICGSTAB ? bicgstab_iterate
	                                         : cg_iterate;
	MR_TRY(precondition(ctx, k, system));
	*report = (mr_solver_report){ .seconds_factor = mr_seconds() - start,
		.nnz_factor = k->b.nnz,
		.bytes_factor = k->b.nnz * (sizeof(double) + sizeof(int)) };
	return MR_OK;
}

const mr_solver_type mr_cg_type = { "cg", sizeof(krylov), krylov_setup, krylov_solve, NULL };
const mr_solver_type mr_bicgstab_type = { "bicgstab", sizeof(krylov), krylov_setup, krylov_solve, NULL };
const mr_solver_type mr_multigrid_type = { "multigrid", sizeof(krylov), krylov_setup, krylov_solve, NULL };
const mr_solver_type mr_vcycle_type = { "vcycle", sizeof(krylov), krylov_setup, krylov_solve, NULL };
