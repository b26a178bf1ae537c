/* layers.h -- the layers and columns that tools agree on.  Getters check shape, indices, regions and finite
 * coordinates; putters drop what the change makes stale (the table in layers.c). */
#ifndef MR_MESH_LAYERS_H
#define MR_MESH_LAYERS_H

#include "mesh/attributes.h"
#include "mesh/mesh.h"

/* True for a layer that by convention holds something else than a surface. */
bool mr_layer_no_surface(const char *layer);

/* A column of the table, its shape checked.  MR_EMISSING where it is absent. */
mr_status
mr_layer_get(mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, const void **data, size_t *rows);

/* The same, where it must have `rows` rows. */
mr_status mr_layer_get_rows(
    mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, size_t rows, const void **data);

/* Puts a column of the table; the shape is the table's. */
mr_status
mr_layer_put(mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, const void *data, size_t rows);

/* mr_layer_points and mr_layer_mesh for what multiplies no lengths: coordinates beyond 1e30, or all below
 * 1e-30, are no failure. */
mr_status mr_layer_points_of_any_size(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m);
mr_status mr_layer_mesh_of_any_size(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m);

/* The layer's surface, or its positions where it has no faces. */
mr_status mr_layer_surface_or_points_of_any_size(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m);
mr_status mr_layer_surface_or_points(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m);

/* mr_layer_put_mesh of a surface that has `normal` where the one before had normals. */
mr_status mr_layer_replace(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_mesh *m);

/* Drops what the change makes stale, of the layer and of others. */
void mr_layer_changed(mr_frame *f, const char *layer, mr_change change);

/* Whether the layer has moved since it was encoded, and its dependent layer has not followed. */
mr_status mr_layer_is_posed(mr_ctx *ctx, mr_frame *f, const char *layer, bool *is);

/* Whether mesh has detail over base that no mr-decode has served yet. */
mr_status mr_layer_has_standing_detail(mr_ctx *ctx, mr_frame *f, bool *has);

/* Drops the columns of a kind. */
void mr_layer_drop_kind(mr_frame *f, const char *layer, mr_attribute kind);

/* The layer's rows have other numbers: drops what refers to them from elsewhere. */
void mr_layer_renumbered(mr_frame *f, const char *layer);

/* The layer's regions, rows checked against nv, values below 2 + 65536. */
mr_status mr_layer_region(mr_ctx *ctx, mr_frame *f, const char *layer, size_t nv, const uint32_t **region);

/* How many vertices each region has, of at least fixed and free ones; in the arena. */
typedef struct mr_regions {
	size_t n; /* the highest that some vertex has, and one */
	size_t *count;
} mr_regions;

mr_regions mr_regions_of(mr_ctx *ctx, const uint32_t *region, size_t nv);

/* Which edges of a control mesh are marked to be sharp, 3 a face, 0 where one is not; NULL: of another layer,
 * and where no column says. */
mr_status mr_layer_crease(mr_ctx *ctx, mr_frame *f, const char *layer, size_t nf, const uint8_t **mark);

/* The layers of a frame without `except` (NULL: all), as a list for a sentence: "" where there is none. */
void mr_layer_names(mr_ctx *ctx, const mr_frame *f, const char *except, const char **names);

/* MR_EMISSING: no layer of these names; which there are, and who makes `layer`, one of them. */
mr_status mr_layer_missing(mr_ctx *ctx, const mr_frame *f, const char *names, const char *layer);

/* The first of the layers (a NULL-terminated list) that is in the frame, or `only` where not NULL.
 * MR_EMISSING names them all. */
mr_status
mr_layer_choose(mr_ctx *ctx, mr_frame *f, const char *only, const char *const *layers, const char **layer);

/* Whether the layer is where its column `encoded` has it, to the bit, or has none. */
mr_status mr_layer_is_as_encoded(mr_ctx *ctx, mr_frame *f, const char *layer, bool *is);

/* Notes that the layer was made, moved, or given what stands over it (column `latest` of no layer).
 * mr_layer_put_mesh and mr_layer_move note it; a frame's only layer needs no note. */
mr_status mr_layer_worked(mr_ctx *ctx, mr_frame *f, const char *layer);

/* A surface shows now what was done to the layer: it is noted no more. */
mr_status mr_layer_followed(mr_ctx *ctx, mr_frame *f, const char *layer);

/* Whether no surface shows yet what was done to the layer. */
mr_status mr_layer_is_pending(mr_ctx *ctx, mr_frame *f, const char *layer, bool *is);

/* The layer that was worked on last; NULL where it is not known. */
mr_status mr_layer_latest(mr_ctx *ctx, mr_frame *f, const char **layer);

/* The same as a warning, of key frames: for a tool that shows several layers, by their names. */
mr_status mr_layer_finished_or_warn(mr_ctx *ctx, mr_frame *f);

/* The layer that a tool takes that shows or writes one: `only`, else the latest, else mesh, control, points
 * or base.  MR_EMISSING where there is none, or it is not finished. */
mr_status mr_layer_result(mr_ctx *ctx, mr_frame *f, const char *only, const char **layer);

/* mr_layer_choose, with a warning where that is not the latest, which may be what was meant. */
mr_status mr_layer_choose_warned(
    mr_ctx *ctx, mr_frame *f, const char *only, const char *const *layers, const char **layer);

#endif
