/*
 * held.h -- constrained vertices of a mesh that its base, which is posed, does not hold where they belong; or
 * of a displaced surface, its control mesh.
 */
#ifndef MR_JUDGE_HELD_H
#define MR_JUDGE_HELD_H

#include "judge/judge.h"

typedef struct mr_held {
	size_t fixed, moved; /* vertices, and those that are not where they were */
	/* Of handles, those that are not where the map has them that moved base's, and of those the ones that
	 * are where it has them if it stretches base alone and turns what stands on it: they are not missed.
	 */
	size_t handled, missed, unscaled;
	size_t faceless; /* constrained vertices without a face, which stand on no surface, and are not where
	                  * they belong: not counted above */
	bool turned;     /* a map turns against the lowest one */
	bool keeps_volume; /* no map scales, nor do they translate alone, which stretches what is between */
} mr_held;

/*
 * Counts those that are off by over `far`.  A map is fitted to the vertices of base that a handle has; a
 * region whose own are off by as much, because each was given a place, is left out.
 */
void mr_held_count(mr_ctx *ctx, const mr_motion *m, const mr_ground *g, double far, mr_held *held);

#endif
