/* A chart is the faces around a first one whose normals are within 60 degrees of their mean.  Charts go where
 * they lie lowest on those before, the highest first (Levy and others 2002, "Least squares conformal maps").
 * */
#include "render/charts.h"

#include "mesh/edges.h"
#include "render/bake.h"

/* At least so many charts: larger ones are concave, and leave more of the texture empty. */
enum { CHARTS = 16, COLUMNS = 512 };

typedef struct flat {
	double x, y;
} flat;

typedef struct chart {
	size_t begin, end; /* its faces */
	mr_v3 axis;
	flat size, place; /* place: in texels */
} chart;

typedef struct sheet {
	mr_ctx *ctx;
	const mr_mesh *m;
	const uint32_t *across; /* of each half-edge another one of the edge, in turn */
	uint32_t *of, *face;    /* the chart of each face; the faces of the charts, one after another */
	chart *chart;
	size_t charts, room;
	double most; /* a chart is full with twice this area */
	flat *at;    /* of each corner, from (0, 0) of its chart on */
} sheet;

/* ---- charts ---- */

static uint32_t *
find_across(mr_ctx *ctx, const mr_mesh *m)
{
	uint32_t *across = MR_NEW(ctx, 3 * m->nf, uint32_t);
	mr_edges edges;

	for (uint32_t h = 0; h < 3 * m->nf; h++)
		across[h] = h;
	mr_edges_build(ctx, m, &edges);
	for (size_t e = 0; e < edges.count; e++)
		for (size_t i = edges.start[e], end = edges.start[e + 1]; i < end; i++)
			across[edges.he[i]] = edges.he[i + 1 < end ? i + 1 : edges.start[e]];
	return across;
}

/* Takes the faces around the chart's first, of its group and near its axis; the sum of their normals. */
static mr_v3
flood(sheet *s, chart *c, const uint32_t *group)
{
	mr_v3 sum = mr_face_cross(s->m, s->face[c->begin]);
	double area = mr_norm(sum);

	c->end = c->begin + 1;
	s->of[s->face[c->begin]] = (uint32_t)s->charts;
	for (size_t i = c->begin; i < c->end && area < s->most; i++)
		for (uint32_t h = 3 * s->face[i]; h < 3 * s->face[i] + 3; h++) {
			uint32_t f = s->across[h] / 3;
			mr_v3 n = mr_face_cross(s->m, f);
			if (s->of[f] != MR_NONE || group[f] != group[h / 3] ||
			    mr_dot(n, c->axis) < 0.5 * mr_norm(n))
				continue;
			s->of[f] = (uint32_t)s->charts;
			s->face[c->end++] = f;
			sum = mr_add(sum, n);
			area += mr_norm(n);
		}
	return sum;
}

/* Charts of faces of one group each; before: parts of these, with their axes; NULL: new ones. */
static void
grow_charts(sheet *s, const uint32_t *group, const chart *before)
{
	size_t n = 0;

	memset(s->of, 0xff, s->m->nf * sizeof *s->of);
	s->charts = 0;
	for (uint32_t f = 0; f < s->m->nf; f++) {
		chart c = { .begin = n, .axis = mr_unit(mr_face_cross(s->m, f)) };
		if (s->of[f] != MR_NONE)
			continue;
		s->face[n] = f;
		if (before) {
			c.axis = before[group[f] / 2].axis;
		} else {
			c.axis = mr_unit(flood(s, &c, group));
			for (size_t i = c.begin; i < c.end; i++)
				s->of[s->face[i]] = MR_NONE;
		}
		flood(s, &c, group);
		n = c.end;
		MR_RESERVE(s->ctx, s->chart, s->charts, 1, &s->room);
		s->chart[s->charts++] = c;
	}
}

/* ---- seen from their directions ---- */

static flat
turned(flat p, double angle)
{
	return (flat){ cos(angle) * p.x - sin(angle) * p.y, sin(angle) * p.x + cos(angle) * p.y };
}

/* Lying along its principal axis. */
static void
flatten(const sheet *s, chart *c)
{
	const mr_mesh *m = s->m;
	mr_v3 from = m->p[m->t[s->face[c->begin]].v[0]], middle = { 0 };
	mr_v3 x = mr_unit(mr_cross(fabs(c->axis.x) < 0.7 ? mr_vec(1, 0, 0) : mr_vec(0, 1, 0), c->axis));
	mr_v3 y = mr_cross(c->axis, x);
	double xx = 0, xy = 0, yy = 0, angle;
	flat low = { INFINITY, INFINITY }, high = { -INFINITY, -INFINITY };

	for (size_t i = 3 * c->begin; i < 3 * c->end; i++)
		middle = mr_axpy(1 / (3.0 * (double)(c->end - c->begin)),
		    mr_sub(m->p[m->t[s->face[i / 3]].v[i % 3]], from), middle);
	for (size_t i = 3 * c->begin; i < 3 * c->end; i++) {
		mr_v3 p = mr_sub(mr_sub(m->p[m->t[s->face[i / 3]].v[i % 3]], from), middle);
		flat *at = &s->at[3 * s->face[i / 3] + i % 3];
		*at = (flat){ mr_dot(p, x), mr_dot(p, y) };
		xx += at->x * at->x;
		xy += at->x * at->y;
		yy += at->y * at->y;
	}
	angle = -0.5 * atan2(2 * xy, xx - yy);
	for (size_t i = 3 * c->begin; i < 3 * c->end; i++) {
		flat *at = &s->at[3 * s->face[i / 3] + i % 3];
		*at = turned(*at, angle);
		low = (flat){ fmin(low.x, at->x), fmin(low.y, at->y) };
		high = (flat){ fmax(high.x, at->x), fmax(high.y, at->y) };
	}
	c->size = (flat){ high.x - low.x, high.y - low.y };
	for (size_t i = 3 * c->begin; i < 3 * c->end; i++) {
		flat *at = &s->at[3 * s->face[i / 3] + i % 3];
		*at = (flat){ at->x - low.x, at->y - low.y };
	}
}

/* ---- where they lie ---- */

static int
by_height(const void *a, const void *b)
{
	const chart *c = a, *d = b;

	return c->size.y != d->size.y ? (c->size.y > d->size.y ? -1 : 1) : c->begin < d->begin ? -1 : 1;
}

typedef struct packing {
	double side, gutter, scale;         /* texels; texels a unit */
	double horizon[COLUMNS];            /* how high charts reach in each column of texels */
	double low[COLUMNS], high[COLUMNS]; /* of the chart at work */
} packing;

/* How low and high an edge is in the columns, each of them with the gutter. */
static void
add_edge(packing *k, flat a, flat b)
{
	double wide = k->side / COLUMNS, g = k->gutter, slope = b.x > a.x ? (b.y - a.y) / (b.x - a.x) : 0;

	for (size_t c = (size_t)fmax((a.x - g) / wide, 0); c < COLUMNS && (double)c * wide <= b.x + g; c++) {
		double from = fmax((double)c * wide - g, a.x), to = fmin((double)(c + 1) * wide + g, b.x);
		double y0 = a.y + slope * (from - a.x), y1 = b.y - slope * (b.x - to);
		k->low[c] = fmin(k->low[c], fmin(y0, y1) - g);
		k->high[c] = fmax(k->high[c], fmax(y0, y1) + g);
	}
}

static void
outline(const sheet *s, const chart *c, packing *k)
{
	for (size_t i = 0; i < COLUMNS; i++) {
		k->low[i] = INFINITY;
		k->high[i] = -INFINITY;
	}
	for (size_t i = 3 * c->begin; i < 3 * c->end; i++) {
		uint32_t h = 3 * s->face[i / 3] + (uint32_t)(i % 3), next = mr_he_next(h);
		bool turn = s->at[h].x > s->at[next].x;
		flat a = s->at[turn ? next : h], b = s->at[turn ? h : next];
		add_edge(k, (flat){ a.x * k->scale + k->gutter, a.y * k->scale + k->gutter },
		    (flat){ b.x * k->scale + k->gutter, b.y * k->scale + k->gutter });
	}
}

/* Puts a chart where it lies lowest; false: there is no room. */
static bool
put(const sheet *s, chart *c, packing *k)
{
	double least = INFINITY, wide = ceil((c->size.x * k->scale + 2 * k->gutter) / (k->side / COLUMNS));
	size_t n = (size_t)fmin(wide, COLUMNS + 1), at = 0;

	outline(s, c, k);
	for (size_t i = 0; i + n <= COLUMNS; i++) {
		double base = 0;
		for (size_t j = 0; j < n && base < least; j++)
			base = fmax(base, k->horizon[i + j] - k->low[j]);
		at = base < least ? i : at;
		least = fmin(least, base);
	}
	if (!(least + c->size.y * k->scale + 2 * k->gutter <= k->side))
		return false;
	for (size_t j = 0; j < n; j++)
		k->horizon[at + j] = fmax(k->horizon[at + j], least + k->high[j]);
	c->place = (flat){ (double)at * k->side / COLUMNS + k->gutter, least + k->gutter };
	return true;
}

static bool
pack_at(const sheet *s, packing *k, double scale)
{
	size_t c = 0;

	k->scale = scale;
	memset(k->horizon, 0, sizeof k->horizon);
	while (c < s->charts && put(s, &s->chart[c], k))
		c++;
	return c == s->charts;
}

/* Texture coordinates of the charts at the largest scale that fits. */
static mr_status
lay_out(sheet *s, packing *k, double *uv)
{
	double low, high, area = 0;

	for (chart *c = s->chart; c < s->chart + s->charts; c++) {
		flatten(s, c);
		area += c->size.x * c->size.y;
	}
	if (s->charts > 0)
		qsort(s->chart, s->charts, sizeof *s->chart, by_height);
	low = high = 2 * k->side / sqrt(area);
	for (int i = 0; !pack_at(s, k, low); high = low, low /= 1.5)
		if (i++ == 20)
			return mr_fail(s->ctx, MR_ERANGE,
			    "%zu charts with a gutter of %g have no room in %gx%g texels", s->charts,
			    k->gutter, k->side, k->side);
	for (int i = 0; i < 6; i++) {
		double middle = sqrt(low * high);
		*(pack_at(s, k, middle) ? &low : &high) = middle;
	}
	pack_at(s, k, low);
	for (const chart *c = s->chart; c < s->chart + s->charts; c++)
		for (size_t i = 3 * c->begin; i < 3 * c->end; i++) {
			size_t h = 3 * s->face[i / 3] + i % 3;
			uv[2 * h] = (c->place.x + low * s->at[h].x) / k->side;
			uv[2 * h + 1] = (c->place.y + low * s->at[h].y) / k->side;
		}
	return MR_OK;
}

/* ---- all ---- */

typedef struct shadow {
	uint32_t *group;
	bool any;
} shadow;

/* If two faces of a chart overlap, the second leaves it. */
static void
part(void *arg, uint32_t a, uint32_t b)
{
	shadow *s = arg;

	(void)a;
	s->group[b] |= 1;
	s->any = true;
}

mr_status
mr_charts(mr_ctx *ctx, const mr_mesh *m, size_t side, size_t gutter, double **uv, size_t *count)
{
	double *made = MR_NEW(ctx, 6 * m->nf, double);
	MR_SCOPE(ctx);
	packing k = { .side = (double)side, .gutter = (double)gutter };
	sheet s = { .ctx = ctx, .m = m, .across = find_across(ctx, m) };
	shadow under = { MR_NEW_ZERO(ctx, m->nf, uint32_t), false };
	chart *before = NULL;

	s.most = 2 * mr_mesh_area(ctx, m) / CHARTS;
	s.of = MR_NEW(ctx, m->nf, uint32_t);
	s.face = MR_NEW(ctx, m->nf, uint32_t);
	s.at = MR_NEW(ctx, 3 * m->nf, flat);
	do {
		grow_charts(&s, under.group, before);
		MR_TRY(lay_out(&s, &k, made));
		before = MR_NEW(ctx, s.charts, chart);
		memcpy(before, s.chart, s.charts * sizeof *before);
		for (size_t c = 0; c < s.charts; c++)
			for (size_t i = before[c].begin; i < before[c].end; i++)
				under.group[s.face[i]] = (uint32_t)(2 * c);
		under.any = false;
		mr_texture_overlap(ctx, m->nf, made, side, part, &under);
	} while (under.any);
	*uv = made;
	*count = s.charts;
	return MR_OK;
}
