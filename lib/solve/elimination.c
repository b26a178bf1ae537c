/*
 * Davis 2006: Direct methods for sparse linear systems, chapter 4: elimination tree, postorder, and column
 * counts (Gilbert, Ng, Peyton 1994); relaxed supernodes (Ashcraft, Grimes 1989).
 */
#include "solve/elimination.h"

/* The columns of the matrix's lower triangle in an order. */
static void
arrange(mr_ctx *ctx, const mr_sparse *a, const int *order, mr_pattern *p)
{
	int n = a->n, *place = MR_NEW(ctx, (size_t)n, int), *next = MR_NEW_ZERO(ctx, (size_t)n, int);

	for (int k = 0; k < n; k++)
		place[order[k]] = k;
	for (int i = 0; i < n; i++)
		for (int e = a->start[i]; e < a->start[i + 1]; e++) {
			int j = place[a->index[e]];
			next[place[i] < j ? place[i] : j]++;
		}
	p->n = n;
	p->start[0] = 0;
	for (int j = 0; j < n; j++) {
		p->start[j + 1] = p->start[j] + next[j];
		next[j] = p->start[j];
	}
	for (int i = 0; i < n; i++)
		for (int e = a->start[i]; e < a->start[i + 1]; e++) {
			int from = place[a->index[e]], to = place[i], j = from < to ? from : to,
			    at = next[j]++;
			p->row[at] = from < to ? to : from;
			p->entry[at] = e;
		}
}

/* The same by rows: of row i the columns before it. */
static void
transpose(mr_ctx *ctx, const mr_pattern *p, int **start, int **column)
{
	size_t n = (size_t)p->n;
	int *next = MR_NEW(ctx, n, int);

	*start = MR_NEW_ZERO(ctx, n + 1, int);
	*column = MR_NEW(ctx, (size_t)p->start[n], int);
	for (int k = 0; k < p->start[n]; k++)
		(*start)[p->row[k] + 1]++;
	for (size_t i = 0; i < n; i++) {
		(*start)[i + 1] += (*start)[i];
		next[i] = (*start)[i];
	}
	for (int j = 0; j < p->n; j++)
		for (int k = p->start[j]; k < p->start[j + 1]; k++)
			(*column)[next[p->row[k]]++] = j;
}

/* Liu 1990. */
static void
find_parents(mr_ctx *ctx, int n, const int *start, const int *column, int *parent)
{
	int *ancestor = MR_NEW(ctx, (size_t)n, int);

	for (int i = 0; i < n; i++) {
		parent[i] = ancestor[i] = -1;
		for (int k = start[i]; k < start[i + 1]; k++)
			for (int j = column[k], next; j != -1 && j < i; j = next) {
				next = ancestor[j];
				ancestor[j] = i;
				if (next == -1)
					parent[j] = i;
			}
	}
}

/* post[k]: the k-th node, children before parents and each subtree at one go. */
static void
find_postorder(mr_ctx *ctx, int n, const int *parent, int *post)
{
	int *child = MR_NEW(ctx, (size_t)n, int), *sibling = MR_NEW(ctx, (size_t)n, int);
	int *stack = MR_NEW(ctx, (size_t)n, int), at = 0;

	memset(child, -1, (size_t)n * sizeof *child);
	for (int i = n; i-- > 0;)
		if (parent[i] != -1) {
			sibling[i] = child[parent[i]];
			child[parent[i]] = i;
		}
	for (int root = 0; root < n; root++) {
		int top = 0;
		if (parent[root] != -1)
			continue;
		stack[top++] = root;
		while (top > 0) {
			int i = stack[top - 1], c = child[i];
			if (c == -1) {
				post[at++] = i;
				top--;
			} else {
				child[i] = sibling[c];
				stack[top++] = c;
			}
		}
	}
}

/* Into the postorder: the order and the parents. */
static void
renumber(mr_ctx *ctx, int n, const int *post, int *order, int *parent)
{
	int *old = MR_NEW(ctx, (size_t)n, int), *place = MR_NEW(ctx, (size_t)n, int);
	int *up = MR_NEW(ctx, (size_t)n, int);

	memcpy(old, order, (size_t)n * sizeof *old);
	memcpy(up, parent, (size_t)n * sizeof *up);
	for (int k = 0; k < n; k++)
		place[post[k]] = k;
	for (int k = 0; k < n; k++) {
		order[k] = old[post[k]];
		parent[k] = up[post[k]] == -1 ? -1 : place[up[post[k]]];
	}
}

typedef struct counting {
	int *first, *highest, *previous, *ancestor;
} counting;

/*
 * Whether column j is a leaf of row i's subtree: 1 of the first, with *common = i, 2 of a later one, with the
 * least common ancestor of it and the one before.
 */
static int
leaf(counting *c, int i, int j, int *common)
{
	int before = c->previous[i], q;

	if (i <= j || c->first[j] <= c->highest[i])
		return 0;
	c->highest[i] = c->first[j];
	c->previous[i] = j;
	*common = i;
	if (before == -1)
		return 1;
	for (q = before; q != c->ancestor[q]; q = c->ancestor[q])
		;
	for (int s = before, next; s != q; s = next) {
		next = c->ancestor[s];
		c->ancestor[s] = q;
	}
	*common = q;
	return 2;
}

/* The entries of each column of the factor. */
static void
find_counts(mr_ctx *ctx, const mr_pattern *p, const int *parent, int *count)
{
	size_t n = (size_t)p->n;
	counting c = { MR_NEW(ctx, n, int), MR_NEW(ctx, n, int), MR_NEW(ctx, n, int), MR_NEW(ctx, n, int) };

	memset(c.first, -1, n * sizeof *c.first);
	memset(c.highest, -1, n * sizeof *c.highest);
	memset(c.previous, -1, n * sizeof *c.previous);
	for (int k = 0; k < p->n; k++) {
		c.ancestor[k] = k;
		count[k] = c.first[k] == -1;
		for (int j = k; j != -1 && c.first[j] == -1; j = parent[j])
			c.first[j] = k;
	}
	for (int j = 0; j < p->n; j++) {
		if (parent[j] != -1)
			count[parent[j]]--;
		for (int k = p->start[j]; k < p->start[j + 1]; k++) {
			int common, kind = leaf(&c, p->row[k], j, &common);
			count[j] += kind > 0;
			if (kind == 2)
				count[common]--;
		}
		if (parent[j] != -1)
			c.ancestor[j] = parent[j];
	}
	for (int j = 0; j < p->n; j++)
		if (parent[j] != -1)
			count[parent[j]] += count[j];
}

/* Columns from `first` on, of which the first has `rows` entries, and how many of all entries are zero. */
typedef struct group {
	int first, columns;
	double rows, zeros;
} group;

/*
 * Whether a group is better one with the next, its parent: larger panels are worth some zeros.  The numbers
 * are CHOLMOD's (Chen et al. 2008, section 3.3).
 */
static bool
joins(const group *s, const group *next, double *zeros)
{
	double columns = s->columns + next->columns, size, share;

	*zeros = next->zeros + s->zeros + s->columns * (next->rows + s->columns - s->rows);
	size = columns * (columns + 1) / 2 + columns * (next->rows - next->columns);
	share = *zeros / size;
	return columns <= 4 || share == 0 || (columns <= 16 && share < 0.8) ||
	       (columns <= 48 && share < 0.1) || share < 0.05;
}

/* The panels, last first from group[0] on; their number. */
static size_t
find_groups(int n, const int *parent, const int *count, group *g)
{
	size_t panels = 0;

	for (int end = n, begin; end > 0; end = begin) {
		double zeros;
		begin = end - 1;
		while (begin > 0 && parent[begin - 1] == begin && count[begin - 1] == count[begin] + 1)
			begin--;
		g[panels] = (group){ begin, end - begin, count[begin], 0 };
		if (panels > 0 && parent[end - 1] != -1 &&
		    parent[end - 1] < g[panels - 1].first + g[panels - 1].columns &&
		    joins(&g[panels], &g[panels - 1], &zeros)) {
			group *next = &g[panels - 1];
			next->rows += end - begin;
			next->columns += end - begin;
			next->first = begin;
			next->zeros = zeros;
		} else {
			panels++;
		}
	}
	return panels;
}

/* The panels' columns, places, tree and work, from groups. */
static void
lay_out(mr_ctx *ctx, const group *g, size_t panels, const int *parent, mr_elimination *e, int *panel_of)
{
	size_t rows = 0, values = 0;
	int *first = MR_NEW(ctx, panels + 1, int);
	size_t *row_at = MR_NEW(ctx, panels + 1, size_t), *value_at = MR_NEW(ctx, panels + 1, size_t);
	int *above = MR_NEW(ctx, panels, int), *first_below = MR_NEW(ctx, panels, int);
	double *work = MR_NEW(ctx, panels, double);

	for (size_t s = 0; s < panels; s++) {
		const group *own = &g[panels - 1 - s];
		double c = own->columns, r = own->rows;
		first[s] = own->first;
		row_at[s] = rows;
		value_at[s] = values;
		rows += (size_t)own->rows;
		values += (size_t)own->rows * (size_t)own->columns + MR_PANEL_SLACK;
		first_below[s] = (int)s;
		work[s] = c * r * r - c * c * r + c * c * c / 3;
		for (int j = 0; j < own->columns; j++)
			panel_of[own->first + j] = (int)s;
	}
	first[panels] = (int)e->l.n;
	row_at[panels] = rows;
	value_at[panels] = values;
	for (size_t s = 0; s < panels; s++) {
		int up = parent[first[s + 1] - 1];
		above[s] = up == -1 ? -1 : panel_of[up];
		if (up != -1 && first_below[s] < first_below[above[s]])
			first_below[above[s]] = first_below[s];
	}
	e->l = (mr_panels){ .n = e->l.n,
		.count = panels,
		.first = first,
		.parent = above,
		.first_below = first_below,
		.row_at = row_at,
		.value_at = value_at,
		.permutation = e->l.permutation };
	e->work = work;
}

/* The rows of the panels, ascending: row i is in those on the ways from its entries up to its own. */
static void
find_rows(
    mr_ctx *ctx, const mr_elimination *e, const int *start, const int *column, const int *panel_of, int *row)
{
	int *mark = MR_NEW(ctx, e->l.count, int);
	size_t *next = MR_NEW(ctx, e->l.count, size_t);

	memset(mark, -1, e->l.count * sizeof *mark);
	memcpy(next, e->l.row_at, e->l.count * sizeof *next);
	for (int i = 0; i < (int)e->l.n; i++) {
		int own = panel_of[i];
		row[next[own]++] = i;
		mark[own] = i;
		for (int k = start[i]; k < start[i + 1]; k++)
			for (int s = panel_of[column[k]]; mark[s] != i; s = e->l.parent[s]) {
				mark[s] = i;
				row[next[s]++] = i;
			}
	}
}

void
mr_eliminate(mr_ctx *ctx, mr_ctx *work, const mr_sparse *a, int *order, mr_elimination *e, mr_pattern *p)
{
	size_t n = (size_t)a->n, entries = (size_t)a->start[a->n];
	int *parent = MR_NEW(work, n, int), *count = MR_NEW(work, n, int), *panel_of = MR_NEW(work, n, int);
	int *start, *column, *row;
	group *groups = MR_NEW(work, n, group);
	size_t panels;

	*p = (mr_pattern){ a->n, MR_NEW(work, n + 1, int), MR_NEW(work, entries, int),
		MR_NEW(work, entries, int) };
	arrange(work, a, order, p);
	transpose(work, p, &start, &column);
	find_parents(work, a->n, start, column, parent);
	find_postorder(work, a->n, parent, count);
	renumber(work, a->n, count, order, parent);
	arrange(work, a, order, p);
	transpose(work, p, &start, &column);
	find_counts(work, p, parent, count);
	panels = find_groups(a->n, parent, count, groups);
	e->l = (mr_panels){ .n = n, .permutation = order };
	lay_out(ctx, groups, panels, parent, e, panel_of);
	e->l.row = row = MR_NEW(ctx, e->l.row_at[panels], int);
	find_rows(work, e, start, column, panel_of, row);
}
