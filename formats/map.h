/* map.h -- what the pictures of mr-map have in common.  Layer rule: formats includes lib. */
#ifndef MR_MAP_H
#define MR_MAP_H

#include "formats/image.h"
#include "render/bake.h"
#include "subdivide/displaced.h"

/* Texts in the picture of heights: the level; the heights of black and white; its width and height. */
#define MR_MAP_LEVEL "Height level"
#define MR_MAP_RANGE "Height range"
#define MR_MAP_SIZE  "Height size"

enum { MR_MAP_WHITE = 65535 };

/* Puts the range beside the heights in displacement. */
mr_status mr_map_put_range(mr_ctx *ctx, mr_frame *f, double low, double high) MR_WARN_UNUSED;

/* The name of a map: of a material, too, on a line of its own. */
mr_status mr_map_check_name(mr_ctx *ctx, const char *name) MR_WARN_UNUSED;

/* Gives nf faces of the layer the material of the map, and, where they are not NULL, texture coordinates;
 * reports replaced columns. */
mr_status mr_map_put_material(mr_ctx *ctx, mr_frame *f, const char *layer, size_t nf, const double *uv,
    const char *name) MR_WARN_UNUSED;

/* The displaced surface as what t->m stands for, and the limit normals of its corners, in the arena. */
void mr_map_displace(mr_ctx *ctx, const mr_domain *d, const double *height, mr_bake_target *t);

/* The texture coordinates of an atlas: 6 a face, in the arena. */
double *mr_map_texcoords(mr_ctx *ctx, const mr_atlas *a);

#endif
