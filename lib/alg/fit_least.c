/*
 * Marinov, Kobbelt 2005: Optimization methods for scattered data approximation with subdivision surfaces;
 * Huber 1964: Robust estimation of a location parameter, for the weights.
 */
#include "alg/fit_least.h"

#include "alg/fit_guard.h"
#include "alg/fit_system.h"
#include "solve/solver.h"

/* Places the k-th smallest of n values at a[k] (Hoare 1961). */
static double
select_kth(double *a, size_t n, size_t k)
{
	size_t low = 0, high = n - 1;

	while (low < high) {
		double pivot = a[low + (high - low) / 2];
		size_t i = low, j = high;
		for (;;) {
			while (a[i] < pivot)
				i++;
			while (a[j] > pivot)
				j--;
			if (i >= j)
				break;
			double x = a[i];
			a[i++] = a[j];
			a[j--] = x;
		}
		if (j < k)
			low = j + 1;
		else
			high = j;
	}
	return a[k];
}

/* Huber's weights: as least squares up to `limit` standard deviations, estimated from the median; beyond, a
 * point pulls as one at the limit does. */
static mr_status
weigh(mr_ctx *ctx, const mr_fit_foot *foot, size_t n, double *w)
{
	static const double limit = 2.5, deviation = 1.4826;
	mr_mark mark = mr_mark_take(ctx);
	double *d = MR_NEW(ctx, n, double), most;

	if (!d)
		return MR_EMEM;
	for (size_t i = 0; i < n; i++)
		d[i] = foot[i].dist;
	most = limit * deviation * select_kth(d, n, n / 2);
	for (size_t i = 0; i < n; i++)
		w[i] = foot[i].dist > most && most > 0 ? most / foot[i].dist : 1;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The solution of the equations, a vector a vertex. */
static mr_status
solve(mr_ctx *ctx, mr_fit_system *s, mr_v3 *z)
{
	size_t nv = (size_t)s->a.n;
	mr_solver *solver;
	mr_status status;

	MR_TRY(mr_solver_new(ctx, MR_CHOLESKY, &s->a, NULL, &solver));
	status = mr_solver_solve(ctx, solver, s->b, 3);
	mr_solver_free(solver);
	for (size_t v = 0; v < nv; v++)
		z[v] = mr_vec(s->b[v], s->b[nv + v], s->b[2 * nv + v]);
	return status;
}

mr_status
mr_fit_least_squares(mr_ctx *ctx, mr_fit_surface *surface, const mr_v3 *point, size_t n,
    const mr_fit_opts *opts, size_t passes, mr_fit_foot *foot, mr_v3 *x)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *z = MR_NEW(ctx, surface->level[0].nv, mr_v3);
	double *w = MR_NEW(ctx, n, double);
	size_t damped = 0;
	mr_fit_system system;

	if (!z || !w)
		return MR_EMEM;
	MR_TRY(mr_fit_system_build(ctx, surface, &system));
	for (size_t i = 0; i < passes; i++) {
		mr_progress(ctx, "fitting", (double)i / (double)passes);
		MR_TRY(weigh(ctx, foot, n, w));
		MR_TRY(mr_fit_system_fill(ctx, &system, x, point, foot, w, n, opts->fairness));
		MR_TRY(solve(ctx, &system, z));
		MR_TRY(mr_fit_step(ctx, surface, &system.patch, x, z, &damped));
		MR_TRY(mr_fit_attach(ctx, surface, point, n, true, foot));
	}
	mr_stat_set(ctx, "damped", (double)damped);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
