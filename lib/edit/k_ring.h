/*
 * k_ring.h -- the part of a mesh that a local problem sees: chosen vertices and k rings around them.
 *
 * Contract: a patch is a mesh of its own, numbered ring by ring, so what an operator
 * that reaches r rings needs is always a prefix.  Everything is in the arena.
 */
#ifndef MR_EDIT_K_RING_H
#define MR_EDIT_K_RING_H

#include "mesh/mesh.h"

enum { MR_PATCH_RINGS = 3 };

/* The faces of the patch are those with a corner in ring `rings` - 1 or nearer. */
typedef struct mr_patch {
	mr_mesh mesh;
	uint32_t *vertex; /* the patch's numbers to the mesh's; ascending in each ring */
	size_t own;       /* its first faces, that are among the first `own` of the mesh */
	size_t end[MR_PATCH_RINGS +
		   1]; /* end[r]: how many vertices are at most r rings away; end[0] the chosen */
} mr_patch;

/*
 * level[v] becomes the distance of vertex v from the nearest vertex with chosen[v], in edges, over
 * paths that leave the chosen ones at once; `most` + 1 where it is more than `most`.  level: nv, the
 * caller's.
 */
void mr_patch_levels(const mr_mesh *m, const bool *chosen, uint8_t most, uint8_t *level);

/* The chosen vertices of m, of whose faces the first `own` count as such, and `rings` rings, 1 to
 * MR_PATCH_RINGS. */
void
mr_patch_build(mr_ctx *ctx, const mr_mesh *m, size_t own, const bool *chosen, size_t rings, mr_patch *patch);

#endif
