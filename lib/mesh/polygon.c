/* Ear clipping (Meisters 1975, Polygons have ears; Eberly): only reflex corners can lie in an ear.  The
 * polygon is seen along the axis nearest to its Newell normal: coordinates are dropped, so that rounding
 * spoils no sign. */
#include "mesh/polygon.h"

typedef struct point {
	double x, y;
} point;

typedef struct polygon {
	const uint32_t *corner;
	size_t n;
	point *q;              /* projected, counter-clockwise */
	uint32_t *next, *prev; /* of the corners not clipped yet */
	uint32_t *queue;       /* 3 n: corners to try */
	bool *clipped;
	bool *reflex;        /* reflex or straight, and not clipped */
	uint32_t *reflex_at; /* those that were in the beginning */
	size_t reflexes;
} polygon;

/* Twice the signed area of a b c. */
static double
cross(point a, point b, point c)
{
	return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/* The sum of cross products of successive corners, seen from the first: twice area times normal. */
static mr_v3
newell(const mr_v3 *p, const uint32_t *corner, size_t n)
{
	mr_v3 sum = { 0, 0, 0 }, o = p[corner[0]];

	for (size_t i = 1; i + 1 < n; i++)
		sum = mr_add(sum, mr_cross(mr_sub(p[corner[i]], o), mr_sub(p[corner[i + 1]], o)));
	return sum;
}

/* Drops the coordinate along which the normal is longest, keeping the polygon counter-clockwise. */
static void
project(polygon *g, const mr_v3 *p, mr_v3 normal)
{
	double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);

	for (size_t i = 0; i < g->n; i++) {
		mr_v3 a = p[g->corner[i]];
		double s = a.x, t = a.y;
		bool flip = normal.z < 0;
		if (x > y && x > z) {
			s = a.y, t = a.z;
			flip = normal.x < 0;
		} else if (y > z) {
			s = a.z, t = a.x;
			flip = normal.y < 0;
		}
		g->q[i] = flip ? (point){ t, s } : (point){ s, t };
	}
}

static void
emit(mr_tri *t, size_t i, size_t j, size_t k)
{
	*t = (mr_tri){ { (uint32_t)i, (uint32_t)j, (uint32_t)k } };
}

static void
fan(const polygon *g, size_t first, mr_tri *t)
{
	for (size_t i = 1; i + 1 < g->n; i++)
		emit(t++, first, (first + i) % g->n, (first + i + 1) % g->n);
}

/* The first corner whose fan has triangles of positive area only, all corners being convex; else n. */
static size_t
fan_corner(const polygon *g)
{
	size_t n = g->n;

	for (size_t i = 0; i < n; i++)
		if (cross(g->q[i], g->q[(i + 1) % n], g->q[(i + 2) % n]) < 0)
			return n;
	for (size_t first = 0; first < n && first < 4; first++) {
		size_t i = 1;
		while (i + 1 < n && cross(g->q[first], g->q[(first + i) % n], g->q[(first + i + 1) % n]) > 0)
			i++;
		if (i + 1 == n)
			return first;
	}
	return n;
}

static bool
same(point a, point b)
{
	return a.x == b.x && a.y == b.y;
}

/* True where a reflex corner lies in the closed triangle, other than at its corners. */
static bool
holds_corner(const polygon *g, point a, point b, point c)
{
	for (size_t i = 0; i < g->reflexes; i++) {
		point q = g->q[g->reflex_at[i]];
		if (g->reflex[g->reflex_at[i]] && cross(a, b, q) >= 0 && cross(b, c, q) >= 0 &&
		    cross(c, a, q) >= 0 && !same(q, a) && !same(q, b) && !same(q, c))
			return true;
	}
	return false;
}

static bool
is_ear(const polygon *g, size_t i)
{
	point a = g->q[g->prev[i]], b = g->q[i], c = g->q[g->next[i]];

	return cross(a, b, c) > 0 && !holds_corner(g, a, b, c);
}

static void
clip(polygon *g, size_t i, mr_tri *t)
{
	uint32_t a = g->prev[i], c = g->next[i];

	emit(t, a, i, c);
	g->next[a] = c;
	g->prev[c] = a;
	g->reflex[i] = false;
	g->clipped[i] = true;
	if (g->reflex[a])
		g->reflex[a] = cross(g->q[g->prev[a]], g->q[a], g->q[c]) <= 0;
	if (g->reflex[c])
		g->reflex[c] = cross(g->q[a], g->q[c], g->q[g->next[c]]) <= 0;
}

/* Clips ears in turn; the two neighbours of a clipped one line up again.  If no ear is left, because the
 * polygon is not simple or rounding hides one, the next corner goes. */
static void
clip_ears(polygon *g, mr_tri *t)
{
	size_t i = 0, at = 0, waiting = g->n;

	for (size_t k = 0; k < g->n; k++)
		g->queue[k] = (uint32_t)k;
	for (size_t left = g->n; left > 3; left--) {
		while (at < waiting && (g->clipped[g->queue[at]] || !is_ear(g, g->queue[at])))
			at++;
		if (at < waiting)
			i = g->queue[at++];
		g->queue[waiting++] = g->prev[i];
		g->queue[waiting++] = g->next[i];
		clip(g, i, t++);
		i = g->next[i];
	}
	emit(t, g->prev[i], i, g->next[i]);
}

static void
ears(mr_ctx *ctx, polygon *g, mr_tri *t)
{
	size_t n = g->n;

	g->next = MR_NEW(ctx, n, uint32_t);
	g->prev = MR_NEW(ctx, n, uint32_t);
	g->queue = MR_NEW(ctx, 3 * n, uint32_t);
	g->clipped = MR_NEW_ZERO(ctx, n, bool);
	g->reflex = MR_NEW(ctx, n, bool);
	g->reflex_at = MR_NEW(ctx, n, uint32_t);
	for (size_t i = 0; i < n; i++) {
		g->next[i] = (uint32_t)((i + 1) % n);
		g->prev[i] = (uint32_t)((i + n - 1) % n);
		g->reflex[i] = cross(g->q[(i + n - 1) % n], g->q[i], g->q[(i + 1) % n]) <= 0;
		if (g->reflex[i])
			g->reflex_at[g->reflexes++] = (uint32_t)i;
	}
	clip_ears(g, t);
}

/* The triangle with the edge from 0 to 1 comes first: there mr_polygons_find begins, too. */
static void
put_first(mr_tri *t, size_t n)
{
	for (size_t i = 0; i < n; i++)
		for (int k = 0; k < 3; k++) {
			mr_tri first = { { t[i].v[k], t[i].v[(k + 1) % 3], t[i].v[(k + 2) % 3] } };
			if (first.v[0] != 0 || first.v[1] != 1)
				continue;
			t[i] = t[0];
			t[0] = first;
			return;
		}
}

void
mr_polygon_triangulate(mr_ctx *ctx, const mr_v3 *p, const uint32_t *corner, size_t n, mr_tri *t)
{
	point small[32];
	polygon g = { .corner = corner, .n = n, .q = small };
	MR_SCOPE(ctx);
	mr_v3 normal = newell(p, corner, n);
	size_t first;

	if (n > sizeof small / sizeof *small)
		g.q = MR_NEW(ctx, n, point);
	project(&g, p, normal);
	first = mr_norm2(normal) > 0 ? fan_corner(&g) : 0;
	if (first < n)
		fan(&g, first, t);
	else
		ears(ctx, &g, t);
	put_first(t, n - 2);
}

/* ---- triangles back to polygons ---- */

/* Whether no half-edge of triangles first to end runs against h. */
static bool
is_outer(const mr_mesh *m, size_t first, size_t end, uint32_t h)
{
	for (uint32_t k = (uint32_t)(3 * first); k < 3 * end; k++)
		if (mr_he_from(m, k) == mr_he_to(m, h) && mr_he_to(m, k) == mr_he_from(m, h))
			return false;
	return true;
}

/* The edge of the outline that begins at a vertex; MR_NONE where it is not exactly one. */
static uint32_t
outer_from(const mr_mesh *m, size_t first, size_t end, uint32_t vertex)
{
	uint32_t found = MR_NONE;

	for (uint32_t h = (uint32_t)(3 * first); h < 3 * end; h++) {
		if (mr_he_from(m, h) != vertex || !is_outer(m, first, end, h))
			continue;
		if (found != MR_NONE)
			return MR_NONE;
		found = h;
	}
	return found;
}

/* The outline of triangles first to end, where it is one loop with all their corners; else false. */
static bool
find_outline(const mr_mesh *m, size_t first, size_t end, uint32_t *corner)
{
	size_t count = 0, corners = end - first + 2;
	uint32_t h = (uint32_t)(3 * first), at;

	while (h < 3 * end && !is_outer(m, first, end, h))
		h++;
	if (h == 3 * end)
		return false;
	at = h;
	do {
		corner[count++] = at;
		at = outer_from(m, first, end, mr_he_to(m, at));
	} while (at != h && at != MR_NONE && count < corners);
	return at == h && count == corners;
}

void
mr_polygons_find(mr_ctx *ctx, const mr_tri *t, size_t nf, const uint32_t *number, mr_polygons *out)
{
	const mr_mesh m = { .t = t, .nf = nf };
	mr_polygons r = { 0 };
	size_t n = 0;

	if (!number) {
		*out = (mr_polygons){ .count = nf, .most = 3 };
		return;
	}
	r.start = MR_NEW(ctx, nf + 1, size_t);
	r.corner = MR_NEW(ctx, 3 * nf, uint32_t);
	for (size_t f = 0, end; f < nf; f = end) {
		bool one;
		for (end = f + 1; end < nf && number[end] == number[f]; end++)
			;
		one = end - f > 1 && find_outline(&m, f, end, r.corner + n);
		r.broken += end - f > 1 && !one;
		for (size_t i = f; i < (one ? f + 1 : end); i++) {
			size_t corners = one ? end - f + 2 : 3;
			r.start[r.count++] = n;
			for (size_t k = 0; !one && k < 3; k++)
				r.corner[n + k] = (uint32_t)(3 * i + k);
			n += corners;
			r.most = corners > r.most ? corners : r.most;
		}
	}
	r.start[r.count] = n;
	*out = r;
}
