/* disjoint_sets.h -- disjoint sets of 0 .. n - 1, joined pairwise (Tarjan 1975, paths halved). Contract: the
 * root of a set is its least element, so the forest does not depend on the order of joins. */
#ifndef MR_BASE_DISJOINT_SETS_H
#define MR_BASE_DISJOINT_SETS_H

#include "base/ctx.h"

/* Makes each of n elements its own set.  parent: n, the caller's. */
static inline void
mr_sets_begin(uint32_t *parent, size_t n)
{
	for (size_t i = 0; i < n; i++)
		parent[i] = (uint32_t)i;
}

/* The same in the arena. */
static inline uint32_t *
mr_sets_new(mr_ctx *ctx, size_t n)
{
	uint32_t *parent = MR_NEW(ctx, n, uint32_t);

	mr_sets_begin(parent, n);
	return parent;
}

/* The root of the set of x; paths become shorter. */
static inline uint32_t
mr_sets_root(uint32_t *parent, uint32_t x)
{
	while (parent[x] != x)
		x = parent[x] = parent[parent[x]];
	return x;
}

static inline void
mr_sets_join(uint32_t *parent, uint32_t a, uint32_t b)
{
	if (parent[a] == parent[b])
		return;
	a = mr_sets_root(parent, a);
	b = mr_sets_root(parent, b);
	if (a < b)
		parent[b] = a;
	else
		parent[a] = b;
}

#endif
