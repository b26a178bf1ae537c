/*
 * cells.h -- a set of cubic cells of space, some of them marked.
 */
#ifndef MR_SPACE_CELLS_H
#define MR_SPACE_CELLS_H

#include "mesh/mesh.h"

typedef struct mr_cell {
	int at[3];
} mr_cell;

/* Cells are marked in a set of bits by their hash: what is marked by chance is looked at in vain. */
typedef struct mr_cells {
	double scale; /* 1 over the side of a cell */
	uint32_t *bits;
	bool any;
} mr_cells;

/* None is marked.  In the arena. */
mr_cells mr_cells_new(mr_ctx *ctx, double size);

mr_cell mr_cell_of(const mr_cells *c, mr_v3 p);
uint32_t mr_cell_hash(mr_cell c);

void mr_cells_mark(mr_cells *c, mr_v3 p);

/* Whether p is in a marked cell. */
bool mr_cells_hold(const mr_cells *c, mr_v3 p);

/* Whether a box meets a marked cell, or more than some cells. */
bool mr_cells_meet(const mr_cells *c, mr_box box);

#endif
