/*
 * Moving least squares in the frame of the domain: the height over the plane across the normal is a quadric,
 * fitted to the nearest points with weights that fall off across the line (Alexa et al. 2003) and with the
 * residual, so that noise averages out and outliers do not count (Fleishman et al. 2005).
 */
#include "base/parallel.h"
#include "base/sort.h"
#include "sample/parts.h"
#include "space/local_quadric.h"

#include <float.h>

enum { CHUNK = 1 << 14, GRAIN = 128, TERMS = MR_QUADRIC_TERMS, ROUNDS = 6 };

/* The points about a line, in units of the radius that they are looked at in. */
typedef struct patch {
	size_t n;
	double x[MR_SAMPLE_MOST][TERMS]; /* of the quadric */
	double t[MR_SAMPLE_MOST], near[MR_SAMPLE_MOST], weight[MR_SAMPLE_MOST], off[MR_SAMPLE_MOST];
	double radius;
} patch;

typedef struct weighted {
	double x, w;
} weighted;

static double
weighted_median(weighted *s, size_t n)
{
	double half = 0, sum = 0;

	for (size_t i = 1; i < n; i++) {
		weighted v = s[i];
		size_t j = i;
		for (; j > 0 && s[j - 1].x > v.x; j--)
			s[j] = s[j - 1];
		s[j] = v;
	}
	for (size_t i = 0; i < n; i++)
		half += s[i].w / 2;
	for (size_t i = 0; i < n; i++)
		if ((sum += s[i].w) >= half)
			return s[i].x;
	return 0;
}

static double
median_of(const patch *p, const double *x)
{
	weighted s[MR_SAMPLE_MOST];

	for (size_t i = 0; i < p->n; i++)
		s[i] = (weighted){ x[i], p->near[i] };
	return weighted_median(s, p->n);
}

static void
patch_new(const mr_sight *s, size_t n, patch *p)
{
	double radius2 = s[n - 1].d2 > 0 ? s[n - 1].d2 : 1, radius = sqrt(radius2);

	p->n = n;
	p->radius = radius;
	for (size_t i = 0; i < n; i++) {
		double x = s[i].x / radius, y = s[i].y / radius, u = 1 - s[i].d2 / radius2;
		mr_quadric_row(x, y, p->x[i]);
		p->t[i] = s[i].t / radius;
		p->near[i] = u * u * u + 1e-3; /* falls to about 0 at the radius */
	}
}

static void
weigh(patch *p, const double c[TERMS], double *scale)
{
	for (size_t k = 0; k < p->n; k++) {
		double z = 0;
		for (int i = 0; i < TERMS; i++)
			z += c[i] * p->x[k][i];
		p->off[k] = fabs(p->t[k] - z);
	}
	*scale = 1.4826 * median_of(p, p->off);
	for (size_t k = 0; k < p->n; k++) {
		double u = p->off[k] / (3 * *scale + 1e-9);
		p->weight[k] = p->near[k] * (1 / ((1 + u * u) * (1 + u * u)));
	}
}

/* The height of the surface on the line, and the deviation of the points from it; false: there is none. */
static bool
local_surface(const mr_sight *s, size_t n, double *height, double *deviation, double *radius)
{
	double c[TERMS] = { 0 }, scale;
	patch p;

	if (n < TERMS)
		return false;
	patch_new(s, n, &p);
	c[0] = median_of(&p, p.t);
	weigh(&p, c, &scale);
	for (int round = 0; round < ROUNDS; round++) {
		if (!mr_quadric_fit(p.x[0], p.t, p.weight, n, c))
			return false;
		weigh(&p, c, &scale);
	}
	*height = c[0] * p.radius;
	*deviation = scale * p.radius;
	*radius = p.radius;
	return c[1] * c[1] + c[2] * c[2] < 25 && fabs(c[0]) < 2;
}

typedef struct search {
	const mr_domain *d;
	const mr_sample_cloud *c;
	size_t k, first;
	const uint32_t *index;
	double *height, *deviation, *radius;
	bool *hit;
} search;

static void
search_vertices(void *arg, size_t begin, size_t end)
{
	const search *s = arg;
	mr_sight sight[MR_SAMPLE_MOST];

	for (size_t i = begin; i < end; i++) {
		size_t v = s->first + i, n;
		mr_v3 normal = s->d->normal[v];
		s->hit[v] = false;
		s->height[v] = s->deviation[v] = s->radius[v] = 0;
		if (!(mr_norm2(normal) > 0))
			continue;
		n = mr_sights(s->c->p, s->index + i * s->k, s->k, s->d->m.p[v], normal, sight);
		n = mr_sights_near_sheet(s->c, normal, sight, n);
		s->hit[v] = local_surface(sight, n, &s->height[v], &s->deviation[v], &s->radius[v]);
	}
}

static mr_status
search_all(mr_ctx *ctx, search *s)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = s->d->m.nv, chunk = nv < CHUNK ? nv : CHUNK;
	uint32_t *index = MR_NEW(ctx, chunk * s->k, uint32_t);

	s->index = index;
	for (s->first = 0; s->first < nv; s->first += chunk) {
		size_t n = nv - s->first < chunk ? nv - s->first : chunk;
		MR_TRY(mr_near_query(ctx, s->c->near, s->d->m.p + s->first, n, s->k, index, NULL));
		mr_parallel(ctx, n, GRAIN, search_vertices, s);
		mr_progress(ctx, "sampling", (double)(s->first + n) / (double)nv);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The median of the values at the vertices that were hit; 0 where none was. */
static void
median_where(mr_ctx *ctx, const bool *hit, const double *value, size_t n, double *median)
{
	mr_mark mark = mr_mark_take(ctx);
	double *x = MR_NEW(ctx, n, double);
	size_t count = 0;

	for (size_t i = 0; i < n; i++)
		if (hit[i])
			x[count++] = value[i];
	*median = count ? mr_kth(x, count, count / 2) : 0;
	mr_mark_release(ctx, mark);
}

mr_status
mr_sample_local(mr_ctx *ctx, const mr_domain *d, const mr_sample_cloud *c, size_t neighbours, double *height,
    bool *hit, mr_sample_result *r)
{
	static const double wide = 4; /* the radius that evens out noise, in deviations */
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = d->m.nv, most = mr_near_distinct(c->near);
	double *deviation = MR_NEW(ctx, nv, double), *spread = MR_NEW(ctx, nv, double), noise, radius, grown;
	search s = { .d = d,
		.c = c,
		.k = neighbours,
		.height = height,
		.deviation = deviation,
		.radius = spread,
		.hit = hit };

	if (most > MR_SAMPLE_MOST)
		most = MR_SAMPLE_MOST;
	MR_TRY(search_all(ctx, &s));
	median_where(ctx, hit, deviation, nv, &noise);
	median_where(ctx, hit, spread, nv, &radius);
	grown = (double)neighbours * pow(wide * noise / fmax(radius, DBL_MIN), 2);
	if (grown > 1.2 * (double)neighbours && most > neighbours) {
		s.k = grown < (double)most ? (size_t)grown : most;
		MR_TRY(search_all(ctx, &s));
		median_where(ctx, hit, deviation, nv, &noise);
	}
	r->missed = 0;
	for (size_t v = 0; v < nv; v++)
		r->missed += !hit[v];
	r->neighbours = s.k;
	r->noise = noise / c->diagonal;
	mr_mark_release(ctx, mark);
	return MR_OK;
}
