/* A hash table with linear probing from half-edges to those of the source. */
#include "mesh/feature_curves.h"

enum { LEAST_BITS = 6, MOST_BITS = 31 };

static uint32_t
next_slot(const mr_curves *c, uint32_t i)
{
	return (i + 1) & ((1u << c->bits) - 1);
}

/* How many slots `to` is behind `from`, around the end. */
static uint32_t
distance(const mr_curves *c, uint32_t from, uint32_t to)
{
	return (to - from) & ((1u << c->bits) - 1);
}

static void
clear(mr_curves *c)
{
	for (size_t i = 0; i < (size_t)1 << c->bits; i++)
		c->slot[i].half_edge = MR_NONE;
	c->count = 0;
}

/* Puts what is in the slots of another table into an empty one. */
static void
refill(mr_curves *c, const mr_curve_slot *slot, size_t slots)
{
	for (size_t i = 0; i < slots; i++)
		if (slot[i].half_edge != MR_NONE)
			mr_curves_set(c, slot[i].half_edge, slot[i].source);
}

static size_t
slots_of(const mr_curves *c)
{
	return c->slot ? (size_t)1 << c->bits : 0;
}

/* At most three slots of four are taken. */
mr_status
mr_curves_reserve(mr_ctx *ctx, mr_curves *c, size_t more)
{
	mr_curves grown = { .bits = c->slot ? c->bits : LEAST_BITS };

	while ((size_t)3 << grown.bits < 4 * (c->count + more))
		grown.bits++;
	if (c->slot && grown.bits == c->bits)
		return MR_OK;
	if (grown.bits > MOST_BITS)
		return mr_fail(ctx, MR_ERANGE, "more than %zu half-edges would lie on curves", c->count);
	grown.slot = MR_NEW(ctx, (size_t)1 << grown.bits, mr_curve_slot);
	clear(&grown);
	refill(&grown, c->slot, slots_of(c));
	*c = grown;
	return MR_OK;
}

/* Empties slot i; what was pushed on by it moves back (Knuth 1973, algorithm 6.4 R). */
static void
take_out(mr_curves *c, uint32_t i)
{
	for (uint32_t j = next_slot(c, i); c->slot[j].half_edge != MR_NONE; j = next_slot(c, j))
		if (distance(c, mr_curves_home(c, c->slot[j].half_edge), j) >= distance(c, i, j)) {
			c->slot[i] = c->slot[j];
			i = j;
		}
	c->slot[i].half_edge = MR_NONE;
	c->count--;
}

void
mr_curves_set(mr_curves *c, uint32_t h, uint32_t source)
{
	uint32_t i;

	if (!c->slot)
		return; /* no room: there is nothing but MR_NONE to set */
	i = mr_curves_find(c, h);
	if (source != MR_NONE) {
		c->count += c->slot[i].half_edge == MR_NONE;
		c->slot[i] = (mr_curve_slot){ h, source };
	} else if (c->slot[i].half_edge == h) {
		take_out(c, i);
	}
}

void
mr_curves_renumber(mr_ctx *ctx, mr_curves *c, const uint32_t *face)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_curves old;

	mr_curves_copy(ctx, c, &old);
	for (size_t i = 0; i < slots_of(&old); i++)
		if (old.slot[i].half_edge != MR_NONE)
			old.slot[i].half_edge = 3 * face[old.slot[i].half_edge / 3] +
			                        old.slot[i].half_edge % 3;
	if (c->slot)
		clear(c);
	refill(c, old.slot, slots_of(&old));
	mr_mark_release(ctx, mark);
}

void
mr_curves_copy(mr_ctx *ctx, const mr_curves *c, mr_curves *copy)
{
	mr_curves r = *c;

	if (c->slot) {
		r.slot = MR_NEW(ctx, slots_of(c), mr_curve_slot);
		memcpy(r.slot, c->slot, slots_of(c) * sizeof *r.slot);
	}
	*copy = r;
}
