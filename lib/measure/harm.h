/*
 * harm.h -- what a motion did to a surface: folds, and faces that pass through others near them.
 */
#ifndef MR_MEASURE_HARM_H
#define MR_MEASURE_HARM_H

#include "mesh/edges.h"

/* What was not there before.  Faces are near that are at most 12 steps over edges apart: that a limb meets
 * another one is no harm. */
typedef struct mr_harm {
	size_t folds;    /* edges, by more than 170 degrees */
	size_t pairs;    /* of near faces that intersect; MR_UNKNOWN where they were not looked for */
	uint32_t vertex; /* of the face that has most of it; MR_NONE without any */
} mr_harm;

/* Of m, with its edges, after its vertices have gone to `after` (nv).  Intersections are looked for where
 * there are at least so many folds as `enough`; a surface that moves rigidly costs no more than its folds. */
mr_status mr_harm_find(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, const mr_v3 *after,
    size_t enough, mr_harm *harm) MR_WARN_UNUSED;

#endif
