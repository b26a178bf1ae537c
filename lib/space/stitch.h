/*
 * stitch.h -- what has come apart in a file: vertices near each other that are to be one, and vertices on
 * edges.
 */
#ifndef MR_SPACE_STITCH_H
#define MR_SPACE_STITCH_H

#include "mesh/layers.h"

/*
 * The distance below which vertices of the boundary ought to be one: by the largest gap, at least tenfold,
 * between the distances to their nearest others and the lengths of boundary edges, below the median of these;
 * 0 without such a gap.  may: nv, true on the boundary, in the arena.
 */
mr_status mr_weld_distance(mr_ctx *ctx, const mr_mesh *m, double *distance, const bool **may) MR_WARN_UNUSED;

/*
 * Splits each face at whose boundary edge vertices of the boundary stand, within 1e-5 of the diagonal, so
 * that they are corners of it.  Faces without area do not count.  Columns go along.  stitched: how many
 * vertices.
 */
mr_status mr_layer_stitch(mr_ctx *ctx, mr_frame *f, const char *layer, size_t *stitched) MR_WARN_UNUSED;

#endif
