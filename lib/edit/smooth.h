/*
 * smooth.h -- low-pass filters of the surface: diffusion, implicit and explicit, and Taubin's.
 *
 * Contract: any mesh with valid indices and finite positions, non-manifold too: cotangent weights need
 * no more than triangles, and the boundary is where an edge has one face.  Boundary vertices and
 * isolated ones stay.
 */
#ifndef MR_EDIT_SMOOTH_H
#define MR_EDIT_SMOOTH_H

#include "mesh/mesh.h"

typedef enum mr_smooth_method {
	MR_SMOOTH_IMPLICIT, /* (M + t L) p' = M p, by Cholesky: any time in one pass */
	MR_SMOOTH_EXPLICIT, /* p' = p - t M^-1 L p: a pass may last a quarter of a squared edge length */
	MR_SMOOTH_TAUBIN    /* a pass forth and one back, so the volume stays: up to 0.15 a pass */
} mr_smooth_method;

typedef struct mr_smooth_opts {
	int method;    /* mr_smooth_method */
	double time;   /* in all, in squared mean edge lengths of the input */
	size_t passes; /* 0: 1 implicit pass; of the others 8 for each unit of time */
} mr_smooth_opts;

#define MR_SMOOTH_DEFAULTS                                                                                   \
	{                                                                                                    \
		.method = MR_SMOOTH_IMPLICIT, .time = 10, .passes = 0                                        \
	}

/*
 * Smooths: out, nv positions, the caller's, may be m->p.  MR_EUSAGE where the passes are too few for the
 * time. Records figures: mean_edge, passes, boundary_vertices, the set-up and solve times.
 */
mr_status mr_smooth(mr_ctx *ctx, const mr_mesh *m, const mr_smooth_opts *opts, mr_v3 *out);

#endif
