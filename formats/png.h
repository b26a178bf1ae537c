/* png.h -- writing PNG pictures; libpng only here.  Layer rule: formats includes lib. */
#ifndef MR_PNG_H
#define MR_PNG_H

#include "render/canvas.h"

/*
 * Writes the image beside `path` and renames it, so that a half picture is never seen; a device, a pipe or
 * "-", stdout, directly.  The same image gives the same bytes.  MR_EIO.
 */
mr_status mr_png_write(mr_ctx *ctx, const char *path, const mr_image *image);

/* True where a picture may be written there: a name in .png, "-", or what is there and is no file.  No model
 * is overwritten so. */
bool mr_png_suits(const char *path);

#endif
