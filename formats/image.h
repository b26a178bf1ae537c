/* image.h -- reading pictures; libjpeg behind jpeg.c, libpng behind png.c.  Layer rule: formats includes lib.
 */
#ifndef MR_FORMATS_IMAGE_H
#define MR_FORMATS_IMAGE_H

#include "render/canvas.h"

/* Whether the bytes begin a PNG, or a JPEG. */
bool mr_is_png(const unsigned char *data, size_t size);
bool mr_is_jpeg(const unsigned char *data, size_t size);

/* Reads a PNG, what is transparent over white, or a JPEG, into the arena.  MR_EFORMAT for another kind. */
mr_status mr_image_read(mr_ctx *ctx, const char *path, mr_image *image) MR_WARN_UNUSED;

/* The same of bytes in memory. */
mr_status mr_png_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_image *image) MR_WARN_UNUSED;
mr_status mr_jpeg_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_image *image) MR_WARN_UNUSED;

#endif
