/*
 * clip.h -- the part of a mesh where a function on its vertices, linear on the faces, is below zero.
 */
#ifndef MR_MESH_CLIP_H
#define MR_MESH_CLIP_H

#include "mesh/mesh.h"

/*
 * Cuts m along the line where value (nv) changes its sign and keeps what is below zero: a manifold stays one,
 * as the line runs through edges and no vertices.  It keeps a twentieth of an edge away from its ends.
 * Vertices that no face is left of go.  out: in the arena.
 */
void mr_mesh_clip(mr_ctx *ctx, const mr_mesh *m, const double *value, mr_mesh *out);

#endif
