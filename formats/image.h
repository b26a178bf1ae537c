/* image.h -- pictures, of colours and of heights, in and out; only jpeg.c includes libjpeg, only png.c
 * libpng. */
#ifndef MR_FORMATS_IMAGE_H
#define MR_FORMATS_IMAGE_H

#include "formats/bytes.h"
#include "render/canvas.h"

/* Whether the bytes begin a PNG, or a JPEG. */
bool mr_is_png(const unsigned char *data, size_t size);
bool mr_is_jpeg(const unsigned char *data, size_t size);

/* Pixels that a byte stands for at most: deflated 1032 times, of a bit each or of 16; a JPEG has a bit at
 * least for each 8 by 8 of them. */
enum { MR_PNG_MOST = 8 * 1032, MR_PNG_GRAY_MOST = 1032 / 2, MR_JPEG_MOST = 8 * 64 };

/* Reads a PNG, transparency over white, or a JPEG, into the arena.  MR_EFORMAT for another kind. */
mr_status
mr_image_decode(mr_ctx *ctx, const unsigned char *data, size_t size, mr_image *image) MR_WARN_UNUSED;
mr_status mr_image_read(mr_ctx *ctx, const mr_file *file, mr_image *image) MR_WARN_UNUSED;

/* MR_EFORMAT where so many bytes, of which each stands for at most so many pixels, cannot hold the picture
 * that they announce. */
mr_status mr_image_fits(mr_ctx *ctx, size_t width, size_t height, size_t bytes, size_t most) MR_WARN_UNUSED;

/* The same of bytes in memory. */
mr_status mr_png_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_image *image) MR_WARN_UNUSED;
mr_status mr_jpeg_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_image *image) MR_WARN_UNUSED;

/* Writes the image beside `path` and renames it, so that a half picture is never seen; a device, a pipe or
 * "-", stdout, directly.  The same image gives the same bytes.  MR_EIO. */
mr_status mr_png_write(mr_ctx *ctx, const char *path, const mr_image *image);

/* A key about a picture, and its text. */
typedef struct mr_png_text {
	const char *key, *text;
} mr_png_text;

/* A picture of one number a pixel, and its texts. */
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
