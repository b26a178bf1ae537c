/*
 * volume.h -- a closed surface around points, of any topology, by a grid: flood from outside, isosurface
 * (Jeong, Kim 2001, section 3).
 */
#ifndef MR_VOLUME_H
#define MR_VOLUME_H

#include "mesh/mesh.h"

/* What was found about the points. */
typedef struct mr_volume_found {
	double noise; /* 1, or more: the spacings it takes to see a surface */
	size_t grid;  /* cells along the longest side of the bounding box */
} mr_volume_found;

typedef struct mr_volume_opts {
	size_t
	    grid; /* cells along the longest side of the bounding box; 0: chosen from the sampling density */
	double spacing; /* of the points where it is known: those that the grid cannot hold are left out; 0:
	                   all count */
	bool project;   /* noisy points go onto the planes of their neighbours first */
	mr_volume_found *found; /* becomes what was found; may be NULL */
} mr_volume_opts;

#define MR_VOLUME_DEFAULTS                                                                                   \
	{                                                                                                    \
		.grid = 0, .spacing = 0                                                                      \
	}

/*
 * The surface, closed, manifold, oriented outward, any number of components, within about a cell of the
 * points; in the arena.  Holes of the sampling are closed; parts and cavities that hardly any points bound
 * are left out, and outliers.  MR_EMESH where the points are flat or enclose nothing; MR_ERANGE for a grid of
 * more than 4096 cells, and for parts so far apart that no grid holds both.
 *
 * Figures: samples (points that counted), spacing (the side of the square that a point stands for), variation
 * (of the median point's neighbourhood: 0 flat, 1/3 a ball), outliers, regions (large flat ones),
 * regions_turned (rounds of that), cell, nodes, inside (share of the nodes), rounds (of the Poisson
 * equation), turned (normals after the first), level (the indicator's value at the surface), parts_dropped,
 * cavities_filled, and seconds_planes, _flood, _indicator, _level and _isosurface.
 */
mr_status mr_volume_wrap(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_volume_opts *opts, mr_mesh *out);

#endif
