/* random.h -- a small seeded generator (Steele, Lea, Flood 2014: SplitMix64). */
#ifndef MR_BASE_RANDOM_H
#define MR_BASE_RANDOM_H

#include "base/ctx.h"

typedef struct mr_random {
	uint64_t state; /* the seed, to begin with */
} mr_random;

static inline uint64_t
mr_random_bits(mr_random *r)
{
	uint64_t z = (r->state += 0x9e3779b97f4a7c15u);
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	return z ^ (z >> 31);
}

/* Uniform in [0, 1). */
static inline double
mr_random_real(mr_random *r)
{
	return (double)(mr_random_bits(r) >> 11) * 0x1p-53;
}

#endif
