/* Sums the angle defects (the discrete Gaussian curvature of Meyer, Desbrun, Schroeder, Barr 2003) within an
 * edge length, and pins where they are greatest. */
#include "remesh/extremities.h"

#include "base/parallel.h"

static const double SHARP = 2.5;   /* total curvature within an edge length that makes a tip */
static const double SPACING = 1.5; /* of two tips, in edge lengths */

enum { MOST = 1024 }; /* vertices looked at around one */

typedef struct search {
	const mr_dyn *d;
	const mr_remesh_source *s;
	double *defect; /* of each vertex: 2 pi less its angles; 0 on curves */
	double *total;  /* within an edge length; 0 where far too little */
} search;

static double
angle_defect(const mr_dyn *d, uint32_t v)
{
	uint32_t h = d->out[v];
	double sum = 2 * MR_PI;

	do {
		mr_v3 a = mr_sub(d->p[mr_dyn_to(d, h)], d->p[v]),
		      b = mr_sub(d->p[mr_dyn_apex(d, h)], d->p[v]);
		sum -= mr_angle(a, b);
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return sum;
}

static void
defect_body(void *arg, size_t begin, size_t end)
{
	search *w = arg;

	for (uint32_t v = (uint32_t)begin; v < end; v++)
		w->defect[v] = w->d->kind[v] == MR_SMOOTH ? angle_defect(w->d, v) : 0;
}

/* The vertices gathered around one: those whose stamp is `now`. */
typedef struct crowd {
	uint32_t list[MOST], now;
	size_t n;
	uint32_t *stamp; /* of all */
} crowd;

/* Adds v where it is not in yet and there is room. */
static void
join_crowd(crowd *c, uint32_t v)
{
	if (c->n == MOST || c->stamp[v] == c->now)
		return;
	c->stamp[v] = c->now;
	c->list[c->n++] = v;
}

/* The vertices that hang together with v within `radius` of it, the nearest in edges; at most MOST. */
static void
gather(const mr_dyn *d, uint32_t v, double radius, crowd *c)
{
	c->now++;
	c->n = 0;
	join_crowd(c, v);
	for (size_t i = 0; i < c->n; i++) {
		uint32_t h = d->out[c->list[i]];
		do {
			uint32_t to = mr_dyn_to(d, h);
			if (mr_dist(d->p[to], d->p[v]) < radius)
				join_crowd(c, to);
			h = mr_dyn_ccw(d, h);
		} while (h != MR_NONE && h != d->out[c->list[i]]);
	}
}

static double
total_around(const search *w, uint32_t v, crowd *c)
{
	double total = 0;

	if (w->defect[v] <= 0)
		return 0;
	gather(w->d, v, mr_remesh_length(w->s, w->d, v), c);
	for (size_t i = 0; i < c->n; i++)
		total += w->defect[c->list[i]];
	return total > SHARP ? total : 0;
}

/* True where no vertex within the spacing has more; the lower number wins among equals. */
static bool
is_summit(const search *w, uint32_t v, crowd *c)
{
	gather(w->d, v, SPACING * mr_remesh_length(w->s, w->d, v), c);
	for (size_t i = 0; i < c->n; i++) {
		uint32_t u = c->list[i];
		if (w->total[u] > w->total[v] || (w->total[u] == w->total[v] && u < v))
			return false;
	}
	return true;
}

void
mr_pin_tips(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s)
{
	MR_SCOPE(ctx);
	search w = { d, s, MR_NEW(ctx, d->nv, double), MR_NEW(ctx, d->nv, double) };
	crowd c = { .stamp = MR_NEW_ZERO(ctx, d->nv, uint32_t) };

	mr_parallel(ctx, d->nv, 1024, defect_body, &w);
	for (uint32_t v = 0; v < d->nv; v++)
		w.total[v] = total_around(&w, v, &c);
	for (uint32_t v = 0; v < d->nv; v++)
		if (w.total[v] > 0 && is_summit(&w, v, &c)) {
			d->kind[v] = MR_CORNER;
			d->at[v] = d->out[v];
		}
}
