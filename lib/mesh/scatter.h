/* scatter.h -- what faces give to their corners, on all threads, the same for any number of them. */
#ifndef MR_MESH_SCATTER_H
#define MR_MESH_SCATTER_H

#include "mesh/mesh.h"

/* Faces by blocks of vertices, ascending in each: block b has t[start[b]] to t[start[b + 1]].  The last has
 * those whose corners are in several. */
typedef struct mr_scatter {
	size_t blocks;
	size_t *start;
	mr_tri *t;
} mr_scatter;

mr_scatter mr_scatter_make(mr_ctx *ctx, const mr_mesh *m);

/* n faces give to their corners: those of each block but the last at a time, then those of the last. */
typedef void mr_giver(void *arg, const mr_tri *t, size_t n);
void mr_scatter_run(const mr_ctx *ctx, const mr_scatter *s, mr_giver *give, void *arg);

#endif
