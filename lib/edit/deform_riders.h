/*
 * deform_riders.h -- small parts that lie on a larger one and go along with it as one body.
 *
 * Where parts are stitched to each other the Laplacian of a vertex is the sum of both, and what is small
 * bends for nothing to cancel what the large one bends: slats of a length of 2, nailed to rails of 20, went
 * to places that were 116 apart.  What does not touch the large part has nothing to lose by going along with
 * it. Private to this room.
 */
#ifndef MR_EDIT_DEFORM_RIDERS_H
#define MR_EDIT_DEFORM_RIDERS_H

#include "edit/deform_parts.h"

/* Pairs of parts that are joined, by a vertex of one and a face of the other. */
typedef struct mr_joints {
	const mr_tie *joint;
	size_t n;
	const bool *touches; /* of each: or it is near, no more */
} mr_joints;

/*
 * Which vertices are of such parts: free ones, of less than a quarter of the extent of one that they are near
 * and that is held without them; that touch nothing and hold nothing else.  component: as mr_components_label
 * has it of rest.  rides: one a vertex, the caller's.
 */
mr_status mr_riders_find(mr_ctx *ctx, const mr_mesh *rest, const uint32_t *component, const mr_joints *joints,
    const uint32_t *region, bool *rides);

#endif
