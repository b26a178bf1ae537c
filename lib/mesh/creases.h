/* creases.h -- normals for shading: faces that meet at more than 45 degrees are not shaded as one. */
#ifndef MR_MESH_CREASES_H
#define MR_MESH_CREASES_H

#include "mesh/mesh.h"

typedef struct mr_creases {
	const mr_mesh *m;
	const mr_incidence *around;
	mr_v3 *normal; /* of vertices, unit: of their faces by area */
	bool *creased; /* vertices with faces that are not shaded as one */
} mr_creases;

/* In the arena; around: of the mesh; both borrowed. */
void mr_creases_find(mr_ctx *ctx, const mr_mesh *m, const mr_incidence *around, mr_creases *c);

/* The normal of a face's corner. */
mr_v3 mr_corner_normal(const mr_creases *c, size_t face, int corner);

/* The normal of the same faces in another pose, p; not unit. */
mr_v3 mr_corner_normal_posed(const mr_creases *c, const mr_v3 *p, size_t face, int corner);

#endif
