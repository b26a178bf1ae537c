/* Joining vertices by a hash table over grid cells; with eps 0 a cell is a position. */
#include "mesh/repair.h"

typedef struct weld {
	double eps;
	struct stand {
		mr_v3 p;
		uint32_t older; /* the number + 1 of the one before in its slot */
	} * stand;              /* the vertices that stand for themselves */
	size_t used, room;
	uint32_t *slot; /* hash table of cells: the number of the one that was put there last + 1 */
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

/* The lowest in the cell within eps of `a`, or `best` where that is lower. */
static uint32_t
lowest_in(const weld *w, mr_v3 cell, mr_v3 a, uint32_t best)
{
	for (uint32_t i = w->slot[mr_hash_reals(&cell.x, 3) & w->mask]; i; i = w->stand[i - 1].older)
		if (i - 1 < best && mr_norm2(mr_sub(w->stand[i - 1].p, a)) <= w->eps * w->eps)
			best = i - 1;
	return best;
}

/* The number of the one that `a` joins, or MR_NONE. */
static uint32_t
find(const weld *w, mr_v3 a, mr_v3 cell)
{
	uint32_t best = MR_NONE;

	if (w->eps == 0)
		return lowest_in(w, cell, a, best);
	for (int k = 0; k < 27; k++) {
		mr_v3 step = mr_vec(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
		mr_v3 beside = mr_add(cell, step);
		best = lowest_in(w, mr_vec(beside.x + 0.0, beside.y + 0.0, beside.z + 0.0), a, best);
	}
	return best;
}

static void
put_in_slot(weld *w, uint32_t number)
{
	mr_v3 cell = cell_of(w, w->stand[number].p);
	uint32_t *slot = &w->slot[mr_hash_reals(&cell.x, 3) & w->mask];

	w->stand[number].older = *slot;
	*slot = number + 1;
}

/* A table of twice the size. */
static void
widen(mr_ctx *ctx, weld *w)
{
	size_t size = 2 * (w->mask + 1);

	w->slot = mr_grow(ctx, w->slot, 0, size, sizeof *w->slot);
	memset(w->slot, 0, size * sizeof *w->slot);
	w->mask = size - 1;
	for (uint32_t i = 0; i < w->used; i++)
		put_in_slot(w, i);
}

/* The vertex stands for itself.  Most slots are empty: 27 are looked into for each vertex. */
static void
add(mr_ctx *ctx, weld *w, mr_v3 p)
{
	MR_RESERVE(ctx, w->stand, w->used, 1, &w->room);
	w->stand[w->used].p = p;
	put_in_slot(w, (uint32_t)w->used++);
	if (w->used > w->mask / 8)
		widen(ctx, w);
}

void
mr_weld(mr_ctx *ctx, const mr_v3 *p, size_t n, double eps, uint32_t *map, size_t *count)
{
	MR_SCOPE(ctx);
	double span = mr_box_diagonal(mr_box_of(p, n));
	weld w = { .eps = eps > 1e-14 * span ? eps : 0, .mask = 31 };

	MR_RESERVE(ctx, w.stand, 0, 1, &w.room);
	widen(ctx, &w);
	for (size_t i = 0; i < n; i++) {
		map[i] = find(&w, p[i], cell_of(&w, p[i]));
		if (map[i] != MR_NONE)
			continue;
		map[i] = (uint32_t)w.used;
		add(ctx, &w, p[i]);
	}
	*count = w.used;
}

void
mr_weld_some(mr_ctx *ctx, const mr_v3 *p, size_t n, double eps, const bool *may, uint32_t *map, size_t *count)
{
	MR_SCOPE(ctx);
	uint32_t *own = MR_NEW(ctx, n, uint32_t), *as = MR_NEW(ctx, n, uint32_t);
	mr_v3 *q = MR_NEW(ctx, n, mr_v3);
	size_t some = 0, k = 0;

	if (!may) {
		mr_weld(ctx, p, n, eps, map, count);
		return;
	}
	for (size_t i = 0; i < n; i++)
		if (may[i])
			q[some++] = p[i];
	mr_weld(ctx, q, some, eps, own, &some);
	memset(as, 0xff, n * sizeof *as);
	*count = 0;
	for (size_t i = 0; i < n; i++) {
		uint32_t *number = may[i] ? &as[own[k++]] : &map[i];
		if (!may[i] || *number == MR_NONE)
			*number = (uint32_t)(*count)++;
		map[i] = *number;
	}
}
