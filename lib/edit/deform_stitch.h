/*
 * deform_stitch.h -- components that touch, made one for what deforms them.
 *
 * A model of parts that are held by different constraints would come apart.  Triangles between them that no
 * one sees carry the system across: its Laplacian, its weights and its rotations are those of one surface.
 * Private to this room.
 */
#ifndef MR_EDIT_DEFORM_STITCH_H
#define MR_EDIT_DEFORM_STITCH_H

#include "edit/deform_opts.h"

/*
 * rest, and a triangle from each vertex that is near another component, to two corners of the face there; so
 * too for each of the ties.  None of parts that are small beside what they are near, unconstrained and not
 * tied, if the ties are known: they have no shape of their own to solve for, and are true in follows (one a
 * vertex, false at first).  Its faces are rest's, or in the arena.
 */
mr_mesh
mr_stitch(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const uint32_t *region, bool *follows);

#endif
