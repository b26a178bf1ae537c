/*
 * region_transfer.h -- regions chosen on the mesh, and where its parts touch, as its base has them, which
 * need not touch there: parts of few vertices shrink, or lose their corners.
 */
#ifndef MR_EDIT_REGION_TRANSFER_H
#define MR_EDIT_REGION_TRANSFER_H

#include "edit/deform_opts.h"
#include "space/source_map.h"

/* True where the regions of the frame's layer are those of the mesh, not its own. */
bool mr_transfer_applies(const mr_frame *f, const char *layer);

/* MR_EMISSING: the layer has no regions.  The sentence says where they are, and how it gets some. */
mr_status mr_transfer_missing(mr_ctx *ctx, const mr_frame *f, const char *layer);

/*
 * The regions of a layer of the frame: its own, or where that is a base and the mesh has regions, the mesh's.
 * Then each vertex of the base takes the region of the corner that is nearest its place on the mesh: the one
 * with the largest barycentric coordinate, of equal ones that of the lowest vertex.  The place is that of
 * the base's source map, or without one the closest point.  MR_EMESH where a handle of the mesh reaches no
 * vertex of the base.  region: one per vertex of `base`.
 */
mr_status mr_transfer_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, const uint32_t **region);

/*
 * Of the frame's base, over which its mesh is encoded, one tie for each vertex and component that touch
 * somewhere by the vertices of the mesh that stand on them.  None of another layer, or without detail.
 * ties: in the arena.
 */
mr_status mr_transfer_ties(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, mr_ties *ties);

#endif
