/*
 * compare_parts.h -- one direction of a comparison.
 *
 * Private to this room.
 */
#ifndef MR_MEASURE_COMPARE_PARTS_H
#define MR_MEASURE_COMPARE_PARTS_H

#include "mesh/mesh.h"

/* From a to b, which have faces, of area or not.  alike: their faces have the same corners by number.
 * scale: a length that bounds are rounded by. */
mr_status mr_compare_one_way(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *opts,
    bool alike, double scale, mr_distance *out) MR_WARN_UNUSED;

#endif
