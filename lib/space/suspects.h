/* suspects.h -- the pairs of faces of a mesh that may intersect. */
#ifndef MR_SPACE_SUSPECTS_H
#define MR_SPACE_SUSPECTS_H

#include "space/bvh.h"

/* Calls visit(arg, f, g) once for every pair of faces that may have more in common than a corner, among
 * others, from several threads at once. */
void mr_suspects_visit(
    mr_ctx *ctx, const mr_bvh *bvh, void (*visit)(void *arg, uint32_t f, uint32_t g), void *arg);

#endif
