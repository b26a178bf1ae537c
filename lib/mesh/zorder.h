/* zorder.h -- points in the order of the Z curve, so that neighbours in space are neighbours in memory. */
#ifndef MR_MESH_ZORDER_H
#define MR_MESH_ZORDER_H

#include "base/vec.h"

enum { MR_ZORDER_CELLS = 1024 };

/* order[i]: the index of the i-th of n finite points along the Z curve over `cells` a side, at most
 * MR_ZORDER_CELLS; points of one cell by x, y, z, then by index.  order: n < 2^32, the caller's. */
void mr_zorder(mr_ctx *ctx, const mr_v3 *p, size_t n, double cells, uint32_t *order);

/* The points in that order, on the finest grid.  sorted: n, the caller's. */
void mr_zorder_points(mr_ctx *ctx, const mr_v3 *p, size_t n, mr_v3 *sorted);

#endif
