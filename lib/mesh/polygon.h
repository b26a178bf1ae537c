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
 * t: n - 2 triangles of corners from 0 to n - 1, the caller's, in the order from which mr_polygons_find finds
 * the polygon again.
 */
void mr_polygon_triangulate(mr_ctx *ctx, const mr_v3 *p, const uint32_t *corner, size_t n, mr_tri *t);

/* Faces of any number of corners, made of the triangles of a mesh. */
typedef struct mr_polygons {
	size_t *start;    /* count + 1: of each face in corner; both NULL where all are triangles */
	uint32_t *corner; /* half-edges 3 f + i: the corner is the i-th of triangle f */
	size_t count;
	size_t broken; /* of more than one triangle, that are no polygon any more: they come as triangles */
	size_t most;   /* corners of a face */
} mr_polygons;

/* Where the corners of face i begin; those of the last end with `count`. */
static inline size_t
mr_polygon_begin(const mr_polygons *p, size_t i)
{
	return p->start ? p->start[i] : 3 * i;
}

/* The half-edge of corner k of all. */
static inline uint32_t
mr_polygon_corner(const mr_polygons *p, size_t k)
{
	return p->corner ? p->corner[k] : (uint32_t)k;
}

/*
 * The polygons of triangles that have the same number and stand one behind the other (the column `polygon`):
 * their outline, from the first edge of the first triangle that is on it.  Where that meets a vertex twice,
 * as around a hole, or leaves one out, they come as triangles. number: NULL where all are triangles.
 */
void mr_polygons_find(mr_ctx *ctx, const mr_tri *t, size_t nf, const uint32_t *number, mr_polygons *out);

#endif
