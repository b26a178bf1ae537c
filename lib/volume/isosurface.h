/*
 * isosurface.h -- the surface where a function on a grid is zero, by marching cubes (Lorensen, Cline 1987)
 * whose every case is consistent with its neighbours'.
 *
 * Contract: the surface is always a closed, oriented manifold. Inside nodes are
 * connected over the edges of the grid, outside nodes over the diagonals of its faces too.
 */
#ifndef MR_VOLUME_ISOSURFACE_H
#define MR_VOLUME_ISOSURFACE_H

#include "mesh/mesh.h"

typedef struct mr_grid {
	mr_v3 origin; /* of node 0 0 0 */
	double step;
	size_t n[3]; /* nodes along each axis, at least two */
} mr_grid;

static inline size_t
mr_grid_nodes(const mr_grid *g)
{
	return g->n[0] * g->n[1] * g->n[2];
}

/* The number of node x y z: x runs fastest. */
static inline size_t
mr_grid_index(const mr_grid *g, size_t x, size_t y, size_t z)
{
	return (z * g->n[1] + y) * g->n[0] + x;
}

static inline mr_v3
mr_grid_place(const mr_grid *g, size_t x, size_t y, size_t z)
{
	return mr_axpy(g->step, mr_vec((double)x, (double)y, (double)z), g->origin);
}

/* The surface of the nodes where f is below the level; none where no node is inside, in the arena.  f:
 * finite, not below the level on the faces of the grid. */
mr_status mr_isosurface(mr_ctx *ctx, const mr_grid *g, const float *f, float level, mr_mesh *out);

#endif
