/*
 * Sparse LU: Davis 2004: Algorithm 832: UMFPACK.  The only file that knows it.
 */
#include "solve/solver_type.h"

#include <umfpack.h>

typedef struct lu {
	void *numeric;
	size_t n;
	double control[UMFPACK_CONTROL];
} lu;

static mr_status
check(mr_ctx *ctx, int status)
{
	switch (status) {
	case UMFPACK_OK:
		return MR_OK;
	case UMFPACK_WARNING_singular_matrix:
		return mr_fail(ctx, MR_ENUMERIC, "the matrix is singular");
	case UMFPACK_ERROR_out_of_memory:
		return mr_fail(ctx, MR_EMEM, "no memory for the factors");
	default:
		return mr_fail(ctx, MR_ENUMERIC, "UMFPACK fails with status %d", status);
	}
}

static void
lu_drop(void *data)
{
	lu *l = data;

	umfpack_di_free_numeric(&l->numeric);
}

/* Our rows are UMFPACK's columns: it factors the transpose, and orders it by itself. */
static mr_status
lu_setup(
    mr_ctx *ctx, const mr_solver_opts *opts, const mr_system *system, void *data, mr_solver_report *report)
{
	lu *l = data;
	const mr_sparse *a = system->a;
	double start = mr_seconds(), analysed, bytes, info[UMFPACK_INFO];
	void *symbolic = NULL;
	int status;

	l->n = (size_t)a->n;
	umfpack_di_defaults(l->control);
	l->control[UMFPACK_IRSTEP] = 0; /* refining would take the matrix along */
	status = umfpack_di_symbolic(a->n, a->n, a->start, a->index, a->value, &symbolic, l->control, info);
	analysed = mr_seconds();
	bytes = info[UMFPACK_PEAK_MEMORY_ESTIMATE] * info[UMFPACK_SIZE_OF_UNIT];
	if (status == UMFPACK_OK && opts->memory > 0 && bytes > opts->memory) {
		umfpack_di_free_symbolic(&symbolic);
		return mr_fail(ctx, MR_ERANGE,
		    "the factors of %d rows may take %.3g MB, more than the %.3g MB there are", a->n,
		    1e-6 * bytes, 1e-6 * opts->memory);
	}
	if (status == UMFPACK_OK)
		status = umfpack_di_numeric(
		    a->start, a->index, a->value, symbolic, &l->numeric, l->control, info);
	umfpack_di_free_symbolic(&symbolic);
	MR_TRY(check(ctx, status));
	*report = (mr_solver_report){ .seconds_analyse = analysed - start,
		.seconds_factor = mr_seconds() - analysed,
		.rcond = info[UMFPACK_RCOND],
		.nnz_factor = info[UMFPACK_LNZ] + info[UMFPACK_UNZ] };
	return MR_OK;
}

static mr_status
lu_solve(mr_ctx *ctx, void *data, double *b, size_t columns, mr_solver_report *report)
{
	lu *l = data;
	size_t n = l->n;
	MR_SCOPE(ctx);
	double *x = MR_NEW(ctx, n, double), info[UMFPACK_INFO];

	(void)report;
	for (size_t c = 0; c < columns; c++, b += n) {
		MR_TRY(check(
		    ctx, umfpack_di_solve(UMFPACK_At, NULL, NULL, NULL, x, b, l->numeric, l->control, info)));
		memcpy(b, x, n * sizeof *b);
	}
	return MR_OK;
}

const mr_solver_type mr_lu_type = { "lu", sizeof(lu), lu_setup, lu_solve, lu_drop };
