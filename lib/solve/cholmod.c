/*
 * Sparse Cholesky: Chen, Davis, Hager, Rajamanickam 2008: Algorithm 887: CHOLMOD.  The only file that knows
 * it.
 */
#include "base/memory.h"
#include "solve/solver_type.h"

#include <cholmod.h>

typedef struct cholmod {
	cholmod_common common;
	cholmod_factor *factor;
} cholmod;

/* CHOLMOD's status as ours.  Its functions return true for a matrix that is not positive definite. */
static mr_status
check(mr_ctx *ctx, const cholmod *c)
{
	switch (c->common.status) {
	case CHOLMOD_OK:
	case CHOLMOD_DSMALL:
		return MR_OK;
	case CHOLMOD_NOT_POSDEF:
		return mr_fail(ctx, MR_ENUMERIC, "the matrix is not positive definite");
	case CHOLMOD_OUT_OF_MEMORY:
		return mr_fail(ctx, MR_EMEM, "no memory for the factor");
	case CHOLMOD_TOO_LARGE:
		return mr_fail(ctx, MR_ERANGE, "the factor is too large");
	default:
		return mr_fail(ctx, MR_ENUMERIC, "CHOLMOD fails with status %d", c->common.status);
	}
}

static void
drop(void *data)
{
	cholmod *c = data;

	if (c->factor) {
		mr_memory_free(c->factor->x);
		c->factor->x = NULL;
	}
	cholmod_free_factor(&c->factor, &c->common);
	cholmod_finish(&c->common);
}

/*
 * Minimum degree within the parts; without parts CHOLMOD's own.  It finds less fill where the coarse cuts are
 * made for it, and takes a tenth of the time of METIS, whose factors are 10 to 20 % smaller still.
 */
static mr_status
analyse(mr_ctx *ctx, cholmod *c, cholmod_sparse *a, const int *part)
{
	MR_SCOPE(ctx);
	int *order = MR_NEW(ctx, a->nrow, int), *member = MR_NEW(ctx, a->nrow, int);

	c->common.supernodal = CHOLMOD_SUPERNODAL;
	c->common.print = 0;
	c->common.nmethods = 1;
	c->common.method[0].ordering = part ? CHOLMOD_GIVEN : CHOLMOD_AMD;
	c->common.postorder = 1;
	if (part) {
		memcpy(member, part, a->nrow * sizeof *member);
		cholmod_camd(a, NULL, 0, member, order, &c->common);
		MR_TRY(check(ctx, c));
	}
	c->factor = cholmod_analyze_p(a, part ? order : NULL, NULL, 0, &c->common);
	return check(ctx, c);
}

/* Its values in memory of ours: of large pages, or on the scratch disk. */
static mr_status
make_room(mr_ctx *ctx, cholmod_factor *f)
{
	size_t bytes = f->xsize * sizeof(double);

	f->x = mr_memory(ctx, NULL, bytes);
	if (!f->x)
		return mr_no_memory(ctx, "the factor", (double)bytes);
	f->xtype = CHOLMOD_REAL;
	return MR_OK;
}

static mr_status
factorize(mr_ctx *ctx, cholmod *c, cholmod_sparse *a, const uint32_t *vertex)
{
	MR_TRY(make_room(ctx, c->factor));
	cholmod_factorize(a, c->factor, &c->common);
	if (c->common.status == CHOLMOD_NOT_POSDEF && c->factor->minor < c->factor->n) {
		/* the first pivot that is not positive, by the matrix's own order */
		size_t row = (size_t)((const int *)c->factor->Perm)[c->factor->minor];
		return mr_fail(ctx, MR_ENUMERIC, "the matrix is not positive definite (at %s %zu)",
		    vertex ? "vertex" : "row", vertex ? vertex[row] : row);
	}
	return check(ctx, c); /* at once: the next call resets the status */
}

/* A row of the lower triangle is a column of the upper one: the same arrays. */
static cholmod_sparse
as_upper(const mr_sparse *a)
{
	return (cholmod_sparse){ .nrow = (size_t)a->n,
		.ncol = (size_t)a->n,
		.nzmax = (size_t)a->start[a->n],
		.p = a->start,
		.i = a->index,
		.x = a->value,
		.stype = 1,
		.itype = CHOLMOD_INT,
		.xtype = CHOLMOD_REAL,
		.dtype = CHOLMOD_DOUBLE,
		.sorted = 1,
		.packed = 1 };
}

/* OpenBLAS 0.3 tries for ever if it cannot get its buffer of 128 MB.  With less memory than that the factor
 * counts as too large; with more, its failure is an error. */
static mr_status
check_room(mr_ctx *ctx)
{
	static const size_t buffer = (size_t)160 << 20;
	void *room;

	if (mr_memory_available() < (double)buffer)
		return mr_fail(
		    ctx, MR_ERANGE, "the buffer of the BLAS takes %zu MB, more than there are", buffer >> 20);
	room = malloc(buffer);
	free(room);
	return room ? MR_OK
	            : mr_fail(ctx, MR_EMEM, "no memory for the buffer of the BLAS, %zu MB", buffer >> 20);
}

static mr_status
set_up(mr_ctx *ctx, const mr_solver_opts *opts, const mr_system *system, void *data, mr_solver_report *report)
{
	cholmod *c = data;
	cholmod_sparse upper = as_upper(system->a);
	double start = mr_seconds(), analysed, bytes;

	cholmod_start(&c->common);
	MR_TRY(check_room(ctx));
	MR_TRY(analyse(ctx, c, &upper, system->part));
	analysed = mr_seconds();
	bytes = (double)(c->factor->xsize + c->factor->maxcsize) * sizeof(double) +
	        (double)c->factor->ssize * sizeof(int);
	if (opts->memory > 0 && bytes > opts->memory)
		return mr_fail(ctx, MR_ERANGE,
		    "the factor of %zu rows takes %.3g MB, more than the %.3g MB there are", c->factor->n,
		    1e-6 * bytes, 1e-6 * opts->memory);
	MR_TRY(factorize(ctx, c, &upper, system->vertex));
	*report = (mr_solver_report){ .seconds_analyse = analysed - start,
		.seconds_factor = mr_seconds() - analysed,
		.rcond = cholmod_rcond(c->factor, &c->common),
		.nnz_factor = c->common.lnz };
	return MR_OK;
}

static mr_status
solve(mr_ctx *ctx, void *data, double *b, size_t columns, mr_solver_report *report)
{
	cholmod *c = data;
	size_t n = c->factor->n;
	cholmod_dense given = { .nrow = n,
		.ncol = columns,
		.nzmax = n * columns,
		.d = n,
		.x = b,
		.xtype = CHOLMOD_REAL,
		.dtype = CHOLMOD_DOUBLE };
	cholmod_dense *x = cholmod_solve(CHOLMOD_A, c->factor, &given, &c->common);

	(void)report;
	MR_TRY(check(ctx, c));
	memcpy(b, x->x, n * columns * sizeof *b);
	cholmod_free_dense(&x, &c->common);
	return MR_OK;
}

const mr_solver_type mr_cholmod_type = { "cholmod", sizeof(cholmod), set_up, solve, drop };
