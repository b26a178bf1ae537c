/*
 * source_map.h -- where the vertices of a base lie on the mesh it came from: the columns base.source_*.
 *
 * The parameterization through which regions and details find their way (Botsch, Kobbelt 2004, section 4).
 */
#ifndef MR_SPACE_SOURCE_MAP_H
#define MR_SPACE_SOURCE_MAP_H

#include "mesh/layers.h"

/* The identity: each vertex of m at a corner of its lowest face; one without a face at a corner of the first.
 * map: in the arena. */
void mr_source_map_identity(mr_ctx *ctx, const mr_mesh *m, mr_places *map);

/*
 * MR_ERANGE where a place of the map, of base_nv vertices, is on no face of the mesh's or not within it.
 */
mr_status mr_source_map_check(mr_ctx *ctx, const mr_mesh *mesh, size_t base_nv, const mr_places *map);

/* The map of the frame's base, checked against the mesh.  MR_EMISSING without one. */
mr_status mr_source_map_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *mesh, size_t base_nv, mr_places *map);

/*
 * The places on the frame's mesh of n vertices that `over` places on its surface m: the same if m is the
 * mesh, composed if it is the base and has a map.  *mapped is false otherwise.
 */
mr_status mr_source_map_follow(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const mr_places *over, size_t n,
    mr_places *map, bool *mapped);

mr_status mr_source_map_put(mr_ctx *ctx, mr_frame *f, const mr_places *map, size_t base_nv);

#endif
