/* picture.h -- an image as a file, PNG or PPM.  Layer rule: formats includes lib. */
#ifndef MR_PICTURE_H
#define MR_PICTURE_H

#include "render/canvas.h"

typedef enum mr_picture_kind { MR_PICTURE_PNG, MR_PICTURE_PPM } mr_picture_kind;

/* How names of such files end: ".png". */
const char *mr_picture_suffix(mr_picture_kind kind);

/* Writes the image as mr_png_write does; PPM: the binary one, P6, of 8 bits.  MR_EIO. */
mr_status
mr_picture_write(mr_ctx *ctx, const char *path, mr_picture_kind kind, const mr_image *image) MR_WARN_UNUSED;

#endif
