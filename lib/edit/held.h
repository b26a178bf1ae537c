/*
 * held.h -- constrained vertices of a mesh that its base, which is posed, does not hold where they belong.
 */
#ifndef MR_EDIT_HELD_H
#define MR_EDIT_HELD_H

#include "mesh/mesh.h"

typedef struct mr_held {
	size_t fixed, moved; /* vertices, and those that are not where they were */
	size_t handled,
	    missed; /* of handles, and those that are not where the map has them that moved base's */
} mr_held;

/*
 * Counts those that are off by over `far`: p is where the vertices of the mesh are now, `encoded` where those
 * of base were.  A map is fitted to the vertices of base that a handle has; a region whose own are off by as
 * much, because each was given a place, is left out.  region, on_base: one per vertex of either.
 */
mr_status mr_held_count(mr_ctx *ctx, const mr_mesh *mesh, const uint32_t *region, const mr_v3 *p,
    const mr_mesh *base, const uint32_t *on_base, const mr_v3 *encoded, double far, mr_held *held);

#endif
