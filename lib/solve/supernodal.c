/* Supernodal triangular solves: Ng, Peyton 1993: Block sparse Cholesky algorithms on advanced uniprocessor
 * computers. */
#include "solve/supernodal.h"

#include "base/parallel.h"
#include "base/vectors.h"

/* A row of x: the right-hand sides that are solved together, whatever their number. */
typedef mr_wide wide;

enum { WIDTH = 4 };

struct mr_supernodal {
	mr_panels l;
	int *to;     /* where what a row is given goes in x: beyond n, where the row is outside of the panel's
	                subtree */
	int *root;   /* of the subtrees, which are worked on in parallel */
	int *beyond; /* start of each panel's outside rows in x */
	size_t roots, most;
	uint8_t *top; /* of each panel: it is in no subtree */
	wide *x;      /* n rows, then what the subtrees give to those outside of them */
	wide *panel;  /* the rows of a panel, of each subtree and of the top */
};

size_t
mr_panel_subtrees(
    mr_ctx *ctx, const mr_panels *l, const double *weight, double share, uint8_t *top, int *root)
{
	MR_SCOPE(ctx);
	double *below = MR_NEW(ctx, l->count, double), all = 0;
	size_t roots = 0;

	memcpy(below, weight, l->count * sizeof *below);
	for (size_t s = 0; s < l->count; s++) {
		all += weight[s];
		if (l->parent[s] != -1)
			below[l->parent[s]] += below[s];
	}
	for (size_t s = l->count; s-- > 0;) {
		bool within = l->parent[s] != -1 && !top[l->parent[s]];
		top[s] = !within && below[s] > share * all;
		if (!within && !top[s])
			root[roots++] = (int)s;
	}
	return roots;
}

/* The rows of the panels of a subtree that are outside of it are some of its root's. */
static void
send_outside(mr_supernodal *s, size_t root, int beyond)
{
	const mr_panels *l = &s->l;
	const int *own = l->row + l->row_at[root] + mr_panel_columns(l, root);

	for (size_t p = (size_t)l->first_below[root]; p <= root; p++)
		for (size_t k = l->row_at[p], at = 0; k < l->row_at[p + 1]; k++) {
			if (l->row[k] < l->first[root + 1])
				continue;
			while (own[at] < l->row[k])
				at++;
			s->to[k] = beyond + (int)at;
		}
}

static void
find_subtrees(mr_ctx *ctx, mr_supernodal *s)
{
	static const double SHARE = 1.0 / 16;
	const mr_panels *l = &s->l;
	double *weight;

	s->top = MR_NEW(ctx, l->count, uint8_t);
	s->root = MR_NEW(ctx, l->count, int);
	s->beyond = MR_NEW(ctx, l->count + 1, int);
	MR_SCOPE(ctx);
	weight = MR_NEW(ctx, l->count, double);
	for (size_t p = 0; p < l->count; p++)
		weight[p] = (double)(l->value_at[p + 1] - l->value_at[p]);
	s->roots = mr_panel_subtrees(ctx, l, weight, SHARE, s->top, s->root);
	s->beyond[0] = (int)l->n;
	for (size_t i = 0; i < s->roots; i++) {
		size_t root = (size_t)s->root[i];
		send_outside(s, root, s->beyond[i]);
		s->beyond[i + 1] = s->beyond[i] + (int)(mr_panel_rows(l, root) - mr_panel_columns(l, root));
	}
}

mr_supernodal *
mr_supernodal_new(mr_ctx *ctx, const mr_panels *factor)
{
	mr_supernodal *s = MR_NEW_ZERO(ctx, 1, mr_supernodal);

	s->l = *factor;
	for (size_t p = 0; p < factor->count; p++)
		s->most = mr_panel_rows(factor, p) > s->most ? mr_panel_rows(factor, p) : s->most;
	s->to = MR_NEW(ctx, factor->row_at[factor->count], int);
	memcpy(s->to, factor->row, factor->row_at[factor->count] * sizeof *s->to);
	find_subtrees(ctx, s);
	s->x = MR_NEW(ctx, (size_t)s->beyond[s->roots], wide);
	s->panel = MR_NEW(ctx, (s->roots + 1) * s->most, wide);
	return s;
}

/* A panel: l has nr rows, z as many.  Four columns are worked on together, so that a row of z serves four. */

/* z -= l y */
static MR_INLINED void
take(wide *z, double l, const wide *y)
{
	*z -= l * *y;
}

static MR_INLINED void
divide(wide *z, double l)
{
	*z /= l;
}

/*
 * Columns are too short for the hardware's prefetch, so it is explicit.  Beyond the factor, to which this may
 * point, nothing is fetched.
 */
static MR_INLINED void
fetch(const double *l, size_t offset)
{
	__builtin_prefetch((const void *)((uintptr_t)l + offset * sizeof *l));
}

/* z[i] -= l[i][0..3] y[0..3] for the rows from begin to end - 1 */
static MR_INLINED void
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
static MR_INLINED void
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

/* L z = z in the panel's columns; their update of the other rows is subtracted there. */
static MR_INLINED void
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
static MR_INLINED void
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

MR_VECTORS static void
forward_panel(const mr_supernodal *s, size_t p, wide *z)
{
	const mr_panels *l = &s->l;
	size_t nr = mr_panel_rows(l, p), nc = mr_panel_columns(l, p);
	const int *to = s->to + l->row_at[p];
	wide *x = s->x + l->first[p];

	memcpy(z, x, nc * sizeof *z);
	memset(z + nc, 0, (nr - nc) * sizeof *z);
	forward(l->value + l->value_at[p], nr, nc, z);
	memcpy(x, z, nc * sizeof *z);
	for (size_t i = nc; i < nr; i++)
		s->x[to[i]] += z[i];
}

MR_VECTORS static void
backward_panel(const mr_supernodal *s, size_t p, wide *z)
{
	const mr_panels *l = &s->l;
	size_t nr = mr_panel_rows(l, p), nc = mr_panel_columns(l, p);
	const int *row = l->row + l->row_at[p];
	wide *x = s->x + l->first[p];

	memcpy(z, x, nc * sizeof *z);
	for (size_t i = nc; i < nr; i++)
		z[i] = s->x[row[i]];
	backward(l->value + l->value_at[p], nr, nc, z);
	memcpy(x, z, nc * sizeof *z);
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
		e->s->x[i] = (wide){ row[0], row[1], row[2], row[3] };
	}
}

static void
write_rows(void *arg, size_t begin, size_t end)
{
	exchange *e = arg;
	size_t n = e->s->l.n;

	for (size_t i = begin; i < end; i++) {
		const wide *x = &e->s->x[i];
		for (size_t c = 0; c < e->columns; c++)
			e->b[c * n + (size_t)e->s->l.permutation[i]] = (*x)[c];
	}
}

static void
forward_subtrees(void *arg, size_t begin, size_t end)
{
	const mr_supernodal *s = arg;

	for (size_t i = begin; i < end; i++) {
		memset(s->x + s->beyond[i], 0, (size_t)(s->beyond[i + 1] - s->beyond[i]) * sizeof *s->x);
		for (int p = s->l.first_below[s->root[i]]; p <= s->root[i]; p++)
			forward_panel(s, (size_t)p, s->panel + i * s->most);
	}
}

static void
backward_subtrees(void *arg, size_t begin, size_t end)
{
	const mr_supernodal *s = arg;

	for (size_t i = begin; i < end; i++)
		for (int p = s->root[i]; p >= s->l.first_below[s->root[i]]; p--)
			backward_panel(s, (size_t)p, s->panel + i * s->most);
}

/* Adds the contributions of the subtrees to the rows above them, in a fixed order. */
static void
receive(const mr_supernodal *s)
{
	for (size_t i = 0; i < s->roots; i++) {
		size_t root = (size_t)s->root[i];
		const int *row = s->l.row + s->l.row_at[root] + mr_panel_columns(&s->l, root);
		for (int k = s->beyond[i]; k < s->beyond[i + 1]; k++)
			s->x[row[k - s->beyond[i]]] += s->x[k];
	}
}

static void
solve_columns(const mr_ctx *ctx, mr_supernodal *s, double *b, size_t columns)
{
	enum { GRAIN = 65536 }; /* less takes no longer than to wake a thread */
	exchange e = { s, b, columns };
	wide *panel = s->panel + s->roots * s->most;

	mr_parallel(ctx, s->l.n, GRAIN, read_rows, &e);
	mr_parallel(ctx, s->roots, 1, forward_subtrees, s);
	receive(s);
	for (size_t p = 0; p < s->l.count; p++)
		if (s->top[p])
			forward_panel(s, p, panel);
	for (size_t p = s->l.count; p-- > 0;)
		if (s->top[p])
			backward_panel(s, p, panel);
	mr_parallel(ctx, s->roots, 1, backward_subtrees, s);
	mr_parallel(ctx, s->l.n, GRAIN, write_rows, &e);
}

void
mr_supernodal_solve(const mr_ctx *ctx, mr_supernodal *s, double *b, size_t columns)
{
	for (size_t c = 0; c < columns; c += WIDTH)
		solve_columns(ctx, s, b + c * s->l.n, columns - c < WIDTH ? columns - c : WIDTH);
}
