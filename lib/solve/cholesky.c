/* Sparse Cholesky: an order of elimination, then the multifrontal method. */
#include "solve/multifrontal.h"
#include "solve/solver_type.h"

typedef struct cholesky {
	mr_supernodal *solve;
	mr_ctx work; /* of the set-up */
} cholesky;

static void
cholesky_drop(void *data)
{
	mr_ctx_free(&((cholesky *)data)->work);
}

/* The squared ratio of the smallest to the largest pivot. */
static double
condition(const mr_panels *l)
{
	double low = INFINITY, high = 0;

	for (size_t s = 0; s < l->count; s++)
		for (size_t c = 0; c < mr_panel_columns(l, s); c++) {
			double pivot = l->value[l->value_at[s] + c * (mr_panel_rows(l, s) + 1)];
			low = fmin(low, pivot);
			high = fmax(high, pivot);
		}
	return high > 0 ? mr_square(low / high) : 1;
}

static mr_status
factorize(mr_ctx *ctx, mr_ctx *work, const mr_system *system, const mr_pattern *pattern, mr_elimination *e)
{
	double *value = MR_NEW(ctx, e->l.value_at[e->l.count], double);
	size_t bad = mr_multifrontal(work, system->a, pattern, e, value), row;

	e->l.value = value;
	if (bad == e->l.n)
		return MR_OK;
	row = (size_t)e->l.permutation[bad];
	return mr_fail(ctx, MR_ENUMERIC, "the matrix is not positive definite (at %s %zu)",
	    system->vertex ? "vertex" : "row", system->vertex ? system->vertex[row] : row);
}

static mr_status
cholesky_setup(
    mr_ctx *ctx, const mr_solver_opts *opts, const mr_system *system, void *data, mr_solver_report *report)
{
	cholesky *c = data;
	mr_ctx *work = mr_keep(ctx, &c->work);
	double start = mr_seconds(), analysed, bytes;
	int *order = MR_NEW(ctx, (size_t)system->a->n, int);
	mr_elimination e;
	mr_pattern pattern;

	MR_TRY(mr_order(ctx, system->a, system->part, order));
	mr_eliminate(ctx, work, system->a, order, &e, &pattern);
	analysed = mr_seconds();
	bytes = (double)e.l.value_at[e.l.count] * sizeof(double) +
	        (double)e.l.row_at[e.l.count] * sizeof(int);
	if (opts->memory > 0 && bytes > opts->memory)
		return mr_fail(ctx, MR_ERANGE,
		    "the factor of %zu rows takes %.3g MB, more than the %.3g MB there are", e.l.n,
		    1e-6 * bytes, 1e-6 * opts->memory);
	MR_TRY(factorize(ctx, work, system, &pattern, &e));
	mr_ctx_free(work);
	c->solve = mr_supernodal_new(ctx, &e.l);
	*report = (mr_solver_report){ .seconds_analyse = analysed - start,
		.seconds_factor = mr_seconds() - analysed,
		.rcond = condition(&e.l),
		.nnz_factor = (double)(e.l.value_at[e.l.count] - MR_PANEL_SLACK * e.l.count) };
	return MR_OK;
}

static mr_status
cholesky_solve(mr_ctx *ctx, void *data, double *b, size_t columns, mr_solver_report *report)
{
	cholesky *c = data;

	(void)report;
	mr_supernodal_solve(ctx, c->solve, b, columns);
	return MR_OK;
}

const mr_solver_type mr_cholesky_type = { "cholesky", sizeof(cholesky), cholesky_setup, cholesky_solve,
	cholesky_drop };
