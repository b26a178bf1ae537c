/*
 * loop_self_intersect.h -- which triangles of a subdivided surface pass through others.
 *
 * Contract: as self_intersect.h, but triangles that touch and look the same way, to 60 degrees, are taken not
 * to cross, and so are regions that touch and whose normals all lie within a cone of that angle (after
 * Volino, Magnenat Thalmann 1994, without their test of the outlines): a smooth surface is then searched only
 * where it comes back to itself.
 */
#ifndef MR_SUBDIVIDE_LOOP_SELF_INTERSECT_H
#define MR_SUBDIVIDE_LOOP_SELF_INTERSECT_H

#include "subdivide/loop.h"

/* A tree of the triangles of levels 0 to n, with their last positions. */
typedef struct mr_loop_tree mr_loop_tree;

mr_loop_tree *mr_loop_tree_new(mr_ctx *ctx, const mr_loop *level, size_t n);

/*
 * The triangles of level n, whose vertices are at p, that pass through others.  crosses: one a triangle, the
 * caller's.  moved: of the triangles of level 0, those that a vertex has moved in since `crosses` was found
 * by this tree, so that only these and their surroundings are looked at: all at first; NULL: all, and the old
 * `crosses` does not count.
 */
void mr_find_crossings(mr_ctx *ctx, mr_loop_tree *x, const mr_v3 *p, const bool *moved, bool *crosses);

#endif
