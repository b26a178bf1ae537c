/*
 * thickness.h -- how thick a surface's body is, and how wide the gap before it, where each vertex stands.
 */
#ifndef MR_SPACE_THICKNESS_H
#define MR_SPACE_THICKNESS_H

#include "space/bvh.h"

/* Where rays begin, of the diagonal: none meets the face that it leaves. */
#define MR_RAY_BEGINS 1e-9

/* What rays are cast from and meet. */
typedef struct mr_sounding {
	const mr_mesh *m;
	const mr_incidence *inc;
	const mr_v3 *normal; /* of the vertices */
	const mr_bvh *bvh;
} mr_sounding;

/* Of m, in the arena. */
mr_status mr_sounding_build(mr_ctx *ctx, const mr_mesh *m, mr_sounding *body) MR_WARN_UNUSED;

/*
 * The distance to the surface on the other side, inwards or outwards, whichever is less, for each vertex:
 * measured along the normal (the shape diameter of Shapira, Shamir, Cohen-Or 2008, of one ray a face), and
 * made a distance that grows along the surface no faster than one walks, as a local feature size does.  Of
 * any mesh.  thickness, nv, has the most that matters at each vertex, and rays are no longer than that takes:
 * what is thicker, or has no other side, gets that or more.
 */
void mr_thickness(mr_ctx *ctx, const mr_sounding *body, double *thickness);

#endif
