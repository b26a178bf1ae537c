/*
 * sparse.h -- sparse matrices by rows.
 *
 * Contract: the indices of a row are ascending, each once.  Row numbers and indices
 * are int, as the direct solvers have them: a matrix has fewer than 2^31 entries.
 * Layer rule: op.
 */
#ifndef MR_SPARSE_H
#define MR_SPARSE_H

#include "base/ctx.h"

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

/* The transpose of a matrix with `columns` columns.  t: in the arena. */
mr_status mr_sparse_transpose(mr_ctx *ctx, const mr_sparse *a, size_t columns, mr_sparse *t);

/* c = a b, where b has `columns` columns.  c: in the arena. */
mr_status
mr_sparse_multiply(mr_ctx *ctx, const mr_sparse *a, const mr_sparse *b, size_t columns, mr_sparse *c);

#endif
