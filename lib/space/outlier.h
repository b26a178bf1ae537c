/*
 * outlier.h -- points of a cloud that belong to no surface.
 *
 * Contract: deterministic for any number of threads.
 */
#ifndef MR_SPACE_OUTLIER_H
#define MR_SPACE_OUTLIER_H

#include "space/near.h"

/*
 * Which of n points, of which `near` is the index, are outliers: points far from a surface that is known to
 * be near most of them, and alone there.  off: the distance of each from that surface.
 *
 * Suspect are those farther than 2.5 standard deviations, estimated from the median of `off`, and `least`. Of
 * these, one is an outlier whose neighbours are about as far as the surface is, and which is far from them
 * compared with what they are from theirs (Breunig et al. 2000: LOF), or which is much farther from them than
 * points usually are and not in a plane with them, or which has mostly outliers about it.  Points that the
 * surface does not reach, but that make one by themselves, are none.
 *
 * outlier: n, the caller's.  *count: how many.
 */
mr_status mr_find_outliers(mr_ctx *ctx, const mr_near *near, const mr_v3 *p, size_t n, const double *off,
    double least, bool *outlier, size_t *count) MR_WARN_UNUSED;

#endif
