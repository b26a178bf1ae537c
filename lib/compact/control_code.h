/* control_code.h -- a control mesh in few bits: its triangles grow over its edges, each new vertex at its
 * place of a grid (Gumhold, Strasser 1998; Touma, Gotsman 1998, for the prediction). */
#ifndef MR_COMPACT_CONTROL_CODE_H
#define MR_COMPACT_CONTROL_CODE_H

#include "compact/coder.h"
#include "mesh/mesh.h"

typedef struct mr_grid_point {
	int32_t x[3];
} mr_grid_point;

enum { MR_GRID_MOST = 1 << 28 };

/* A control mesh whose vertices are on a grid, at most MR_GRID_MOST steps from its origin. */
typedef struct mr_grid_mesh {
	size_t nv, nf;
	mr_grid_point *p;
	mr_tri *t;
	uint8_t *crease; /* of half-edges, 3 nf, on both sides of an edge; NULL: none */
} mr_grid_mesh;

/* The mesh in the order of the file. */
typedef struct mr_control_order {
	mr_grid_mesh m;
	const uint32_t *vertex, *half; /* index in the input mesh of each vertex and half-edge of m */
} mr_control_order;

/* Writes an oriented manifold m with the topology.  order: in the arena. */
void mr_control_write(
    mr_ctx *ctx, mr_coder *c, const mr_grid_mesh *m, const mr_topology *topo, mr_control_order *order);

/* Reads the rest of m, of which nv and nf are given, and creases if m->crease is not NULL; in the arena.
 * MR_EFORMAT for damage; the caller checks that m is a manifold. */
mr_status mr_control_read(mr_ctx *ctx, mr_coder *c, mr_grid_mesh *m);

#endif
