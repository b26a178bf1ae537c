/*
 * dynmesh_patch.h -- a part of an editable mesh that is worked on alone and then put back, at a price that
 * goes with the part and not with the mesh.
 *
 * Contract: the part's vertices of kind MR_RIM, and the edges and faces between them, stay as they are.
 */
#ifndef MR_MESH_DYNMESH_PATCH_H
#define MR_MESH_DYNMESH_PATCH_H

#include "mesh/dynmesh.h"

typedef struct mr_patch {
	mr_dyn d;       /* its outermost edges, between vertices of the rim, have no twins */
	uint32_t *of;   /* of each of its first nv vertices: its number in the mesh */
	uint32_t *face; /* nf faces of the mesh */
	size_t nv, nf;
} mr_patch;

/*
 * Cuts out a copy of what is within `rings` (at least 1, at most 200) edges of the n vertices of d, and one
 * ring of faces more, which is the rim.  In the arena.
 */
mr_status
mr_patch_cut(mr_ctx *ctx, const mr_dyn *d, const uint32_t *vertex, size_t n, unsigned rings, mr_patch *patch);

/* Puts it back in place of what it was cut from, which has not changed since. */
mr_status mr_patch_paste(mr_ctx *ctx, mr_dyn *d, const mr_patch *patch);

#endif
