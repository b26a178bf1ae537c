/* islands.h -- loops that bound one hole together: its rim, and those of pieces of surface that lie in it. */
#ifndef MR_EDIT_ISLANDS_H
#define MR_EDIT_ISLANDS_H

#include "mesh/loops.h"

/* next: of each loop the next of the same hole, MR_NONE: none.  holes: n loops, the first of which take
 * islands before later ones do.  An island is another component, all within the ball about the hole's rim,
 * and open: its loop is one of `open`, lies within the hole as seen along its normal, and runs the other way
 * around. component: as by mr_components_label. */
void mr_islands_find(mr_ctx *ctx, const mr_mesh *m, const mr_loops *loops, const uint32_t *component,
    const bool *open, const uint32_t *holes, size_t n, uint32_t *next);

/* Joins `count` closed polygons, of the corners from start[i] to start[i + 1], to the one of *n corners, each
 * by the shortest bridge to what is joined before it: that is passed both ways, so that its ends come twice.
 * p: the places of all; corner: room for all and two more an island; ends: of each bridge, the caller's. */
void mr_islands_join(
    const mr_v3 *p, const uint32_t *start, size_t count, uint32_t *corner, size_t *n, uint32_t (*ends)[2]);

#endif
