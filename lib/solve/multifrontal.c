/*
 * Duff, Reid 1983: The multifrontal solution of indefinite sparse symmetric linear equations; of supernodes,
 * in subtrees that are independent (Liu 1992: The multifrontal method for sparse matrix solution).
 */
#include "solve/multifrontal.h"

#include "base/parallel.h"
#include "base/vectors.h"

#include <stdatomic.h>

/* A subtree is left to one thread where its work is at most 1 / SHARES of all. */
static const double SHARES = 24;
/* Multiplications of a panel for which threads are worth waking. */
static const double MANY = 2e6;

enum { ROWS = 8, COLUMNS = 4, DEPTH = 128, BLOCK = 64, CHUNK = 64 };

/* The workspace of a thread. */
typedef struct desk {
	atomic_flag taken;
	int *place; /* of each row in the panel's */
	int *to;    /* rows of a child in the panel's */
	double *stack;
} desk;

typedef struct multifrontal {
	const mr_ctx *ctx;
	const mr_sparse *a;
	const mr_pattern *pattern;
	const mr_elimination *e;
	double *value;
	int *child, *sibling; /* of each panel the first child, and the next of its parent's; -1: none */
	double **update;      /* each panel's update of the rows below its own */
	uint8_t *top;         /* of each panel: it is in no subtree */
	int *root;            /* of the subtrees */
	size_t roots;
	desk *desks;
	atomic_size_t failed; /* the first column without a positive pivot; n: none */
} multifrontal;

/* A panel of nr rows and nc columns, and its update, m x m and packed. */
typedef struct front {
	double *l, *u;
	size_t nr, nc, m;
	size_t begin, end;     /* the columns that are being worked on */
	const mr_ctx *threads; /* NULL: the caller alone */
} front;

/* Dense matrices, column by column */

typedef double loose __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Column by column: c[i + j m], or, packed, the lower triangle alone, m x m. */
typedef struct matrix {
	double *c;
	size_t m;
	bool packed;
} matrix;

/* The offset of row 0 of a column, which a packed matrix may not store. */
static MR_INLINED ptrdiff_t
column_at(size_t m, bool packed, size_t j)
{
	return (ptrdiff_t)(j * m) - (packed ? (ptrdiff_t)(j * (j + 1) / 2) : 0);
}

/* Rows from i and columns from j of c less a b', in a tile of which `rows` and `columns` exist: a is read
 * beyond them, without use. */
static MR_INLINED void
tile(const matrix *c, size_t i, size_t j, const double *a, const double *b, size_t ld, size_t depth,
    size_t rows, size_t columns)
{
	mr_wide s[COLUMNS][2] = { { { 0 } } };
	size_t b1 = columns > 1, b2 = columns > 2 ? 2 : 0,
	       b3 = columns > 3 ? 3 : 0; /* others' are not touched */

	for (size_t t = 0; t < depth; t++, a += ld, b += ld) {
		mr_wide a0 = *(const loose *)a, a1 = *(const loose *)(a + 4);
		s[0][0] += a0 * b[0];
		s[0][1] += a1 * b[0];
		s[1][0] += a0 * b[b1];
		s[1][1] += a1 * b[b1];
		s[2][0] += a0 * b[b2];
		s[2][1] += a1 * b[b2];
		s[3][0] += a0 * b[b3];
		s[3][1] += a1 * b[b3];
	}
	for (size_t k = 0; k < columns; k++) {
		double *at = c->c + (column_at(c->m, c->packed, j + k) + (ptrdiff_t)i);
		size_t above = c->packed && j + k > i ? j + k - i : 0;
		if (rows == ROWS && above == 0) {
			*(loose *)at -= s[k][0];
			*(loose *)(at + 4) -= s[k][1];
		} else {
			for (size_t r = above; r < rows; r++)
				at[r] -= s[k][r / 4][r % 4];
		}
	}
}

static MR_INLINED size_t
least(size_t a, size_t b)
{
	return a < b ? a : b;
}

/* c less a b', for rows from `begin` to `end`, of depth k; row i is in a[i], of a packed c those from the
 * column on. */
static MR_INLINED void
subtract_product(const matrix *c, size_t begin, size_t end, size_t left, size_t right, const double *a,
    const double *b, size_t ld, size_t k)
{
	for (size_t t = 0; t < k; t += DEPTH)
		for (size_t block = begin; block < end; block += BLOCK)
			for (size_t j = left; j < right; j += COLUMNS) {
				size_t last = least(block + BLOCK, end),
				       i = c->packed && j > block ? j : block;
				for (; i < last; i += ROWS)
					tile(c, i, j, a + t * ld + i, b + t * ld + j, ld, least(DEPTH, k - t),
					    least(ROWS, last - i), least(COLUMNS, right - j));
			}
}

/* x = x L'^-1 for rows begin to end - 1 of the columns j to e - 1, at most COLUMNS, whose L is done. */
static MR_INLINED void
divide_rows(const front *f, size_t j, size_t e, size_t begin, size_t end)
{
	for (size_t k = j; k < e; k++) {
		double *x = f->l + k * f->nr, inverse = 1 / x[k];
		for (size_t i = begin; i < end; i++)
			x[i] *= inverse;
		for (size_t c = k + 1; c < e; c++) {
			double *y = f->l + c * f->nr, factor = x[c];
			for (size_t i = begin; i < end; i++)
				y[i] -= factor * x[i];
		}
	}
}

/* Columns j to e - 1 of some rows less what the columns from `before` on take. */
static MR_INLINED void
take_before(const front *f, size_t begin, size_t end, size_t j, size_t e, size_t before)
{
	const double *l = f->l + before * f->nr;

	subtract_product(&(matrix){ f->l, f->nr, false }, begin, end, j, e, l, l, f->nr, j - before);
}

/* Rows of the columns begin to end - 1 less what the columns before take. */
MR_VECTORS static void
update_columns(void *arg, size_t from, size_t to)
{
	const front *f = arg;

	take_before(f, f->begin + from, f->begin + to, f->begin, f->end, 0);
}

/* The square of the columns begin to end - 1; the first whose pivot is not positive, or nc. */
MR_VECTORS static size_t
factor_square(const front *f)
{
	for (size_t j = f->begin, e; j < f->end; j = e) {
		e = least(j + COLUMNS, f->end);
		take_before(f, j, f->end, j, e, f->begin);
		for (size_t k = j; k < e; k++) {
			double *x = f->l + k * f->nr;
			if (!(x[k] > 0))
				return k;
			x[k] = sqrt(x[k]);
			for (size_t i = k + 1; i < e; i++)
				x[i] /= x[k];
			for (size_t c = k + 1; c < e; c++)
				for (size_t i = c; i < e; i++)
					f->l[c * f->nr + i] -= x[i] * x[c];
		}
		divide_rows(f, j, e, e, f->end);
	}
	return f->nc;
}

/* The rows below that square. */
MR_VECTORS static void
solve_rows(void *arg, size_t from, size_t to)
{
	const front *f = arg;
	size_t begin = f->end + from, end = f->end + to;

	for (size_t j = f->begin, e; j < f->end; j = e) {
		e = least(j + COLUMNS, f->end);
		take_before(f, begin, end, j, e, f->begin);
		divide_rows(f, j, e, begin, end);
	}
}

/* Columns of the update less what the panel takes. */
MR_VECTORS static void
update_below(void *arg, size_t from, size_t to)
{
	const front *f = arg;
	const double *l = f->l + f->nc;

	subtract_product(&(matrix){ f->u, f->m, true }, from, f->m, from, to, l, l, f->nr, f->nc);
}

static void
share(const front *f, size_t count, mr_body body)
{
	if (f->threads)
		mr_parallel(f->threads, count, CHUNK, body, (void *)(uintptr_t)f);
	else if (count > 0)
		body((void *)(uintptr_t)f, 0, count);
}

/* The panel and its update; the first column whose pivot is not positive, or nc. */
static size_t
factor(front *f)
{
	for (f->begin = 0; f->begin < f->nc; f->begin = f->end) {
		size_t bad;
		f->end = least(f->begin + BLOCK, f->nc);
		if (f->begin > 0)
			share(f, f->nr - f->begin, update_columns);
		bad = factor_square(f);
		if (bad < f->nc)
			return bad;
		share(f, f->nr - f->end, solve_rows);
	}
	share(f, f->m, update_below);
	return f->nc;
}

/* Fronts */

static size_t
update_size(const mr_elimination *e, size_t s)
{
	size_t m = mr_panel_rows(&e->l, s) - mr_panel_columns(&e->l, s);

	return m * (m + 1) / 2;
}

/* The matrix's own entries in the panel's columns. */
static void
put_entries(const multifrontal *w, size_t s, const front *f, const int *place)
{
	const mr_pattern *p = w->pattern;

	for (size_t c = 0; c < f->nc; c++) {
		int j = w->e->l.first[s] + (int)c;
		for (int k = p->start[j]; k < p->start[j + 1]; k++)
			f->l[c * f->nr + (size_t)place[p->row[k]]] += w->a->value[p->entry[k]];
	}
}

static void
add_child(const multifrontal *w, size_t c, const front *f, const desk *d)
{
	const mr_panels *l = &w->e->l;
	size_t nc = mr_panel_columns(l, c), m = mr_panel_rows(l, c) - nc;
	const int *row = l->row + l->row_at[c] + nc;
	int own = (int)f->nc;

	for (size_t i = 0; i < m; i++)
		d->to[i] = d->place[row[i]];
	for (size_t j = 0; j < m; j++) {
		const double *u = w->update[c] + column_at(m, true, j);
		if (d->to[j] < own) {
			double *l_j = f->l + (size_t)d->to[j] * f->nr;
			for (size_t i = j; i < m; i++)
				l_j[d->to[i]] += u[i];
		} else {
			double *u_j = f->u + (column_at(f->m, true, (size_t)(d->to[j] - own)) - own);
			for (size_t i = j; i < m; i++)
				u_j[d->to[i]] += u[i];
		}
	}
}

/* Factors panel s, whose children are done, with its update at u. */
static bool
eliminate(multifrontal *w, size_t s, double *u, const desk *d)
{
	const mr_panels *l = &w->e->l;
	front f = { .l = w->value + l->value_at[s],
		.u = u,
		.nr = mr_panel_rows(l, s),
		.nc = mr_panel_columns(l, s),
		.threads = w->top[s] && w->e->work[s] > MANY ? w->ctx : NULL };
	size_t bad, column;

	f.m = f.nr - f.nc;
	memset(f.l, 0, f.nr * f.nc * sizeof *f.l);
	memset(f.u, 0, update_size(w->e, s) * sizeof *f.u);
	for (size_t i = 0; i < f.nr; i++)
		d->place[l->row[l->row_at[s] + i]] = (int)i;
	put_entries(w, s, &f, d->place);
	for (int c = w->child[s]; c != -1; c = w->sibling[c])
		add_child(w, (size_t)c, &f, d);
	bad = factor(&f);
	if (bad == f.nc)
		return true;
	column = (size_t)l->first[s] + bad;
	for (size_t now = w->failed; column < now && !atomic_compare_exchange_weak(&w->failed, &now, column);)
		;
	return false;
}

/* Eliminates a panel, with its update on the stack; a subtree's root has memory of its own. */
static size_t
eliminate_on_stack(multifrontal *w, size_t s, size_t used, const desk *d)
{
	double *u = d->stack + used, *bottom = u;
	size_t size = update_size(w->e, s);

	if (!eliminate(w, s, u, d))
		return SIZE_MAX;
	for (int c = w->child[s]; c != -1; c = w->sibling[c])
		if (w->top[c] == w->top[s] && w->update[c] < bottom)
			bottom = w->update[c];
	memmove(bottom, u, size * sizeof *u);
	w->update[s] = bottom;
	return (size_t)(bottom - d->stack) + size;
}

static void
eliminate_subtree(multifrontal *w, size_t root, const desk *d)
{
	size_t used = 0;

	for (size_t s = (size_t)w->e->l.first_below[root]; s < root && used != SIZE_MAX; s++)
		used = eliminate_on_stack(w, s, used, d);
	if (used != SIZE_MAX)
		eliminate(w, root, w->update[root], d);
}

static void
subtree_body(void *arg, size_t begin, size_t end)
{
	multifrontal *w = arg;
	desk *d = w->desks;

	while (atomic_flag_test_and_set(&d->taken)) /* there is one for each thread */
		d++;
	for (size_t i = begin; i < end; i++)
		eliminate_subtree(w, (size_t)w->root[i], d);
	atomic_flag_clear(&d->taken);
}

/* How large the stack gets. */
static size_t
stack_size(const multifrontal *w, size_t begin, size_t end, bool top)
{
	size_t used = 0, most = 0;

	for (size_t s = begin; s < end; s++) {
		size_t size = update_size(w->e, s);
		if (w->top[s] != top)
			continue;
		most = used + size > most ? used + size : most;
		used += size;
		for (int c = w->child[s]; c != -1; c = w->sibling[c])
			used -= w->top[c] == top ? update_size(w->e, (size_t)c) : 0;
	}
	return most;
}

static void
find_children(multifrontal *w, mr_ctx *work)
{
	size_t count = w->e->l.count;

	w->child = MR_NEW(work, count, int);
	w->sibling = MR_NEW(work, count, int);
	memset(w->child, -1, count * sizeof *w->child);
	for (size_t s = count; s-- > 0;) {
		int up = w->e->l.parent[s];
		if (up == -1)
			continue;
		w->sibling[s] = w->child[up];
		w->child[up] = (int)s;
	}
}

/* Room for the updates of the subtrees' roots, and for the threads. */
static void
make_room(multifrontal *w, mr_ctx *work)
{
	const mr_elimination *e = w->e;
	size_t rows = 0, stack = stack_size(w, 0, e->l.count, true), updates = 0, threads = w->ctx->threads;

	for (size_t s = 0; s < e->l.count; s++)
		rows = mr_panel_rows(&e->l, s) > rows ? mr_panel_rows(&e->l, s) : rows;
	for (size_t i = 0; i < w->roots; i++) {
		size_t root = (size_t)w->root[i],
		       own = stack_size(w, (size_t)e->l.first_below[root], root, false);
		stack = own > stack ? own : stack;
		updates += update_size(e, root);
	}
	w->update = MR_NEW(work, e->l.count, double *);
	for (size_t i = 0, at = 0; i < w->roots; i++) {
		if (i == 0)
			w->update[w->root[0]] = MR_NEW(work, updates, double);
		else
			w->update[w->root[i]] = w->update[w->root[0]] + at;
		at += update_size(e, (size_t)w->root[i]);
	}
	w->desks = MR_NEW(work, threads, desk);
	for (size_t t = 0; t < threads; t++) {
		desk *d = &w->desks[t];
		atomic_flag_clear(&d->taken);
		d->place = MR_NEW(work, e->l.n, int);
		d->to = MR_NEW(work, rows, int);
		d->stack = MR_NEW(work, stack, double);
	}
}

size_t
mr_multifrontal(
    mr_ctx *work, const mr_sparse *a, const mr_pattern *pattern, const mr_elimination *e, double *value)
{
	multifrontal w = { .ctx = work, .a = a, .pattern = pattern, .e = e, .value = value };
	size_t used = 0;

	atomic_init(&w.failed, e->l.n);
	find_children(&w, work);
	w.top = MR_NEW(work, e->l.count, uint8_t);
	w.root = MR_NEW(work, e->l.count, int);
	w.roots = mr_panel_subtrees(work, &e->l, e->work, 1 / SHARES, w.top, w.root);
	make_room(&w, work);
	mr_parallel(work, w.roots, 1, subtree_body, &w);
	for (size_t s = 0; s < e->l.count && w.failed == e->l.n; s++)
		if (w.top[s])
			used = eliminate_on_stack(&w, s, used, &w.desks[0]);
	return w.failed;
}
