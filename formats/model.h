/* model.h -- models made better, and models as layers of a frame.  Layer rule: formats. */
#ifndef MR_MODEL_H
#define MR_MODEL_H

#include "formats/formats.h"
#include "mesh/layers.h"

/* Puts the model as this layer, or, where `layer` is NULL, as `mesh`, without faces as `points`; the frame
 * borrows its arrays. */
mr_status mr_model_put(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_model *m) MR_WARN_UNUSED;

/* The layer as a model, with all that it has; columns of a number that are none by convention as properties.
 */
mr_status mr_model_get(mr_ctx *ctx, mr_frame *f, const char *layer, mr_model *m) MR_WARN_UNUSED;

/* The same, as it is to be written: what the frame's mesh has on the same triangles and the layer has not is
 * added; what stays behind, of a mesh with other triangles, and creases, is reported with a key frame. */
mr_status mr_model_complete(mr_ctx *ctx, mr_frame *f, const char *layer, mr_model *m) MR_WARN_UNUSED;

/* The texture coordinates of a corner, whose v runs upwards; NULL: none. */
const double *mr_corner_texcoord(const mr_model *m, size_t corner);

/* mr_export where the format is checked, and the file is the caller's to keep where `held` is not NULL. */
mr_status mr_export_held(mr_ctx *ctx, mr_frame *f, const char *layer, const char *path, const char *format,
    mr_outfile *held) MR_WARN_UNUSED;

#endif
