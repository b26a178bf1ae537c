/* A table of the faces by their vertices. */
#include "mesh/alike.h"

/* The three vertices in ascending order. */
static mr_tri
sorted(mr_tri t)
{
	uint32_t a = t.v[0], b = t.v[1], c = t.v[2], x;

	if (a > b)
		x = a, a = b, b = x;
	if (b > c)
		x = b, b = c, c = x;
	if (a > b)
		x = a, a = b, b = x;
	return (mr_tri){ { a, b, c } };
}

static size_t
hash3(mr_tri t)
{
	uint64_t h = (uint64_t)t.v[0] << 32 | t.v[1];

	h = (h ^ h >> 31) * 0x9e3779b97f4a7c15u;
	h = (h ^ t.v[2] ^ h >> 29) * 0xbf58476d1ce4e5b9u;
	return (size_t)(h ^ h >> 32);
}

static bool
alike(mr_tri sorted_face, mr_tri other)
{
	mr_tri o = sorted(other);

	return !memcmp(&sorted_face, &o, sizeof o);
}

void
mr_first_alike(mr_ctx *ctx, const mr_mesh *m, uint32_t *first)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t mask = 64;
	uint32_t *slot;

	while (mask < 2 * m->nf)
		mask *= 2;
	slot = MR_NEW_ZERO(ctx, mask--, uint32_t); /* number of a face + 1 */
	for (size_t f = 0; f < m->nf; f++) {
		mr_tri key = sorted(m->t[f]);
		size_t at = hash3(key) & mask;
		while (slot[at] && !alike(key, m->t[slot[at] - 1]))
			at = (at + 1) & mask;
		if (!slot[at])
			slot[at] = (uint32_t)f + 1;
		first[f] = slot[at] - 1;
	}
	mr_mark_release(ctx, mark);
}
