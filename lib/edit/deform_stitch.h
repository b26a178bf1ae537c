/*
 * deform_stitch.h -- components that touch, made one for what deforms them.
 *
 * A model of parts that are held by different constraints would come apart.  Triangles between them that no
 * one sees carry the system across: its Laplacian, its weights and its rotations are those of one surface.
 * Private to this room.
 */
#ifndef MR_EDIT_DEFORM_STITCH_H
#define MR_EDIT_DEFORM_STITCH_H

#include "edit/deform_parts.h"

/*
 * rest, and a triangle from each vertex that touches another component to two corners of the face there: of
 * the three that which is best shaped; so too for each of the ties.  None where all is constrained.  region:
 * one a vertex.  stitched: rest at first; its faces come into the arena where there are more.  Riders
 * (deform_riders.h) get none, and are true in rides: one a vertex, false at first; none where ties are not
 * known.
 */
mr_status mr_stitch(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const uint32_t *region,
    mr_mesh *stitched, bool *rides);

#endif
