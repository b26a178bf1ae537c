/*
 * atlas.h -- the triangles of a mesh laid out in a picture that has a texel for each vertex of their
 * subdivision.
 *
 * A triangle is a right one there, its first corner at the right angle, its second to the right. Every other
 * one is turned by 180 degrees.  Two of them fill a square.  So the vertices that level n of a subdivision
 * has on the triangle, at multiples of 2^-n in its barycentric coordinates, are at the centres of texels:
 * their values are not resampled.  Texels around a triangle, the gutter, are its own, too.
 */
#ifndef MR_SUBDIVIDE_ATLAS_H
#define MR_SUBDIVIDE_ATLAS_H

#include "mesh/mesh.h"

typedef struct mr_atlas {
	size_t faces, level, gutter;
	size_t segments;      /* along an edge of a triangle: 2^level */
	size_t cell;          /* texels along a square */
	size_t columns;       /* squares in a row */
	size_t width, height; /* texels */
	const uint32_t
	    *vertex; /* the level's vertices in each triangle, row by row; NULL: see mr_atlas_fill */
} mr_atlas;

/* A texel has the value of vertices: v[0] + v[1] - v[2], of which the last two are the same on a triangle. */
typedef struct mr_texel {
	uint32_t face; /* MR_NONE: of none, and what follows is nothing */
	double b, c;   /* barycentric coordinates of its corners 1 and 2 */
	uint32_t v[3];
} mr_texel;

/* Lays triangles out, with `gutter` texels around each, at least 1.  MR_ERANGE where the picture has more
 * than `most` texels a side; the sentence says which level has not. */
mr_status mr_atlas_plan(
    mr_ctx *ctx, size_t faces, size_t level, size_t gutter, size_t most, mr_atlas *a) MR_WARN_UNUSED;

/* Finds the vertices.  t: the triangles of the level, by Loop's numbering; a->vertex: in the arena. */
void mr_atlas_fill(mr_ctx *ctx, const mr_tri *t, mr_atlas *a);

/* The vertex i steps towards corner 1 of a face and j towards corner 2; beyond the long side, any. */
uint32_t mr_atlas_vertex(const mr_atlas *a, size_t face, size_t i, size_t j);

/*
 * The texel in column x from the left and row y from the top.  In the gutter it has what lets bilinear
 * samples at the triangle be right: next to the long side what makes them linear in each triangle there, so
 * that they are the same on both sides of a seam; else what the nearest texel has.
 */
mr_texel mr_atlas_texel(const mr_atlas *a, size_t x, size_t y);

/* Texture coordinates of the triangle's corners, two each; v runs upwards. */
void mr_atlas_texcoords(const mr_atlas *a, size_t face, double uv[6]);

#endif
