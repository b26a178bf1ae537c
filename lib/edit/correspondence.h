/* correspondence.h -- where each vertex of a mesh stands on its base, by the source map. */
#ifndef MR_EDIT_CORRESPONDENCE_H
#define MR_EDIT_CORRESPONDENCE_H

#include "mesh/mesh.h"

typedef struct mr_correspondence {
	const mr_mesh *mesh;
	mr_mesh lifted; /* the base with its vertices where the source map has them on the mesh */
	const mr_incidence *inc;
	mr_incidence mesh_inc;
	uint32_t *
	    label; /* of each vertex of the mesh, a vertex of the base that is near on the mesh, or MR_NONE */
} mr_correspondence;

/* inc: of the base.  In the arena. */
void mr_correspond(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, const mr_incidence *inc,
    const mr_places *source, mr_correspondence *c);

/* Prefetches data of mr_correspond_near for some vertices after i, below end. */
void mr_correspond_soon(const mr_correspondence *c, const mr_mesh *base, size_t i, size_t end);

/* A place near vertex i on base, on a face around the vertex that is near i on the mesh: the first that has
 * its foot within, or the nearest; face MR_NONE without any. */
mr_place mr_correspond_near(const mr_correspondence *c, const mr_mesh *base, size_t i);

/* Places for the other vertices: the nearest on the lifted base, met by a walk from the base vertex near it
 * or from a neighbour's place.  So no vertex lands on another sheet, however close.  face, bary: the
 * caller's; those that stand have theirs. */
void
mr_correspond_rest(mr_ctx *ctx, const mr_correspondence *c, const bool *stands, uint32_t *face, mr_v3 *bary);

#endif
