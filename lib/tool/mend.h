/* mend.h -- surfaces that have come apart. */
#ifndef MR_TOOL_MEND_H
#define MR_TOOL_MEND_H

#include "mesh/layers.h"

/* Welds, stitches, repairs and turns the layer, as the options ask; one finding says what was done, and what
 * is left.  unit: the length that o->weld counts. */
mr_status mr_layer_mend(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_import_opts *o, double unit) MR_WARN_UNUSED;

#endif
