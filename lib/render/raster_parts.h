/* raster_parts.h -- what raster.c and shade.c share.  Private to this room. */
#ifndef MR_RENDER_RASTER_PARTS_H
#define MR_RENDER_RASTER_PARTS_H

#include "render/raster.h"

/* SAMPLES by SAMPLES samples are taken of a pixel; a sample's side has 256 steps. */
enum { SAMPLES = 2, STEP_BITS = 8, STEP = 1 << STEP_BITS };

/* A vertex in the picture, in steps; `near` is linear in the picture, and larger for nearer vertices. */
typedef struct mr_placed {
	int32_t x, y;
	float near;
} mr_placed;

/* The picture while it is made. */
typedef struct mr_raster_view {
	const mr_subject *subject;
	const mr_camera *camera;
	bool wire;
	mr_image *image;
	size_t w, h;    /* samples */
	mr_placed *at;  /* the vertices */
	double radius;  /* of points, in samples */
	float *near;    /* of each sample; -INFINITY: nothing */
	uint32_t *item; /* face, or point, that is seen there */
	size_t *start;  /* items that touch each band of rows: list[start[b]] to list[start[b + 1]] */
	uint32_t *list;
} mr_raster_view;

/* Edge functions: twice the signed areas, in squared steps, of the triangles that (x, y) makes with them. */
static inline void
edge_functions(const mr_placed p[3], int64_t x, int64_t y, int64_t e[3])
{
	for (int i = 0; i < 3; i++) {
		const mr_placed *a = &p[(i + 1) % 3], *b = &p[(i + 2) % 3];
		e[i] = (int64_t)(b->x - a->x) * (y - a->y) - (int64_t)(b->y - a->y) * (x - a->x);
	}
}

/* `near` of the height z towards the eye, and back. */
static inline double
near_of(const mr_camera *c, double z)
{
	return c->distance / (c->distance - z);
}

static inline double
height_of(const mr_camera *c, double near)
{
	return c->distance - c->distance / near;
}

/* Colours the samples that see something, and puts the pixels into the image: shade.c. */
void mr_shade(mr_ctx *ctx, const mr_raster_view *v);

#endif
