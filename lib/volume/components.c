/*
 * Parts of the inside and of the outside of a volume, as sets of runs of nodes along x: far fewer than nodes.
 * As on the isosurface, inside nodes touch over edges of the grid, outside nodes over diagonals of its faces
 * too.
 */
#include "volume/parts.h"

#include "base/disjoint_sets.h"

enum { POINTS_LEAST = 12, WALL_LEAST = 12, MANY = 100 };

/* What the points on the walls of a part that stays have to themselves, as a share of the walls' area.  Of
 * the wraps that volume.c counts 130 of 164 are right so and by half as much, 131 by twice, at distances 1 %
 * longer. */
static const double SHARE_LEAST = 0.3;

typedef struct runs {
	const mr_grid *g;
	size_t *first;   /* of each row: runs first[row] to first[row + 1], alternately outside and inside */
	uint32_t *start; /* x of a run's first node */
	uint32_t *part;  /* the first run of its part */
	size_t n;
} runs;

static size_t
rows_of(const mr_grid *g)
{
	return g->n[1] * g->n[2];
}

void
mr_filled_new(mr_ctx *ctx, const mr_grid *g, mr_filled *in)
{
	in->g = g;
	in->words = (g->n[0] + 63) / 64;
	in->bit = MR_NEW_ZERO(ctx, in->words * rows_of(g), uint64_t);
}

/* The nodes of word w of a row that are not as the one before is. */
static uint64_t
changes(const uint64_t *row, size_t w)
{
	return row[w] ^ (row[w] << 1 | (w > 0 ? row[w - 1] >> 63 : 0));
}

static mr_status
find_runs(mr_ctx *ctx, const mr_filled *in, runs *r)
{
	size_t rows = rows_of(in->g), n = 0;

	*r = (runs){ .g = in->g, .first = MR_NEW(ctx, rows + 1, size_t) };
	for (size_t row = 0; row < rows; row++) {
		r->first[row] = n++;
		for (size_t w = 0; w < in->words; w++)
			n += (size_t)__builtin_popcountll(changes(in->bit + row * in->words, w));
	}
	r->first[rows] = r->n = n;
	if (n >= UINT32_MAX)
		return mr_fail(ctx, MR_ERANGE, "a volume of %zu runs is too large", n);
	r->start = MR_NEW(ctx, n, uint32_t);
	r->part = mr_sets_new(ctx, n);
	for (size_t row = 0; row < rows; row++) {
		size_t at = r->first[row];
		r->start[at++] = 0;
		for (size_t w = 0; w < in->words; w++)
			for (uint64_t c = changes(in->bit + row * in->words, w); c; c &= c - 1)
				r->start[at++] = (uint32_t)(64 * w) + (uint32_t)__builtin_ctzll(c);
	}
	return MR_OK;
}

/* One past the last node of a run. */
static uint32_t
run_end(const runs *r, size_t row, size_t run)
{
	return run + 1 < r->first[row + 1] ? r->start[run + 1] : (uint32_t)r->g->n[0];
}

/* Rows begin outside. */
static bool
is_inside(const runs *r, size_t row, size_t run)
{
	return (run - r->first[row]) & 1;
}

/*
 * Joins the runs of two rows that touch.  Rows beside one another touch over the edges between them, outside
 * runs also over diagonals: one ends where an inside run of the other does.  Rows aslant touch over
 * diagonals.
 */
static void
join_rows(runs *r, size_t a, size_t b, bool aslant)
{
	size_t i = r->first[a], j = r->first[b];

	while (i < r->first[a + 1] && j < r->first[b + 1]) {
		uint32_t i1 = run_end(r, a, i), j1 = run_end(r, b, j);
		bool in_a = is_inside(r, a, i), in_b = is_inside(r, b, j);
		if (in_a == in_b && !(in_a && aslant))
			mr_sets_join(r->part, (uint32_t)i, (uint32_t)j);
		if (in_a != in_b && i1 == j1 && !aslant && i1 < r->g->n[0])
			mr_sets_join(r->part, (uint32_t)(in_a ? i + 1 : i), (uint32_t)(in_a ? j : j + 1));
		i += i1 <= j1;
		j += j1 <= i1;
	}
}

static void
join_runs(runs *r)
{
	size_t up = r->g->n[1];

	for (size_t z = 0; z < r->g->n[2]; z++)
		for (size_t y = 0; y < up; y++) {
			size_t row = z * up + y;
			if (y > 0)
				join_rows(r, row, row - 1, false);
			if (z > 0)
				join_rows(r, row, row - up, false);
			if (z > 0 && y > 0)
				join_rows(r, row, row - up - 1, true);
			if (z > 0 && y + 1 < up)
				join_rows(r, row, row - up + 1, true);
		}
	for (uint32_t i = 0; i < r->n; i++)
		r->part[i] = mr_sets_root(r->part, i);
}

/* What is known of a part, at its root. */
typedef struct tally {
	uint32_t *points; /* near its walls */
	double *area;     /* that these stand for */
	uint32_t *wall;   /* crossings of grid lines along x */
} tally;

/* The run of a row that holds node x. */
static size_t
run_of(const runs *r, size_t row, uint32_t x)
{
	size_t low = r->first[row], high = r->first[row + 1];

	while (high - low > 1) {
		size_t mid = low + (high - low) / 2;
		if (r->start[mid] <= x)
			low = mid;
		else
			high = mid;
	}
	return low;
}

/* Counts a point for each part that a corner of its cell lies in. */
static void
count_point(const runs *r, mr_v3 p, double area, tally *t)
{
	mr_v3 d = mr_mul(1 / r->g->step, mr_sub(p, r->g->origin));
	size_t row = (size_t)d.z * r->g->n[1] + (size_t)d.y, seen = 0;
	uint32_t x = (uint32_t)d.x, parts[8];

	for (size_t c = 0; c < 4; c++) {
		size_t at = row + (c & 1) + (c >> 1) * r->g->n[1], run = run_of(r, at, x);
		for (size_t k = run; k <= run + (run_end(r, at, run) == x + 1); k++) {
			size_t j = 0;
			while (j < seen && parts[j] != r->part[k])
				j++;
			if (j == seen) {
				parts[seen++] = r->part[k];
				t->points[r->part[k]]++;
				t->area[r->part[k]] += area;
			}
		}
	}
}

static void
count_all(mr_ctx *ctx, const mr_volume_cloud *s, const runs *r, tally *t)
{
	t->points = MR_NEW_ZERO(ctx, r->n, uint32_t);
	t->area = MR_NEW_ZERO(ctx, r->n, double);
	t->wall = MR_NEW_ZERO(ctx, r->n, uint32_t);
	for (size_t row = 0; row < rows_of(r->g); row++)
		for (size_t k = r->first[row] + 1; k < r->first[row + 1]; k++) {
			t->wall[r->part[k]]++;
			t->wall[r->part[k - 1]]++;
		}
	for (size_t i = 0; i < s->n; i++)
		count_point(r, s->p[i], s->plane.area[i], t);
}

/*
 * A line along x meets half of the area of a wall, on the average of directions.  A few points that stand for
 * much area are as likely strewn as of a surface: they count as others do.
 */
static bool
is_supported(const mr_volume_cloud *s, const runs *r, const tally *t, uint32_t part)
{
	double points = t->points[part], wall = 2 * (double)t->wall[part] * r->g->step * r->g->step;
	double area = points < MANY ? points * s->spacing * s->spacing : t->area[part];

	return points >= POINTS_LEAST && t->wall[part] >= WALL_LEAST && area >= SHARE_LEAST * wall;
}

/* Whether the runs of each part, by its root, are inside in the end; a part that is dropped becomes what is
 * around it, which has the lower root: the run before its first. */
static void
judge(mr_ctx *ctx, const mr_volume_cloud *s, const runs *r, const tally *t, bool **inside)
{
	bool *in = MR_NEW_ZERO(ctx, r->n, bool);
	uint32_t largest = 0;

	for (size_t row = 0; row < rows_of(r->g); row++)
		for (size_t k = r->first[row] + 1; k < r->first[row + 1]; k += 2)
			if (largest == 0 || t->area[r->part[k]] > t->area[largest])
				largest = r->part[k];
	for (size_t row = 0; row < rows_of(r->g); row++)
		for (uint32_t k = (uint32_t)r->first[row] + 1; k < r->first[row + 1]; k++) {
			if (r->part[k] == k && k != r->part[0])
				in[k] = k == largest || is_supported(s, r, t, k) ? is_inside(r, row, k)
				                                                 : in[r->part[k - 1]];
		}
	*inside = in;
}

static void
turn_runs(const runs *r, const bool *inside, mr_filled *in)
{
	for (size_t row = 0; row < rows_of(r->g); row++)
		for (size_t k = r->first[row]; k < r->first[row + 1]; k++)
			if (inside[r->part[k]] != is_inside(r, row, k))
				for (uint32_t x = r->start[k]; x < run_end(r, row, k); x++)
					in->bit[row * in->words + x / 64] ^= (uint64_t)1 << x % 64;
}

mr_status
mr_volume_clean(mr_ctx *ctx, const mr_volume_cloud *s, mr_filled *in)
{
	mr_mark mark = mr_mark_take(ctx);
	bool *inside;
	tally t;
	runs r;

	MR_TRY(find_runs(ctx, in, &r));
	join_runs(&r);
	count_all(ctx, s, &r, &t);
	judge(ctx, s, &r, &t, &inside);
	turn_runs(&r, inside, in);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
