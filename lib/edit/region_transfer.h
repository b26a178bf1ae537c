/* region_transfer.h -- regions chosen on the mesh, and where its parts touch, as its base has them. */
#ifndef MR_EDIT_REGION_TRANSFER_H
#define MR_EDIT_REGION_TRANSFER_H

#include "edit/deform_opts.h"
#include "space/source_map.h"

/* True if the frame's layer takes its regions from the mesh. */
bool mr_transfer_applies(const mr_frame *f, const char *layer);

/* MR_EMISSING: the layer has no regions.  The sentence says where they are, and how it gets some. */
mr_status mr_transfer_missing(mr_ctx *ctx, const mr_frame *f, const char *layer);

/* The regions of a layer: its own, or for a base the mesh's: of the corner with the largest barycentric
 * coordinate of its place by the source map, else of the closest point.  MR_EMESH where a handle of the mesh
 * reaches no vertex of the base.  region: one per vertex of `base`. */
mr_status mr_transfer_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, const uint32_t **region);

/* One tie for each vertex of the base and component that touch by the vertices of the mesh that stand on
 * them.  None of another layer, or without detail.  ties: in the arena. */
mr_status mr_transfer_ties(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, mr_ties *ties);

#endif
