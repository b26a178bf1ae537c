/* Sums the angle defects (the discrete Gaussian curvature of Meyer, Desbrun, Schroeder, Barr 2003) within an
 * edge length, and pins where they are greatest. */
#include "remesh/extremities.h"

#include "base/parallel.h"

static const double SHARP = 2.5;   /* total curvature within an edge length that makes a tip */
static const double SPACING = 1.5; /* of two tips, in edge lengths */

enum { MOST = 1024, SLOTS = 4 * MOST }; /* vertices looked at around one; of a power of two slots */

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

/* The vertices gathered around one, and a hash set of them: a slot is taken where its stamp is `now`. */
typedef struct crowd {
	uint32_t list[MOST];
	uint32_t slot[SLOTS], stamp[SLOTS], now;
	size_t n;
} crowd;

/* Adds v where it is not in yet and there is room. */
static void
join_crowd(crowd *c, uint32_t v)
{
	uint32_t i = v * 2654435769u >> 20 & (SLOTS - 1);

	while (c->stamp[i] == c->now) {
		if (c->slot[i] == v)
			return;
		i = (i + 1) & (SLOTS - 1);
	}
	if (c->n == MOST)
		return;
	c->stamp[i] = c->now;
	c->slot[i] = v;
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

static void
total_body(void *arg, size_t begin, size_t end)
{
	search *w = arg;
	crowd c = { .now = 0 };

	for (uint32_t v = (uint32_t)begin; v < end; v++) {
		double total = 0;
		w->total[v] = 0;
		if (w->defect[v] <= 0)
			continue;
		gather(w->d, v, mr_remesh_length(w->s, w->d, v), &c);
		for (size_t i = 0; i < c.n; i++)
			total += w->defect[c.list[i]];
		w->total[v] = total > SHARP ? total : 0;
	}
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
mr_pin_tips(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, size_t *pinned)
{
	mr_mark mark = mr_mark_take(ctx);
	search w = { d, s, MR_NEW(ctx, d->nv, double), MR_NEW(ctx, d->nv, double) };
	crowd c = { .now = 0 };

	mr_parallel(ctx, d->nv, 1024, defect_body, &w);
	mr_parallel(ctx, d->nv, 1024, total_body, &w);
	*pinned = 0;
	for (uint32_t v = 0; v < d->nv; v++)
		if (w.total[v] > 0 && is_summit(&w, v, &c)) {
			d->kind[v] = MR_CORNER;
			d->at[v] = d->out[v];
			++*pinned;
		}
	mr_mark_release(ctx, mark);
}
