/* paint.h -- the pictures that surfaces of a gallery wear, read from files.  Layer rule: formats includes
 * lib. */
#ifndef MR_PAINT_H
#define MR_PAINT_H

#include "formats/model.h"
#include "render/gallery.h"

/* mr_gallery_add, and paints the panels that no column colours by opts->texture or the materials in
 * opts->materials or in the stream; what stays the same is shared.  MR_EMISSING where no panel can be painted
 * as asked. */
mr_status mr_gallery_add_painted(
    mr_ctx *ctx, mr_ctx *keep, mr_gallery *g, mr_frame *frame, const mr_render_opts *opts) MR_WARN_UNUSED;

/* Finds the texture of a model: the file `picture`, or if NULL the files that its materials name, in
 * the folder `materials` (or NULL) or in the stream.  In the arena of keep, which may be ctx. */
mr_status mr_paint_model(mr_ctx *ctx, mr_ctx *keep, const mr_model *m, const char *picture,
    const char *materials, mr_subject *s) MR_WARN_UNUSED;

#endif
