/* Joining vertices by a hash table over grid cells; with eps 0 a cell is a position. */
#include "mesh/repair.h"

typedef struct weld {
	const mr_v3 *p;
	double eps;
	uint32_t *slot;  /* hash table of cells: the vertex that was put there last + 1 */
	uint32_t *older; /* per vertex that stands for itself, the one before in its slot + 1 */
	size_t mask;
} weld;

/* 0 for -0: equal coordinates must have equal bits. */
static mr_v3
cell_of(const weld *w, mr_v3 a)
{
	if (w->eps > 0)
		return mr_vec(
		    floor(a.x / w->eps) + 0.0, floor(a.y / w->eps) + 0.0, floor(a.z / w->eps) + 0.0);
	return mr_vec(a.x + 0.0, a.y + 0.0, a.z + 0.0);
}

static size_t
slot_of(const weld *w, mr_v3 cell)
{
	uint64_t bits[3], h = 0;

	memcpy(bits, &cell, sizeof bits);
	for (int k = 0; k < 3; k++) {
		h = (h ^ bits[k]) * 0x9e3779b97f4a7c15u;
		h ^= h >> 32;
	}
	return (size_t)h & w->mask;
}

/* The lowest vertex of the cell within eps of `a`, or `best` where that is lower. */
static uint32_t
lowest_in(const weld *w, mr_v3 cell, mr_v3 a, uint32_t best)
{
	for (uint32_t i = w->slot[slot_of(w, cell)]; i; i = w->older[i - 1])
		if (i - 1 < best && mr_norm2(mr_sub(w->p[i - 1], a)) <= w->eps * w->eps)
			best = i - 1;
	return best;
}

static uint32_t
find(const weld *w, mr_v3 a, mr_v3 cell)
{
	uint32_t best = MR_NONE;

	if (w->eps == 0) {
		for (uint32_t i = w->slot[slot_of(w, cell)]; i; i = w->older[i - 1])
			if (w->p[i - 1].x == a.x && w->p[i - 1].y == a.y && w->p[i - 1].z == a.z)
				return i - 1;
		return MR_NONE;
	}
	for (int k = 0; k < 27; k++) {
		mr_v3 step = mr_vec(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
		mr_v3 beside = mr_add(cell, step);
		best = lowest_in(w, mr_vec(beside.x + 0.0, beside.y + 0.0, beside.z + 0.0), a, best);
	}
	return best;
}

mr_status
mr_weld(mr_ctx *ctx, const mr_v3 *p, size_t n, double eps, uint32_t *map, size_t *count)
{
	mr_mark mark = mr_mark_take(ctx);
	double span = mr_box_diagonal(mr_box_of(p, n));
	weld w = { .p = p, .eps = eps > 1e-14 * span ? eps : 0, .mask = 64 };
	uint32_t used = 0;

	while (w.mask < n + n / 2)
		w.mask *= 2;
	w.slot = MR_NEW_ZERO(ctx, w.mask--, uint32_t);
	w.older = MR_NEW(ctx, n, uint32_t);
	if (!w.slot || !w.older) {
		mr_mark_release(ctx, mark);
		return MR_EMEM;
	}
	for (size_t i = 0; i < n; i++) {
		mr_v3 cell = cell_of(&w, p[i]);
		uint32_t j = find(&w, p[i], cell), *slot = &w.slot[slot_of(&w, cell)];
		if (j != MR_NONE) {
			map[i] = map[j];
			continue;
		}
		map[i] = used++;
		w.older[i] = *slot;
		*slot = (uint32_t)i + 1;
	}
	mr_mark_release(ctx, mark);
	*count = used;
	return MR_OK;
}
