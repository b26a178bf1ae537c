/*
 * fit.h -- control meshes whose Loop limit surface comes close to points (Jeong, Kim 2001, section 4).
 */
#ifndef MR_FIT_H
#define MR_FIT_H

#include "subdivide/loop.h"

typedef enum mr_fit_method {
	MR_FIT_LOCAL, /* Suzuki et al. 1999, as the paper has it: each vertex by the point nearest its limit
	                 point */
	MR_FIT_LEAST_SQUARES /* all points at once, by the normal equations */
} mr_fit_method;

typedef struct mr_fit_opts {
	int method;
	size_t iterations; /* 0: as many as the method needs by default */
	double step;       /* of local: share of the force taken */
	double fairness;   /* of least-squares: weight of the smoothness term */
} mr_fit_opts;

#define MR_FIT_DEFAULTS                                                                                      \
	{                                                                                                    \
		.method = MR_FIT_LEAST_SQUARES, .step = 0.8, .fairness = 1e-3                                \
	}

/*
 * Fits the control mesh, oriented manifold, to n points: out, control->nv positions, the caller's.
 * MR_EMESH where there are no points or they lie at one place.  Figures: see man/mr-fit.1.
 */
mr_status mr_fit(
    mr_ctx *ctx, const mr_mesh *control, const mr_v3 *point, size_t n, const mr_fit_opts *opts, mr_v3 *out);

#endif
