/*
 * polygon.h -- polygons into triangles.
 */
#ifndef MR_MESH_POLYGON_H
#define MR_MESH_POLYGON_H

#include "mesh/mesh.h"

/*
 * Triangulates the polygon p[corner[0]], ..., p[corner[n - 1]], n >= 3, without new
 * vertices: triangles of its own orientation that cover it exactly, where it is simple,
 * seen along its normal (Newell's).  Convex polygons become fans from a corner.  A polygon
 * that crosses itself or has no area still gives n - 2 triangles that use each of its edges once.
 * t: n - 2, the caller's.
 */
mr_status mr_polygon_triangulate(
    mr_ctx *ctx, const mr_v3 *p, const uint32_t *corner, size_t n, mr_tri *t) MR_WARN_UNUSED;

#endif
