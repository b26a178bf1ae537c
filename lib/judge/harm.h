/*
 * harm.h -- what a motion did to a surface: folds, and faces that pass through others.
 *
 * Looked for where the surface may touch itself: in the cells of space that hold a face which turned against
 * those around it, or vertices that were far apart.  Where there are none this costs a few looks at each
 * face.
 */
#ifndef MR_JUDGE_HARM_H
#define MR_JUDGE_HARM_H

#include "judge/judge.h"

/* More of it than there was.  What hangs together where it meets is near, and harm; far faces that meet may
 * be meant: a limb that meets another one, or a sheet that passes through the one beneath. */
typedef struct mr_harm {
	size_t folds;                /* edges, by more than 170 degrees */
	size_t pairs, far;           /* of faces that intersect, near ones and others */
	uint32_t vertex, far_vertex; /* of the faces that have most of it; MR_NONE without any */
} mr_harm;

void mr_harm_find(mr_ctx *ctx, const mr_motion *m, mr_harm *harm);

/* Whether faces f and g stand to each other as they did: where they touch, rounding decides whether they
 * intersect. */
bool mr_faces_stand(const mr_mesh *before, const mr_mesh *after, uint32_t f, uint32_t g);

#endif
