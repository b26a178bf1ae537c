/* polygon.h -- polygons into triangles, and back. */
#ifndef MR_MESH_POLYGON_H
#define MR_MESH_POLYGON_H

#include "mesh/mesh.h"

/* Triangulates the polygon p[corner[0]], ..., n >= 3, without new vertices: exactly, where it is simple, seen
 * along Newell's normal; convex ones become fans.  t: n - 2 triangles of corners from 0 to n - 1, the
 * caller's, in the order from which mr_polygons_find finds the polygon again. */
void mr_polygon_triangulate(mr_ctx *ctx, const mr_v3 *p, const uint32_t *corner, size_t n, mr_tri *t);

/* Faces of any number of corners, made of the triangles of a mesh. */
typedef struct mr_polygons {
	size_t *start;    /* count + 1: of each face in corner; both NULL where all are triangles */
	uint32_t *corner; /* half-edges 3 f + i: the corner is the i-th of triangle f */
	size_t count;
	size_t broken; /* of more than one triangle, that are no polygon any more: they come as triangles */
	size_t most;   /* corners of a face */
} mr_polygons;

/* The first corner of face i; the last face's corners end with `count`. */
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

/* The polygons of successive triangles of the same number (the column `polygon`): their outline.  If that
 * meets a vertex twice, or leaves one out, they come as triangles.  number: NULL if all are triangles. */
void mr_polygons_find(mr_ctx *ctx, const mr_tri *t, size_t nf, const uint32_t *number, mr_polygons *out);

#endif
