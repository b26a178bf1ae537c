/* loops.h -- the boundary loops of any mesh, and triangles that span one. */
#ifndef MR_MESH_LOOPS_H
#define MR_MESH_LOOPS_H

#include "mesh/mesh.h"

/* Loop i is the half-edges he[start[i]] to he[start[i + 1]], each beginning where the one before ends.  No
 * loop meets a vertex twice: those that touch at a vertex are several. */
typedef struct mr_loops {
	size_t count;
	size_t *start; /* count + 1 */
	uint32_t *he;
	size_t broken; /* boundary edges of no loop: edges of three faces or more interrupt them */
} mr_loops;

/* The loops of m, by the first half-edge of each, in the arena. */
void mr_loops_find(mr_ctx *ctx, const mr_mesh *m, mr_loops *loops);

/* Spans the closed polygon p of n >= 3 corners by n - 2 triangles t, the caller's, along its edges backwards:
 * of the least largest angle between neighbours, then of the least area (Liepa 2003; Barequet, Sharir 1995).
 * beside: the normal of the face beyond each edge, 0: none.  taken: whether corners have an edge in common
 * already, which is avoided.  Beyond 256 corners every so many are spanned first. */
void mr_span(mr_ctx *ctx, const mr_v3 *p, const mr_v3 *beside, size_t n,
    bool (*taken)(const void *arg, uint32_t i, uint32_t j), const void *arg, mr_tri *t);

#endif
