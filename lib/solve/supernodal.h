/*
 * supernodal.h -- solves with a supernodal Cholesky factor: L y = b, L' x = y.
 *
 * Contract: a factor is dense panels of columns (supernodes) that share their rows.  Its values are borrowed.
 * No sum depends on a BLAS.
 * Private to this room.
 */
#ifndef MR_SOLVE_SUPERNODAL_H
#define MR_SOLVE_SUPERNODAL_H

#include "base/ctx.h"

/*
 * L, n x n.  Panel s has the columns first[s] to first[s + 1] - 1 and the rows row[row_at[s]] to row[row_at[s
 * + 1] - 1], ascending from its own columns on; its values stand column by column from value[value_at[s]].
 */
typedef struct mr_panels {
	size_t n, count;
	const int *first, *row_at, *value_at, *row;
	const double *value;
	const int *permutation; /* row i of L is that number of the system */
} mr_panels;

typedef struct mr_supernodal mr_supernodal;

/* Prepares solves.  The arrays of the factor must outlive *s. */
mr_supernodal *mr_supernodal_new(mr_ctx *ctx, const mr_panels *factor);

/* Replaces the right-hand sides b (`columns` of them, n values each, in the system's order) by the solutions.
 */
void mr_supernodal_solve(const mr_ctx *ctx, mr_supernodal *s, double *b, size_t columns);

#endif
