/*
 * Conjugate gradients (Hestenes, Stiefel 1952), preconditioned by the incomplete Cholesky factor of the part
 * of the matrix that x, y and z have in common: a ninth of the whole's entries.  A row has all vertices that
 * a control face couples, so that there is nothing to gain by fill: complete factors save one step in thirty,
 * and on thousands of control vertices take a quarter of the fit.
 */
#include "fit/solve_step.h"

#include "solve/conjugate_gradients.h"

enum { MOST_STEPS = 50 }; /* of which 16 models take 12 at most */

/*
 * Of the solution, in the norm of the energy.  On 16 models 1e-2 takes 3 steps of 10 less and leaves up to 3
 * % more distance, 1e-4 takes 3 more and gains less than 0.1 %.
 */
static const double ACCURACY = 1e-3;

/* All of a symmetric matrix of which the lower triangle is given. */
static mr_status
complete(mr_ctx *ctx, const mr_sparse *lower, mr_sparse *full)
{
	int n = lower->n, used = 0;
	size_t nnz = (size_t)(2 * lower->start[n] - n);
	mr_sparse r = { n, MR_NEW(ctx, (size_t)n + 1, int), MR_NEW(ctx, nnz, int), MR_NEW(ctx, nnz, double) };
	mr_sparse upper;

	MR_TRY(mr_sparse_transpose(ctx, lower, (size_t)n, &upper));
	for (int i = 0; i < n; i++) {
		r.start[i] = used;
		for (int e = lower->start[i]; e < lower->start[i + 1]; e++, used++) {
			r.index[used] = lower->index[e];
			r.value[used] = lower->value[e];
		}
		for (int e = upper.start[i] + 1; e < upper.start[i + 1]; e++, used++) {
			r.index[used] = upper.index[e];
			r.value[used] = upper.value[e];
		}
	}
	r.start[n] = used;
	*full = r;
	return MR_OK;
}

/* z = B r for x, y and z: b is of one of them. */
static mr_status
precondition(mr_ctx *ctx, void *b, mr_multivector s, const double *r, double *z)
{
	const mr_preconditioner *common = b;

	return common->apply(ctx, common->data, (mr_multivector){ s.n / 3, 3 }, r, z);
}

/* y += (a I + block) x for the three rows and columns of a pair of vertices. */
static void
apply_entry(const double *m, double a, const double *x, double *y)
{
	y[0] += (a + m[0]) * x[0] + m[3] * x[1] + m[5] * x[2];
	y[1] += m[3] * x[0] + (a + m[1]) * x[1] + m[4] * x[2];
	y[2] += m[5] * x[0] + m[4] * x[1] + (a + m[2]) * x[2];
}

/* y = A x, of which the lower triangle is given. */
static void
apply(const mr_ctx *ctx, const void *system, mr_multivector s, const double *x, double *y)
{
	const mr_fit_system *t = system;

	(void)ctx;
	memset(y, 0, s.n * sizeof *y);
	for (int i = 0; i < t->a.n; i++)
		for (int e = t->a.start[i]; e < t->a.start[i + 1]; e++) {
			int j = t->a.index[e];
			apply_entry(t->block[e].m, t->a.value[e], x + 3 * j, y + 3 * i);
			if (j != i)
				apply_entry(t->block[e].m, t->a.value[e], x + 3 * i, y + 3 * j);
		}
}

mr_status
mr_fit_solve(mr_ctx *ctx, mr_fit_system *system, mr_v3 *motion, size_t *steps)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = (size_t)system->a.n, taken = 0;
	mr_preconditioner b;
	mr_sparse common;
	mr_cg g = { .s = { 3 * nv, 1 },
		.apply = apply,
		.a = system,
		.b = &(mr_preconditioner){ .apply = precondition, .data = &b },
		.tol = ACCURACY,
		.most = MOST_STEPS };

	MR_TRY(complete(ctx, &system->a, &common));
	MR_TRY(mr_incomplete_new(ctx, &common, &b));
	memset(motion, 0, nv * sizeof *motion);
	MR_TRY(mr_cg_improve(ctx, &g, (double *)motion, (double *)system->b, &taken));
	mr_mark_release(ctx, mark);
	*steps += taken;
	return MR_OK;
}
