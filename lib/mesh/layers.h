/*
 * layers.h -- the layers and columns that tools agree on, once: shapes, what refers to what, frame <-> mesh.
 *
 * Contract: getters check shape, indices, regions and finite coordinates, and
 * fail with a sentence that names layer and column; putters drop what the
 * change makes stale (the table in layers.c).
 */
#ifndef MR_MESH_LAYERS_H
#define MR_MESH_LAYERS_H

#include "mesh/mesh.h"
#include "stream/frame.h"

/* Regions (column `region`): fixed, free, or handle number region - MR_REGION_HANDLE. */
enum { MR_REGION_FIXED = 0, MR_REGION_FREE = 1, MR_REGION_HANDLE = 2 };

typedef struct mr_column_info {
	const char *layer, *name; /* layer NULL: any */
	mr_shape shape;           /* components 0: any number */
	const char *what;
} mr_column_info;

/* Every column by convention; ends with a name of NULL. */
extern const mr_column_info mr_columns[];

/* True where the frame has the column. */
bool mr_layer_has(const mr_frame *f, const char *layer, const char *name);

/* True for a layer that by convention holds something else than a surface. */
bool mr_layer_no_surface(const char *layer);

/* A column of the table, its shape checked.  MR_EMISSING where it is absent. */
mr_status
mr_layer_get(mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, const void **data, size_t *rows);

/* The same, where it must have `rows` rows. */
mr_status mr_layer_get_rows(
    mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, size_t rows, const void **data);

/* Puts a column of the table; the shape is the table's (components where the table has 0 there). */
mr_status
mr_layer_put(mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, const void *data, size_t rows);
mr_status mr_layer_put_wide(mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, uint8_t components,
    const void *data, size_t rows);

/* The layer's surface: positions and triangles, checked.  MR_EMISSING without them; MR_EMESH without a face.
 */
mr_status mr_layer_mesh(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m);

/* The layer's positions, checked; faces are not looked at (m->t NULL, nf 0). */
mr_status mr_layer_points(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m);

/* The layer's surface, or its positions where it has no faces. */
mr_status mr_layer_surface_or_points(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m);

/* What became of a layer. */
typedef enum mr_change {
	MR_POSED,       /* the same surface, elsewhere */
	MR_RESHAPED,    /* another surface of the same vertices and triangles */
	MR_RECONNECTED, /* other vertices or triangles */
	MR_RESELECTED   /* the same surface with other regions */
} mr_change;

/* Drops what the change makes stale, of the layer and of others. */
void mr_layer_changed(mr_frame *f, const char *layer, mr_change change);

/* Puts positions, which must be finite, and triangles; drops what is stale where they are not those that were
 * there. */
mr_status mr_layer_put_mesh(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_mesh *m);

/* Puts positions alone, which must be finite: the layer is posed or reshaped. */
mr_status
mr_layer_move(mr_ctx *ctx, mr_frame *f, const char *layer, mr_change change, const mr_v3 *p, size_t nv);

/* Puts regions; what followed from others is dropped. */
mr_status mr_layer_put_region(mr_ctx *ctx, mr_frame *f, const char *layer, const uint32_t *region, size_t nv);

/* The layer's regions, rows checked against nv, values below 2 + 65536. */
mr_status mr_layer_region(mr_ctx *ctx, mr_frame *f, const char *layer, size_t nv, const uint32_t **region);

/* The first of the layers (a NULL-terminated list) that is in the frame, or `only` where not NULL.
 * MR_EMISSING names them all. */
mr_status
mr_layer_choose(mr_ctx *ctx, mr_frame *f, const char *only, const char *const *layers, const char **layer);

#endif
