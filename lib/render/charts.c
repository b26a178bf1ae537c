/*
 * Faces are joined to charts pair by pair, those of the roundest border first (Garland, Willmott, Heckbert
 * 2001, "Hierarchical face clustering on polygonal surfaces"), as long as a cone of 60 degrees has their
 * normals.  Charts go where they lie lowest on those before, the highest first (Levy and others 2002, "Least
 * squares conformal maps").
 */
#include "render/charts.h"

#include "base/disjoint_sets.h"
#include "base/priority_queue.h"
#include "mesh/edges.h"
#include "render/bake.h"

enum { COLUMNS = 512, TURNS = 16 };

/* ---- cones ---- */

/* Directions within `spread` of an axis; all of them none where that is negative. */
typedef struct cone {
	mr_v3 axis;
	double spread;
} cone;

/* The least that holds both. */
static cone
cone_of(cone a, cone b)
{
	double d = mr_angle(a.axis, b.axis), turn;
	cone c;

	if (b.spread < 0 || (a.spread >= 0 && d + b.spread <= a.spread))
		return a;
	if (a.spread < 0 || d + a.spread <= b.spread)
		return b;
	c.spread = (d + a.spread + b.spread) / 2;
	turn = c.spread - a.spread;
	c.axis = mr_unit(mr_add(mr_mul(sin(d - turn), a.axis), mr_mul(sin(turn), b.axis)));
	return c;
}

/* ---- charts ---- */

typedef struct border {
	uint32_t chart;
	double length; /* of the border with it */
} border;

typedef struct chart {
	cone normals;
	double area, around;
	border *beside;
	size_t sides, room;
	uint32_t version; /* how often it has changed */
} chart;

/* Two charts that may become one. */
typedef struct pair {
	double cost;
	uint32_t a, b, versions;
} pair;

typedef struct growth {
	mr_ctx *ctx;
	chart *chart; /* of each face, while it is the root of its set */
	uint32_t *set;
	pair *queue;
	size_t n, room;
} growth;

static bool
is_cheaper(const void *a, const void *b)
{
	const pair *p = a, *q = b;

	return p->cost != q->cost ? p->cost < q->cost : p->a != q->a ? p->a < q->a : p->b < q->b;
}

/* The border of both, squared, over their area; where normals fit. */
static void
offer(growth *g, uint32_t a, border s)
{
	const chart *c = &g->chart[a], *d = &g->chart[s.chart];
	double around = c->around + d->around - 2 * s.length, area = c->area + d->area;
	cone both = cone_of(c->normals, d->normals);
	pair p = { around * around / (area > 0 ? area : 1) * (1 + both.spread), a, s.chart,
		c->version + d->version };

	if (both.spread > MR_PI / 3)
		return;
	MR_RESERVE(g->ctx, g->queue, g->n, 1, &g->room);
	mr_queue_push(g->queue, g->n++, sizeof p, &p, is_cheaper);
}

static border *
find_side(chart *c, uint32_t of)
{
	for (size_t i = 0; i < c->sides; i++)
		if (c->beside[i].chart == of)
			return &c->beside[i];
	return NULL;
}

static void
add_side(growth *g, uint32_t a, border s)
{
	chart *c = &g->chart[a];
	border *known = find_side(c, s.chart);

	if (known) {
		known->length += s.length;
		return;
	}
	MR_RESERVE(g->ctx, c->beside, c->sides, 1, &c->room);
	c->beside[c->sides++] = s;
}

static void
remove_side(chart *c, uint32_t of)
{
	border *s = find_side(c, of);

	*s = c->beside[--c->sides];
}

/* a takes over b, whose number is greater. */
static void
join(growth *g, uint32_t a, uint32_t b)
{
	chart *c = &g->chart[a], *d = &g->chart[b];

	c->around += d->around - 2 * find_side(c, b)->length;
	c->area += d->area;
	c->normals = cone_of(c->normals, d->normals);
	c->version += d->version + 1;
	mr_sets_join(g->set, a, b);
	remove_side(c, b);
	for (size_t i = 0; i < d->sides; i++) {
		border s = d->beside[i];
		if (s.chart == a)
			continue;
		remove_side(&g->chart[s.chart], b);
		add_side(g, s.chart, (border){ a, s.length });
		add_side(g, a, s);
	}
	for (size_t i = 0; i < c->sides; i++)
		offer(g, a, c->beside[i]);
}

static void
begin_charts(growth *g, const mr_mesh *m)
{
	mr_edges edges;

	for (size_t f = 0; f < m->nf; f++) {
		mr_v3 n = mr_face_cross(m, f), p[3];
		mr_corners(m, f, p);
		g->chart[f] = (chart){ .normals = { mr_unit(n), mr_norm2(n) > 0 ? 0 : -1 },
			.area = mr_norm(n) / 2,
			.around = mr_dist(p[0], p[1]) + mr_dist(p[1], p[2]) + mr_dist(p[2], p[0]) };
	}
	mr_edges_build(g->ctx, m, &edges);
	for (size_t e = 0; e < edges.count; e++)
		for (size_t i = edges.start[e]; i + 1 < edges.start[e + 1]; i++) {
			uint32_t h = edges.he[i], a = h / 3, b = edges.he[i + 1] / 3;
			double length = mr_dist(m->p[mr_he_from(m, h)], m->p[mr_he_to(m, h)]);
			add_side(g, a, (border){ b, length });
			add_side(g, b, (border){ a, length });
		}
}

/* The chart of each face is the root of its set. */
static void
grow_charts(growth *g, const mr_mesh *m)
{
	begin_charts(g, m);
	for (uint32_t f = 0; f < m->nf; f++)
		for (size_t i = 0; i < g->chart[f].sides; i++)
			if (f < g->chart[f].beside[i].chart)
				offer(g, f, g->chart[f].beside[i]);
	while (g->n > 0) {
		pair p;
		mr_queue_pop(g->queue, g->n--, sizeof p, &p, is_cheaper);
		if (g->set[p.a] == p.a && g->set[p.b] == p.b &&
		    g->chart[p.a].version + g->chart[p.b].version == p.versions)
			join(g, p.a < p.b ? p.a : p.b, p.a < p.b ? p.b : p.a);
	}
}

/* ---- seen from their directions ---- */

typedef struct flat {
	double x, y;
} flat;

/* Charts with their faces, and where the corners of these are in each. */
typedef struct sheet {
	size_t charts;
	size_t *start;  /* charts + 1: of each in face */
	uint32_t *face; /* nf */
	flat *at;       /* 3 nf, from (0, 0) on */
	flat *size;     /* of each chart */
} sheet;

static flat
turned(flat p, double angle)
{
	return (flat){ cos(angle) * p.x - sin(angle) * p.y, sin(angle) * p.x + cos(angle) * p.y };
}

/* The box of a chart's corners when it is turned; *low: its least corner. */
static flat
box_of(const sheet *s, size_t c, double angle, flat *low)
{
	flat high = { -INFINITY, -INFINITY };

	*low = (flat){ INFINITY, INFINITY };
	for (size_t i = 3 * s->start[c]; i < 3 * s->start[c + 1]; i++) {
		flat p = turned(s->at[3 * s->face[i / 3] + i % 3], angle);
		*low = (flat){ fmin(low->x, p.x), fmin(low->y, p.y) };
		high = (flat){ fmax(high.x, p.x), fmax(high.y, p.y) };
	}
	return (flat){ high.x - low->x, high.y - low->y };
}

/* A direction that turns with the chart: of its longest edge. */
static mr_v3
longest_edge(const mr_mesh *m, const sheet *s, size_t c)
{
	mr_v3 longest = { 0 };

	for (size_t i = 3 * s->start[c]; i < 3 * s->start[c + 1]; i++) {
		uint32_t h = 3 * s->face[i / 3] + (uint32_t)(i % 3);
		mr_v3 e = mr_sub(m->p[mr_he_to(m, h)], m->p[mr_he_from(m, h)]);
		longest = mr_norm2(e) > mr_norm2(longest) ? e : longest;
	}
	return longest;
}

/* Upright in the least box of some. */
static void
flatten_chart(const mr_mesh *m, sheet *s, size_t c, mr_v3 axis)
{
	mr_v3 x = longest_edge(m, s, c), y;
	double best = 0, least = INFINITY;
	flat low;

	x = mr_unit(mr_axpy(-mr_dot(x, axis), axis, x));
	y = mr_cross(axis, x);
	for (size_t i = 3 * s->start[c]; i < 3 * s->start[c + 1]; i++) {
		uint32_t h = 3 * s->face[i / 3] + (uint32_t)(i % 3);
		mr_v3 p = mr_sub(m->p[mr_he_from(m, h)], m->p[m->t[s->face[s->start[c]]].v[0]]);
		s->at[h] = (flat){ mr_dot(p, x), mr_dot(p, y) };
	}
	for (int k = 0; k < TURNS; k++) {
		flat size = box_of(s, c, MR_PI * k / TURNS, &low);
		if (size.x >= size.y && size.x * size.y < least) {
			least = size.x * size.y;
			best = MR_PI * k / TURNS;
		}
	}
	s->size[c] = box_of(s, c, best, &low);
	for (size_t i = 3 * s->start[c]; i < 3 * s->start[c + 1]; i++) {
		flat *p = &s->at[3 * s->face[i / 3] + i % 3];
		*p = turned(*p, best);
		*p = (flat){ p->x - low.x, p->y - low.y };
	}
}

static sheet
flatten(mr_ctx *ctx, const mr_mesh *m, uint32_t *set, const mr_v3 *axis)
{
	sheet s = { .face = MR_NEW(ctx, m->nf, uint32_t), .at = MR_NEW(ctx, 3 * m->nf, flat) };
	uint32_t *number = MR_NEW(ctx, m->nf, uint32_t);

	for (uint32_t f = 0; f < m->nf; f++)
		number[f] = mr_sets_root(set, f) == f ? (uint32_t)s.charts++ : number[mr_sets_root(set, f)];
	s.start = MR_NEW_ZERO(ctx, s.charts + 2, size_t);
	s.size = MR_NEW(ctx, s.charts, flat);
	for (size_t f = 0; f < m->nf; f++)
		s.start[number[f] + 2]++;
	for (size_t c = 1; c <= s.charts; c++)
		s.start[c + 1] += s.start[c];
	for (size_t f = 0; f < m->nf; f++)
		s.face[s.start[number[f] + 1]++] = (uint32_t)f;
	for (size_t c = 0; c < s.charts; c++)
		flatten_chart(m, &s, c, axis[s.face[s.start[c]]]);
	return s;
}

/* ---- where they lie ---- */

typedef struct packing {
	const sheet *s;
	const uint32_t *order;
	double side, gutter, scale;                 /* texels; texels a unit */
	double horizon[COLUMNS];                    /* how high charts reach in each column of texels */
	double low[COLUMNS + 1], high[COLUMNS + 1]; /* of the chart at work */
	flat *place;                                /* of each chart, in texels */
} packing;

/* What an edge is within the columns, each of them with the gutter. */
static void
add_edge(packing *k, flat a, flat b)
{
	double wide = k->side / COLUMNS, g = k->gutter;

	if (a.x > b.x) {
		flat swap = a;
		a = b;
		b = swap;
	}
	for (size_t c = (size_t)fmax((a.x - g) / wide, 0); c < COLUMNS && (double)c * wide <= b.x + g; c++) {
		double from = fmax((double)c * wide - g, a.x), to = fmin((double)(c + 1) * wide + g, b.x);
		double slope = b.x > a.x ? (b.y - a.y) / (b.x - a.x) : 0;
		double y0 = b.x > a.x ? a.y + slope * (from - a.x) : a.y,
		       y1 = b.x > a.x ? a.y + slope * (to - a.x) : b.y;
		k->low[c] = fmin(k->low[c], fmin(y0, y1) - g);
		k->high[c] = fmax(k->high[c], fmax(y0, y1) + g);
	}
}

/* The columns that a chart takes, with its gutter on both sides; COLUMNS + 1: too many. */
static size_t
outline(packing *k, size_t c)
{
	const sheet *s = k->s;
	size_t n = (size_t)ceil((s->size[c].x * k->scale + 2 * k->gutter) / (k->side / COLUMNS));

	if (n > COLUMNS)
		return COLUMNS + 1;
	for (size_t i = 0; i <= COLUMNS; i++) {
		k->low[i] = INFINITY;
		k->high[i] = -INFINITY;
	}
	for (size_t i = 3 * s->start[c]; i < 3 * s->start[c + 1]; i++) {
		uint32_t h = 3 * s->face[i / 3] + (uint32_t)(i % 3);
		flat a = s->at[h], b = s->at[mr_he_next(h)];
		add_edge(k, (flat){ a.x * k->scale + k->gutter, a.y * k->scale + k->gutter },
		    (flat){ b.x * k->scale + k->gutter, b.y * k->scale + k->gutter });
	}
	return n;
}

static bool
put_chart(packing *k, size_t c)
{
	double least = INFINITY;
	size_t n = outline(k, c), at = 0;

	for (size_t i = 0; i + n <= COLUMNS; i++) {
		double base = 0;
		for (size_t j = 0; j < n && base < least; j++)
			base = fmax(base, k->horizon[i + j] - k->low[j]);
		if (base < least) {
			least = base;
			at = i;
		}
	}
	if (!(least + k->s->size[c].y * k->scale + 2 * k->gutter <= k->side))
		return false;
	for (size_t j = 0; j < n; j++)
		k->horizon[at + j] = fmax(k->horizon[at + j], least + k->high[j]);
	k->place[c] = (flat){ (double)at * k->side / COLUMNS + k->gutter, least + k->gutter };
	return true;
}

static bool
pack_at(packing *k, double scale)
{
	k->scale = scale;
	memset(k->horizon, 0, sizeof k->horizon);
	for (size_t i = 0; i < k->s->charts; i++)
		if (!put_chart(k, k->order[i]))
			return false;
	return true;
}

/* The largest scale that fits. */
static bool
pack(packing *k, double area)
{
	double high = k->side / sqrt(area), low = high;

	for (int i = 0; !pack_at(k, low); i++) {
		high = low;
		low /= 1.5;
		if (i == 20)
			return false;
	}
	for (int i = 0; i < 6 && low < high; i++) {
		double middle = sqrt(low * high);
		if (pack_at(k, middle))
			low = middle;
		else
			high = middle;
	}
	return pack_at(k, low);
}

/* ---- all ---- */

static double
area_of(const flat *p)
{
	return fabs((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y)) / 2;
}

typedef struct ranked {
	double height;
	uint32_t chart;
} ranked;

static int
by_height(const void *a, const void *b)
{
	const ranked *p = a, *q = b;

	return p->height != q->height ? (p->height > q->height ? -1 : 1) : p->chart < q->chart ? -1 : 1;
}

static uint32_t *
find_order(mr_ctx *ctx, const sheet *s)
{
	uint32_t *order = MR_NEW(ctx, s->charts, uint32_t);
	ranked *r = MR_NEW(ctx, s->charts, ranked);

	for (size_t c = 0; c < s->charts; c++)
		r[c] = (ranked){ s->size[c].y, (uint32_t)c };
	qsort(r, s->charts, sizeof *r, by_height);
	for (size_t c = 0; c < s->charts; c++)
		order[c] = r[c].chart;
	return order;
}

/* Faces that lie on others of their chart, of which the lower goes. */
typedef struct shadow {
	const mr_mesh *m;
	const mr_v3 *axis;
	bool *under, any;
} shadow;

static double
height_of(const shadow *s, uint32_t f)
{
	const uint32_t *v = s->m->t[f].v;

	return mr_dot(s->axis[f], mr_mean3(s->m->p[v[0]], s->m->p[v[1]], s->m->p[v[2]]));
}

static void
mark_under(void *arg, uint32_t a, uint32_t b)
{
	shadow *s = arg;

	s->under[height_of(s, a) < height_of(s, b) ? a : b] = s->any = true;
}

/* The pieces of charts without what is under them, and of that. */
static void
part_charts(mr_ctx *ctx, const mr_mesh *m, const bool *under, uint32_t *set)
{
	uint32_t *before = MR_NEW(ctx, m->nf, uint32_t);
	mr_edges edges;

	for (uint32_t f = 0; f < m->nf; f++)
		before[f] = mr_sets_root(set, f);
	mr_sets_begin(set, m->nf);
	mr_edges_build(ctx, m, &edges);
	for (size_t e = 0; e < edges.count; e++)
		for (size_t i = edges.start[e]; i + 1 < edges.start[e + 1]; i++) {
			uint32_t a = edges.he[i] / 3, b = edges.he[i + 1] / 3;
			if (before[a] == before[b] && under[a] == under[b])
				mr_sets_join(set, a, b);
		}
}

/* Texture coordinates of the charts as they are. */
static mr_status
lay_out(
    mr_ctx *ctx, const mr_mesh *m, uint32_t *set, const mr_v3 *axis, packing *k, double *uv, size_t *count)
{
	double area = 0;
	sheet *s = MR_NEW(ctx, 1, sheet);

	*s = flatten(ctx, m, set, axis);
	for (size_t f = 0; f < m->nf; f++)
		area += area_of(s->at + 3 * f);
	k->s = s;
	k->order = find_order(ctx, s);
	k->place = MR_NEW(ctx, s->charts, flat);
	if (!(area > 0) || !pack(k, area))
		return mr_fail(ctx, MR_ERANGE, "%zu charts with a gutter of %g have no room in %gx%g texels",
		    s->charts, k->gutter, k->side, k->side);
	for (size_t c = 0; c < s->charts; c++)
		for (size_t i = 3 * s->start[c]; i < 3 * s->start[c + 1]; i++) {
			uint32_t h = 3 * s->face[i / 3] + (uint32_t)(i % 3);
			uv[2 * h] = (k->place[c].x + k->scale * s->at[h].x) / k->side;
			uv[2 * h + 1] = (k->place[c].y + k->scale * s->at[h].y) / k->side;
		}
	*count = s->charts;
	return MR_OK;
}

mr_status
mr_charts(mr_ctx *ctx, const mr_mesh *m, size_t side, size_t gutter, double **uv, size_t *count)
{
	double *made = MR_NEW(ctx, 6 * m->nf, double);
	growth g = { .ctx = ctx };
	mr_v3 *axis;
	MR_SCOPE(ctx);

	g.chart = MR_NEW(ctx, m->nf, chart);
	g.set = mr_sets_new(ctx, m->nf);
	grow_charts(&g, m);
	axis = MR_NEW(ctx, m->nf, mr_v3);
	for (uint32_t f = 0; f < m->nf; f++)
		axis[f] = g.chart[mr_sets_root(g.set, f)].normals.axis;
	for (bool again = true; again;) {
		packing k = { .side = (double)side, .gutter = (double)gutter };
		shadow s = { m, axis, MR_NEW_ZERO(ctx, m->nf, bool), false };
		MR_TRY(lay_out(ctx, m, g.set, axis, &k, made, count));
		mr_texture_overlap(ctx, m->nf, made, side, mark_under, &s);
		again = s.any;
		if (again)
			part_charts(ctx, m, s.under, g.set);
	}
	*uv = made;
	return MR_OK;
}
