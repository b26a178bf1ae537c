/* normals.h -- normals that a surface came with, after it has been moved. */
#ifndef MR_MESH_NORMALS_H
#define MR_MESH_NORMALS_H

#include "mesh/mesh.h"

/* Turns normals with the faces around them: by the mean, weighted by area, of the rotations nearest to what
 * became of these (Kabsch 1976).  Lengths stay, and to the bit what nothing around moved.  before: the mesh
 * as it was; p: nv positions now.  normal: nv, corner: 3 nf, equal ones of a vertex turned as one; in place,
 * or NULL. */
void mr_turn_normals(mr_ctx *ctx, const mr_mesh *before, const mr_v3 *p, mr_v3 *normal, mr_v3 *corner);

#endif
