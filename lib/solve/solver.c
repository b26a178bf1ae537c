#include "solve/solver_type.h"

/* The order of mr_solver_kind. */
static const mr_solver_type *const types[] = { &mr_cholesky_type, &mr_lu_type };

struct mr_solver {
	const mr_solver_type *type;
	void *data;
	mr_solver_report report;
};

mr_status
mr_solver_new(mr_ctx *ctx, mr_solver_kind kind, const mr_sparse *a, const int *part, mr_solver **solver)
{
	mr_solver *s = calloc(1, sizeof *s);
	mr_status status;

	if (!s)
		return mr_fail(ctx, MR_EMEM, "no memory for a solver");
	s->type = types[kind];
	status = s->type->setup(ctx, a, part, &s->data, &s->report);
	if (status < 0) {
		free(s);
		return mr_prefix(ctx, status, "%s", types[kind]->name);
	}
	*solver = s;
	return MR_OK;
}

mr_status
mr_solver_solve(mr_ctx *ctx, mr_solver *solver, double *b, size_t columns)
{
	return mr_prefix(ctx, solver->type->solve(ctx, solver->data, b, columns), "%s", solver->type->name);
}

mr_solver_report
mr_solver_reported(const mr_solver *solver)
{
	return solver->report;
}

void
mr_solver_free(mr_solver *solver)
{
	if (!solver)
		return;
	solver->type->free(solver->data);
	free(solver);
}
