/* transform.h -- affine maps of whole frames: all layers and the columns that relate them. */
#ifndef MR_EDIT_TRANSFORM_H
#define MR_EDIT_TRANSFORM_H

#include "mesh/layers.h"

/* The maps to apply, step by step; starts zeroed. */
typedef struct mr_transform {
	struct mr_transform_step *step;
	size_t n, room;
} mr_transform;

/* Appends the step `what`: "translate" x,y,z; "rotate" ax,ay,az,degrees; "scale" s or sx,sy,sz; "matrix" 12
 * or 16 numbers, or a file of them; "up" from:to, two of x, y, z, -x, -y, -z; "center"; "unit", the longest
 * side to 1, too.  MR_EUSAGE with a sentence; MR_EIO, MR_EFORMAT of a file. */
mr_status mr_transform_add(mr_ctx *ctx, mr_transform *t, const char *what, const char *text) MR_WARN_UNUSED;

/* The map of all steps for this frame; the box is of all positions, or of the layer's, where not NULL. */
mr_status mr_transform_map(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_transform *t, mr_affine *map) MR_WARN_UNUSED;

#endif
