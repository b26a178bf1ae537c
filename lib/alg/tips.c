#include "alg/tips.h"

#include "base/parallel.h"

static const double SHARP = 2.5;   /* total curvature within an edge length that makes a tip */
static const double SPACING = 1.5; /* of two tips, in edge lengths */

enum { MOST = 4096 }; /* vertices looked at around one */

typedef struct search {
	const mr_dyn *d;
	const mr_surface *s;
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
		sum -= atan2(mr_norm(mr_cross(a, b)), mr_dot(a, b));
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

static bool
is_among(const uint32_t *list, size_t n, uint32_t v)
{
	for (size_t i = n; i > 0; i--)
		if (list[i - 1] == v)
			return true;
	return false;
}

/* The vertices that hang together with v within `radius` of it; at most MOST. */
static size_t
gather(const mr_dyn *d, uint32_t v, double radius, uint32_t list[MOST])
{
	size_t n = 0;

	list[n++] = v;
	for (size_t i = 0; i < n; i++) {
		uint32_t h = d->out[list[i]];
		do {
			uint32_t to = mr_dyn_to(d, h);
			if (n < MOST && mr_dist(d->p[to], d->p[v]) < radius && !is_among(list, n, to))
				list[n++] = to;
			h = mr_dyn_ccw(d, h);
		} while (h != MR_NONE && h != d->out[list[i]]);
	}
	return n;
}

static void
total_body(void *arg, size_t begin, size_t end)
{
	search *w = arg;
	uint32_t list[MOST];

	for (uint32_t v = (uint32_t)begin; v < end; v++) {
		double total = 0;
		size_t n = w->defect[v] > 0 ? gather(w->d, v, mr_surface_length(w->s, w->d, v), list) : 0;
		for (size_t i = 0; i < n; i++)
			total += w->defect[list[i]];
		w->total[v] = total > SHARP ? total : 0;
	}
}

/* True where no vertex within the spacing has more; the lower number wins among equals. */
static bool
is_summit(const search *w, uint32_t v, uint32_t list[MOST])
{
	size_t n = gather(w->d, v, SPACING * mr_surface_length(w->s, w->d, v), list);

	for (size_t i = 0; i < n; i++) {
		uint32_t u = list[i];
		if (w->total[u] > w->total[v] || (w->total[u] == w->total[v] && u < v))
			return false;
	}
	return true;
}

mr_status
mr_pin_tips(mr_ctx *ctx, mr_dyn *d, const mr_surface *s, size_t *pinned)
{
	mr_mark mark = mr_mark_take(ctx);
	search w = { d, s, MR_NEW(ctx, d->nv, double), MR_NEW(ctx, d->nv, double) };
	uint32_t list[MOST];

	if (!w.defect || !w.total)
		return MR_EMEM;
	mr_parallel(ctx, d->nv, 1024, defect_body, &w);
	mr_parallel(ctx, d->nv, 1024, total_body, &w);
	*pinned = 0;
	for (uint32_t v = 0; v < d->nv; v++)
		if (w.total[v] > 0 && is_summit(&w, v, list)) {
			d->kind[v] = MR_CORNER;
			d->at[v] = d->out[v];
			++*pinned;
		}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
