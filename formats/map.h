/* map.h -- what the pictures of mr-map have in common.  Layer rule: formats includes lib. */
#ifndef MR_MAP_H
#define MR_MAP_H

#include "formats/png.h"
#include "subdivide/displaced.h"

/* Texts in the picture of heights: the level; the heights of black and white; its width and height. */
#define MR_MAP_LEVEL "Height level"
#define MR_MAP_RANGE "Height range"
#define MR_MAP_SIZE  "Height size"

enum { MR_MAP_WHITE = 65535 };

/* Puts the range beside the heights in displacement. */
mr_status mr_map_put_range(mr_ctx *ctx, mr_frame *f, double low, double high) MR_WARN_UNUSED;

#endif
