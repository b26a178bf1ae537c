/* raster.h -- a shaded picture of a surface or of a cloud, the same for every number of threads: of two
 * equally near faces the lower is seen. */
#ifndef MR_RENDER_RASTER_H
#define MR_RENDER_RASTER_H

#include "mesh/mesh.h"
#include "render/camera.h"
#include "render/texture.h"

/* A surface without colours. */
static const mr_rgb MR_PLAIN = { 212, 204, 193 };

/* The subject: a surface, or, for a mesh without faces, its points as small balls. */
typedef struct mr_subject {
	mr_mesh mesh;
	const mr_v3 *normal; /* nv, unit, of points, where known; else NULL */
	const mr_rgb *color; /* one a vertex, or a face where `per_face`; NULL: MR_PLAIN */
	mr_paint paint;      /* pictures over the colours; all NULL: none */
	bool per_face;
	bool nearest; /* colours are kinds: each place has its nearest vertex's, no mixture */
} mr_subject;

/* Draws the subject over what the image shows; wire: with its edges. */
void mr_raster(mr_ctx *ctx, const mr_subject *subject, const mr_camera *camera, bool wire, mr_image *image);

#endif
