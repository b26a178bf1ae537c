/*
 * elimination.h -- what elimination in a given order makes of a symmetric matrix: the tree, the panels of the
 * factor. Private to this room.
 */
#ifndef MR_SOLVE_ELIMINATION_H
#define MR_SOLVE_ELIMINATION_H

#include "solve/sparse.h"
#include "solve/supernodal.h"

/*
 * Column j of the matrix in the order of elimination has, on and below the diagonal, the rows row[k] with the
 * values value[entry[k]] of the matrix given, for k from start[j] to start[j + 1].
 */
typedef struct mr_pattern {
	int n;
	int *start, *row, *entry;
} mr_pattern;

/* Padding after each panel, which is read and not used, eight rows at a time. */
enum { MR_PANEL_SLACK = 8 };

typedef struct mr_elimination {
	mr_panels l;        /* without values */
	const double *work; /* multiplications of each panel */
} mr_elimination;

/*
 * a: the lower triangle, by rows.  order: n, which row is eliminated when; postordered on return, and part of
 * *e.  e: in the arena of ctx; pattern: in work's arena.
 */
void mr_eliminate(
    mr_ctx *ctx, mr_ctx *work, const mr_sparse *a, int *order, mr_elimination *e, mr_pattern *pattern);

#endif
