/*
 * orientation.h -- whether a mesh faces the way of the surface that it stands for.
 *
 * Contract: a triangle is flipped where its normal points against that of the source at the places of all its
 * three corners.  The source's normal is that of its triangle, on an edge the mean of two, at a vertex the
 * mean by angle (the pseudonormals of Baerentzen, Aanaes 2005).
 */
#ifndef MR_REMESH_ORIENTATION_H
#define MR_REMESH_ORIENTATION_H

#include "space/source_map.h"

typedef struct mr_facing {
	const mr_mesh *m;
	const mr_topology *topo;
} mr_facing; /* the source */

/* The normal of the source at a place, of any length. */
mr_v3 mr_facing_normal(const mr_facing *s, mr_place at);

/* The flipped faces of m, whose vertices lie on the source as the map says. */
size_t mr_count_flipped(const mr_facing *s, const mr_mesh *m, const mr_places *map);

#endif
