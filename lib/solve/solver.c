/* The table of solvers, and how each is called. */
#include "solve/blas_threads.h"
#include "solve/solver_type.h"

/* The order of mr_solver_kind. */
static const mr_solver_type *const types[] = { &mr_cholesky_type, &mr_lu_type, &mr_cg_type, &mr_bicgstab_type,
	&mr_multigrid_type, &mr_vcycle_type };

struct mr_solver {
	const mr_solver_type *type;
	void *data;
	mr_solver_report report;
};

void
mr_solver_free(mr_solver *s)
{
	if (!s)
		return;
	if (s->data)
		s->type->free(s->data);
	free(s->data);
	free(s);
}

mr_status
mr_solver_open(mr_ctx *ctx, const mr_solver_opts *opts, const mr_system *system, mr_solver **solver)
{
	mr_solver *s = calloc(1, sizeof *s);
	mr_status status;
	int threads;

	if (s) {
		s->type = types[opts->kind];
		s->data = calloc(1, s->type->size);
	}
	if (!s || !s->data) {
		free(s);
		return mr_fail(ctx, MR_EMEM, "no memory for a solver");
	}
	threads = mr_serial_begin();
	status = s->type->setup(ctx, opts, system, s->data, &s->report);
	mr_serial_end(threads);
	if (status < 0) {
		mr_solver_free(s);
		return mr_prefix(ctx, status, "%s", types[opts->kind]->name);
	}
	*solver = s;
	return MR_OK;
}

mr_status
mr_solver_new(mr_ctx *ctx, mr_solver_kind kind, const mr_sparse *a, const int *part, mr_solver **solver)
{
	mr_solver_opts opts = MR_SOLVER_DEFAULTS;

	opts.kind = kind;
	return mr_solver_open(ctx, &opts, &(mr_system){ .a = a, .part = part }, solver);
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
