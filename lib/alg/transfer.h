/*
 * transfer.h -- regions chosen on the mesh, as its base has them.
 *
 * Layer rule: alg.
 */
#ifndef MR_TRANSFER_H
#define MR_TRANSFER_H

#include "alg/sourcemap.h"

/*
 * Each vertex of the base takes the region of the corner that is nearest its place on the mesh: the one
 * with the largest barycentric coordinate, of equal ones that of the lowest vertex.  The place is that of
 * the map, or without one (NULL) the closest point.  MR_EMESH where a handle of the mesh reaches no
 * vertex of the base.  out: base->nv, the caller's.
 */
mr_status mr_transfer_regions(mr_ctx *ctx, const mr_mesh *mesh, const uint32_t *region,
    const mr_source_map *map, const mr_mesh *base, uint32_t *out);

/* True where the regions of the frame's layer are those of the mesh, not its own. */
bool mr_transfer_applies(const mr_frame *f, const char *layer);

/*
 * The regions of a layer of the frame: its own, or where that is a base and the mesh has regions, the mesh's
 * by the base's source map.  region: one per vertex of `base`, whose positions a map that is missing asks
 * for.
 */
mr_status mr_transfer_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, const uint32_t **region);

#endif
