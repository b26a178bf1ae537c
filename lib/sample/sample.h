/*
 * sample.h -- the displacement of a domain surface to points without connectivity, or to a mesh (Jeong, Kim
 * 2001, section 5).
 */
#ifndef MR_SAMPLE_H
#define MR_SAMPLE_H

#include "subdivide/displaced.h"

typedef enum mr_sample_method {
	MR_SAMPLE_TRIANGLE, /* the paper's search for the valid triangle among the nearest points */
	MR_SAMPLE_ROBUST    /* the nearest points' local surface, for noise and outliers */
} mr_sample_method;

typedef struct mr_sample_opts {
	int method;
	size_t neighbours; /* nearest points looked at */
	size_t refine;     /* passes that fit the heights to the points by least squares */
} mr_sample_opts;

enum { MR_SAMPLE_MOST = 128 }; /* neighbours, at most */

#define MR_SAMPLE_DEFAULTS                                                                                   \
	{                                                                                                    \
		.neighbours = 30, .refine = 3                                                                \
	}

/*
 * Heights over the domain to the points: d->m.nv, the caller's.  A vertex that finds no valid triangle is
 * filled smoothly from its neighbours and counted; heights that fold the surface are
 * drawn to the domain, if `refine` is not 0.  MR_EMESH where the points cannot make a surface (fewer
 * than four, all equal, collinear, coplanar with a closed control mesh).  Figures: see man/mr-sample.1.
 */
mr_status mr_sample_points(mr_ctx *ctx, const mr_domain *d, const mr_v3 *point, size_t n,
    const mr_sample_opts *opts, double *height);

/* The same to the surface of a mesh, by the first hit of the line along the normal on the near sheet (Lee et
 * al. 2000). */
mr_status mr_sample_mesh(
    mr_ctx *ctx, const mr_domain *d, const mr_mesh *mesh, const mr_sample_opts *opts, double *height);

#endif
