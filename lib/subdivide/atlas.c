/* An atlas of right triangles in pairs; the corner of a cell beyond the long side makes it a parallelogram.
 */
#include "subdivide/atlas.h"

#include "subdivide/loop.h"

/* ---- the plan ---- */

/* Two triangles, g around each; between their long sides, across which texels are 1 / sqrt(2) apart, 2 g + 1.
 */
static mr_atlas
plan(size_t faces, size_t level, size_t gutter)
{
	mr_atlas a = { .faces = faces, .level = level, .gutter = gutter, .segments = (size_t)1 << level };
	size_t cells = (faces + 1) / 2;

	a.cell = a.segments + 3 * gutter + 2;
	a.columns = (size_t)ceil(sqrt((double)cells));
	a.width = a.columns * a.cell;
	a.height = (cells + a.columns - 1) / a.columns * a.cell;
	return a;
}

static mr_status
too_large(mr_ctx *ctx, const mr_atlas *a, size_t most)
{
	mr_atlas less = *a;

	while (less.level > 0 && less.width > most)
		less = plan(a->faces, less.level - 1, a->gutter);
	if (less.width > most)
		return mr_fail(ctx, MR_ERANGE,
		    "%zu triangles with a gutter of %zu take %zux%zu texels on level 0 already, and %zu a "
		    "side are allowed",
		    a->faces, a->gutter, less.width, less.height, most);
	return mr_fail(ctx, MR_ERANGE,
	    "level %zu of %zu triangles takes %zux%zu texels, and %zu a side are allowed: level %zu takes "
	    "%zux%zu",
	    a->level, a->faces, a->width, a->height, most, less.level, less.width, less.height);
}

mr_status
mr_atlas_plan(mr_ctx *ctx, size_t faces, size_t level, size_t gutter, size_t most, mr_atlas *a)
{
	mr_atlas made = plan(faces, level, gutter);

	if (made.width > most)
		return too_large(ctx, &made, most);
	*a = made;
	return MR_OK;
}

/* ---- vertices ---- */

/* The points of a triangle. */
static size_t
points(const mr_atlas *a)
{
	return (a->segments + 1) * (a->segments + 2) / 2;
}

/* The number of point (i, j) of a triangle, i / segments of the way to corner 1 and j / segments to corner 2.
 */
static size_t
point(const mr_atlas *a, size_t i, size_t j)
{
	return j * (2 * a->segments + 3 - j) / 2 + i;
}

uint32_t
mr_atlas_vertex(const mr_atlas *a, size_t face, size_t i, size_t j)
{
	bool in = i + j <= a->segments;

	return a->vertex[face * points(a) + (in ? point(a, i, j) : 0)];
}

void
mr_atlas_fill(mr_ctx *ctx, const mr_tri *t, mr_atlas *a)
{
	size_t each = points(a), pieces = a->segments * a->segments;
	double scale = (double)a->segments;
	uint32_t *vertex = MR_NEW(ctx, a->faces * each, uint32_t);

	for (size_t f = 0; f < a->faces * pieces; f++) {
		mr_v3 at[3];
		mr_loop_corners(a->level, f, at);
		for (int k = 0; k < 3; k++)
			vertex[f / pieces * each +
			       point(a, (size_t)(at[k].y * scale), (size_t)(at[k].z * scale))] = t[f].v[k];
	}
	a->vertex = vertex;
}

/* ---- texels ---- */

/* A place in a triangle's own grid, which may be outside. */
typedef struct place {
	size_t face;
	ptrdiff_t i, j;
} place;

/* Whose texel it is; face: beyond the last where it is nobody's. */
static place
owner(const mr_atlas *a, size_t x, size_t y)
{
	size_t up = a->height - 1 - y, g = a->gutter, s = a->cell;
	size_t square = y / s * a->columns + x / s;
	ptrdiff_t i = (ptrdiff_t)(x % s), j = (ptrdiff_t)(up % s), last = (ptrdiff_t)(s - 1);

	if (i + j <= last || 2 * square + 1 >= a->faces)
		return (place){ 2 * square, i - (ptrdiff_t)g, j - (ptrdiff_t)g };
	return (place){ 2 * square + 1, last - (ptrdiff_t)g - i, last - (ptrdiff_t)g - j };
}

/* Moves a place that is outside to the nearest one that is not, or is just beyond the long side. */
static place
come_near(place p, ptrdiff_t segments)
{
	ptrdiff_t beyond;

	p.i = p.i < 0 ? 0 : p.i;
	p.j = p.j < 0 ? 0 : p.j;
	beyond = p.i + p.j - segments;
	if (beyond > 1) {
		p.i -= beyond / 2;
		p.j -= beyond / 2;
	}
	if (p.i <= 0 || p.j <= 0) { /* beyond an acute corner, if not inside */
		p.i = p.i < 0 ? 0 : p.i > segments ? segments : p.i;
		p.j = p.j < 0 ? 0 : p.j > segments ? segments : p.j;
	}
	return p;
}

mr_texel
mr_atlas_texel(const mr_atlas *a, size_t x, size_t y)
{
	place p = owner(a, x, y);
	const uint32_t *vertex;
	mr_texel texel = { .face = MR_NONE };
	size_t i, j;

	if (p.face >= a->faces)
		return texel;
	p = come_near(p, (ptrdiff_t)a->segments);
	i = (size_t)p.i;
	j = (size_t)p.j;
	vertex = a->vertex + p.face * points(a);
	texel = (mr_texel){ (uint32_t)p.face, (double)i / (double)a->segments,
		(double)j / (double)a->segments, { 0, 0, 0 } };
	if (i + j <= a->segments) {
		texel.v[0] = texel.v[1] = texel.v[2] = vertex[point(a, i, j)];
	} else {
		texel.v[0] = vertex[point(a, i - 1, j)];
		texel.v[1] = vertex[point(a, i, j - 1)];
		texel.v[2] = vertex[point(a, i - 1, j - 1)];
	}
	return texel;
}

void
mr_atlas_texcoords(const mr_atlas *a, size_t face, double uv[6])
{
	size_t square = face / 2, s = a->cell, rows = a->height / s;
	double left = (double)(square % a->columns * s),
	       bottom = (double)((rows - 1 - square / a->columns) * s);
	double side = face % 2 ? -(double)a->segments : (double)a->segments;
	double at = face % 2 ? (double)(s - a->gutter) - 0.5 : (double)a->gutter + 0.5;

	for (int k = 0; k < 3; k++) {
		uv[2 * k] = (left + at + (k == 1) * side) / (double)a->width;
		uv[2 * k + 1] = (bottom + at + (k == 2) * side) / (double)a->height;
	}
}
