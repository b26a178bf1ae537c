/*
 * outward.h -- which side of a surface is outside.
 */
#ifndef MR_SPACE_OUTWARD_H
#define MR_SPACE_OUTWARD_H

#include "mesh/mesh.h"

/*
 * The parts that are inside out: rays from either side of some of its faces meet the same side of other
 * parts, or leave the scene, which only an outside does.  A part is inside out if over four times as many say
 * so as the contrary: a hollow is not, nor a sheet that is seen from both sides alike.
 *
 * turned: nf, whether the face is of such a part; *parts: how many there are.
 */
void mr_inside_out(mr_ctx *ctx, const mr_mesh *m, bool *turned, size_t *parts);

#endif
