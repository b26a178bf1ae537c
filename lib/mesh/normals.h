/*
 * normals.h -- normals that a surface came with, after it has been moved.
 */
#ifndef MR_MESH_NORMALS_H
#define MR_MESH_NORMALS_H

#include "mesh/mesh.h"

/*
 * Turns normals with the faces around them: each by the mean, weighted by area, of the rotations that are
 * nearest to what became of these faces (W. Kabsch 1976, in the plane).  Lengths stay.  Where nothing around
 * moved, and on faces without area, a normal is as it was, to the bit; so is one of zero.
 *
 * before: the mesh as it was; p: nv positions, as it is now.
 * normal: nv, of vertices, in place; corner: 3 nf, of corners, in place, those of a vertex that are equal
 * being turned as one; either NULL.
 */
void mr_turn_normals(mr_ctx *ctx, const mr_mesh *before, const mr_v3 *p, mr_v3 *normal, mr_v3 *corner);

#endif
