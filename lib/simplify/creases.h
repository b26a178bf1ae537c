/*
 * creases.h -- sharp edges of the surface that points were taken from, in a mesh that is near it.
 *
 * For points without noise: what is noisy shows no planes.
 */
#ifndef MR_SIMPLIFY_CREASES_H
#define MR_SIMPLIFY_CREASES_H

#include "simplify/simplify.h"

/*
 * The vertices of m, an oriented manifold that is near the points and finer than its sharp edges are
 * apart, with those near a sharp edge or a corner moved onto it, as far as nothing folds.  to: m->nv, the
 * caller's, unless *any says that hardly any are sharp: then nothing.
 */
mr_status
mr_sharpen(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, mr_v3 *to, bool *any) MR_WARN_UNUSED;

/*
 * Marks the edges of m that points on both sides show to be sharp, but for short pieces.  mark: 3 m->nf, the
 * caller's: 1 where the edge from that corner on is sharp, else 0.  *count: edges.
 */
mr_status mr_find_creases(
    mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, uint8_t *mark, size_t *count) MR_WARN_UNUSED;

#endif
