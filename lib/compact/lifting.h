/*
 * lifting.h -- whole numbers on the levels of a subdivision surface as coefficients, and exactly back.
 *
 * Lifting (Sweldens 1996) by the butterfly's stencil (Dyn, Levin, Gregory 1990), the mean of the ends on a
 * sharp edge; then each end takes an eighth of the coefficient, so that a coarse level is about the mean of
 * the finer ones.  Numbers beyond 2^30 are cut off there.
 */
#ifndef MR_COMPACT_LIFTING_H
#define MR_COMPACT_LIFTING_H

#include "subdivide/loop.h"

/* x: level[n].nv, changed in place. */
void mr_lifting_analyse(mr_ctx *ctx, const mr_loop *level, size_t n, int32_t *x);
void mr_lifting_synthesize(mr_ctx *ctx, const mr_loop *level, size_t n, int32_t *x);

#endif
