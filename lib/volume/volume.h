/*
 * volume.h -- a closed surface around points, of any topology, by a grid: flood from outside, isosurface
 * (Jeong, Kim 2001, section 3).
 */
#ifndef MR_VOLUME_H
#define MR_VOLUME_H

#include "space/sampling.h"

enum { MR_VOLUME_LEVELS = 9 }; /* that are looked at for their topology */

/* Known outer sides of points: a direction of each, of any length; 0 or NaN: unknown. */
typedef struct mr_outer_sides {
	const mr_v3 *toward;
	bool normals; /* these are normals; else from where the points were seen */
} mr_outer_sides;

typedef struct mr_volume_opts {
	size_t
	    grid; /* cells along the longest side of the bounding box; 0: chosen from the sampling density */
	const mr_sampling *sampling; /* of the points, where it is known; NULL: found */
	const mr_outer_sides
	    *sides; /* alike; where they do not fit the points they are not used, with a warning */
} mr_volume_opts;

#define MR_VOLUME_DEFAULTS                                                                                   \
	{                                                                                                    \
		.grid = 0                                                                                    \
	}

/*
 * The surface, closed, manifold, oriented outward, any number of components, within about a cell of the
 * points; in the arena.  Holes of the sampling are closed; parts and cavities that hardly any points bound
 * are left out, and outliers; and some of the points too near to each other for the grid.  MR_EMESH if the
 * points are flat or enclose nothing; MR_ERANGE for a grid of more than 4096 cells, and for parts so far
 * apart that no grid holds both.
 */
mr_status mr_volume_wrap(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_volume_opts *opts, mr_mesh *out,
    mr_volume_result *result);

/*
 * Unit normals of n distinct places along the Z curve, of least squares through `neighbours` nearest of the
 * sampling.  toward: n directions to the side that a normal is on, of any length, 0: unknown, there
 * neighbours decide; parts without any are treated as without toward.  Without toward (NULL) they point out
 * of the enclosed volume, as mr_volume_wrap finds it; in flat clouds all point to one side.  MR_EMESH for
 * fewer than three places, and on a line. normal: n, the caller's.
 */
mr_status mr_places_normals(mr_ctx *ctx, mr_v3 *place, size_t n, const mr_sampling *of, const mr_v3 *toward,
    mr_v3 *normal) MR_WARN_UNUSED;

#endif
