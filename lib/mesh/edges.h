/* edges.h -- the edges of any mesh, each with all its half-edges; not of faces with a vertex twice. */
#ifndef MR_MESH_EDGES_H
#define MR_MESH_EDGES_H

#include "mesh/fold.h"

/* Edge e has he[start[e]] to he[start[e + 1]], by index; edges are ordered by lower, then higher vertex. */
typedef struct mr_edges {
	size_t count;
	uint32_t *start; /* count + 1 */
	uint32_t *he;
} mr_edges;

/* The edges of m, in the arena. */
void mr_edges_build(mr_ctx *ctx, const mr_mesh *m, mr_edges *edges);

/* Whether two half-edges of one edge run in the same direction: their faces are not oriented alike. */
static inline bool
mr_same_direction(const mr_mesh *m, uint32_t h, uint32_t g)
{
	return mr_he_from(m, h) == mr_he_from(m, g);
}

/* Whether the two faces of an edge, however they are oriented, are folded there. */
static inline bool
mr_is_fold(const mr_mesh *m, uint32_t h, uint32_t g)
{
	mr_v3 a = mr_face_cross(m, h / 3), b = mr_face_cross(m, g / 3);

	return mr_folds(mr_same_direction(m, h, g) ? mr_mul(-1, a) : a, b, MR_FOLD);
}

/* Whether the surface encloses a volume: every edge has as many faces one way as the other. */
bool mr_edges_enclose(const mr_mesh *m, const mr_edges *edges);

/* Faces of edge e. */
static inline uint32_t
mr_edge_faces(const mr_edges *edges, size_t e)
{
	return edges->start[e + 1] - edges->start[e];
}

#endif
