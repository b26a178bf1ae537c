/*
 * A k-d tree (Friedman, Bentley, Finkel 1977) whose leaves are blocks of a few points that lie together in
 * memory.
 *
 * Every block but the last is full, so a tree of so many blocks has one form and needs no pointers. Distances
 * to parts of the tree are computed as those to points are, and rounded alike: nothing that is nearest is
 * missed.
 */
#include "space/near.h"

#include "base/parallel.h"
#include "mesh/repair.h"

enum { BLOCK = 8, GRAIN = 64 };

static const double MOST = 1e150;

/* Points of a leaf, and their indices; what is left of it is at infinity. */
typedef struct block {
	double at[3][BLOCK];
	uint32_t index[BLOCK];
} block;

/* Along an axis, where the points of the one part end and where those of the other begin. */
typedef struct split {
	double end, begin;
	uint32_t axis;
} split;

struct mr_near {
	split *split; /* of each part that has more than a block, before those of its own parts */
	block *block;
	size_t blocks, points;
};

static mr_status
check(mr_ctx *ctx, const char *what, const mr_v3 *p, size_t n)
{
	for (size_t i = 0; i < n; i++)
		if (!(fabs(p[i].x) < MOST && fabs(p[i].y) < MOST && fabs(p[i].z) < MOST))
			return mr_fail(ctx, MR_ERANGE, "%s %zu (%g %g %g) is not below 1e150", what, i,
			    p[i].x, p[i].y, p[i].z);
	return MR_OK;
}

/* ---- building ---- */

typedef struct item {
	double at[3];
	uint32_t index;
} item;

/* The lowest index of each position; how many. */
static size_t
find_items(mr_ctx *ctx, const mr_v3 *p, size_t n, bool distinct, item *items)
{
	uint32_t *map = MR_NEW(ctx, n, uint32_t), used = 0;
	size_t count;

	if (!distinct)
		mr_weld(ctx, p, n, 0, map, &count);
	for (uint32_t i = 0; i < n; i++)
		if (distinct || map[i] == used)
			items[used++] = (item){ { p[i].x, p[i].y, p[i].z }, i };
	return used;
}

static uint32_t
widest_axis(const item *p, size_t n)
{
	uint32_t widest = 0;
	double most = -1;

	for (uint32_t k = 0; k < 3; k++) {
		double low = p->at[k], high = low;
		for (size_t i = 1; i < n; i++) {
			low = p[i].at[k] < low ? p[i].at[k] : low;
			high = p[i].at[k] > high ? p[i].at[k] : high;
		}
		widest = high - low > most ? k : widest;
		most = fmax(most, high - low);
	}
	return widest;
}

/* Puts those first that lie before the one at place k, and those last that lie behind it (Hoare 1961: Find).
 */
static void
partition(item *p, ptrdiff_t n, ptrdiff_t k, uint32_t axis)
{
	ptrdiff_t low = 0, high = n - 1;

	while (low < high) {
		double pivot = p[low + (high - low) / 2].at[axis];
		ptrdiff_t i = low, j = high;
		while (i <= j) {
			item swapped;
			while (p[i].at[axis] < pivot)
				i++;
			while (p[j].at[axis] > pivot)
				j--;
			if (i > j)
				break;
			swapped = p[i];
			p[i++] = p[j];
			p[j--] = swapped;
		}
		low = j < k ? i : low;
		high = k < i ? j : high;
	}
}

static void
fill_block(const item *p, size_t n, block *b)
{
	for (size_t i = 0; i < BLOCK; i++) {
		for (int k = 0; k < 3; k++)
			b->at[k][i] = i < n ? p[i].at[k] : INFINITY;
		b->index[i] = i < n ? p[i].index : UINT32_MAX;
	}
}

/* Of n points, so many blocks, whose splits and blocks begin there. */
static void
build(item *p, size_t n, size_t blocks, split *s, block *b)
{
	size_t left = blocks / 2, first = left * BLOCK;

	if (blocks == 1) {
		fill_block(p, n, b);
		return;
	}
	s->axis = widest_axis(p, n);
	partition(p, (ptrdiff_t)n, (ptrdiff_t)first, s->axis);
	s->begin = p[first].at[s->axis];
	s->end = p[0].at[s->axis];
	for (size_t i = 1; i < first; i++)
		s->end = fmax(s->end, p[i].at[s->axis]);
	build(p, first, left, s + 1, b);
	build(p + first, n - first, blocks - left, s + left, b + left);
}

static mr_status
build_tree(mr_ctx *ctx, const mr_v3 *p, size_t n, bool distinct, mr_near **out)
{
	mr_near *near = MR_NEW(ctx, 1, mr_near);
	mr_mark mark;
	item *items;

	if (n == 0 || n >= INT32_MAX)
		return mr_fail(ctx, MR_ERANGE, "an index of nearest points needs 1 to %d points, not %zu",
		    INT32_MAX - 1, n);
	MR_TRY(check(ctx, "point", p, n));
	near->block = MR_NEW(ctx, (n + BLOCK - 1) / BLOCK, block);
	near->split = MR_NEW(ctx, (n + BLOCK - 1) / BLOCK, split);
	mark = mr_mark_take(ctx);
	items = MR_NEW(ctx, n, item);
	near->points = find_items(ctx, p, n, distinct, items);
	near->blocks = (near->points + BLOCK - 1) / BLOCK;
	build(items, near->points, near->blocks, near->split, near->block);
	mr_mark_release(ctx, mark);
	*out = near;
	return MR_OK;
}

mr_status
mr_near_build(mr_ctx *ctx, const mr_v3 *p, size_t n, mr_near **near)
{
	return build_tree(ctx, p, n, false, near);
}

mr_status
mr_near_build_distinct(mr_ctx *ctx, const mr_v3 *p, size_t n, mr_near **near)
{
	return build_tree(ctx, p, n, true, near);
}

size_t
mr_near_distinct(const mr_near *near)
{
	return near->points;
}

/* ---- queries ---- */

typedef struct query {
	double at[3];
	double off2[3]; /* along each axis, the square of how far what is looked at is, at least */
	size_t k, found;
	uint32_t *index; /* the k nearest so far */
	double *dist2;
	double most; /* the largest of k; infinite where there are fewer */
} query;

static bool
is_before(double dist2, uint32_t index, const query *q, size_t i)
{
	return dist2 < q->dist2[i] || (dist2 == q->dist2[i] && index < q->index[i]);
}

static void
insert(query *q, double dist2, uint32_t index)
{
	size_t j = q->found < q->k ? q->found++ : q->k - 1;

	for (; j > 0 && is_before(dist2, index, q, j - 1); j--) {
		q->index[j] = q->index[j - 1];
		q->dist2[j] = q->dist2[j - 1];
	}
	q->index[j] = index;
	q->dist2[j] = dist2;
	if (q->found == q->k)
		q->most = q->dist2[q->k - 1];
}

static void
look_at_block(query *q, const block *b)
{
	double dist2[BLOCK];

	for (size_t i = 0; i < BLOCK; i++) {
		double x = b->at[0][i] - q->at[0], y = b->at[1][i] - q->at[1], z = b->at[2][i] - q->at[2];
		dist2[i] = x * x + y * y + z * z;
	}
	for (size_t i = 0; i < BLOCK; i++)
		if (dist2[i] < q->most ||
		    (dist2[i] == q->most && q->found == q->k && b->index[i] < q->index[q->k - 1]))
			insert(q, dist2[i], b->index[i]);
}

static void
look(query *q, const split *s, const block *b, size_t blocks)
{
	size_t left = blocks / 2;
	double before, behind, old;
	bool first;

	if (blocks == 1) {
		look_at_block(q, b);
		return;
	}
	before = q->at[s->axis] - s->end;
	behind = s->begin - q->at[s->axis];
	first = before < behind;
	if (first)
		look(q, s + 1, b, left);
	else
		look(q, s + left, b + left, blocks - left);
	old = q->off2[s->axis];
	before = fmax(first ? behind : before, 0);
	q->off2[s->axis] = fmax(old, before * before);
	if (q->off2[0] + q->off2[1] + q->off2[2] <= q->most) {
		if (first)
			look(q, s + left, b + left, blocks - left);
		else
			look(q, s + 1, b, left);
	}
	q->off2[s->axis] = old;
}

typedef struct work {
	const mr_near *near;
	const mr_v3 *q;
	size_t k;
	uint32_t *index;
	double *dist2;
} work;

static void
query_body(void *arg, size_t begin, size_t end)
{
	const work *w = arg;
	const mr_near *near = w->near;

	for (size_t i = begin; i < end; i++) {
		query q = { { w->q[i].x, w->q[i].y, w->q[i].z }, { 0, 0, 0 }, w->k, 0, w->index + i * w->k,
			w->dist2 + i * w->k, INFINITY };
		look(&q, near->split, near->block, near->blocks);
		for (; q.found < q.k; q.found++) {
			q.index[q.found] = UINT32_MAX;
			q.dist2[q.found] = INFINITY;
		}
	}
}

mr_status
mr_near_query(
    mr_ctx *ctx, const mr_near *near, const mr_v3 *q, size_t nq, size_t k, uint32_t *index, double *dist2)
{
	mr_mark mark = mr_mark_take(ctx);

	MR_TRY(check(ctx, "query", q, nq));
	if (k > 0)
		mr_parallel(ctx, nq, GRAIN, query_body,
		    &(work){ near, q, k, index, dist2 ? dist2 : MR_NEW(ctx, nq * k, double) });
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_near_once(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_v3 *q, size_t nq, size_t k, uint32_t *index,
    double *dist2)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_near *near;

	MR_TRY(mr_near_build(ctx, p, n, &near));
	MR_TRY(mr_near_query(ctx, near, q, nq, k, index, dist2));
	mr_mark_release(ctx, mark);
	return MR_OK;
}
