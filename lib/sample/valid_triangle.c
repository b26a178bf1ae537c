/* Jeong, Kim 2001: Direct reconstruction of displaced subdivision surface from unorganized points,
 * section 5. */
#include "base/parallel.h"
#include "sample/parts.h"

enum { CHUNK = 1 << 12, GRAIN = 256, FIRST = 12 };

/* Two unit vectors across n, so that (a, b, n) is right-handed (Duff et al. 2017). */
static void
across(mr_v3 n, mr_v3 *a, mr_v3 *b)
{
	double s = copysign(1, n.z), u = -1 / (s + n.z), w = n.x * n.y * u;

	*a = mr_vec(1 + s * n.x * n.x * u, s * w, -s * n.x);
	*b = mr_vec(w, s + n.y * n.y * u, -n.y);
}

static bool
farther(const mr_sight *a, const mr_sight *b)
{
	return a->d2 != b->d2 ? a->d2 > b->d2 : a->index > b->index;
}

size_t
mr_sights(const mr_v3 *point, const uint32_t *index, size_t k, mr_v3 v, mr_v3 n, mr_sight *s)
{
	size_t count = 0;
	mr_v3 a, b;

	across(n, &a, &b);
	for (size_t i = 0; i < k && index[i] != MR_NONE; i++) {
		mr_v3 r = mr_sub(point[index[i]], v);
		mr_sight x = { mr_dot(r, a), mr_dot(r, b), mr_dot(r, n), 0, index[i] };
		size_t j = count++;
		x.d2 = x.x * x.x + x.y * x.y;
		for (; j > 0 && farther(&s[j - 1], &x); j--)
			s[j] = s[j - 1];
		s[j] = x;
	}
	return count;
}

static double
cross(const mr_sight *a, const mr_sight *b)
{
	return a->x * b->y - a->y * b->x;
}

static double
dist2(const mr_sight *a, const mr_sight *b)
{
	double x = a->x - b->x, y = a->y - b->y, t = a->t - b->t;

	return x * x + y * y + t * t;
}

/* Twice the area in space of the triangle. */
static double
area_of(const mr_sight *a, const mr_sight *b, const mr_sight *c)
{
	return mr_norm(mr_cross(
	    mr_vec(b->x - a->x, b->y - a->y, b->t - a->t), mr_vec(c->x - a->x, c->y - a->y, c->t - a->t)));
}

/* Takes the triangle a b c, which the line meets with the weights w (of sum `sum`, twice its area across the
 * line), if it is the smallest so far within the bounds. */
static void
consider(const mr_sight *a, const mr_sight *b, const mr_sight *c, const double w[3], const mr_bounds *bounds,
    mr_valid *v)
{
	double sum = w[0] + w[1] + w[2], area;
	double height = (w[0] * a->t + w[1] * b->t + w[2] * c->t) / sum;

	if (fabs(height) > bounds->height || dist2(a, b) > bounds->edge2 || dist2(b, c) > bounds->edge2 ||
	    dist2(c, a) > bounds->edge2)
		return;
	area = area_of(a, b, c) / 2;
	if ((v->taken && area >= v->area) || sum < 2 * area * bounds->cosine)
		return;
	v->taken = true;
	v->area = area;
	v->height = height;
}

/* All triangles that point m completes with those before it. */
static void
complete(const mr_sight *s, size_t m, const mr_bounds *bounds, mr_valid *v)
{
	double c[MR_SAMPLE_MOST];
	uint8_t left[MR_SAMPLE_MOST];
	size_t n = 0;

	for (size_t i = 0; i < m; i++) {
		c[i] = cross(&s[i], &s[m]);
		if (!(c[i] < 0))
			left[n++] = (uint8_t)i;
	}
	for (size_t a = 0; a < m; a++) {
		if (c[a] > 0)
			continue;
		for (size_t i = 0; i < n; i++) {
			/* the line, at the origin, is left of a b, of b m and of m a */
			size_t b = left[i];
			double ab = cross(&s[a], &s[b]);
			if (b == a || !(ab >= 0) || !(ab + c[b] - c[a] > 0))
				continue;
			if (!v->points)
				v->points = m + 1;
			if (!bounds)
				return;
			consider(&s[a], &s[b], &s[m], (double[3]){ c[b], -c[a], ab }, bounds, v);
		}
	}
}

mr_valid
mr_valid_triangle(const mr_sight *s, size_t n, const mr_bounds *bounds)
{
	mr_valid v = { 0 };

	for (size_t m = 2; m < n && !v.taken && (bounds || !v.points); m++)
		complete(s, m, bounds, &v);
	return v;
}

typedef struct search {
	const mr_domain *d;
	const mr_sample_cloud *c;
	size_t k;
	const uint32_t *vertex; /* of a chunk */
	const uint32_t *index;  /* k nearest points of each */
	const double *dist2;
	double *height;
	bool *hit;
	uint8_t *points;   /* of mr_valid */
	uint32_t *nearest; /* point of each vertex */
} search;

/* The k nearest points lie in a disc about the foot of v on the surface: of squared radius R^2 = d_k^2 -
 * d_1^2, so one point has the area pi R^2 / k. */
static mr_bounds
bounds_of(const double *near2, size_t k)
{
	double spacing2 = MR_PI * (near2[k - 1] - near2[0]) / (double)k, spacing = sqrt(spacing2);

	return (
	    mr_bounds){ .height = 4 * sqrt(near2[0]) + 4 * spacing, .edge2 = 36 * spacing2, .cosine = 0.1 };
}

static void
search_vertices(void *arg, size_t begin, size_t end)
{
	const search *s = arg;
	mr_sight sight[MR_SAMPLE_MOST];

	for (size_t i = begin; i < end; i++) {
		size_t v = s->vertex[i], n, near = 0;
		mr_v3 normal = s->d->normal[v];
		mr_bounds bounds;
		mr_valid found;
		s->nearest[v] = s->index[i * s->k];
		s->hit[v] = false;
		s->height[v] = 0;
		s->points[v] = 0;
		if (!(mr_norm2(normal) > 0))
			continue;
		n = mr_sights(s->c->p, s->index + i * s->k, s->k, s->d->m.p[v], normal, sight);
		bounds = bounds_of(s->dist2 + i * s->k, n);
		while (near < n && mr_same_side(s->c, sight[near].index, normal))
			near++;
		found = mr_valid_triangle(sight, n, near < n ? NULL : &bounds);
		s->points[v] = (uint8_t)found.points;
		if (near < n) {
			near = mr_sights_near_sheet(s->c, normal, sight, n);
			found = mr_valid_triangle(sight, near, &bounds);
		}
		s->hit[v] = found.taken;
		s->height[v] = found.taken ? found.height : 0;
	}
}

/* Shares of the vertices by how many triangles, C(points, 3), had been tested when the line met one. */
static void
report_tries(const search *s, size_t nv, mr_sample_result *r)
{
	size_t tally[6] = { 0 }, met = 0;

	for (size_t v = 0; v < nv; v++) {
		if (s->points[v] && s->points[v] <= 5)
			tally[s->points[v]]++;
		met += s->points[v] > 0;
	}
	r->tries_1 = (double)tally[3] / (double)nv;
	r->tries_4 = (double)(tally[3] + tally[4]) / (double)nv;
	r->tries_10 = (double)(tally[3] + tally[4] + tally[5]) / (double)nv;
	r->missed = nv - met;
}

/* Handles the n vertices of the list, among k points. */
static mr_status
search_list(mr_ctx *ctx, const uint32_t *list, size_t n, search *s)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t chunk = n < CHUNK ? n : CHUNK;
	uint32_t *index = MR_NEW(ctx, chunk * s->k, uint32_t);
	double *dist2 = MR_NEW(ctx, chunk * s->k, double);
	mr_v3 *q = MR_NEW(ctx, chunk, mr_v3);

	s->index = index;
	s->dist2 = dist2;
	for (size_t first = 0; first < n; first += chunk) {
		size_t m = n - first < chunk ? n - first : chunk;
		s->vertex = list + first;
		for (size_t i = 0; i < m; i++)
			q[i] = s->d->m.p[s->vertex[i]];
		MR_TRY(mr_near_query(ctx, s->c->near, q, m, s->k, index, dist2));
		mr_parallel(ctx, m, GRAIN, search_vertices, s);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Most vertices find their triangle among few points; all others look at all. */
mr_status
mr_sample_triangles(mr_ctx *ctx, const mr_domain *d, const mr_sample_cloud *c, size_t neighbours,
    double *height, bool *hit, uint32_t *nearest, mr_sample_result *r)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *list = MR_NEW(ctx, d->m.nv, uint32_t);
	search s = { .d = d, .c = c, .height = height, .hit = hit, .nearest = nearest };
	size_t missed = 0;

	s.k = neighbours < FIRST ? neighbours : FIRST;
	s.points = MR_NEW(ctx, d->m.nv, uint8_t);
	for (uint32_t v = 0; v < d->m.nv; v++)
		list[v] = v;
	MR_TRY(search_list(ctx, list, d->m.nv, &s));
	for (uint32_t v = 0; v < d->m.nv; v++)
		if (!hit[v])
			list[missed++] = v;
	s.k = neighbours;
	if (neighbours > FIRST)
		MR_TRY(search_list(ctx, list, missed, &s));
	report_tries(&s, d->m.nv, r);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
