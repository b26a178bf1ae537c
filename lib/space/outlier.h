/*
 * outlier.h -- outliers of a cloud beside a surface that is known to be near most points.
 *
 * Contract: deterministic for any number of threads.
 */
#ifndef MR_SPACE_OUTLIER_H
#define MR_SPACE_OUTLIER_H

#include "space/sampling.h"

/*
 * Finds the outliers of a sampling (s->n > 0) that are far from the surface too; off: the distance of each of
 * the points from it.  They are farther than 2.5 standard deviations, estimated from the median of
 * `off`, than `least`, and than their spacing: sparse points as near to the surface as others are no
 * outliers.
 *
 * outlier: s->n, the caller's.  *count: how many, of which it warns.
 */
void mr_find_outliers(
    mr_ctx *ctx, const mr_sampling *s, const double *off, double least, bool *outlier, size_t *count);

#endif
