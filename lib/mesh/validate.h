/*
 * validate.h -- what must hold of the layers of a frame.
 *
 * Contract: every column decodes, has the shape that convention gives it, as many
 * rows as its layer, and finite numbers; indices and regions are in range,
 * barycentric coordinates are of a place within a face, and what refers to another
 * layer finds it.
 */
#ifndef MR_MESH_VALIDATE_H
#define MR_MESH_VALIDATE_H

#include "mesh/layers.h"

/*
 * Calls broken(user, sentence) for each law that the frame breaks.  MR_OK whatever they are;
 * only want of memory fails.
 */
void mr_check_frame(mr_ctx *ctx, mr_frame *f, void (*broken)(void *user, const char *sentence), void *user);

/* MR_ERANGE where a number of a decoded column by convention is not finite, but for a corner without texture
 * coordinates. */
mr_status mr_check_finite(mr_ctx *ctx, const mr_column *c);

/* The same of all columns that a tool put: those that it passes on are as they came. */
mr_status mr_check_made(mr_ctx *ctx, const mr_frame *f);

#endif
