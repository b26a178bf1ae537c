/*
 * shrinking.h -- what a coarser or rounder surface has lost, or has too much.
 *
 * Private to this room.
 */
#ifndef MR_TOOL_SHRINKING_H
#define MR_TOOL_SHRINKING_H

#include "mesh/mesh.h"

/* Warns where `out`, which is made of m, has lost over a tenth of its area, or where m is closed has lost or
 * gained as much of its volume, and says why. */
mr_status mr_warn_of_shrinking(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const char *why);

/* The same; else warns where a part has lost over half of it, or else where a place of m is farther than a
 * twentieth of its diagonal from `out`, or one of `out` from m: of at most 65,536 corners at equal strides,
 * and of 16,384 places drawn by area.  from: a vertex of m, that each of `out` comes from. */
mr_status mr_warn_of_coarseness(
    mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const uint32_t *from, const char *why);

#endif
