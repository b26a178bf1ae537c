/*
 * voronoi_area.h -- the area that belongs to each vertex.
 *
 * Contract: any mesh with valid indices; the sum is the mesh's area.
 */
#ifndef MR_OP_VORONOI_AREA_H
#define MR_OP_VORONOI_AREA_H

#include "mesh/mesh.h"

/*
 * Mixed Voronoi areas: circumcentric parts, edge midpoints in obtuse triangles.  0 for
 * a vertex without a face of positive area.  area: nv values, the caller's.
 */
mr_status mr_voronoi_areas(mr_ctx *ctx, const mr_mesh *m, double *area);

/* The parts of the triangle a b c that belong to its corners; their sum is its area.  Zero where it has none.
 */
void mr_voronoi_corners(mr_v3 a, mr_v3 b, mr_v3 c, double part[3]);

#endif
