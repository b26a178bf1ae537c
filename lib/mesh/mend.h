/* mend.h -- layers mended: welding and repair, with all that vertices, faces and corners have. */
#ifndef MR_MESH_MEND_H
#define MR_MESH_MEND_H

#include "mesh/layers.h"

/*
 * Joins vertices within eps (0: equal ones); the lowest of them gives position and attributes, but for
 * texture coordinates and normals, which become those of corners where they differ.  Faces that lose a corner
 * by it go; those that had a vertex twice before stay.  joined: how many went.
 */
mr_status mr_layer_weld(mr_ctx *ctx, mr_frame *f, const char *layer, double eps, size_t *joined) MR_WARN_UNUSED;

/* mr_repair, attributes carried along.  Points stay as they are.  Reports what was done. */
mr_status mr_layer_repair(mr_ctx *ctx, mr_frame *f, const char *layer) MR_WARN_UNUSED;

#endif
