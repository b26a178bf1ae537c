/*
 * columns.h -- the columns of a layer on a finer mesh of the same vertices and more.
 */
#ifndef MR_SUBDIVIDE_COLUMNS_H
#define MR_SUBDIVIDE_COLUMNS_H

#include "mesh/layers.h"
#include "subdivide/loop.h"

/*
 * A mesh and one that is finer, each triangle of which is a part of one of the mesh.  The vertices of the
 * mesh come first.
 */
typedef struct mr_refined {
	mr_mesh m, fine;
	const uint32_t *face; /* of each fine triangle, the one it is a part of; NULL: by the levels */
	const mr_v3 *bary;    /* of its corners, 3 fine.nf, in that */
	const mr_loop *level; /* where it was made by Loop's rules, by levels 0 to n; else NULL */
	size_t n;
} mr_refined;

/*
 * The columns that go along.  Numbers of vertices are subdivided as positions are, by Loop's rules or
 * linearly; normals, and columns of corners, always linearly, normals keeping the mean of the lengths.  A new
 * vertex has the least region of the vertices that it lies between; other whole numbers, and single doubles
 * that are all whole, come from the nearest.  A triangle takes its parent's values, except its polygon under
 * Loop's rules. out: *count of them, in the arena.
 */
mr_status mr_refine_columns(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_refined *r,
    mr_carried **out, size_t *count) MR_WARN_UNUSED;

/* The fine vertices on the flat triangles of the mesh: fine.nv, the caller's. */
void mr_refined_flat(mr_ctx *ctx, const mr_refined *r, mr_v3 *p);

#endif
