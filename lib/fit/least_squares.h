/*
 * least_squares.h -- least-squares fitting of a limit surface to points: passes of feet, weights, equations,
 * guarded steps.
 */
#ifndef MR_FIT_LEAST_SQUARES_H
#define MR_FIT_LEAST_SQUARES_H

#include "fit/fit.h"
#include "fit/limit_surface.h"

/* Points no further than this share of a control edge are no outliers, however near the others are. */
#define MR_FIT_NEAR 0.1

/*
 * Moves the control vertices x, and the surface with them.  spacing: of each of n points, the side of the
 * square of surface that it has to itself.  noise: in usual spacings.  foot: of the points, on the surface as
 * given; left where the last step attached them.  result: gets its figures of the steps.  outliers: the
 * points had some, and may have more.
 */
mr_status mr_fit_least_squares(mr_ctx *ctx, mr_fit_surface *surface, const mr_v3 *point,
    const double *spacing, size_t n, double noise, const mr_fit_opts *opts, size_t passes, bool outliers,
    mr_fit_foot *foot, mr_v3 *x, mr_fit_result *result);

#endif
