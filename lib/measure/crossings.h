/*
 * crossings.h -- faces that pass through each other since a surface was made anew.
 */
#ifndef MR_MEASURE_CROSSINGS_H
#define MR_MEASURE_CROSSINGS_H

#include "mesh/mesh.h"

/*
 * Warns where over twice as many pairs of faces, and more than five, intersect in `after` than in `before`,
 * of which it was made, and says whether they are in the same places.  onto: the vertex of after that each of
 * before became, or NULL where that is not known: it is looked at as a whole then.
 */
mr_status mr_crossings_warn(
    mr_ctx *ctx, const mr_mesh *before, const uint32_t *onto, const mr_mesh *after) MR_WARN_UNUSED;

#endif
