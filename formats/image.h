/* image.h -- reading pictures; libjpeg behind jpeg.c, libpng behind png.c.  Layer rule: formats includes lib.
 */
#ifndef MR_FORMATS_IMAGE_H
#define MR_FORMATS_IMAGE_H

#include "render/canvas.h"

/* Whether the bytes begin a PNG, or a JPEG. */
bool mr_is_png(const unsigned char *data, size_t size);
bool mr_is_jpeg(const unsigned char *data, size_t size);

/* Pixels that a byte stands for at most: deflated 1032 times, of a bit each or of 16; a JPEG has a bit at
 * least for each 8 by 8 of them. */
enum { MR_PNG_MOST = 8 * 1032, MR_PNG_GRAY_MOST = 1032 / 2, MR_JPEG_MOST = 8 * 64 };

/* Reads a PNG, what is transparent over white, or a JPEG, into the arena.  MR_EFORMAT for another kind. */
mr_status
mr_image_decode(mr_ctx *ctx, const unsigned char *data, size_t size, mr_image *image) MR_WARN_UNUSED;
mr_status mr_image_read(mr_ctx *ctx, const char *path, mr_image *image) MR_WARN_UNUSED;

/* MR_EFORMAT where so many bytes, of which each stands for at most so many pixels, cannot hold the picture
 * that they announce. */
mr_status mr_image_fits(mr_ctx *ctx, size_t width, size_t height, size_t bytes, size_t most) MR_WARN_UNUSED;

/* The same of bytes in memory. */
mr_status mr_png_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_image *image) MR_WARN_UNUSED;
mr_status mr_jpeg_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_image *image) MR_WARN_UNUSED;

#endif
