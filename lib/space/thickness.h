/*
 * thickness.h -- how thick a surface's body is, and how wide the gap before it, where each vertex stands.
 */
#ifndef MR_SPACE_THICKNESS_H
#define MR_SPACE_THICKNESS_H

#include "mesh/mesh.h"

/*
 * The distance to the surface on the other side, inwards or outwards, whichever is less, for each vertex:
 * measured along the normal (the shape diameter of Shapira, Shamir, Cohen-Or 2008, of one ray a face), no
 * more than `most`, and made a distance that grows along the surface no faster than one walks, as a local
 * feature size does.  Of any mesh; `most` where there is no other side.  thickness: nv, the caller's.
 */
mr_status mr_thickness(mr_ctx *ctx, const mr_mesh *m, double most, double *thickness);

#endif
