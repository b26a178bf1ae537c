/*
 * George 1973: Nested dissection of a regular finite element mesh; the cuts are across an axis, where the
 * fewest edges cross, as surfaces invite it.  The larger parts are left to minimum degree.
 */
#include "solve/dissect.h"

#include "base/parallel.h"

enum { BINS = 64, SMALL = 2000, DEEPEST = 20 };
enum { BELOW, ABOVE, SEPARATOR, PENDING };

/* A part: vertices order[begin] to order[end - 1].  Those of node i are cut into nodes 2 i + 1 and 2 i + 2.
 */
typedef struct piece {
	int begin, end;
	uint32_t node;
} piece;

typedef struct dissection {
	const mr_sparse *l;
	const mr_v3 *p;
	int n;
	size_t reach;
	int *order, *spare;
	uint32_t *node; /* of each vertex; neighbours are of the same node, or separators of earlier cuts */
	uint8_t *side;
	piece *now,
	    *next; /* of a level, and of the one below: two for each, empty ones where it is not cut */
} dissection;

/* A cut across an axis, above the first `bins` of BINS equal slices from `low`. */
typedef struct cut {
	int axis, bins;
	double low, scale, cost;
} cut;

static int
bin_of(const dissection *d, const cut *c, int v)
{
	return (int)(((&d->p[v].x)[c->axis] - c->low) * c->scale);
}

/* The best cut across an axis: few crossing edges, halves that balance. */
static void
try_axis(const dissection *d, const piece *b, int axis, cut *best)
{
	cut c = { .axis = axis, .low = INFINITY };
	double high = -INFINITY;
	int count[BINS] = { 0 }, crossing[BINS + 1] = { 0 }, below = 0, edges = 0, n = b->end - b->begin;

	for (int i = b->begin; i < b->end; i++) {
		double x = (&d->p[d->order[i]].x)[axis];
		c.low = fmin(c.low, x);
		high = fmax(high, x);
	}
	c.scale = 0.999999 * BINS / (high - c.low);
	if (!isfinite(c.scale))
		return;
	for (int i = b->begin; i < b->end; i++) {
		int v = d->order[i], at = bin_of(d, &c, v);
		count[at]++;
		for (int e = d->l->start[v]; e < d->l->start[v + 1] && d->l->index[e] < v; e++)
			if (d->node[d->l->index[e]] == b->node) {
				int to = bin_of(d, &c, d->l->index[e]);
				crossing[at < to ? at : to]++;
				crossing[at < to ? to : at]--;
			}
	}
	for (c.bins = 1; c.bins < BINS; c.bins++) {
		double share;
		below += count[c.bins - 1];
		edges += crossing[c.bins - 1];
		share = (double)below / n;
		c.cost = (edges + 1) / (share * (1 - share));
		if (share > 0.25 && share < 0.75 && c.cost < best->cost)
			*best = c;
	}
}

/* Makes a separator of the vertices of a side that have a neighbour elsewhere in the piece. */
static void
peel(dissection *d, const piece *b, uint8_t side)
{
	for (int i = b->begin; i < b->end; i++) {
		int v = d->order[i];
		for (int e = d->l->start[v]; d->side[v] == side && e < d->l->start[v + 1]; e++) {
			int w = d->l->index[e];
			if (w < d->n && d->node[w] == b->node && d->side[w] != side && d->side[w] != PENDING)
				d->side[v] = PENDING;
		}
	}
	for (int i = b->begin; i < b->end; i++)
		if (d->side[d->order[i]] == PENDING)
			d->side[d->order[i]] = SEPARATOR;
}

/* Brings the vertices of a side to order[begin...], in their order; returns their end. */
static int
gather(dissection *d, const piece *b, uint8_t side, int begin)
{
	for (int i = b->begin; i < b->end; i++)
		if (d->side[d->spare[i]] == side)
			d->order[begin++] = d->spare[i];
	return begin;
}

static void
cut_piece(dissection *d, const piece *b, piece child[2])
{
	cut c = { .cost = INFINITY };
	int ends[3];

	child[0] = child[1] = (piece){ 0, 0, 0 };
	for (int axis = 0; axis < 3; axis++)
		try_axis(d, b, axis, &c);
	if (c.cost == INFINITY)
		return;
	for (int i = b->begin; i < b->end; i++)
		d->side[d->order[i]] = bin_of(d, &c, d->order[i]) < c.bins ? BELOW : ABOVE;
	for (size_t ring = 0; ring < d->reach; ring++)
		peel(d, b, ring % 2 ? ABOVE : BELOW);
	memcpy(d->spare + b->begin, d->order + b->begin, (size_t)(b->end - b->begin) * sizeof *d->order);
	ends[0] = gather(d, b, BELOW, b->begin);
	ends[1] = gather(d, b, ABOVE, ends[0]);
	gather(d, b, SEPARATOR, ends[1]);
	if (2 * (b->end - ends[1]) > b->end - b->begin)
		return; /* the separator is most of it */
	child[0] = (piece){ b->begin, ends[0], 2 * b->node + 1 };
	child[1] = (piece){ ends[0], ends[1], 2 * b->node + 2 };
	for (int k = 0; k < 2; k++)
		for (int i = child[k].begin; i < child[k].end; i++)
			d->node[d->order[i]] = child[k].node;
}

static void
cut_pieces(void *arg, size_t begin, size_t end)
{
	dissection *d = arg;

	for (size_t i = begin; i < end; i++)
		cut_piece(d, &d->now[i], &d->next[2 * i]);
}

/* Cuts all pieces of a level; returns how many of the next are to be cut. */
static size_t
cut_level(const mr_ctx *ctx, dissection *d, size_t count)
{
	piece *swap = d->now;
	size_t kept = 0;

	mr_parallel(ctx, count, 1, cut_pieces, d);
	for (size_t i = 0; i < 2 * count; i++)
		if (d->next[i].end - d->next[i].begin > SMALL)
			d->next[kept++] = d->next[i];
	d->now = d->next;
	d->next = swap;
	return kept;
}

/* Numbers the nodes in use, children first. */
static void
number_nodes(const bool *used, uint32_t nodes, uint32_t node, int *number, int *next)
{
	if (node >= nodes)
		return;
	number_nodes(used, nodes, 2 * node + 1, number, next);
	number_nodes(used, nodes, 2 * node + 2, number, next);
	if (used[node])
		number[node] = (*next)++;
}

static void
number_parts(mr_ctx *ctx, const dissection *d, int *part)
{
	uint32_t nodes = 0;
	bool *used;
	int *number, next = 0;

	for (int v = 0; v < d->n; v++)
		nodes = d->node[v] >= nodes ? d->node[v] + 1 : nodes;
	used = MR_NEW_ZERO(ctx, nodes, bool);
	number = MR_NEW(ctx, nodes, int);
	for (int v = 0; v < d->n; v++)
		used[d->node[v]] = true;
	number_nodes(used, nodes, 0, number, &next);
	for (int v = 0; v < d->n; v++)
		part[v] = number[d->node[v]];
}

void
mr_dissect(mr_ctx *ctx, const mr_sparse *l, const mr_v3 *p, size_t n, size_t reach, int *part)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t pieces = n / SMALL + 2, count = n > SMALL;
	dissection d = { .l = l,
		.p = p,
		.n = (int)n,
		.reach = reach,
		.order = MR_NEW(ctx, n, int),
		.spare = MR_NEW(ctx, n, int),
		.node = MR_NEW_ZERO(ctx, n, uint32_t),
		.side = MR_NEW(ctx, n, uint8_t),
		.now = MR_NEW(ctx, 2 * pieces, piece),
		.next = MR_NEW(ctx, 2 * pieces, piece) };

	for (int i = 0; i < d.n; i++)
		d.order[i] = i;
	d.now[0] = (piece){ 0, d.n, 0 };
	for (int depth = 0; count && depth < DEEPEST; depth++)
		count = cut_level(ctx, &d, count);
	number_parts(ctx, &d, part);
	mr_mark_release(ctx, mark);
}
