/*
 * Incomplete factors without fill: Meijerink, van der Vorst 1977: An iterative solution method for linear
 * systems of which the coefficient matrix is a symmetric M-matrix.  Laplacians of obtuse triangles are none:
 * Axelsson, Kolotilina 1994: Diagonally compensated reduction and related preconditioning methods.  Nor are
 * bilaplacians: Manteuffel's shift.
 */
#include "solve/preconditioner.h"

#include <math.h>

typedef struct incomplete {
	mr_sparse f; /* rows of L without its unit diagonal, then of U */
	int *diagonal;
	bool compensated; /* of the matrix that compensate() leaves */
} incomplete;

/* D^-1 */

static mr_status
jacobi_apply(mr_ctx *ctx, void *data, mr_multivector s, const double *r, double *z)
{
	mr_multivector_scale(ctx, s, data, r, z);
	return MR_OK;
}

mr_preconditioner
mr_jacobi_of(double *inverse, size_t n)
{
	return (mr_preconditioner){ jacobi_apply, inverse, (double)n };
}

/* (L U)^-1 */

/* Eliminates row i; at[column]: place of the row's entry, or -1 before and after. */
static void
eliminate(incomplete *c, int i, int *at)
{
	mr_sparse *f = &c->f;

	for (int e = f->start[i]; e < f->start[i + 1]; e++)
		at[f->index[e]] = e;
	for (int e = f->start[i]; e < c->diagonal[i]; e++) {
		int k = f->index[e];
		double l = f->value[e] /= f->value[c->diagonal[k]];
		for (int g = c->diagonal[k] + 1; g < f->start[k + 1]; g++)
			if (at[f->index[g]] >= 0)
				f->value[at[f->index[g]]] -= l * f->value[g];
	}
	for (int e = f->start[i]; e < f->start[i + 1]; e++)
		at[f->index[e]] = -1;
}

/* Adds entries above zero beside the diagonal to it: of a positive definite matrix that makes an M-matrix,
 * all of whose pivots are positive. */
static void
compensate(incomplete *c)
{
	mr_sparse *f = &c->f;

	for (int i = 0; i < f->n; i++)
		for (int e = f->start[i]; e < f->start[i + 1]; e++)
			if (f->index[e] != i && f->value[e] > 0) {
				f->value[c->diagonal[i]] += f->value[e];
				f->value[e] = 0;
			}
}

/* False where a pivot is not positive. */
static bool
factor(incomplete *c, const mr_sparse *a, double shift, int *at)
{
	memcpy(c->f.value, a->value, (size_t)a->start[a->n] * sizeof *a->value);
	if (c->compensated)
		compensate(c);
	for (int i = 0; i < a->n; i++) {
		double *pivot = &c->f.value[c->diagonal[i]];
		*pivot += shift * fabs(*pivot);
		eliminate(c, i, at);
		if (!(*pivot > 0))
			return false;
	}
	return true;
}

/* z = L^-1 r, then U^-1 z */
static inline void
substitute(const incomplete *c, size_t width, const double *r, double *z)
{
	const mr_sparse *f = &c->f;

	for (int i = 0; i < f->n; i++) {
		double sum[MR_WIDTH];
		for (size_t k = 0; k < width; k++)
			sum[k] = r[(size_t)i * width + k];
		for (int e = f->start[i]; e < c->diagonal[i]; e++)
			for (size_t k = 0; k < width; k++)
				sum[k] -= f->value[e] * z[(size_t)f->index[e] * width + k];
		for (size_t k = 0; k < width; k++)
			z[(size_t)i * width + k] = sum[k];
	}
	for (int i = f->n - 1; i >= 0; i--) {
		double sum[MR_WIDTH], inverse = 1 / f->value[c->diagonal[i]];
		for (size_t k = 0; k < width; k++)
			sum[k] = z[(size_t)i * width + k];
		for (int e = f->start[i + 1] - 1; e > c->diagonal[i];
		     e--) /* the row that is waited for comes last */
			for (size_t k = 0; k < width; k++)
				sum[k] -= f->value[e] * z[(size_t)f->index[e] * width + k];
		for (size_t k = 0; k < width; k++)
			z[(size_t)i * width + k] = inverse * sum[k];
	}
}

/* A loop of a known length is faster. */
static mr_status
incomplete_apply(mr_ctx *ctx, void *data, mr_multivector s, const double *r, double *z)
{
	(void)ctx;
	if (s.width == 3)
		substitute(data, 3, r, z);
	else
		substitute(data, s.width, r, z);
	return MR_OK;
}

static mr_status
find_diagonal(mr_ctx *ctx, incomplete *c)
{
	for (int i = 0; i < c->f.n; i++) {
		int e = mr_sparse_find(&c->f, i, i);
		if (e < 0)
			return mr_fail(ctx, MR_ENUMERIC, "the matrix has no diagonal entry in row %d", i);
		c->diagonal[i] = e;
	}
	return MR_OK;
}

mr_status
mr_incomplete_new(mr_ctx *ctx, const mr_sparse *a, bool laplacian, mr_preconditioner *b)
{
	/* a first shift ten times as large or small: 17 % fewer iterations or 12 % more, as the model has it
	 */
	static const double first = 1e-3, last = 10;
	size_t n = (size_t)a->n, nnz = (size_t)a->start[n];
	incomplete *c = MR_NEW(ctx, 1, incomplete);
	double *value = MR_NEW(ctx, nnz, double);
	int *diagonal = MR_NEW(ctx, n, int), *at = MR_NEW(ctx, n, int);
	bool done;

	*c = (incomplete){ .f = { a->n, a->start, a->index, value }, .diagonal = diagonal };
	MR_TRY(find_diagonal(ctx, c));
	for (size_t i = 0; i < n; i++)
		at[i] = -1;
	done = factor(c, a, 0, at);
	if (!done && laplacian) {
		c->compensated = true;
		done = factor(c, a, 0, at);
	}
	for (double shift = first; !done && shift <= last; shift *= 2)
		done = factor(c, a, shift, at);
	if (!done)
		return mr_fail(ctx, MR_ENUMERIC, "the matrix has no incomplete factors");
	*b = (mr_preconditioner){ incomplete_apply, c, (double)nnz };
	return MR_OK;
}
