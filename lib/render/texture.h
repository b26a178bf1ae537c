/* texture.h -- pictures on surfaces, with smaller copies for where they are seen from afar (Williams 1983).
 * u runs to the right, v upwards; the picture repeats beyond 0 to 1. */
#ifndef MR_RENDER_TEXTURE_H
#define MR_RENDER_TEXTURE_H

#include "render/canvas.h"

enum { MR_TEXTURE_LEVELS = 16 }; /* down to a pixel, of the largest image that there is */

typedef struct mr_texture {
	mr_image
	    level[MR_TEXTURE_LEVELS]; /* the picture, then each half as wide and high as the one before */
	int levels;
} mr_texture;

/* Pictures on the faces of a surface. */
typedef struct mr_paint {
	const double *uv;   /* 6 nf: of the corners; NaN: none, and the face has no picture */
	const uint32_t *of; /* nf: the texture of each face, MR_NONE: none */
	const mr_texture *texture;
} mr_paint;

/* The smaller copies, in the arena; the image is borrowed. */
mr_status mr_texture_make(mr_ctx *ctx, const mr_image *image, mr_texture *texture);

/* The level whose pixels are about as large as samples are: `texels` of the picture are seen in so many. */
int mr_texture_level(const mr_texture *texture, double texels, double samples);

/* The four pixels of a level around a place, with their weights. */
typedef struct mr_texels {
	mr_rgb color[4];
	double weight[4];
} mr_texels;

mr_texels mr_texture_at(const mr_texture *texture, int level, double u, double v);

#endif
