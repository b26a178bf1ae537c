/*
 * remesh.h -- area-equalizing isotropic remeshing (Botsch, Kobbelt 2004, section 4).
 */
#ifndef MR_REMESH_H
#define MR_REMESH_H

#include "space/source_map.h"

/* Edges that are kept as curves.  Marks of the input's half-edges; for the result's half-edges, in the arena,
 * the input's whose curve each is on, MR_NONE for most. */
typedef struct mr_kept {
	uint8_t *seam;
	const uint32_t *along;
} mr_kept;

/*
 * Remeshes an oriented manifold m, boundary allowed; isolated vertices are left out.  MR_EMESH where
 * it is not manifold.  kept: or NULL.  map: where its vertices lie on m.  out, map: in the arena.  result:
 * or NULL, which saves figures that take time.
 */
mr_status mr_remesh(mr_ctx *ctx, const mr_mesh *m, const mr_remesh_opts *o, mr_kept *kept, mr_mesh *out,
    mr_places *map, mr_remesh_result *result);

#endif
