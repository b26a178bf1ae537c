/* Counts by the table of edges and sets of connected corners, sizes and shapes by sums over them. */
#include "measure/measure.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "mesh/fold.h"
#include "mesh/layers.h"
#include "op/voronoi_area.h"
#include "space/self_intersect.h"

/* ---- counts ---- */

/* The corner of half-edge h's face at vertex v, one of its ends. */
static uint32_t
corner_at(const mr_mesh *m, uint32_t h, uint32_t v)
{
	return mr_he_from(m, h) == v ? h : mr_he_next(h);
}

static void
count_components(mr_ctx *ctx, const mr_mesh *m, mr_census *c, size_t *used)
{
	MR_SCOPE(ctx);
	uint32_t *parent = mr_sets_new(ctx, m->nv);
	unsigned char *state = MR_NEW_ZERO(ctx, m->nv, unsigned char); /* 1: in a face; 2: in a proper one */

	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		bool proper = !mr_face_repeats(m, f);
		for (int i = 0; i < 3; i++)
			state[v[i]] = proper || state[v[i]] == 2 ? 2 : 1;
		if (proper) {
			mr_sets_join(parent, v[0], v[1]);
			mr_sets_join(parent, v[1], v[2]);
		}
	}
	for (uint32_t v = 0; v < m->nv; v++) {
		*used += state[v] == 2;
		c->isolated_vertices += state[v] == 0;
		c->components += state[v] == 2 && mr_sets_root(parent, v) == v;
	}
}

static void
join_corners(const mr_mesh *m, const mr_edges *edges, uint32_t *fan)
{
	for (size_t e = 0; e < edges->count; e++) {
		uint32_t h = edges->he[edges->start[e]], a = mr_he_from(m, h), b = mr_he_to(m, h);
		for (uint32_t i = edges->start[e] + 1; i < edges->start[e + 1]; i++) {
			mr_sets_join(fan, h, corner_at(m, edges->he[i], a));
			mr_sets_join(fan, mr_he_next(h), corner_at(m, edges->he[i], b));
		}
	}
}

static void
count_fans(mr_ctx *ctx, const mr_mesh *m, uint32_t *fan, mr_census *c)
{
	MR_SCOPE(ctx);
	uint32_t *fans = MR_NEW_ZERO(ctx, m->nv, uint32_t);

	for (uint32_t h = 0; h < 3 * m->nf; h++)
		if (!mr_face_repeats(m, h / 3) && fan[h] == h)
			c->nonmanifold_vertices += ++fans[mr_he_from(m, h)] == 2;
}

/* Boundary edges of one fan belong to one loop: each fan keeps the first it meets. */
static void
count_loops(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, uint32_t *fan, mr_census *c)
{
	MR_SCOPE(ctx);
	uint32_t *first = MR_NEW(ctx, 3 * m->nf, uint32_t), *loop = mr_sets_new(ctx, c->boundary_edges),
		 n = 0;

	memset(first, 0xff, 3 * m->nf * sizeof *first);
	for (size_t e = 0; e < edges->count; e++) {
		uint32_t h = edges->he[edges->start[e]], corner[2] = { h, mr_he_next(h) };
		if (mr_edge_faces(edges, e) != 1)
			continue;
		for (int i = 0; i < 2; i++) {
			uint32_t root = mr_sets_root(fan, corner[i]);
			if (first[root] == MR_NONE)
				first[root] = n;
			mr_sets_join(loop, first[root], n);
		}
		n++;
	}
	for (uint32_t i = 0; i < n; i++)
		c->boundary_loops += mr_sets_root(loop, i) == i;
}

static void
count_fans_and_loops(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, mr_census *c)
{
	MR_SCOPE(ctx);
	uint32_t *fan = mr_sets_new(ctx, 3 * m->nf);

	join_corners(m, edges, fan);
	count_fans(ctx, m, fan, c);
	count_loops(ctx, m, edges, fan, c);
}

static void
count_edges(const mr_mesh *m, const mr_edges *edges, mr_census *c)
{
	c->edges = edges->count;
	for (size_t e = 0; e < edges->count; e++) {
		const uint32_t *h = edges->he + edges->start[e];
		uint32_t n = mr_edge_faces(edges, e);
		c->boundary_edges += n == 1;
		c->nonmanifold_edges += n > 2;
		c->inconsistent_edges += n == 2 && mr_same_direction(m, h[0], h[1]);
		c->folded_edges += n == 2 && mr_is_fold(m, h[0], h[1]);
	}
}

static void
count_duplicates(mr_ctx *ctx, const mr_mesh *m, mr_census *c)
{
	MR_SCOPE(ctx);
	mr_incidence around;

	mr_incidence_build(ctx, m, &around);
	for (uint32_t f = 0; f < m->nf; f++)
		c->duplicate_faces += !mr_face_repeats(m, f) && mr_face_is_repeated(m, &around, f);
}

void
mr_take_census(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, mr_census *out)
{
	mr_census c = { .genus = MR_UNKNOWN };
	size_t used = 0, proper = 0;

	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		bool repeats = mr_face_repeats(m, f);
		proper += !repeats;
		c.degenerate_faces += repeats || mr_triangle_degenerate(m->p[v[0]], m->p[v[1]], m->p[v[2]]);
	}
	count_edges(m, edges, &c);
	count_components(ctx, m, &c, &used);
	count_fans_and_loops(ctx, m, edges, &c);
	count_duplicates(ctx, m, &c);
	c.euler = (int64_t)used - (int64_t)edges->count + (int64_t)proper;
	c.oriented = c.inconsistent_edges == 0;
	c.manifold = c.nonmanifold_edges == 0 && c.nonmanifold_vertices == 0;
	if (c.oriented && c.manifold) /* euler = 2 components - 2 genus - loops */
		c.genus = (size_t)((2 * (int64_t)c.components - (int64_t)c.boundary_loops - c.euler) / 2);
	*out = c;
}

/* ---- sizes and shapes ---- */

static mr_spread
spread_of(const double *x, size_t n)
{
	mr_spread s = { INFINITY, 0, -INFINITY, 0 };

	if (n == 0)
		return (mr_spread){ NAN, NAN, NAN, NAN };
	for (size_t i = 0; i < n; i++) {
		s.min = x[i] < s.min ? x[i] : s.min;
		s.max = x[i] > s.max ? x[i] : s.max;
		s.mean += x[i];
	}
	s.mean /= (double)n;
	for (size_t i = 0; i < n; i++)
		s.deviation += (x[i] - s.mean) * (x[i] - s.mean);
	s.deviation = sqrt(s.deviation / (double)n);
	return s;
}

typedef struct job {
	const mr_mesh *m;
	const mr_edges *edges;
	double (*angle)[3]; /* per face: least, greatest, sum of |angle - 60|; NaN without area */
} job;

static void
measure_edges(mr_ctx *ctx, const job *j, mr_geometry *g)
{
	MR_SCOPE(ctx);
	double *length = MR_NEW(ctx, j->edges->count, double);

	for (size_t e = 0; e < j->edges->count; e++) {
		uint32_t h = j->edges->he[j->edges->start[e]];
		length[e] = mr_dist(j->m->p[mr_he_from(j->m, h)], j->m->p[mr_he_to(j->m, h)]);
	}
	g->edge = spread_of(length, j->edges->count);
}

static void
face_angles(void *arg, size_t begin, size_t end)
{
	job *j = arg;

	for (size_t f = begin; f < end; f++) {
		double *out = j->angle[f];
		const uint32_t *v = j->m->t[f].v;
		out[0] = mr_norm2(mr_face_cross(j->m, f)) > 0 ? INFINITY : NAN;
		out[1] = out[2] = 0;
		for (int i = 0; i < 3; i++) {
			mr_v3 at = j->m->p[v[i]];
			double a = mr_angle(mr_sub(j->m->p[v[(i + 1) % 3]], at),
				       mr_sub(j->m->p[v[(i + 2) % 3]], at)) *
			           (180 / MR_PI);
			out[0] = a < out[0] ? a : out[0];
			out[1] = a > out[1] ? a : out[1];
			out[2] += fabs(a - 60);
		}
	}
}

static void
measure_angles(mr_ctx *ctx, job *j, mr_geometry *g)
{
	MR_SCOPE(ctx);
	double low = INFINITY, high = -INFINITY, sum = 0;
	size_t n = 0;

	j->angle = mr_alloc(ctx, j->m->nf, sizeof *j->angle);
	mr_parallel(ctx, j->m->nf, 4096, face_angles, j);
	for (size_t f = 0; f < j->m->nf; f++) {
		const double *a = j->angle[f];
		if (isnan(a[0]))
			continue;
		low = a[0] < low ? a[0] : low;
		high = a[1] > high ? a[1] : high;
		sum += a[2];
		n += 3;
	}
	g->angle_min = n ? low : NAN;
	g->angle_max = n ? high : NAN;
	g->angle_error = n ? sum / (double)n : NAN;
}

void
mr_mark_boundary(const mr_mesh *m, const mr_edges *edges, bool *boundary)
{
	memset(boundary, 0, m->nv * sizeof *boundary);
	for (size_t e = 0; e < edges->count; e++) {
		uint32_t h = edges->he[edges->start[e]];
		if (mr_edge_faces(edges, e) == 1)
			boundary[mr_he_from(m, h)] = boundary[mr_he_to(m, h)] = true;
	}
}

static void
measure_valence(mr_ctx *ctx, const job *j, mr_geometry *g)
{
	MR_SCOPE(ctx);
	uint32_t *valence = MR_NEW_ZERO(ctx, j->m->nv, uint32_t);
	bool *boundary = MR_NEW(ctx, j->m->nv, bool);
	size_t used = 0, regular = 0;

	mr_mark_boundary(j->m, j->edges, boundary);
	for (size_t e = 0; e < j->edges->count; e++) {
		uint32_t h = j->edges->he[j->edges->start[e]];
		valence[mr_he_from(j->m, h)]++;
		valence[mr_he_to(j->m, h)]++;
	}
	for (size_t v = 0; v < j->m->nv; v++) {
		used += valence[v] > 0;
		regular += valence[v] == (boundary[v] ? 4 : 6);
	}
	g->valence6 = used ? (double)regular / (double)used : NAN;
}

void
mr_measure_geometry(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, mr_geometry *out)
{
	mr_geometry g = { .box = mr_mesh_box(m), .volume = NAN };
	job j = { .m = m, .edges = edges };

	g.diagonal = mr_box_diagonal(g.box);
	g.area = mr_mesh_area(ctx, m);
	if (mr_edges_enclose(m, edges))
		g.volume = mr_mesh_volume(ctx, m);
	measure_edges(ctx, &j, &g);
	measure_angles(ctx, &j, &g);
	measure_valence(ctx, &j, &g);
	*out = g;
}

/* Moves the areas of interior vertices to the front and returns how many there are. */
static size_t
keep_interior(const mr_mesh *m, const mr_edges *edges, bool *boundary, double *area)
{
	size_t n = 0;

	mr_mark_boundary(m, edges, boundary);
	for (size_t v = 0; v < m->nv; v++)
		if (!boundary[v] && area[v] > 0) /* none: isolated, or only in faces without area */
			area[n++] = area[v];
	return n;
}

/* Rounds a ratio's rounding error to zero. */
static double
tidy(double ratio)
{
	return fabs(ratio) < 1e-12 ? 0 : ratio;
}

static void
measure_evenness(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, mr_evenness *out)
{
	MR_SCOPE(ctx);
	double *area = MR_NEW(ctx, m->nv, double), error = 0;
	bool *boundary = MR_NEW(ctx, m->nv, bool);
	mr_spread s;
	size_t n;

	mr_voronoi_areas(ctx, m, area);
	n = keep_interior(m, edges, boundary, area);
	s = spread_of(area, n);
	for (size_t i = 0; i < n; i++)
		error += fabs(area[i] - s.mean);
	*out = (mr_evenness){ n, s.mean, n ? tidy(error / ((double)n * s.mean)) : NAN,
		tidy(s.deviation / s.mean * (s.deviation / s.mean)) };
}

mr_status
mr_measure_surface(mr_ctx *ctx, const mr_mesh *m, bool intersections, mr_surface_figures *out)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_surface_figures s = { .intersections = MR_UNKNOWN };
	mr_edges edges;

	MR_ENTER(ctx);
	mr_edges_build(ctx, m, &edges);
	mr_take_census(ctx, m, &edges, &s.census);
	mr_measure_geometry(ctx, m, &edges, &s.geometry);
	measure_evenness(ctx, m, &edges, &s.evenness);
	mr_mark_release(ctx, mark);
	if (intersections)
		mr_self_intersections(ctx, NULL, m, NULL, &s.intersections);
	*out = s;
	return MR_OK;
}

/* ---- clouds ---- */

static void
measure_sampling(mr_ctx *ctx, const mr_sampling *s, mr_cloud_figures *c)
{
	double *spacing = MR_NEW(ctx, s->n, double);
	size_t count = 0;

	for (size_t i = 0; i < s->n; i++)
		if (!s->repeat[i] && !s->outlier[i])
			spacing[count++] = s->spacing[i];
	c->places = s->places;
	c->outliers = s->outliers;
	c->duplicates = s->n - s->places;
	if (!(s->usual > 0))
		return;
	c->spacing = spread_of(spacing, count);
	c->usual = s->usual;
	c->area = s->area;
	c->evenness = s->evenness;
	c->noise = s->noise;
	c->noise_spacing = s->noise / s->usual;
	c->noise_diagonal = s->noise / c->diagonal;
}

mr_status
mr_measure_points(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_sampling *sampling, mr_cloud_figures *out)
{
	MR_SCOPE(ctx);
	mr_cloud_figures c = { .points = n, .spacing = { NAN, NAN, NAN, NAN } };
	mr_v3 *finite = MR_NEW(ctx, n, mr_v3);
	mr_sampling found;
	size_t count = 0;

	for (size_t i = 0; i < n; i++)
		if (mr_finite(p[i]))
			finite[count++] = p[i];
	c.not_finite = n - count;
	c.box = mr_box_of(finite, count);
	c.diagonal = mr_box_diagonal(c.box);
	c.usual = c.area = c.evenness = c.noise = c.noise_spacing = c.noise_diagonal = NAN;
	MR_TRY(mr_sampling_find(ctx, finite, count, count == n ? sampling : NULL, &found));
	measure_sampling(ctx, &found, &c);
	*out = c;
	return MR_OK;
}

mr_status
mr_measure_cloud(mr_ctx *ctx, mr_frame *f, const char *layer, mr_cloud_figures *figures)
{
	mr_sampling sampling;
	bool stored = false;
	const void *p;
	size_t n;

	MR_ENTER(ctx);
	MR_TRY(mr_layer_get(ctx, f, layer, "position", &p, &n));
	/* where it breaks a law it is found anew; that is for --check to say */
	if (mr_sampling_stored(ctx, f, layer, n, &sampling, &stored) < 0)
		stored = false;
	return mr_measure_points(ctx, p, n, stored ? &sampling : NULL, figures);
}
