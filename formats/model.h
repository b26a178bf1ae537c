/*
 * model.h -- models made better, and models as layers of a frame.  Layer rule: formats.
 */
#ifndef MR_MODEL_H
#define MR_MODEL_H

#include "formats/formats.h"
#include "mesh/layers.h"

/* Drops the faces: what is left is a cloud. */
void mr_model_to_points(mr_model *m);

/*
 * Joins vertices within eps (0: equal ones); the lowest of them gives position and attributes.  Faces that
 * lose a corner by it go; those that had a vertex twice before stay.  Says and counts what was done.
 */
mr_status mr_model_weld(mr_ctx *ctx, double eps, mr_model *m) MR_WARN_UNUSED;

/* mr_repair, attributes carried along.  Points stay as they are.  Says and counts what was done. */
mr_status mr_model_repair(mr_ctx *ctx, mr_model *m) MR_WARN_UNUSED;

/*
 * Puts the model as this layer, or, where `layer` is NULL, as `mesh`, without faces as `points`; the frame
 * borrows its arrays.
 */
mr_status mr_model_put(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_model *m) MR_WARN_UNUSED;

/* The layer as a model: positions, and triangles, normals, colours, texture coordinates and groups where it
 * has them. */
mr_status mr_model_get(mr_ctx *ctx, mr_frame *f, const char *layer, mr_model *m) MR_WARN_UNUSED;

/* mr_export where the format is checked, and the renaming is the caller's where `held` is not NULL. */
mr_status mr_export_held(mr_ctx *ctx, mr_frame *f, const char *layer, const char *path, const char *format,
    mr_held *held, mr_export_result *result) MR_WARN_UNUSED;

#endif
