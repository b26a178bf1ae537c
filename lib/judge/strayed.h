/*
 * strayed.h -- edges of a mesh that its base does not account for: detail that is torn or crushed.
 */
#ifndef MR_JUDGE_STRAYED_H
#define MR_JUDGE_STRAYED_H

#include "judge/judge.h"

typedef struct mr_strayed {
	size_t edges; /* over twice as long as they were, or under half as long, where no edge of base is */
	uint32_t vertex; /* of the one that changed most; MR_NONE without any */
} mr_strayed;

mr_strayed mr_strayed_find(const mr_motion *m, const mr_ground *g);

#endif
