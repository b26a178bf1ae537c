/*
 * sparse.h -- sparse matrices by rows.
 *
 * Contract: the indices of a row are ascending, each once.  Row numbers and indices
 * are int, as the direct solvers have them: a matrix has fewer than 2^31 entries.
 */
#ifndef MR_SOLVE_SPARSE_H
#define MR_SOLVE_SPARSE_H

#include "base/ctx.h"
#include "base/vec.h"

/* Row i: the columns index[k] and values value[k] for k from start[i] to start[i + 1]. */
typedef struct mr_sparse {
	int n;      /* rows */
	int *start; /* n + 1 */
	int *index;
	double *value;
} mr_sparse;

/* Sorts the n columns of a short row. */
static inline void
mr_sparse_sort(int *column, int n)
{
	for (int i = 1; i < n; i++) {
		int x = column[i], k = i;
		for (; k > 0 && column[k - 1] > x; k--)
			column[k] = column[k - 1];
		column[k] = x;
	}
}

/* The row starts of a matrix whose row i has length[i] entries, which may be a->start + 1 itself; MR_ERANGE
 * for 2^31 entries or more. */
mr_status mr_sparse_starts(mr_ctx *ctx, const int *length, mr_sparse *a);

/* The index of row i's entry of a column; -1: nowhere. */
static inline int
mr_sparse_find(const mr_sparse *a, int i, int column)
{
	int e = a->start[i];

	while (e < a->start[i + 1] && a->index[e] < column)
		e++;
	return e < a->start[i + 1] && a->index[e] == column ? e : -1;
}

/* The n rows listed, ascending, and their columns alone; with `lower` only entries on and below the diagonal.
 * out: in the arena. */
void mr_sparse_restrict(
    mr_ctx *ctx, const mr_sparse *a, const uint32_t *row, size_t n, bool lower, mr_sparse *out);

/* The transpose of a matrix with `columns` columns.  t: in the arena. */
mr_status mr_sparse_transpose(mr_ctx *ctx, const mr_sparse *a, size_t columns, mr_sparse *t);

/* c = a b, where b has `columns` columns.  c: in the arena. */
mr_status
mr_sparse_multiply(mr_ctx *ctx, const mr_sparse *a, const mr_sparse *b, size_t columns, mr_sparse *c);

/*
 * The first n rows and columns of L (W L)^(k-1), W = diag(w) with a weight per row of L, which is symmetric;
 * with `lower` only entries on and below the diagonal.  Entries (k-1 steps away from row n) of l are read, so
 * those rows must be complete.  out: in the arena.
 */
mr_status mr_sparse_power(
    mr_ctx *ctx, const mr_sparse *l, const double *w, size_t k, size_t n, bool lower, mr_sparse *out);

/*
 * y = A x for the first `rows` rows of A; scaled by w[i] where w is not NULL.  x and y have `width` values
 * (at most 4) per row, next to each other.
 */
void mr_sparse_apply(const mr_ctx *ctx, const mr_sparse *a, const double *w, size_t rows, size_t width,
    const double *x, double *y);

/* y = y + f A x, for all rows of A. */
void mr_sparse_add(const mr_ctx *ctx, const mr_sparse *a, double f, size_t width, const double *x, double *y);

/*
 * Nested dissection: cuts the vertices 0 to n - 1, at positions p and with the neighbours of l's rows, into
 * parts and the separators between them, `reach` edges wide, until a part is small.  part[i] is a number
 * below n; a separator's is higher than its parts', and no vertices of two parts are within `reach` edges
 * through either.  Neighbours from n on are not looked at.  part: n, the caller's.
 */
void mr_dissect(mr_ctx *ctx, const mr_sparse *l, const mr_v3 *p, size_t n, size_t reach, int *part);

/* An order to eliminate the rows of a in, its lower triangle, part after part; NULL: all are one.  order: a->n. */
mr_status mr_order(mr_ctx *ctx, const mr_sparse *a, const int *part, int *order) MR_WARN_UNUSED;

#endif
