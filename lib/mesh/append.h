/* append.h -- the layers of several frames one behind the other, as one frame's. */
#ifndef MR_MESH_APPEND_H
#define MR_MESH_APPEND_H

#include "mesh/layers.h"

/* A key frame with the name and order of the first of n > 0 frames: a layer has the rows of all that have it,
 * triangles and what refers to rows new numbers, names are those of all.  A frame without a column gets what
 * stands for it (mr_missing).  Lost are columns that not all have where nothing can, or not in one shape, and
 * handles, displacement and samplings of several.  Histories are joined, equal ones once.  Where one frame
 * has texture coordinates of corners, the frames' own become such.  *out is in the arena and borrows from
 * them. */
mr_status mr_frames_append(mr_ctx *ctx, mr_frame *const *frames, size_t n, mr_frame **out) MR_WARN_UNUSED;

#endif
