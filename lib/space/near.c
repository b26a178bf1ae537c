/*
 * FLANN's traps, each closed here: no rows and too large k crash or return rubbish;
 * NaN gives wrong neighbours silently; equal points are scanned one by one; its
 * threads spin where they wait, so they are ours, and queries go in chunks.
 */
#include "space/near.h"

#include "base/parallel.h"
#include "mesh/repair.h"
#include "space/near_shim.h"

#include <stdatomic.h>

/* Leaves of 10 points take 2 % fewer instructions and 1 % more memory, of 40 up to 7 % more instructions. */
enum { CHUNK = 1 << 13, GRAIN = 64, LEAF = 20 };

static const double MOST = 1e150;

struct mr_near {
	void *tree;
	uint32_t *original; /* index of each row; NULL: as they are */
	size_t rows;
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

/* The distinct points, kept for FLANN, each with the lowest index of its position; *n: how many. */
static const mr_v3 *
find_rows(mr_ctx *ctx, const mr_v3 *p, size_t *n, uint32_t *original)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *map = MR_NEW(ctx, *n, uint32_t), used = 0;
	size_t rows;
	mr_v3 *row;

	mr_weld(ctx, p, *n, 0, map, &rows);
	for (uint32_t i = 0; i < *n; i++)
		if (map[i] == used)
			original[used++] = i;
	mr_mark_release(ctx, mark);
	row = MR_NEW(ctx, used, mr_v3);
	for (size_t i = 0; i < used; i++)
		row[i] = p[original[i]];
	*n = used;
	return row;
}

static void
drop(void *near)
{
	mr_tree_free(((mr_near *)near)->tree);
}

static mr_status
build_tree(mr_ctx *ctx, const mr_v3 *p, size_t n, bool distinct, mr_near **out)
{
	mr_near *near = MR_NEW_ZERO(ctx, 1, mr_near);

	if (n == 0 || n >= INT32_MAX)
		return mr_fail(ctx, MR_ERANGE, "an index of nearest points needs 1 to %d points, not %zu",
		    INT32_MAX - 1, n);
	MR_TRY(check(ctx, "point", p, n));
	if (!distinct) {
		near->original = MR_NEW(ctx, n, uint32_t);
		p = find_rows(ctx, p, &n, near->original);
	}
	near->rows = n;
	mr_own(ctx, drop, near);
	near->tree = mr_tree_build((const double(*)[3])(const void *)p, n, LEAF);
	if (!near->tree)
		return mr_fail(ctx, MR_EMEM, "no memory for an index of %zu points", n);
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
	return near->rows;
}

/* FLANN's k rows of one query, nearest first, as indices of p: equal ones by index. */
static void
order(const mr_near *near, const size_t *row, const double *d, size_t k, uint32_t *index)
{
	for (size_t i = 0; i < k; i++) {
		uint32_t x = near->original ? near->original[row[i]] : (uint32_t)row[i];
		size_t j = i;
		for (; j > 0 && d[j - 1] == d[i] && index[j - 1] > x; j--)
			index[j] = index[j - 1];
		index[j] = x;
	}
}

/* Queries of one chunk; the rows found, and a failure where there was one. */
typedef struct work {
	const mr_near *near;
	const mr_v3 *q;
	size_t k, found;
	size_t *row; /* found of each query */
	double *d;   /* alike */
	uint32_t *index;
	double *dist2; /* or NULL */
	atomic_bool failed;
} work;

static void
query_body(void *arg, size_t begin, size_t end)
{
	work *w = arg;

	if (!mr_tree_query(w->near->tree, (const double(*)[3])(const void *)(w->q + begin), end - begin,
		w->found, w->row + begin * w->found, w->d + begin * w->found)) {
		atomic_store(&w->failed, true);
		return;
	}
	for (size_t i = begin; i < end; i++) {
		const double *d = w->d + i * w->found;
		uint32_t *index = w->index + i * w->k;
		order(w->near, w->row + i * w->found, d, w->found, index);
		for (size_t j = w->found; j < w->k; j++)
			index[j] = UINT32_MAX;
		for (size_t j = 0; w->dist2 && j < w->k; j++)
			w->dist2[i * w->k + j] = j < w->found ? d[j] : INFINITY;
	}
}

mr_status
mr_near_query(
    mr_ctx *ctx, const mr_near *near, const mr_v3 *q, size_t nq, size_t k, uint32_t *index, double *dist2)
{
	MR_SCOPE(ctx);
	size_t found = k < near->rows ? k : near->rows, chunk = CHUNK / (k / 8 + 1) + 1;
	size_t *row = MR_NEW(ctx, chunk * found, size_t);
	double *d = MR_NEW(ctx, chunk * found, double);

	MR_TRY(check(ctx, "query", q, nq));
	for (size_t first = 0; first < nq && k > 0; first += chunk) {
		size_t n = nq - first < chunk ? nq - first : chunk, at = first * k;
		work w = { near, q + first, k, found, row, d, index + at, dist2 ? dist2 + at : NULL, false };
		mr_parallel(ctx, n, GRAIN, query_body, &w);
		if (atomic_load(&w.failed))
			return mr_fail(
			    ctx, MR_EMEM, "no memory for %zu nearest points of %zu queries", found, n);
	}
	return MR_OK;
}

mr_status
mr_near_once(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_v3 *q, size_t nq, size_t k, uint32_t *index,
    double *dist2)
{
	MR_SCOPE(ctx);
	mr_near *near;

	MR_TRY(mr_near_build(ctx, p, n, &near));
	return mr_near_query(ctx, near, q, nq, k, index, dist2);
}
