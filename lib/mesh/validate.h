/* validate.h -- the laws of a frame's layers: columns decode, have the shape of convention, as many rows as
 * their layer, finite numbers, indices and places in range. */
#ifndef MR_MESH_VALIDATE_H
#define MR_MESH_VALIDATE_H

#include "mesh/layers.h"

/* Calls broken(user, sentence) for each law that the frame breaks. */
void mr_check_frame(mr_ctx *ctx, mr_frame *f, void (*broken)(void *user, const char *sentence), void *user);

/* MR_ERANGE where a number of a decoded column by convention is not finite, but for absent corners. */
mr_status mr_check_finite(mr_ctx *ctx, const mr_column *c);

/* The same of all columns that a tool put: those that it passes on are as they came. */
mr_status mr_check_made(mr_ctx *ctx, const mr_frame *f);

#endif
