/*
 * correspondence.h -- where each vertex of a mesh stands on its base by the source map, which says the
 * reverse.
 */
#ifndef MR_EDIT_CORRESPONDENCE_H
#define MR_EDIT_CORRESPONDENCE_H

#include "mesh/mesh.h"

/*
 * The base with its vertices where the source map has them on the mesh is a second surface close to the mesh:
 * a vertex stands at its nearest place there, met by a walk from the base vertex that lies nearest to it on
 * the mesh. So neighbours stand side by side, and no vertex on another sheet, however close that is.  Face
 * MR_NONE where the map reaches nothing of a vertex's component.  inc: of the base.  at: as many as mesh has
 * vertices, the caller's.
 */
mr_status mr_correspond(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, const mr_incidence *inc,
    const mr_places *source, uint32_t *face, mr_v3 *bary);

#endif
