/* chord.h -- edges of a posed mesh that cut across what its base does between their ends. */
#ifndef MR_JUDGE_CHORD_H
#define MR_JUDGE_CHORD_H

#include "judge/judge.h"

typedef struct mr_chords {
	size_t edges;    /* whose middle is farther than `far` from where base takes it */
	uint32_t vertex; /* an end of the farthest; MR_NONE without any */
	double enough;   /* edges of this length would go within `far`, as arcs do; infinite without any */
} mr_chords;

/* Looks at edges longer than 4 far alone: across others base would have to turn by over two radians. */
void mr_chords_find(mr_ctx *ctx, const mr_motion *m, const mr_ground *g, double far, mr_chords *found);

#endif
