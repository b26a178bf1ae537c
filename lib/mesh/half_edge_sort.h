/*
 * half_edge_sort.h -- half-edges as seen from one of their vertices, which keeps them sorted by the other.
 *
 * Private to this room.
 */
#ifndef MR_MESH_HALF_EDGE_SORT_H
#define MR_MESH_HALF_EDGE_SORT_H

#include "mesh/mesh.h"

typedef struct mr_spoke {
	uint32_t to, he;
} mr_spoke;

static inline int
mr_spoke_compare(const void *a, const void *b)
{
	const mr_spoke *x = a, *y = b;

	return x->to != y->to ? (x->to > y->to) - (x->to < y->to) : (x->he > y->he) - (x->he < y->he);
}

/* Sorts the spokes of one vertex by `to`, then `he`: few, mostly. */
static inline void
mr_spokes_sort(mr_spoke *s, size_t n)
{
	if (n > 32) {
		qsort(s, n, sizeof *s, mr_spoke_compare);
		return;
	}
	for (size_t i = 1; i < n; i++) {
		mr_spoke x = s[i];
		size_t j = i;
		for (; j > 0 && mr_spoke_compare(&s[j - 1], &x) > 0; j--)
			s[j] = s[j - 1];
		s[j] = x;
	}
}

#endif
