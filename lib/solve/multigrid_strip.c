/*
 * Multigrid for L (W L)^(k-1).  V-cycles on L, k times, invert it except its boundary conditions: they have
 * all Laplacians vanish at the constraints, but the system has k rings of given vertices.  The error varies
 * along the boundary and decays away from it, the faster the shorter its waves.  So a strip of rings along
 * the boundary is solved exactly before and after: multiplicative Schwarz (Smith, Bjorstad, Gropp 1996:
 * Domain decomposition, chapter 1).  It is symmetric, and positive definite because both its parts are.
 */
#include "solve/preconditioner.h"
#include "solve/sparse.h"

typedef struct strip {
	mr_preconditioner cycles;
	const mr_sparse *a; /* borrowed */
	const uint32_t *row;
	size_t n;         /* rows of the strip */
	mr_solver *exact; /* of the strip alone; NULL where it is empty */
	double *column;   /* its right-hand sides */
	double *r, *d;    /* of all rows, MR_WIDTH wide: residual, a change */
} strip;

/* z += R' (R A R')^-1 R r, R being the choice of the strip's rows */
static mr_status
solve_strip(mr_ctx *ctx, const strip *t, mr_multivector s, const double *r, double *z)
{
	for (size_t c = 0; c < s.width; c++)
		for (size_t i = 0; i < t->n; i++)
			t->column[c * t->n + i] = r[t->row[i] * s.width + c];
	MR_TRY(mr_solver_solve(ctx, t->exact, t->column, s.width));
	for (size_t c = 0; c < s.width; c++)
		for (size_t i = 0; i < t->n; i++)
			z[t->row[i] * s.width + c] += t->column[c * t->n + i];
	return MR_OK;
}

/* r = b - A z */
static void
find_residual(const mr_ctx *ctx, const strip *t, mr_multivector s, const double *b, const double *z)
{
	memcpy(t->r, b, s.n * s.width * sizeof *b);
	mr_sparse_add(ctx, t->a, -1, s.width, z, t->r);
}

static mr_status
strip_apply(mr_ctx *ctx, void *data, mr_multivector s, const double *r, double *z)
{
	const strip *t = data;

	if (!t->exact)
		return t->cycles.apply(ctx, t->cycles.data, s, r, z);
	memset(z, 0, s.n * s.width * sizeof *z);
	MR_TRY(solve_strip(ctx, t, s, r, z));
	find_residual(ctx, t, s, r, z);
	MR_TRY(t->cycles.apply(ctx, t->cycles.data, s, t->r, t->d));
	mr_multivector_add(ctx, s, MR_ONE, t->d, MR_ONE, z);
	find_residual(ctx, t, s, r, z);
	return solve_strip(ctx, t, s, t->r, z);
}

static mr_status
factor_strip(mr_ctx *ctx, strip *t)
{
	mr_sparse lower;

	t->exact = mr_solver_new(ctx);
	MR_SCOPE(ctx);
	mr_sparse_restrict(ctx, t->a, t->row, t->n, true, &lower);
	return mr_solver_direct(ctx, t->exact, MR_CHOLESKY, &lower, NULL);
}

mr_status
mr_multigrid_new(mr_ctx *ctx, const mr_sparse *a, const mr_hierarchy *h, mr_preconditioner *b)
{
	strip *t = MR_NEW_ZERO(ctx, 1, strip);
	size_t n = (size_t)a->n * MR_WIDTH;

	*b = (mr_preconditioner){ strip_apply, t, 0 };
	t->a = a;
	t->row = h->strip;
	t->n = h->strip_count;
	MR_TRY(mr_cycles_new(ctx, h, &t->cycles));
	b->nnz = t->cycles.nnz;
	if (t->n == 0)
		return MR_OK;
	t->column = MR_NEW(ctx, t->n * MR_WIDTH, double);
	t->r = MR_NEW(ctx, n, double);
	t->d = MR_NEW(ctx, n, double);
	MR_TRY(factor_strip(ctx, t));
	b->nnz += mr_solver_reported(t->exact).nnz_factor;
	return MR_OK;
}
