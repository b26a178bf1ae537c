/* The table of solvers, and how each is called. */
#include "solve/solver_type.h"

/* The order of mr_solver_kind; a browser has the first. */
static const mr_solver_type *const types[] = {
	&mr_cholesky_type,
#ifndef __wasm__
	&mr_cholmod_type,
	&mr_lu_type,
	&mr_cg_type,
	&mr_multigrid_type,
	&mr_vcycle_type,
#endif
};

struct mr_solver {
	mr_ctx keep; /* of all that it has */
	const mr_solver_type *type;
	void *data;
	mr_solver_report report;
};

static void
drop(void *solver)
{
	mr_ctx_free(&((mr_solver *)solver)->keep);
}

mr_solver *
mr_solver_new(mr_ctx *ctx)
{
	mr_solver *s = MR_NEW_ZERO(ctx, 1, mr_solver);

	mr_own(ctx, drop, s);
	return s;
}

mr_status
mr_solver_open(mr_ctx *ctx, mr_solver *s, const mr_solver_opts *opts, const mr_system *system)
{
	mr_ctx *keep = mr_keep(ctx, &s->keep);
	mr_status status;
	int threads;

	mr_ctx_free(keep);
	s->type = types[opts->kind];
	s->data = mr_alloc_zero(keep, 1, s->type->size);
	if (s->type->drop)
		mr_own(keep, s->type->drop, s->data);
	threads = MR_BROWSER ? 0 : mr_serial_begin();
	status = s->type->setup(keep, opts, system, s->data, &s->report);
	if (!MR_BROWSER)
		mr_serial_end(threads);
	return mr_prefix(ctx, mr_fail_as(ctx, keep, status), "%s", s->type->name);
}

mr_status
mr_solver_direct(mr_ctx *ctx, mr_solver *solver, mr_solver_kind kind, const mr_sparse *a, const int *part)
{
	mr_solver_opts opts = MR_SOLVER_DEFAULTS;

	opts.kind = kind;
	return mr_solver_open(ctx, solver, &opts, &(mr_system){ .a = a, .part = part });
}

mr_status
mr_solver_solve(mr_ctx *ctx, mr_solver *solver, double *b, size_t columns)
{
	return mr_prefix(ctx, solver->type->solve(ctx, solver->data, b, columns, &solver->report), "%s",
	    solver->type->name);
}

mr_solver_report
mr_solver_reported(const mr_solver *solver)
{
	return solver->report;
}
