/* Samples of a side: many, on planes fitted to their neighbours; few of even density, with fast point feature
 * histograms (Rusu, Blodow, Beetz 2009). */
#include "align/model.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "mesh/repair.h"
#include "shape/shape.h"
#include "space/local_planes.h"

enum { RAW = 30000, DENSE = 10000, AROUND = 24, MOST = 128, SOME = 500, NEAR = 64, BINS = 11, LEAST = 10 };

/* From this offset of its neighbours' middle on, in radii of the neighbourhood, a point is on the rim: 0.42
 * of half a disc, 0.1 of samples strewn over a whole one. */
static const double RIM = 0.3;

/* Noise is looked through by a neighbourhood of this many times its size. */
static const double THROUGH = 6;

/* Of the neighbourhood that a feature is of, in steps. */
static const double REACH = 6;

/* ---- dense samples ---- */

/* Points at random or at equal strides, and the normals that are known. */
static mr_status
draw(mr_ctx *ctx, mr_align_side side, model *m, mr_v3 **p, mr_v3 **hint, size_t *n)
{
	const mr_mesh *of = side.m;

	*n = RAW;
	if (of->nf && mr_mesh_area(ctx, of) > 0) {
		MR_TRY(mr_surface_sample(ctx, of, *n, 1, p, hint));
	} else {
		*n = of->nv < RAW ? of->nv : RAW;
		*p = MR_NEW(ctx, *n, mr_v3);
		*hint = side.normal ? MR_NEW(ctx, *n, mr_v3) : NULL;
		mr_at_strides(of->p, of->nv, *n, *p);
		if (side.normal)
			mr_at_strides(side.normal, of->nv, *n, *hint);
	}
	for (size_t i = 0; i < *n; i++)
		(*p)[i] = mr_mul(1 / m->unit, mr_sub((*p)[i], m->middle));
	return MR_OK;
}

typedef struct smoothing {
	const mr_v3 *p, *hint, *at;
	const uint32_t *around; /* k of each */
	size_t k;
	samples *to;
	double *off,
	    *radius; /* of the points around from their plane, the root mean square; how far they reach */
} smoothing;

static void
smooth(void *arg, size_t begin, size_t end)
{
	smoothing *s = arg;

	for (size_t i = begin; i < end; i++) {
		mr_v3 q[MOST], middle = mr_vec(0, 0, 0), side = middle, off, *normal = &s->to->normal[i];
		double variation, sum = 0;
		size_t k = 0;
		for (; k < s->k && s->around[i * s->k + k] != MR_NONE; k++) {
			uint32_t j = s->around[i * s->k + k];
			q[k] = s->p[j];
			middle = mr_add(middle, q[k]);
			side = s->hint ? mr_add(side, s->hint[j]) : side;
		}
		s->radius[i] = mr_dist(q[k - 1], s->at[i]);
		middle = mr_mul(1 / (double)k, middle);
		*normal = mr_plane_fit(q, k, &variation);
		for (size_t j = 0; j < k; j++)
			sum += mr_square(mr_dot(*normal, mr_sub(q[j], middle)));
		s->off[i] = sqrt(sum / (double)k);
		if (mr_dot(*normal, side) < 0)
			*normal = mr_mul(-1, *normal);
		off = mr_sub(middle, s->at[i]);
		s->to->p[i] = mr_axpy(mr_dot(off, *normal), *normal, s->at[i]);
		s->to->rim[i] = mr_norm(mr_sub(middle, s->to->p[i])) > RIM * s->radius[i];
	}
}

static samples
new_samples(mr_ctx *ctx, size_t n)
{
	return (samples){ .p = MR_NEW(ctx, n, mr_v3),
		.normal = MR_NEW(ctx, n, mr_v3),
		.rim = MR_NEW(ctx, n, bool),
		.n = n };
}

/* Smooths n of the points p at equal strides, each by the k nearest. */
static mr_status
make_smooth(mr_ctx *ctx, const mr_near *near, const mr_v3 *p, const mr_v3 *hint, size_t of, size_t n,
    size_t k, samples *to, smoothing *s)
{
	mr_v3 *at = MR_NEW(ctx, n, mr_v3);
	uint32_t *around = MR_NEW(ctx, n * k, uint32_t);

	mr_at_strides(p, of, n, at);
	MR_TRY(mr_near_query(ctx, near, at, n, k, around, NULL));
	*to = new_samples(ctx, n);
	*s = (smoothing){ p, hint, at, around, k, to, MR_NEW(ctx, n, double), MR_NEW(ctx, n, double) };
	mr_parallel(ctx, n, 64, smooth, s);
	return MR_OK;
}

/* As many neighbours as see the surface through the noise. */
static mr_status
make_dense(mr_ctx *ctx, mr_align_side side, model *m)
{
	size_t n, places, k = AROUND, some;
	double noise, reach;
	mr_v3 *p, *hint;
	mr_near *near;
	smoothing s;

	MR_TRY(draw(ctx, side, m, &p, &hint, &n));
	MR_TRY(mr_near_build(ctx, p, n, &near));
	places = mr_near_distinct(near);
	if (places < LEAST)
		return mr_fail(ctx, MR_EMESH, "%s: %zu points are too few to align", side.m->name, places);
	some = n < SOME ? n : SOME;
	MR_TRY(make_smooth(ctx, near, p, hint, n, some, k, &m->dense, &s));
	mr_median(ctx, s.off, some, &noise);
	mr_median(ctx, s.radius, some, &reach);
	k = (size_t)fmin(MOST, fmax(AROUND, AROUND * mr_square(THROUGH * noise / reach)));
	m->oriented = hint != NULL;
	return make_smooth(ctx, near, p, hint, n, n < DENSE ? n : DENSE, k, &m->dense, &s);
}

/* ---- sparse samples and their features ---- */

static size_t
cell_at(const grid *g, size_t x, size_t y, size_t z)
{
	return (x * g->side[1] + y) * g->side[2] + z;
}

/* Which cell a coordinate is in. */
static size_t
along(const grid *g, double from, double at)
{
	return (size_t)((at - from) / g->edge);
}

/* Every sample is told to the cells around, two on each side. */
static void
make_cells(mr_ctx *ctx, samples *s)
{
	mr_box box = mr_box_of(s->p, s->n);
	grid *g = &s->cells;
	mr_v3 size = mr_sub(box.max, box.min);
	size_t count;

	g->edge = fmax(STEP, fmax(size.x, fmax(size.y, size.z)) / 200);
	g->origin = mr_sub(box.min, mr_vec(3 * g->edge, 3 * g->edge, 3 * g->edge));
	for (int k = 0; k < 3; k++)
		g->side[k] = 8 + (size_t)(mr_coordinate(size, k) / g->edge);
	count = g->side[0] * g->side[1] * g->side[2];
	g->sample = MR_NEW(ctx, count, uint32_t);
	memset(g->sample, 0xff, count * sizeof *g->sample);
	for (uint32_t i = 0; i < s->n; i++) {
		size_t x = along(g, g->origin.x, s->p[i].x), y = along(g, g->origin.y, s->p[i].y),
		       z = along(g, g->origin.z, s->p[i].z);
		for (size_t k = 0; k < 125; k++) {
			size_t u = x + k / 25 - 2, v = y + k / 5 % 5 - 2, w = z + k % 5 - 2;
			uint32_t *at = &g->sample[cell_at(g, u, v, w)];
			mr_v3 middle = mr_axpy(
			    g->edge, mr_vec((double)u + 0.5, (double)v + 0.5, (double)w + 0.5), g->origin);
			if (*at == MR_NONE ||
			    mr_norm2(mr_sub(middle, s->p[i])) < mr_norm2(mr_sub(middle, s->p[*at])))
				*at = i;
		}
	}
}

uint32_t
mr_align_nearby(const samples *s, mr_v3 p)
{
	const grid *g = &s->cells;
	const double at[3] = { p.x - g->origin.x, p.y - g->origin.y, p.z - g->origin.z };

	for (int k = 0; k < 3; k++)
		if (!(at[k] >= 0 && at[k] < g->edge * (double)g->side[k]))
			return MR_NONE;
	return g->sample[cell_at(g, along(g, 0, at[0]), along(g, 0, at[1]), along(g, 0, at[2]))];
}

static mr_status
make_sparse(mr_ctx *ctx, model *m)
{
	const samples *d = &m->dense;
	uint32_t *onto = MR_NEW(ctx, d->n, uint32_t), taken = 0;
	size_t count;

	mr_weld(ctx, d->p, d->n, STEP, onto, &count);
	m->sparse = new_samples(ctx, count);
	for (size_t i = 0; i < d->n; i++)
		if (onto[i] == taken) {
			m->sparse.p[taken] = d->p[i];
			m->sparse.normal[taken] = d->normal[i];
			m->sparse.rim[taken++] = d->rim[i];
		}
	make_cells(ctx, &m->sparse);
	return mr_near_build(ctx, m->sparse.p, count, &m->sparse.near);
}

typedef struct histograms {
	const samples *s;
	bool oriented;
	const uint32_t *around; /* NEAR of each, itself among them */
	float (*simple)[FEATURE], (*fast)[FEATURE];
} histograms;

static size_t
bin(double x, double low, double high)
{
	double at = BINS * (x - low) / (high - low);

	return at < 0 ? 0 : at >= BINS ? BINS - 1 : (size_t)at;
}

/* The neighbours of point i within reach, after itself. */
static size_t
neighbours(const histograms *h, size_t i, const uint32_t **around)
{
	size_t k = 1;

	*around = h->around + i * NEAR;
	while (
	    k < NEAR && (*around)[k] != MR_NONE && mr_dist(h->s->p[i], h->s->p[(*around)[k]]) < REACH * STEP)
		k++;
	return k;
}

/* How the normals around turn, in the frame of normal and direction. */
static void
find_simple(void *arg, size_t begin, size_t end)
{
	histograms *h = arg;
	const uint32_t *around;

	for (size_t i = begin; i < end; i++) {
		size_t k = neighbours(h, i, &around);
		float one = 100 / (float)k;
		memset(h->simple[i], 0, sizeof h->simple[i]);
		for (size_t j = 1; j < k; j++) {
			mr_v3 u = h->s->normal[i], n = h->s->normal[around[j]];
			mr_v3 d = mr_unit(mr_sub(h->s->p[around[j]], h->s->p[i]));
			n = h->oriented || mr_dot(u, n) >= 0 ? n : mr_mul(-1, n);
			mr_v3 v = mr_unit(mr_cross(d, u)), w = mr_cross(u, v);
			h->simple[i][bin(mr_dot(v, n), -1, 1)] += one;
			h->simple[i][BINS + bin(mr_dot(u, d), -1, 1)] += one;
			h->simple[i][2 * BINS + bin(atan2(mr_dot(w, n), mr_dot(u, n)), -MR_PI, MR_PI)] += one;
		}
	}
}

/* Its own histogram and the mean of those around, each by its nearness. */
static void
find_fast(void *arg, size_t begin, size_t end)
{
	histograms *h = arg;
	const uint32_t *around;

	for (size_t i = begin; i < end; i++) {
		size_t k = neighbours(h, i, &around);
		float weight = 0, sum[FEATURE] = { 0 };
		for (size_t j = 1; j < k; j++) {
			float one = (float)(STEP / mr_dist(h->s->p[around[j]], h->s->p[i]));
			weight += one;
			for (int c = 0; c < FEATURE; c++)
				sum[c] += one * h->simple[around[j]][c];
		}
		for (int c = 0; c < FEATURE; c++)
			h->fast[i][c] = h->simple[i][c] + (k > 1 ? sum[c] / weight : 0);
	}
}

/* Sides that nobody knows: away from what is around. */
static void
turn_outward(void *arg, size_t begin, size_t end)
{
	histograms *h = arg;
	const uint32_t *around;

	for (size_t i = begin; i < end; i++) {
		size_t k = neighbours(h, i, &around);
		mr_v3 sum = mr_vec(0, 0, 0);
		for (size_t j = 1; j < k; j++)
			sum = mr_add(sum, mr_sub(h->s->p[around[j]], h->s->p[i]));
		if (mr_dot(sum, h->s->normal[i]) > 0)
			h->s->normal[i] = mr_mul(-1, h->s->normal[i]);
	}
}

mr_status
mr_align_features(mr_ctx *ctx, bool oriented, model *m)
{
	size_t n = m->sparse.n;
	uint32_t *around = MR_NEW(ctx, n * NEAR, uint32_t);
	histograms h = { &m->sparse, oriented, around, mr_alloc(ctx, n, sizeof *h.simple),
		mr_alloc(ctx, n, sizeof *h.fast) };

	MR_TRY(mr_near_query(ctx, m->sparse.near, m->sparse.p, n, NEAR, around, NULL));
	if (!oriented)
		mr_parallel(ctx, n, 64, turn_outward, &h);
	mr_parallel(ctx, n, 64, find_simple, &h);
	mr_parallel(ctx, n, 64, find_fast, &h);
	m->feature = h.fast;
	return MR_OK;
}

mr_status
mr_align_model(mr_ctx *ctx, mr_align_side side, double unit, model *m)
{
	mr_box box = mr_box_of(side.m->p, side.m->nv);

	*m = (model){ .middle = mr_lerp(0.5, box.min, box.max), .unit = unit };
	MR_TRY(make_dense(ctx, side, m));
	MR_TRY(mr_near_build(ctx, m->dense.p, m->dense.n, &m->dense.near));
	return make_sparse(ctx, m);
}
