/*
 * harm.h -- what a motion did to a surface: folds, and faces that pass through others near them.
 */
#ifndef MR_JUDGE_HARM_H
#define MR_JUDGE_HARM_H

#include "mesh/edges.h"

/*
 * More of it than there was.  Faces are near that are at most 12 steps over edges apart: that those intersect
 * is harm, that far ones do or those of another part may be meant: a limb that meets another one, or a sheet
 * that passes through the one beneath.  Faces that stand to each other as they did count as they did.
 */
typedef struct mr_harm {
	size_t folds;      /* edges, by more than 170 degrees */
	size_t pairs, far; /* of faces that intersect, near ones and others; MR_UNKNOWN where they were not
	                      looked for */
	uint32_t vertex, far_vertex; /* of the faces that have most of it; MR_NONE without any */
} mr_harm;

/* Of m, with its edges, after its vertices have gone to `after` (nv).  Intersections are looked for where
 * there are at least so many folds as `enough`; what moves as one rigid body costs no more than its folds. */
void mr_harm_find(
    mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, const mr_v3 *after, size_t enough, mr_harm *harm);

/* Whether faces f and g stand to each other as they did: where they touch, rounding decides whether they
 * intersect. */
bool mr_faces_stand(const mr_mesh *before, const mr_mesh *after, uint32_t f, uint32_t g);

#endif
