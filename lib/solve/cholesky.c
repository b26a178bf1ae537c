/*
 * Sparse Cholesky: Chen, Davis, Hager, Rajamanickam 2008: Algorithm 887: CHOLMOD.  The only file that knows
 * it.
 */
#include "base/memory.h"
#include "solve/solver_type.h"
#include "solve/supernodal.h"

#include <cholmod.h>

typedef struct cholesky {
	cholmod_common common;
	cholmod_factor *factor;
	mr_supernodal *solve;
} cholesky;

/* CHOLMOD's status as ours.  Its functions return true for a matrix that is not positive definite. */
static mr_status
check(mr_ctx *ctx, const cholesky *c)
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
cholesky_drop(void *data)
{
	cholesky *c = data;

	cholmod_free_factor(&c->factor, &c->common);
	cholmod_finish(&c->common);
}

/*
 * Minimum degree within the parts; without parts CHOLMOD's own.  It finds less fill where the coarse cuts are
 * made for it, and takes a tenth of the time of METIS, whose factors are 10 to 20 % smaller still.
 */
static mr_status
analyse(mr_ctx *ctx, cholesky *c, cholmod_sparse *a, const int *part)
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

static mr_status
factorize(mr_ctx *ctx, cholesky *c, cholmod_sparse *a, const uint32_t *vertex)
{
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

static mr_panels
panels_of(const cholmod_factor *f)
{
	return (mr_panels){ .n = f->n,
		.count = f->nsuper,
		.first = f->super,
		.row_at = f->pi,
		.value_at = f->px,
		.row = f->s,
		.value = f->x,
		.permutation = f->Perm };
}

/* OpenBLAS 0.3 tries for ever where its buffer of 128 MB cannot be had.  Where there is less than that the
 * factor is too large; where there seems to be more, its failure is one. */
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
cholesky_setup(
    mr_ctx *ctx, const mr_solver_opts *opts, const mr_system *system, void *data, mr_solver_report *report)
{
	cholesky *c = data;
	cholmod_sparse upper = as_upper(system->a);
	double start = mr_seconds(), analysed, bytes;
	mr_panels panels;

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
	panels = panels_of(c->factor);
	c->solve = mr_supernodal_new(ctx, &panels);
	*report = (mr_solver_report){ .seconds_analyse = analysed - start,
		.seconds_factor = mr_seconds() - analysed,
		.rcond = cholmod_rcond(c->factor, &c->common),
		.nnz_factor = c->common.lnz };
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
