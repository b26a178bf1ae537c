/* fill.h -- boundary loops of a surface filled with patches that go on smoothly. */
#ifndef MR_EDIT_FILL_H
#define MR_EDIT_FILL_H

#include "mesh/mesh.h"

/* The patches as a mesh.  Its first `rim` vertices are the starts of the half-edges he of the surface, loop
 * by loop; the others, and the faces, follow those of the surface in the filled one. */
typedef struct mr_patches {
	mr_mesh m, all;
	size_t rim;
	const uint32_t *he;
	const uint32_t *loop; /* of each vertex: which hole it fills, 0 the shortest */
} mr_patches;

/* touching: of each vertex whether a loop that can be filled passes its place again by another vertex, in the
 * arena; NULL: none does. */
mr_status
mr_fill_touching(mr_ctx *ctx, const mr_mesh *m, const mr_fill_opts *o, bool **touching) MR_WARN_UNUSED;

/* Fills the boundary loops that the options choose, by default those no longer than a circle of 0.3 of their
 * component's area, each with those of islands in it.  What no patch fills without crossing the surface
 * or a shorter loop's patch stays open, and is reported.  out: in the arena. */
mr_status mr_fill(mr_ctx *ctx, const mr_mesh *m, const mr_fill_opts *o, mr_patches *out,
    mr_fill_result *result) MR_WARN_UNUSED;

#endif
