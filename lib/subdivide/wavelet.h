/*
 * wavelet.h -- heights on the levels of a subdivision surface as wavelet coefficients.
 *
 * Lifting without an update step: an odd vertex's coefficient is its height less the one that Loop's odd
 * stencil predicts from the level below; level 0 keeps its heights.  So every level stays a prefix.
 */
#ifndef MR_SUBDIVIDE_WAVELET_H
#define MR_SUBDIVIDE_WAVELET_H

#include "subdivide/loop.h"

/* Heights to coefficients and back, exactly the inverse to rounding; level: 0 to n; x: level[n].nv, changed
 * in place. */
void mr_wavelet_analyse(mr_ctx *ctx, const mr_loop *level, size_t n, double *x);
void mr_wavelet_synthesize(mr_ctx *ctx, const mr_loop *level, size_t n, double *x);

/* Multiplies the coefficients of level i by gain[i], i = 0 to n.  x: heights, changed in place.  MR_ERANGE
 * where one is not finite any more. */
mr_status mr_equalize(mr_ctx *ctx, const mr_loop *level, size_t n, const double *gain, double *x);

#endif
