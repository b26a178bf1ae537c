/*
 * turns.h -- how a surface has turned around each of its vertices.
 */
#ifndef MR_EDIT_TURNS_H
#define MR_EDIT_TURNS_H

#include "base/rotation.h"
#include "mesh/mesh.h"

/*
 * The rotations that are nearest to what became of the faces around the vertices, some rings far: a smooth
 * field, as those of single faces, and as the normals of the moved surface, are not.  The identity to within
 * rounding where nothing moved.
 *
 * rest, now: the same vertices and faces; inc: of both.  turn: nv, the arena's.
 */
void
mr_turns(mr_ctx *ctx, const mr_mesh *rest, const mr_mesh *now, const mr_incidence *inc, const mr_mat3 **turn);

#endif
