/* What a solution is worth.  The condition number: von Mises, Pollaczek-Geiringer 1929, by the power method
 * on K and on its inverse. */
#include "edit/deform_parts.h"
#include "solve/multivector.h"

#include <math.h>

/* x / |x|; the norm of x. */
static double
normalize(double *x, size_t n)
{
	double sum = 0;

	for (size_t i = 0; i < n; i++)
		sum += x[i] * x[i];
	for (size_t i = 0; i < n && sum > 0; i++)
		x[i] /= sqrt(sum);
	return sqrt(sum);
}

static mr_status
estimate_condition(mr_ctx *ctx, mr_deform *d, double *condition)
{
	enum { STEPS = 60 };
	size_t n = d->patch.end[0];
	mr_patch_field f = mr_deform_field(d, 1);
	double greatest = 0, inverse = 0;

	mr_rough_start(n, f.u);
	for (int step = 0; step < STEPS; step++) {
		normalize(f.u, n);
		mr_deform_residual(ctx, d, &f);
		memcpy(f.u, f.r, n * sizeof *f.u);
		greatest = normalize(f.u, n);
	}
	mr_rough_start(n, f.r);
	for (int step = 0; step < STEPS; step++) {
		normalize(f.r, n);
		MR_TRY(mr_solver_solve(ctx, d->solver, f.r, 1));
		inverse = normalize(f.r, n);
	}
	*condition = greatest * inverse;
	return MR_OK;
}

static mr_status
verify(mr_ctx *ctx, mr_deform *direct, const mr_deform_task *task, const mr_v3 *p, double *error,
    double *condition)
{
	double diagonal = mr_box_diagonal(mr_box_of(p, direct->nv)), most = 0;
	mr_v3 *q = MR_NEW(ctx, direct->nv, mr_v3);

	if (!q)
		return MR_EMEM;
	MR_TRY(mr_deform_solve(ctx, direct, task, q));
	for (size_t v = 0; v < direct->nv; v++)
		most = fmax(most, mr_dist(p[v], q[v]));
	*error = diagonal > 0 ? most / diagonal : 0;
	*condition = 1;
	return direct->solver ? estimate_condition(ctx, direct, condition) : MR_OK;
}

mr_status
mr_deform_verify(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const mr_deform *d,
    const mr_deform_task *task, const mr_v3 *p, double *error, double *condition)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_deform_opts opts = d->opts;
	mr_deform *direct = NULL;
	mr_status status;

	opts.unsymmetric = false;
	opts.solver.kind = MR_CHOLESKY;
	MR_TRY(mr_deform_new(ctx, rest, ties, d->region, &opts, &direct));
	status = verify(ctx, direct, task, p, error, condition);
	mr_deform_free(direct);
	mr_mark_release(ctx, mark);
	return status;
}
