/* Morton 1966: A computer oriented geodetic data base and a new technique in file sequencing. */
#include "mesh/zorder.h"

#include <stdlib.h>

enum { BITS = 10, BUCKETS = 1 << BITS };

/* The lowest BITS bits of x, two zeros between each. */
static uint32_t
spread(uint32_t x)
{
	x = (x | x << 16) & 0x030000ff;
	x = (x | x << 8) & 0x0300f00f;
	x = (x | x << 4) & 0x030c30c3;
	return (x | x << 2) & 0x09249249;
}

/* Any, of a box so small or large that its cells are no numbers. */
static uint32_t
cell(double x, double low, double scale)
{
	double c = (x - low) * scale;

	return c >= BUCKETS - 1 ? BUCKETS - 1 : c >= 1 ? (uint32_t)c : 0;
}

/* The order by one digit of the keys, stably. */
static void
sort_digit(const uint32_t *key, int digit, const uint32_t *from, size_t n, uint32_t *to)
{
	size_t start[BUCKETS + 1] = { 0 };

	for (size_t i = 0; i < n; i++)
		start[(key[i] >> (digit * BITS) & (BUCKETS - 1)) + 1]++;
	for (size_t b = 0; b < BUCKETS; b++)
		start[b + 1] += start[b];
	for (size_t i = 0; i < n; i++)
		to[start[key[from[i]] >> (digit * BITS) & (BUCKETS - 1)]++] = from[i];
}

/* A point of a cell that holds several. */
typedef struct tied {
	mr_v3 p;
	uint32_t index;
} tied;

static int
compare_tied(const void *a, const void *b)
{
	const tied *x = a, *y = b;

	if (x->p.x != y->p.x)
		return x->p.x < y->p.x ? -1 : 1;
	if (x->p.y != y->p.y)
		return x->p.y < y->p.y ? -1 : 1;
	if (x->p.z != y->p.z)
		return x->p.z < y->p.z ? -1 : 1;
	return (x->index > y->index) - (x->index < y->index);
}

/* One past the last of the points from `first` on that are in its cell. */
static size_t
end_of_cell(const uint32_t *key, const uint32_t *order, size_t first, size_t n)
{
	size_t end = first + 1;

	while (end < n && key[order[end]] == key[order[first]])
		end++;
	return end;
}

/* Sorts the points of one cell, cell by cell. */
static void
sort_cells(mr_ctx *ctx, const mr_v3 *p, const uint32_t *key, size_t n, uint32_t *order)
{
	size_t most = 0;
	tied *t;

	for (size_t i = 0, end; i < n; i = end) {
		end = end_of_cell(key, order, i, n);
		most = end - i > most ? end - i : most;
	}
	if (most < 2)
		return;
	t = MR_NEW(ctx, most, tied);
	for (size_t i = 0, end; i < n; i = end) {
		end = end_of_cell(key, order, i, n);
		if (end - i < 2)
			continue;
		for (size_t k = i; k < end; k++)
			t[k - i] = (tied){ p[order[k]], order[k] };
		qsort(t, end - i, sizeof *t, compare_tied);
		for (size_t k = i; k < end; k++)
			order[k] = t[k - i].index;
	}
}

void
mr_zorder(mr_ctx *ctx, const mr_v3 *p, size_t n, double cells, uint32_t *order)
{
	MR_SCOPE(ctx);
	uint32_t *key = MR_NEW(ctx, n, uint32_t), *other = MR_NEW(ctx, n, uint32_t);
	mr_box box = mr_box_of(p, n);
	mr_v3 size = mr_sub(box.max, box.min);
	double longest = fmax(size.x, fmax(size.y, size.z)), scale = longest > 0 ? cells / longest : 0;

	for (size_t i = 0; i < n; i++) {
		key[i] = spread(cell(p[i].x, box.min.x, scale)) |
		         spread(cell(p[i].y, box.min.y, scale)) << 1 |
		         spread(cell(p[i].z, box.min.z, scale)) << 2;
		other[i] = (uint32_t)i;
	}
	sort_digit(key, 0, other, n, order);
	sort_digit(key, 1, order, n, other);
	sort_digit(key, 2, other, n, order);
	sort_cells(ctx, p, key, n, order);
}

void
mr_zorder_points(mr_ctx *ctx, const mr_v3 *p, size_t n, mr_v3 *sorted)
{
	MR_SCOPE(ctx);
	uint32_t *order = MR_NEW(ctx, n, uint32_t);

	mr_zorder(ctx, p, n, MR_ZORDER_CELLS, order);
	for (size_t i = 0; i < n; i++)
		sorted[i] = p[order[i]];
}
