/*
 * alike.h -- faces with the same vertices.
 */
#ifndef MR_MESH_ALIKE_H
#define MR_MESH_ALIKE_H

#include "mesh/mesh.h"

/* first[f]: the lowest face with the vertices of face f, in any order; m->nf of them, the caller's. */
void mr_first_alike(mr_ctx *ctx, const mr_mesh *m, uint32_t *first);

#endif
