/*
 * creases.h -- sharp edges of the surface that points were taken from, in a mesh that is near it.
 *
 * For points without noise: noise hides the planes.
 */
#ifndef MR_SIMPLIFY_CREASES_H
#define MR_SIMPLIFY_CREASES_H

#include "simplify/simplify.h"

/*
 * The mesh m, an oriented manifold that is near the points, cut along the sharp edges that they show: its
 * vertices first, then those on sharp edges and in corners.  mark: 3 out->nf, in the arena: 1 where the edge
 * from that corner on is sharp, else 0; NULL: none is.
 */
mr_status mr_find_creases(
    mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, mr_mesh *out, uint8_t **mark) MR_WARN_UNUSED;

#endif
