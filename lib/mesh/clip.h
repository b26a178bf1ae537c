/* clip.h -- the part of a mesh where a function on its vertices, linear on the faces, is below zero. */
#ifndef MR_MESH_CLIP_H
#define MR_MESH_CLIP_H

#include "mesh/mesh.h"

/* Keeps the part of m below zero, cut where value (nv) changes its sign: a manifold stays one, as the line
 * keeps a twentieth of an edge away from vertices.  Vertices without a face go.  out: in the arena. */
void mr_mesh_clip(mr_ctx *ctx, const mr_mesh *m, const double *value, mr_mesh *out);

#endif
