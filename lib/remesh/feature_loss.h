/*
 * feature_loss.h -- whether the sharp edges of a source are still there.
 */
#ifndef MR_REMESH_FEATURE_LOSS_H
#define MR_REMESH_FEATURE_LOSS_H

#include "remesh/relax.h"

/* How many edges of the source are on curves and not on the boundary, and from the middle of how many all
 * curves of d are more than a quarter of the target length away. */
void mr_feature_loss(mr_ctx *ctx, const mr_dyn *d, const mr_remesh_source *s, size_t *edges, size_t *lost);

#endif
