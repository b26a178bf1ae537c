/*
 * append.h -- the layers of several frames one behind the other, as one frame's.
 */
#ifndef MR_MESH_APPEND_H
#define MR_MESH_APPEND_H

#include "mesh/layers.h"

/*
 * A key frame with the name and order of the first of n > 0 frames: a layer has the rows of all that have it,
 * in their order.  Triangles, and what refers to those of another layer, get the new numbers; names of
 * groups, objects and materials are those of all.  A column stays that every frame with the layer has in one
 * shape, of faces every one with faces; others are warned of.  handles and displacement, whose rows are no
 * vertices, and how points sample their surface do not stay where several frames have the layer that they are
 * of.  A surface that comes of fewer frames than another is warned of, and so are materials of one name that
 * come of different files.  Histories are joined, equal ones once.  *out is in the arena and borrows from the
 * frames.
 */
mr_status mr_frames_append(mr_ctx *ctx, mr_frame *const *frames, size_t n, mr_frame **out) MR_WARN_UNUSED;

#endif
