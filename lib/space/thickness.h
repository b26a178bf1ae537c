/*
 * thickness.h -- how thick a surface's body is, and how wide the gap before it, where each vertex stands.
 */
#ifndef MR_SPACE_THICKNESS_H
#define MR_SPACE_THICKNESS_H

#include "mesh/mesh.h"

/*
 * The distance to the surface on the other side, inwards or outwards, whichever is less, for each vertex.  It
 * is measured along the normal (the shape diameter of Shapira, Shamir, Cohen-Or 2008) by one ray for some of
 * the faces, and for all where that is few edges long.  Like a local feature size it grows along the surface
 * no faster than one walks.  For any mesh.  Vertices thicker than `most`, or without another side, get
 * `most`.  thickness: nv, the caller's.
 */
void mr_thickness(mr_ctx *ctx, const mr_mesh *m, double most, double *thickness);

#endif
