/*
 * Conjugate gradients (Hestenes, Stiefel 1952), preconditioned by the incomplete Cholesky factor of the part
 * of the matrix that x, y and z have in common: a ninth of the whole's entries.  A row has all vertices that a
 * control face couples, so that there is nothing to gain by fill: complete factors save one step in thirty,
 * and on thousands of control vertices take a quarter of the fit.
 */
#include "fit/solve_step.h"

#include "solve/preconditioner.h"

enum { MOST_STEPS = 50 };

static const double ACCURACY = 1e-3; /* of the solution, in the norm of the energy */

static double
dot(const double *a, const double *b, size_t n)
{
	double sum = 0;

	for (size_t i = 0; i < n; i++)
		sum += a[i] * b[i];
	return sum;
}

/* p = a p + q */
static void
combine(double a, double *p, const double *q, size_t n)
{
	for (size_t i = 0; i < n; i++)
		p[i] = a * p[i] + q[i];
}

/* All of a symmetric matrix of which the lower triangle is given. */
static mr_status
complete(mr_ctx *ctx, const mr_sparse *lower, mr_sparse *full)
{
	int n = lower->n, used = 0;
	size_t nnz = (size_t)(2 * lower->start[n] - n);
	mr_sparse r = { n, MR_NEW(ctx, (size_t)n + 1, int), MR_NEW(ctx, nnz, int), MR_NEW(ctx, nnz, double) };
	mr_sparse upper;

	if (!r.start || !r.index || !r.value)
		return MR_EMEM;
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

/* z = B r for x, y and z.  rows: 6 nv, the caller's. */
static mr_status
precondition(mr_ctx *ctx, const mr_preconditioner *b, size_t nv, const double *r, double *rows, double *z)
{
	mr_columns three = { nv, 3 };

	mr_columns_gather(three, r, rows);
	MR_TRY(b->apply(ctx, b->data, three, rows, rows + 3 * nv));
	mr_columns_scatter(three, rows + 3 * nv, z);
	return MR_OK;
}

/* r: the right-hand side, used up.  z: the solution. */
static mr_status
conjugate_gradients(
    mr_ctx *ctx, const mr_fit_system *s, const mr_preconditioner *b, double *r, double *z, size_t *steps)
{
	size_t nv = (size_t)s->a.n, n = 3 * nv;
	double *p = MR_NEW_ZERO(ctx, n, double), *q = MR_NEW(ctx, n, double),
	       *rows = MR_NEW(ctx, 2 * n, double);
	double rho = 1, first = 0;

	if (!p || !q || !rows)
		return MR_EMEM;
	memset(z, 0, n * sizeof *z);
	for (size_t i = 0; i < MOST_STEPS; i++) {
		double before = rho, alpha;
		MR_TRY(precondition(ctx, b, nv, r, rows, q));
		rho = dot(r, q, n);
		first = i == 0 ? rho : first;
		if (!(rho > ACCURACY * ACCURACY * first))
			break;
		combine(i == 0 ? 0 : rho / before, p, q, n);
		mr_fit_system_apply(s, p, q);
		alpha = rho / dot(p, q, n);
		for (size_t k = 0; k < n; k++) {
			z[k] += alpha * p[k];
			r[k] -= alpha * q[k];
		}
		++*steps;
	}
	return MR_OK;
}

mr_status
mr_fit_solve(mr_ctx *ctx, mr_fit_system *system, mr_v3 *motion, size_t *steps)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = (size_t)system->a.n;
	double *z = MR_NEW(ctx, 3 * nv, double);
	mr_preconditioner b;
	mr_sparse common;

	if (!z)
		return MR_EMEM;
	MR_TRY(complete(ctx, &system->a, &common));
	MR_TRY(mr_incomplete_new(ctx, &common, &b));
	MR_TRY(conjugate_gradients(ctx, system, &b, system->b, z, steps));
	for (size_t v = 0; v < nv; v++)
		motion[v] = mr_vec(z[v], z[nv + v], z[2 * nv + v]);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
