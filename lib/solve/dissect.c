/*
 * George 1973: Nested dissection of a regular finite element mesh; the cuts are across an axis, where the
 * fewest edges cross, as surfaces invite it.  The larger parts are left to mr_order.
 */
#include "solve/sparse.h"

enum { BINS = 64, SMALL = MR_BROWSER ? 40 : 2000 };
enum { BELOW, ABOVE, SEPARATOR, PENDING };

/* Vertices order[begin] to order[end - 1], which are of a node alone. */
typedef struct piece {
	int begin, end, node;
} piece;

typedef struct dissection {
	const mr_sparse *l;
	const mr_v3 *p;
	int n;
	size_t reach;
	int *order, *spare, *part;
	int *node; /* of each vertex; neighbours are of the same node, or separators of earlier cuts */
	uint8_t *side;
	int nodes, parts; /* so far */
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

/* Cuts a piece into a lower part, from begin to ends[0], an upper one, to ends[1], and the separator; false
 * without a good cut. */
static bool
cut_piece(dissection *d, const piece *b, int ends[2])
{
	cut c = { .cost = INFINITY };

	for (int axis = 0; axis < 3; axis++)
		try_axis(d, b, axis, &c);
	if (c.cost == INFINITY)
		return false;
	for (int i = b->begin; i < b->end; i++)
		d->side[d->order[i]] = bin_of(d, &c, d->order[i]) < c.bins ? BELOW : ABOVE;
	for (size_t ring = 0; ring < d->reach; ring++)
		peel(d, b, ring % 2 ? ABOVE : BELOW);
	memcpy(d->spare + b->begin, d->order + b->begin, (size_t)(b->end - b->begin) * sizeof *d->order);
	ends[0] = gather(d, b, BELOW, b->begin);
	ends[1] = gather(d, b, ABOVE, ends[0]);
	gather(d, b, SEPARATOR, ends[1]);
	return 2 * (b->end - ends[1]) <= b->end - b->begin; /* else the separator is most of it */
}

/* Numbers a piece: the separator after the parts. */
static void
dissect(dissection *d, int begin, int end)
{
	piece own = { begin, end, d->nodes++ };
	int ends[2];

	for (int i = begin; i < end; i++)
		d->node[d->order[i]] = own.node;
	if (end - begin > SMALL && cut_piece(d, &own, ends)) {
		dissect(d, begin, ends[0]);
		dissect(d, ends[0], ends[1]);
		begin = ends[1];
	}
	for (int i = begin; i < end; i++)
		d->part[d->order[i]] = d->parts;
	d->parts += begin < end;
}

void
mr_dissect(mr_ctx *ctx, const mr_sparse *l, const mr_v3 *p, size_t n, size_t reach, int *part)
{
	MR_SCOPE(ctx);
	dissection d = { .l = l,
		.p = p,
		.n = (int)n,
		.reach = reach,
		.order = MR_NEW(ctx, n, int),
		.spare = MR_NEW(ctx, n, int),
		.part = part,
		.node = MR_NEW(ctx, n, int),
		.side = MR_NEW(ctx, n, uint8_t) };

	for (int i = 0; i < d.n; i++)
		d.order[i] = i;
	dissect(&d, 0, d.n);
}
