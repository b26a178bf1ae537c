/*
 * tips.h -- keeps the tips of thin limbs when remeshing.
 *
 * Tangential relaxation draws vertices back from tips that are thinner than an edge: the vertices stay on
 * the surface, but the surface's tip is left outside.
 * Layer rule: alg.
 */
#ifndef MR_TIPS_H
#define MR_TIPS_H

#include "alg/relax.h"

/*
 * Moves the nearest vertex of d to each vertex of the source that is more than half the target
 * length away, the farthest first, and pins it there; where that would turn a face the tip is left.
 * d is compact.  *pinned: how many.
 */
mr_status mr_pin_tips(mr_ctx *ctx, mr_dyn *d, const mr_surface *s, size_t *pinned);

#endif
