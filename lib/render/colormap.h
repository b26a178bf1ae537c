/* colormap.h -- colours for numbers and for kinds. */
#ifndef MR_RENDER_COLORMAP_H
#define MR_RENDER_COLORMAP_H

#include "base/ctx.h"

/* An sRGB colour. */
typedef struct mr_rgb {
	uint8_t r, g, b;
} mr_rgb;

/* Dark blue through green to yellow, of even lightness steps; t in [0, 1], else the nearer end. */
mr_rgb mr_color_sequential(double t);

/* Blue through white to red; t in [-1, 1], else the nearer end. */
mr_rgb mr_color_diverging(double t);

/* A colour of its own for each kind, MR_NONE grey. */
mr_rgb mr_color_kind(uint32_t kind);

/* Regions: fixed grey, free blue, handles green, orange and on. */
mr_rgb mr_color_region(uint32_t region);

#endif
