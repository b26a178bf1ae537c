/* Boundary loops by a walk along them; Liepa 2003: Filling holes in meshes, section 3. */
#include "mesh/loops.h"

#include "mesh/edges.h"

/* ---- loops ---- */

/* The half-edges of boundary edges, in lists by their start. */
typedef struct rims {
	uint32_t *first; /* of each vertex the first that is left, MR_NONE: none */
	uint32_t *next;  /* of each half-edge */
	uint32_t *at;    /* of each vertex its place on the path, MR_NONE: not on it */
	uint32_t *path;
	size_t n;
} rims;

static void
list_rims(mr_ctx *ctx, const mr_mesh *m, rims *r)
{
	mr_edges edges;
	size_t n = 0;

	mr_edges_build(ctx, m, &edges);
	r->first = MR_NEW(ctx, m->nv, uint32_t);
	r->at = MR_NEW(ctx, m->nv, uint32_t);
	r->next = MR_NEW(ctx, 3 * m->nf, uint32_t);
	memset(r->first, 0xff, m->nv * sizeof *r->first);
	memset(r->at, 0xff, m->nv * sizeof *r->at);
	for (size_t e = edges.count; e-- > 0;) {
		uint32_t h = edges.he[edges.start[e]], v = mr_he_from(m, h);
		if (mr_edge_faces(&edges, e) != 1)
			continue;
		r->next[h] = r->first[v];
		r->first[v] = h;
		n++;
	}
	r->path = MR_NEW(ctx, n + 1, uint32_t);
}

/* The path has returned to its vertex k: takes what lies between as a loop. */
static void
close_loop(const mr_mesh *m, rims *r, size_t k, mr_loops *out)
{
	size_t at = out->start[out->count];

	for (size_t i = k; i < r->n; i++) {
		r->at[mr_he_from(m, r->path[i])] = MR_NONE;
		out->he[at++] = r->path[i];
	}
	out->start[++out->count] = at;
	r->n = k;
}

/* Walks from v until no boundary leaves; whatever comes back to itself is cut off as a loop. */
static void
walk(const mr_mesh *m, rims *r, uint32_t v, mr_loops *out)
{
	for (uint32_t h = r->first[v]; h != MR_NONE; h = r->first[v]) {
		r->first[v] = r->next[h];
		r->at[v] = (uint32_t)r->n;
		r->path[r->n++] = h;
		v = mr_he_to(m, h);
		if (r->at[v] != MR_NONE)
			close_loop(m, r, r->at[v], out);
	}
	out->broken += r->n;
	while (r->n > 0)
		r->at[mr_he_from(m, r->path[--r->n])] = MR_NONE;
}

void
mr_loops_find(mr_ctx *ctx, const mr_mesh *m, mr_loops *loops)
{
	size_t n = 0;
	rims r = { 0 };

	list_rims(ctx, m, &r);
	for (size_t v = 0; v < m->nv; v++)
		for (uint32_t h = r.first[v]; h != MR_NONE; h = r.next[h])
			n++;
	*loops = (mr_loops){ .start = MR_NEW_ZERO(ctx, n + 1, size_t), .he = MR_NEW(ctx, n, uint32_t) };
	for (uint32_t v = 0; v < m->nv; v++)
		while (r.first[v] != MR_NONE)
			walk(m, &r, v, loops);
}

/* ---- spans ---- */

enum { MOST = 256 };

/* The cost of triangles that span corners i to j: the largest angle, as minus its cosine, then the area. */
typedef struct cost {
	double bend, area;
	uint32_t apex;
} cost;

typedef struct span {
	mr_ctx *ctx;
	const mr_v3 *p, *beside;
	bool (*taken)(const void *arg, uint32_t i, uint32_t j);
	const void *arg;
	size_t all;
	const uint32_t *corner; /* of the polygon at hand: n of all */
	size_t n;
	cost *cost; /* n x n */
	mr_tri *t;
	size_t count;
} span;

static mr_v3
normal_of(const span *s, size_t i, size_t j, size_t apex)
{
	mr_v3 p = s->p[s->corner[i]];

	return mr_cross(mr_sub(s->p[s->corner[j]], p), mr_sub(s->p[s->corner[apex]], p));
}

/* The normal beyond the edge between corners i and j: of the triangle chosen there, or the surface. */
static mr_v3
normal_beyond(const span *s, size_t i, size_t j)
{
	uint32_t a = s->corner[i], b = s->corner[i + 1 == s->n ? 0 : i + 1];

	if (j > i + 1)
		return normal_of(s, i, j, s->cost[i * s->n + j].apex);
	return b == (a + 1) % s->all ? s->beside[a] : mr_vec(0, 0, 0);
}

static double
bend_of(mr_v3 m, mr_v3 n)
{
	double mn = sqrt(mr_norm2(m) * mr_norm2(n));

	return mn > 0 ? -mr_dot(m, n) / mn : -1;
}

/* The cost of triangle (i, j, apex) and of the triangles beyond its sides. */
static cost
cost_with(const span *s, size_t i, size_t j, size_t apex)
{
	const cost *left = &s->cost[i * s->n + apex], *right = &s->cost[apex * s->n + j];
	mr_v3 n = normal_of(s, i, j, apex);
	double area = mr_norm(n), bend = fmax(left->bend, right->bend);

	bend = fmax(bend, bend_of(n, normal_beyond(s, i, apex)));
	bend = fmax(bend, bend_of(n, normal_beyond(s, apex, j)));
	if (i == 0 && j + 1 == s->n)
		bend = fmax(bend, bend_of(n, normal_beyond(s, j, j)));
	if (!(area > 0))
		bend = 1;
	return (cost){ bend, area + left->area + right->area, (uint32_t)apex };
}

static void
choose(const span *s, size_t i, size_t j)
{
	cost best = { INFINITY, INFINITY, 0 };
	bool chord = i > 0 || j + 1 < s->n;

	for (size_t k = i + 1; k < j; k++) {
		cost c = cost_with(s, i, j, k);
		if (c.bend < best.bend || (c.bend == best.bend && c.area < best.area))
			best = c;
	}
	if (chord && s->taken(s->arg, s->corner[i], s->corner[j]))
		best.bend = 2;
	s->cost[i * s->n + j] = best;
}

static void
emit(span *s, size_t i, size_t j)
{
	size_t k = s->cost[i * s->n + j].apex;

	if (j < i + 2)
		return;
	s->t[s->count++] = (mr_tri){ { s->corner[i], s->corner[j], s->corner[k] } };
	emit(s, i, k);
	emit(s, k, j);
}

/* The least cost of every part, short ones first. */
static void
span_corners(span *s, const uint32_t *corner, size_t n)
{
	mr_mark mark = mr_mark_take(s->ctx);

	s->corner = corner;
	s->n = n;
	s->cost = MR_NEW(s->ctx, n * n, cost);
	for (size_t i = 0; i + 1 < n; i++)
		s->cost[i * n + i + 1] = (cost){ -1, 0, 0 };
	for (size_t length = 2; length < n; length++)
		for (size_t i = 0; i + length < n; i++)
			choose(s, i, i + length);
	emit(s, 0, n - 1);
	s->corner = NULL;
	mr_mark_release(s->ctx, mark);
}

/* Triangles of n corners: as many as it takes at equal strides, then those between two of these. */
static void
span_strides(span *s, const uint32_t *corner, size_t n)
{
	uint32_t some[MOST];
	size_t count = n < MOST ? n : MOST;

	if (n < 3)
		return;
	for (size_t i = 0; i < count; i++)
		some[i] = corner[i * (n - 1) / (count - 1)];
	span_corners(s, some, count);
	for (size_t i = 0; i + 1 < count; i++) {
		size_t a = i * (n - 1) / (count - 1), b = (i + 1) * (n - 1) / (count - 1);
		span_strides(s, corner + a, b - a + 1);
	}
}

void
mr_span(mr_ctx *ctx, const mr_v3 *p, const mr_v3 *beside, size_t n,
    bool (*taken)(const void *arg, uint32_t i, uint32_t j), const void *arg, mr_tri *t)
{
	mr_mark mark = mr_mark_take(ctx);
	span s = { .ctx = ctx, .p = p, .beside = beside, .all = n, .taken = taken, .arg = arg, .t = t };
	uint32_t *corner = MR_NEW(ctx, n, uint32_t);

	for (size_t i = 0; i < n; i++)
		corner[i] = (uint32_t)i;
	span_strides(&s, corner, n);
	mr_mark_release(ctx, mark);
}
