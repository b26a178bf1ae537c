/*
 * feature_curves.h -- which half-edges lie on curves, and on what half-edges of a source these do: a hash
 * table, since few half-edges do.
 *
 * Contract: all zero is an empty table.
 */
#ifndef MR_MESH_FEATURE_CURVES_H
#define MR_MESH_FEATURE_CURVES_H

#include "mesh/mesh.h"

typedef struct mr_curve_slot {
	uint32_t half_edge; /* MR_NONE: nothing is here */
	uint32_t source;
} mr_curve_slot;

typedef struct mr_curves {
	mr_curve_slot *slot; /* NULL: none yet */
	size_t count;
	unsigned bits; /* of the number of a slot */
} mr_curves;

/*
 * The slot where a half-edge is looked for first (Knuth 1973: multiplicative hashing); that of the next is
 * beside it, since they are asked for one after the other.
 */
static inline uint32_t
mr_curves_home(const mr_curves *c, uint32_t h)
{
	const uint32_t beside = 15;

	return ((h >> 4) * 2654435769u >> (32 - c->bits) & ~beside) | (h & beside);
}

/* The slot of h, or the empty one where it would be. */
static inline uint32_t
mr_curves_find(const mr_curves *c, uint32_t h)
{
	uint32_t i = mr_curves_home(c, h);

	while (c->slot[i].half_edge != h && c->slot[i].half_edge != MR_NONE)
		i = (i + 1) & ((1u << c->bits) - 1);
	return i;
}

/* The half-edge of the source that h lies on; MR_NONE where it lies on no curve. */
static inline uint32_t
mr_curves_get(const mr_curves *c, uint32_t h)
{
	uint32_t i;

	if (c->count == 0)
		return MR_NONE;
	i = mr_curves_find(c, h);
	return c->slot[i].half_edge == h ? c->slot[i].source : MR_NONE;
}

/* Room for so many more, in the arena. */
mr_status mr_curves_reserve(mr_ctx *ctx, mr_curves *c, size_t more);

/* Puts h on a curve, where there is room, or with MR_NONE on none. */
void mr_curves_set(mr_curves *c, uint32_t h, uint32_t source);

/* Half-edge 3 f + i becomes 3 face[f] + i. */
void mr_curves_renumber(mr_ctx *ctx, mr_curves *c, const uint32_t *face);

/* A copy in the arena. */
void mr_curves_copy(mr_ctx *ctx, const mr_curves *c, mr_curves *copy);

#endif
