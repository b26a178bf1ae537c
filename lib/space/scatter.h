/* scatter.h -- points that are strewn in all directions, as in a volume, where others lie along a surface. */
#ifndef MR_SPACE_SCATTER_H
#define MR_SPACE_SCATTER_H

#include "space/near.h"

/*
 * How far the points p spread across what would be their surface: the variation (local_planes.h) of the 32
 * nearest, of the 128, and of 8,192 points or more the 512, each time the median of some at equal strides; of
 * these the least.  0 in a plane, 1/3 of a ball; 0 of fewer than 256 points.  p: distinct places; near: theirs.
 */
mr_status
mr_cloud_scatter(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_near *near, double *scatter) MR_WARN_UNUSED;

#endif
