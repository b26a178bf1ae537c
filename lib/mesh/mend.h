/* mend.h -- layers mended: welding and repair, with all that vertices, faces and corners have. */
#ifndef MR_MESH_MEND_H
#define MR_MESH_MEND_H

#include "mesh/layers.h"
#include "mesh/repair.h"

/* Turns a column of vertices into one of corners: texcoord or normal. */
mr_status mr_layer_to_corners(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const char *name) MR_WARN_UNUSED;

/* Joins vertices within eps (0: equal ones): the lowest gives position and attributes; texture coordinates
 * and normals that differ become corners'.  Faces that lose a corner go.  may: which may join others; NULL:
 * all.  joined: how many went. */
mr_status mr_layer_weld(
    mr_ctx *ctx, mr_frame *f, const char *layer, double eps, const bool *may, size_t *joined) MR_WARN_UNUSED;

/* mr_repair of a layer of faces, attributes carried along. */
mr_status
mr_layer_repair(mr_ctx *ctx, mr_frame *f, const char *layer, mr_repair_report *report) MR_WARN_UNUSED;

/* Turns these faces over; normals go. */
mr_status mr_layer_turn(mr_ctx *ctx, mr_frame *f, const char *layer, const bool *turned) MR_WARN_UNUSED;

#endif
