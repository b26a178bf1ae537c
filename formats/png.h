/* png.h -- PNG pictures, of colours and of heights; libpng only here.  Layer rule: formats includes lib. */
#ifndef MR_PNG_H
#define MR_PNG_H

#include "render/canvas.h"

/* Writes the image beside `path` and renames it, so that a half picture is never seen; a device, a pipe or
 * "-", stdout, directly.  The same image gives the same bytes.  MR_EIO. */
mr_status mr_png_write(mr_ctx *ctx, const char *path, const mr_image *image);

/* A word about a picture, and what it says. */
typedef struct mr_png_text {
	const char *key, *text;
} mr_png_text;

/* A picture of one number a pixel, and what is said of it. */
typedef struct mr_gray {
	uint16_t *pixel; /* rows from the top, pixels from the left */
	size_t width, height;
	const mr_png_text *text;
	size_t texts;
} mr_gray;

/* The same of 16 bits a pixel, the texts in its tEXt chunks. */
mr_status mr_png_write_gray(mr_ctx *ctx, const char *path, const mr_gray *gray) MR_WARN_UNUSED;

/* Reads such a file into the arena.  MR_EFORMAT for pixels of another kind; MR_ERANGE over 32,767 a side. */
mr_status mr_png_read_gray(mr_ctx *ctx, const char *path, mr_gray *gray) MR_WARN_UNUSED;

#endif
