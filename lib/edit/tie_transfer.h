/*
 * tie_transfer.h -- where parts touch on the mesh, as its base has them.
 *
 * A base need not touch where its mesh does: parts of few vertices shrink, or lose their corners.
 */
#ifndef MR_EDIT_TIE_TRANSFER_H
#define MR_EDIT_TIE_TRANSFER_H

#include "edit/deform.h"
#include "mesh/layers.h"

/*
 * Of the frame's base, over which its mesh is encoded, one tie for each vertex and component that touch
 * somewhere by the vertices of the mesh that stand on them.  None of another layer, or without detail.
 * ties: in the arena.
 */
mr_status mr_transfer_ties(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, mr_ties *ties);

#endif
