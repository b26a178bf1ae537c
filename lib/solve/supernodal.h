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
 * L, n x n, in postorder: the descendants of panel s are first_below[s] to s - 1.  Panel s has the columns
 * first[s] to first[s + 1] - 1 and the rows row[row_at[s]] to row[row_at[s
 * + 1] - 1], ascending from its own columns on; its values stand column by column from value[value_at[s]].
 */
typedef struct mr_panels {
	size_t n, count;
	const int *first, *row;
	const int *parent, *first_below; /* of each panel; -1: it is a root */
	const size_t *row_at, *value_at;
	const double *value;
	const int *permutation; /* row i of L is that number of the system */
} mr_panels;

static inline size_t
mr_panel_rows(const mr_panels *l, size_t s)
{
	return l->row_at[s + 1] - l->row_at[s];
}

static inline size_t
mr_panel_columns(const mr_panels *l, size_t s)
{
	return (size_t)(l->first[s + 1] - l->first[s]);
}

/*
 * The largest subtrees whose weights are at most a share of all, the last first; their number.
 * top: of each panel, whether it is in none.  root: count, the caller's, as top.
 */
size_t mr_panel_subtrees(
    mr_ctx *ctx, const mr_panels *l, const double *weight, double share, uint8_t *top, int *root);

typedef struct mr_supernodal mr_supernodal;

/* Prepares solves.  The arrays of the factor must outlive *s. */
mr_supernodal *mr_supernodal_new(mr_ctx *ctx, const mr_panels *factor);

/* Replaces the right-hand sides b (`columns` of them, n values each, in the system's order) by the solutions.
 */
void mr_supernodal_solve(const mr_ctx *ctx, mr_supernodal *s, double *b, size_t columns);

#endif
