/*
 * zorder.h -- points in the order of the Z curve, so that neighbours in space are neighbours in memory.
 *
 * Layer rule: mesh.
 */
#ifndef MR_ZORDER_H
#define MR_ZORDER_H

#include "base/vec.h"

/*
 * order[i]: the index of the i-th of n finite points along the Z curve over a grid of 1024 cells a side;
 * those of one cell by index.  order: n < 2^32, the caller's.
 */
mr_status mr_zorder(mr_ctx *ctx, const mr_v3 *p, size_t n, uint32_t *order);

#endif
