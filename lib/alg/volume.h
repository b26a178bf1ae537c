/*
 * volume.h -- a closed surface around points, of any topology, by a grid: occupied cells, flood from
 * outside, isosurface of a signed distance (Jeong, Kim 2001, section 3).
 *
 * Layer rule: alg.
 */
#ifndef MR_VOLUME_H
#define MR_VOLUME_H

#include "mesh/mesh.h"

typedef struct mr_volume_opts {
	size_t
	    grid; /* cells along the longest side of the bounding box; 0: chosen from the sampling density */
} mr_volume_opts;

#define MR_VOLUME_DEFAULTS                                                                                   \
	{                                                                                                    \
		.grid = 0                                                                                    \
	}

/*
 * The surface, closed, manifold, oriented outward, any number of components, within about a cell of the
 * points; in the arena.  MR_EMESH where the points enclose nothing at any grid that their density allows.
 * Figures: see man/mr-shrinkwrap.1.
 */
mr_status mr_volume_wrap(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_volume_opts *opts, mr_mesh *out);

#endif
