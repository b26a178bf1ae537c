/* canvas.h -- an image of sRGB pixels, and rectangles and text on it, clipped. */
#ifndef MR_RENDER_CANVAS_H
#define MR_RENDER_CANVAS_H

#include "render/colormap.h"

typedef struct mr_image {
	mr_rgb *pixel; /* rows from the top, pixels from the left */
	size_t width, height;
} mr_image;

/* An image of one colour, in the arena.  MR_ERANGE over 32,767 pixels a side. */
mr_status mr_image_new(mr_ctx *ctx, size_t width, size_t height, mr_rgb color, mr_image *image);

/* Copies `from` with its upper left corner at (x, y). */
void mr_image_copy(mr_image *to, size_t x, size_t y, const mr_image *from);

void mr_image_fill(mr_image *image, double x, double y, double w, double h, mr_rgb color);

/* Advance of a letter, and the height of a line, in units of text. */
enum { MR_TEXT_ADVANCE = 6, MR_TEXT_LINE = 10 };

/* Writes ASCII (other bytes are boxes) from its upper left corner (x, y); capitals are 7 units of `unit`
 * pixels high, letters 6 apart. */
void mr_image_text(mr_image *image, double x, double y, double unit, mr_rgb color, const char *text);

/* A letter's nine rows of five bits, from the left and from the top, highest first; two hang below. */
uint64_t mr_glyph(char letter);

#endif
