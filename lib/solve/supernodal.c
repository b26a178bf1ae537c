/*
 * Supernodal triangular solves: Ng, Peyton 1993: Block sparse Cholesky algorithms on advanced uniprocessor
 * computers; by subtrees as in Heath, Ng, Peyton 1991: Parallel algorithms for sparse linear systems.
 *
 * Panels of disjoint subtrees share no column, only rows further up.  Each subtree has rows of its own to
 * stand for these, so it runs alone; they are added up, and set, in the subtrees' order.
 */
#include "solve/supernodal.h"

#include "base/parallel.h"

/* Two of the right-hand sides: a vector of every 64-bit machine. */
typedef double pair __attribute__((vector_size(2 * sizeof(double))));

/* A row of x: the right-hand sides that are solved together, whatever their number. */
typedef struct wide {
	pair a, b;
} wide;

enum { WIDTH = 4 };

/* A subtree, solved by one thread: the panels begin to end - 1. */
typedef struct subtree {
	size_t begin, end;
	size_t shared; /* first of its rows that stand for those of panel end - 1 beyond its columns */
	size_t panel;  /* where its workspace is in s->panel */
} subtree;

struct mr_supernodal {
	mr_panels l;
	int *target;      /* of each of l.row: the row of x that stands for it in its subtree */
	subtree *subtree; /* ascending */
	size_t subtrees;
	size_t *above; /* the panels in no subtree, ascending */
	size_t aboves;
	wide *x;     /* n rows, then those that are shared */
	wide *panel; /* the rows of a panel, for what is above, then for each subtree */
};

/* Setting up */

static size_t
rows_of(const mr_panels *l, size_t s)
{
	return (size_t)(l->row_at[s + 1] - l->row_at[s]);
}

static size_t
columns_of(const mr_panels *l, size_t s)
{
	return (size_t)(l->first[s + 1] - l->first[s]);
}

static size_t
below_of(const mr_panels *l, size_t s)
{
	return rows_of(l, s) - columns_of(l, s);
}

/* The rows of panel s beyond its columns, in l.row. */
static size_t
below_at(const mr_panels *l, size_t s)
{
	return (size_t)l->row_at[s] + columns_of(l, s);
}

/* weight[s]: the entries of the subtree below panel s, itself too; first[s]: its first panel. */
static void
weigh(const mr_panels *l, const int *panel_of, size_t *weight, size_t *first)
{
	for (size_t s = 0; s < l->count; s++) {
		weight[s] = 0;
		first[s] = s;
	}
	for (size_t s = 0; s < l->count; s++) {
		weight[s] += rows_of(l, s) * columns_of(l, s);
		if (below_of(l, s)) {
			size_t parent = (size_t)panel_of[l->row[below_at(l, s)]];
			weight[parent] += weight[s];
			if (first[s] < first[parent])
				first[parent] = first[s];
		}
	}
}

/* The largest subtrees of no more entries than `limit`; what is above them. */
static void
choose_subtrees(
    mr_supernodal *s, const int *panel_of, const size_t *weight, const size_t *first, size_t limit)
{
	const mr_panels *l = &s->l;

	for (size_t p = 0; p < l->count; p++) {
		bool root = below_of(l, p) == 0;
		size_t parent = root ? 0 : (size_t)panel_of[l->row[below_at(l, p)]];
		if (weight[p] > limit)
			s->above[s->aboves++] = p;
		else if (root || weight[parent] > limit)
			s->subtree[s->subtrees++] = (subtree){ .begin = first[p], .end = p + 1 };
	}
}

static size_t
larger(size_t a, size_t b)
{
	return a > b ? a : b;
}

/* Gives the subtrees their shared rows and workspace.  shared, panel: how many rows x and s->panel need. */
static void
place_rows(mr_supernodal *s, size_t *shared, size_t *panel)
{
	size_t most = 0;

	*shared = s->l.n;
	*panel = 0;
	for (size_t i = 0; i < s->aboves; i++)
		/* NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage) those that are counted are filled */
		*panel = larger(*panel, rows_of(&s->l, s->above[i]));
	for (size_t i = 0; i < s->subtrees; i++, *panel += most) {
		subtree *t = &s->subtree[i];
		t->shared = *shared;
		t->panel = *panel;
		/* NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult) the same */
		*shared += below_of(&s->l, t->end - 1);
		most = 0;
		for (size_t p = t->begin; p < t->end; p++)
			most = larger(most, rows_of(&s->l, p));
	}
}

/* The rows of panel p beyond its columns, as the subtree has them; where: of each row beyond the subtree. */
static void
set_targets(mr_supernodal *s, size_t p, const int *where, int beyond)
{
	size_t end = (size_t)s->l.row_at[p + 1];

	for (size_t k = below_at(&s->l, p); k < end; k++) {
		int row = s->l.row[k];
		s->target[k] = row < beyond ? row : where[row];
	}
}

static void
find_targets(mr_supernodal *s, int *where)
{
	const mr_panels *l = &s->l;

	for (size_t i = 0; i < s->subtrees; i++) {
		const subtree *t = &s->subtree[i];
		size_t root = t->end - 1, at = below_at(l, root);
		for (size_t k = 0; k < below_of(l, root); k++)
			where[l->row[at + k]] = (int)(t->shared + k);
		for (size_t p = t->begin; p < t->end; p++)
			set_targets(s, p, where, l->first[t->end]);
	}
	for (size_t i = 0; i < s->aboves; i++)
		set_targets(s, s->above[i], where, (int)l->n);
}

static void
set_up(mr_ctx *ctx, mr_supernodal *s)
{
	enum { PARTS = 8, LEAST = 50000 }; /* a subtree takes 25 microseconds or more */
	const mr_panels *l = &s->l;
	size_t rows = (size_t)l->row_at[l->count], total = 0, shared, panel;
	size_t *weight = MR_NEW(ctx, l->count, size_t), *first = MR_NEW(ctx, l->count, size_t);
	int *panel_of = MR_NEW(ctx, l->n, int);

	s->target = MR_NEW(ctx, rows, int);
	s->subtree = MR_NEW(ctx, l->count, subtree);
	s->above = MR_NEW(ctx, l->count, size_t);
	for (size_t p = 0; p < l->count; p++) {
		for (int c = l->first[p]; c < l->first[p + 1]; c++)
			panel_of[c] = (int)p;
		total += rows_of(l, p) * columns_of(l, p);
	}
	weigh(l, panel_of, weight, first);
	choose_subtrees(s, panel_of, weight, first, total / PARTS > LEAST ? total / PARTS : LEAST);
	place_rows(s, &shared, &panel);
	s->x = mr_alloc(ctx, (shared + 1) / 2, 64);
	s->panel = mr_alloc(ctx, (panel + 1) / 2, 64);
	find_targets(s, panel_of); /* which is not needed any more */
}

mr_supernodal *
mr_supernodal_new(mr_ctx *ctx, const mr_panels *factor)
{
	mr_supernodal *s = MR_NEW_ZERO(ctx, 1, mr_supernodal);

	s->l = *factor;
	set_up(ctx, s);
	return s;
}

/* A panel: l has nr rows, z as many.  Four columns are worked on together, so that a row of z serves four. */

/* z -= l y */
static inline void
take(wide *z, double l, const wide *y)
{
	z->a -= l * y->a;
	z->b -= l * y->b;
}

static inline void
divide(wide *z, double l)
{
	z->a /= l;
	z->b /= l;
}

static inline void
add(wide *z, const wide *y)
{
	z->a += y->a;
	z->b += y->b;
}

/*
 * Columns are too short for the machine to see what comes next, so it is told.  Beyond the factor, where this
 * may point, nothing is fetched.
 */
static inline void
fetch(const double *l, size_t offset)
{
	__builtin_prefetch((const void *)((uintptr_t)l + offset * sizeof *l));
}

/* z[i] -= l[i][0..3] y[0..3] for the rows from begin to end - 1 */
static void
subtract(const double *l, size_t nr, size_t begin, size_t end, const wide *y, wide *z)
{
	wide y0 = y[0], y1 = y[1], y2 = y[2], y3 = y[3];

	for (size_t i = begin; i < end; i++) {
		const double *li = l + i;
		wide zi = z[i];
		fetch(l, 4 * nr + 4 * i);
		take(&zi, li[0], &y0);
		take(&zi, li[nr], &y1);
		take(&zi, li[2 * nr], &y2);
		take(&zi, li[3 * nr], &y3);
		z[i] = zi;
	}
}

/* y[0..3] -= the sum of l[i][0..3] z[i] over those rows */
static void
gather(const double *l, size_t nr, size_t begin, size_t end, const wide *z, wide *y)
{
	wide y0 = y[0], y1 = y[1], y2 = y[2], y3 = y[3];

	for (size_t i = begin; i < end; i++) {
		const double *li = l + i;
		wide zi = z[i];
		fetch(l, 4 * i - 4 * nr);
		take(&y0, li[0], &zi);
		take(&y1, li[nr], &zi);
		take(&y2, li[2 * nr], &zi);
		take(&y3, li[3 * nr], &zi);
	}
	y[0] = y0;
	y[1] = y1;
	y[2] = y2;
	y[3] = y3;
}

/* L z = z in the panel's columns; what they take from the other rows is subtracted there. */
static void
forward(const double *l, size_t nr, size_t nc, wide *z)
{
	for (size_t j = 0, end; j < nc; j = end) {
		bool four = j + 4 <= nc;
		end = j + (four ? 4 : 1);
		for (size_t k = j; k < end; k++) {
			divide(&z[k], l[k * nr + k]);
			for (size_t i = k + 1; i < (four ? end : nr); i++)
				take(&z[i], l[k * nr + i], &z[k]);
		}
		if (four)
			subtract(l + j * nr, nr, end, nr, z + j, z);
	}
}

/* L' z = z in the panel's columns, the other rows given. */
static void
backward(const double *l, size_t nr, size_t nc, wide *z)
{
	for (size_t j, end = nc; end > 0; end = j) {
		bool four = end % 4 == 0;
		j = end - (four ? 4 : 1);
		if (four)
			gather(l + j * nr, nr, end, nr, z, z + j);
		for (size_t k = end; k-- > j;) {
			for (size_t i = k + 1; i < (four ? end : nr); i++)
				take(&z[k], l[k * nr + i], &z[i]);
			divide(&z[k], l[k * nr + k]);
		}
	}
}

/* Panels in x */

static void
forward_panel(mr_supernodal *s, size_t p, wide *z)
{
	const mr_panels *l = &s->l;
	size_t nr = rows_of(l, p), nc = columns_of(l, p);
	const int *target = s->target + l->row_at[p];
	wide *x = s->x + l->first[p];

	memcpy(z, x, nc * sizeof *z);
	memset(z + nc, 0, (nr - nc) * sizeof *z);
	forward(l->value + l->value_at[p], nr, nc, z);
	memcpy(x, z, nc * sizeof *z);
	for (size_t i = nc; i < nr; i++)
		add(&s->x[target[i]], &z[i]);
}

static void
backward_panel(mr_supernodal *s, size_t p, wide *z)
{
	const mr_panels *l = &s->l;
	size_t nr = rows_of(l, p), nc = columns_of(l, p);
	const int *target = s->target + l->row_at[p];
	wide *x = s->x + l->first[p];

	memcpy(z, x, nc * sizeof *z);
	for (size_t i = nc; i < nr; i++)
		z[i] = s->x[target[i]];
	backward(l->value + l->value_at[p], nr, nc, z);
	memcpy(x, z, nc * sizeof *z);
}

static void
forward_subtrees(void *arg, size_t begin, size_t end)
{
	mr_supernodal *s = arg;

	for (size_t i = begin; i < end; i++) {
		const subtree *t = &s->subtree[i];
		memset(s->x + t->shared, 0, below_of(&s->l, t->end - 1) * sizeof *s->x);
		for (size_t p = t->begin; p < t->end; p++)
			forward_panel(s, p, s->panel + t->panel);
	}
}

static void
backward_subtrees(void *arg, size_t begin, size_t end)
{
	mr_supernodal *s = arg;

	for (size_t i = begin; i < end; i++) {
		const subtree *t = &s->subtree[i];
		const int *row = s->l.row + below_at(&s->l, t->end - 1);
		for (size_t k = 0; k < below_of(&s->l, t->end - 1); k++)
			s->x[t->shared + k] = s->x[row[k]];
		for (size_t p = t->end; p-- > t->begin;)
			backward_panel(s, p, s->panel + t->panel);
	}
}

static void
add_shared(mr_supernodal *s)
{
	for (size_t i = 0; i < s->subtrees; i++) {
		const subtree *t = &s->subtree[i];
		const int *row = s->l.row + below_at(&s->l, t->end - 1);
		for (size_t k = 0; k < below_of(&s->l, t->end - 1); k++)
			add(&s->x[row[k]], &s->x[t->shared + k]);
	}
}

typedef struct exchange {
	mr_supernodal *s;
	double *b;
	size_t columns;
} exchange;

static void
read_rows(void *arg, size_t begin, size_t end)
{
	exchange *e = arg;
	const double *b = e->b;
	size_t n = e->s->l.n;

	for (size_t i = begin; i < end; i++) {
		size_t from = (size_t)e->s->l.permutation[i];
		double row[WIDTH] = { 0 };
		for (size_t c = 0; c < e->columns; c++)
			row[c] = b[c * n + from];
		e->s->x[i] = (wide){ { row[0], row[1] }, { row[2], row[3] } };
	}
}

static void
write_rows(void *arg, size_t begin, size_t end)
{
	exchange *e = arg;
	size_t n = e->s->l.n;

	for (size_t i = begin; i < end; i++) {
		const wide *x = &e->s->x[i];
		const double row[WIDTH] = { x->a[0], x->a[1], x->b[0], x->b[1] };
		for (size_t c = 0; c < e->columns; c++)
			e->b[c * n + (size_t)e->s->l.permutation[i]] = row[c];
	}
}

static void
solve_columns(const mr_ctx *ctx, mr_supernodal *s, double *b, size_t columns)
{
	enum { GRAIN = 8192 };
	exchange e = { s, b, columns };

	mr_parallel(ctx, s->l.n, GRAIN, read_rows, &e);
	mr_parallel(ctx, s->subtrees, 1, forward_subtrees, s);
	add_shared(s);
	for (size_t i = 0; i < s->aboves; i++)
		forward_panel(s, s->above[i], s->panel);
	for (size_t i = s->aboves; i-- > 0;)
		backward_panel(s, s->above[i], s->panel);
	mr_parallel(ctx, s->subtrees, 1, backward_subtrees, s);
	mr_parallel(ctx, s->l.n, GRAIN, write_rows, &e);
}

void
mr_supernodal_solve(const mr_ctx *ctx, mr_supernodal *s, double *b, size_t columns)
{
	for (size_t c = 0; c < columns; c += WIDTH)
		solve_columns(ctx, s, b + c * s->l.n, columns - c < WIDTH ? columns - c : WIDTH);
}
