/* Distances from points of one surface or cloud to the nearest point of the other.  Means are integrals by
 * the midpoint rule on a subdivision of the faces.  The greatest distance lies between max, which is
 * attained, and max_bound, found by branch and bound.  No point of a triangle is farther than its farthest
 * corner is from any one face (Tang, Lee, Kim 2009), nor than the centroid's distance and its radius. */
#include "mesh/mesh.h"

#include "base/options.h"
#include "base/parallel.h"
#include "base/priority_queue.h"
#include "mesh/edges.h"
#include "space/bvh.h"
#include "stream/frame.h"

enum { SAMPLES = 100000, EFFORT = 200000, GRAIN = 256, BATCH = 2048, SIDE_MOST = 2048 };

/* Below this share of the diagonal a difference of bounds is rounding. */
static const double ROUNDING = 1e-12;

/* A triangle and its bound: no point of it is farther than `bound`. */
typedef struct piece {
	mr_v3 v[3];
	uint32_t face; /* of the other surface, near its centroid */
	double bound;
} piece;

static mr_v3
centroid(const mr_v3 v[3])
{
	return mr_mean3(v[0], v[1], v[2]);
}

static double
radius(const mr_v3 v[3], mr_v3 c)
{
	return sqrt(
	    fmax(mr_norm2(mr_sub(v[0], c)), fmax(mr_norm2(mr_sub(v[1], c)), mr_norm2(mr_sub(v[2], c)))));
}

/* The greatest distance of a corner to face f, and so of any point of the triangle. */
static double
convex_bound(const mr_mesh *b, uint32_t f, const mr_v3 v[3])
{
	double most = 0;

	for (int i = 0; i < 3; i++) {
		double d2 = mr_face_closest(b, f, v[i]).dist2;
		most = d2 > most ? d2 : most;
	}
	return sqrt(most);
}

/* Measures of a point: the distance, the angle between the normals in degrees (NaN: none). */
typedef struct sample {
	double distance, angle, weight;
} sample;

/* One direction. */
typedef struct job {
	const mr_mesh *a, *b;
	const mr_bvh *bvh; /* of b */
	bool *used;        /* vertices of a that count; NULL: all */
	bool alike;        /* the faces of a and b have the same corners by number */
	double piece_area; /* faces are cut into pieces of at most this */
	sample *samples;   /* of vertex i at i, or of face f from first[f] on */
	size_t *first;     /* NULL: vertices */
	double *bound;     /* per face of a */
	piece *pieces;     /* of one batch, four children each: in `children` */
	piece *children;
	double *reached; /* per child: the distance of its centroid */
	double enough;   /* pieces whose bound is not above this are done */
} job;

/* ---- vertices and integrals ---- */

/* Whether vertex i of a, which a face has, coincides with vertex i of b. */
static bool
stays(const job *j, size_t i)
{
	return j->alike && mr_dist(j->a->p[i], j->b->p[i]) == 0;
}

static void
measure_vertices(void *arg, size_t begin, size_t end)
{
	job *j = arg;

	for (size_t i = begin; i < end; i++)
		if (!j->used || j->used[i])
			j->samples[i] = (sample){
				stays(j, i) ? 0 : sqrt(mr_bvh_closest(j->bvh, j->a->p[i]).dist2), NAN, 1
			};
}

/* The angle between two normals, in degrees. */
static double
deviation(mr_v3 a, mr_v3 b)
{
	return mr_norm2(a) > 0 && mr_norm2(b) > 0 ? mr_angle(a, b) * 180 / MR_PI : NAN;
}

/* Measures the centroid of a piece; raises *bound if the piece may reach beyond the centroid's distance. */
static void
measure_piece(
    const job *j, const mr_v3 v[3], mr_v3 normal, double area, double *most, sample *at, double *bound)
{
	mr_v3 c = centroid(v);
	mr_closest near = mr_bvh_closest(j->bvh, c);
	double d = sqrt(near.dist2), lipschitz = d + radius(v, c), convex;

	*most = fmax(*most, d);
	*at = (sample){ d, deviation(normal, mr_face_cross(j->b, near.at.face)), area };
	if (lipschitz <= *most || lipschitz <= *bound)
		return;
	convex = convex_bound(j->b, near.at.face, v);
	*bound = fmax(*bound, fmin(lipschitz, convex));
}

/* Into how many parts each side of face f is cut. */
static int
parts_of_side(const job *j, size_t f)
{
	double area = mr_norm(mr_face_cross(j->a, f)) / 2;

	return (int)fmin(SIDE_MOST, fmax(1, ceil(sqrt(area / j->piece_area) - 1e-9)));
}

/* Cuts the face into side^2 triangles of its own shape and measures each. */
static void
measure_face(const job *j, size_t f, double *most, double *bound)
{
	const uint32_t *t = j->a->t[f].v;
	mr_v3 p = j->a->p[t[0]], area2 = mr_face_cross(j->a, f);
	int side = parts_of_side(j, f);
	double area = mr_norm(area2) / 2 / ((double)side * side);
	sample *at = j->samples + j->first[f];
	mr_v3 du = mr_mul(1.0 / side, mr_sub(j->a->p[t[1]], p)),
	      dv = mr_mul(1.0 / side, mr_sub(j->a->p[t[2]], p));

	for (int u = 0; u < side; u++)
		for (int w = 0; u + w < side; w++) {
			mr_v3 o = mr_axpy(u, du, mr_axpy(w, dv, p)), x = mr_add(o, du), y = mr_add(o, dv);
			measure_piece(j, (mr_v3[3]){ o, x, y }, area2, area, most, at++, bound);
			if (u + w < side - 1)
				measure_piece(
				    j, (mr_v3[3]){ x, mr_add(x, dv), y }, area2, area, most, at++, bound);
		}
}

static void
measure_faces(void *arg, size_t begin, size_t end)
{
	job *j = arg;
	double most = 0;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *t = j->a->t[f].v;
		j->bound[f] = 0;
		if (stays(j, t[0]) && stays(j, t[1]) && stays(j, t[2]))
			j->samples[j->first[f]].weight = mr_norm(mr_face_cross(j->a, f)) / 2;
		else
			measure_face(j, f, &most, &j->bound[f]);
	}
}

/* ---- branch and bound ---- */

/* The piece of greatest bound first. */
typedef struct queue {
	piece *p;
	size_t n, room;
} queue;

static bool
greater(const void *a, const void *b)
{
	const piece *x = a, *y = b;

	return x->bound > y->bound;
}

static void
push(mr_ctx *ctx, queue *q, const piece *x)
{
	MR_RESERVE(ctx, q->p, q->n, 1, &q->room);
	mr_queue_push(q->p, q->n++, sizeof *x, x, greater);
}

/* The four triangles between corners and midpoints of edges. */
static void
quarter(const mr_v3 v[3], mr_v3 out[4][3])
{
	mr_v3 m[3] = { mr_lerp(0.5, v[1], v[2]), mr_lerp(0.5, v[2], v[0]), mr_lerp(0.5, v[0], v[1]) };

	for (int i = 0; i < 3; i++) {
		out[i][0] = v[i];
		out[i][1] = m[(i + 2) % 3];
		out[i][2] = m[(i + 1) % 3];
	}
	memcpy(out[3], m, sizeof m);
}

/* A part of `parent`: it needs no query where the parent's face will do. */
static void
bound_child(const job *j, const piece *parent, const mr_v3 v[3], piece *child, double *reached)
{
	mr_v3 c = centroid(v);
	mr_closest near;
	double convex = convex_bound(j->b, parent->face, v);

	memcpy(child->v, v, sizeof child->v);
	child->face = parent->face;
	child->bound = fmin(parent->bound, convex);
	*reached = 0;
	if (child->bound <= j->enough)
		return;
	near = mr_bvh_closest(j->bvh, c);
	*reached = sqrt(near.dist2);
	child->bound = fmin(child->bound, *reached + radius(v, c));
	if (near.at.face != parent->face)
		child->bound = fmin(child->bound, convex_bound(j->b, near.at.face, v));
	child->face = near.at.face;
}

static void
bound_children(void *arg, size_t begin, size_t end)
{
	job *j = arg;
	mr_v3 part[4][3];

	for (size_t i = begin; i < end; i++) {
		quarter(j->pieces[i].v, part);
		for (size_t k = 0; k < 4; k++)
			bound_child(
			    j, &j->pieces[i], part[k], &j->children[4 * i + k], &j->reached[4 * i + k]);
	}
}

static double
enough_for(double max, double tolerance, double scale)
{
	return max * (1 + tolerance) + ROUNDING * scale;
}

static void
push_faces(mr_ctx *ctx, const job *j, queue *q)
{
	for (size_t f = 0; f < j->a->nf; f++) {
		piece x = { .bound = j->bound[f] };
		if (x.bound <= j->enough)
			continue;
		for (int i = 0; i < 3; i++)
			x.v[i] = j->a->p[j->a->t[f].v[i]];
		x.face = mr_bvh_closest(j->bvh, centroid(x.v)).at.face;
		push(ctx, q, &x);
	}
}

/* Cuts the pieces of greatest bound until none is above `enough`, or the effort is spent. */
static void
search(mr_ctx *ctx, job *j, queue *q, size_t effort, double tolerance, double scale, mr_distance *d)
{
	while (q->n && q->p[0].bound > j->enough && effort) {
		size_t n = 0;
		for (; n < BATCH && n < effort && q->n && q->p[0].bound > j->enough; n++)
			mr_queue_pop(q->p, q->n--, sizeof *q->p, &j->pieces[n], greater);
		effort -= n;
		mr_parallel(ctx, n, 16, bound_children, j);
		for (size_t i = 0; i < 4 * n; i++)
			d->max = fmax(d->max, j->reached[i]);
		j->enough = enough_for(d->max, tolerance, scale);
		for (size_t i = 0; i < 4 * n; i++)
			if (j->children[i].bound > j->enough)
				push(ctx, q, &j->children[i]);
	}
	d->max_bound = fmax(j->enough, q->n ? q->p[0].bound : 0);
}

static void
bound_max(mr_ctx *ctx, job *j, const mr_compare_opts *opts, double scale, mr_distance *d)
{
	size_t effort = opts->effort ? opts->effort : j->a->nf > EFFORT / 2 ? 2 * j->a->nf : EFFORT;
	queue q = { NULL, 0, 0 };
	double most = 0;

	j->pieces = MR_NEW(ctx, BATCH, piece);
	j->children = MR_NEW(ctx, (size_t)4 * BATCH, piece);
	j->reached = MR_NEW(ctx, (size_t)4 * BATCH, double);
	j->enough = enough_for(d->max, opts->tolerance, scale);
	for (size_t f = 0; f < j->a->nf; f++)
		most = fmax(most, j->bound[f]);
	if (most <= j->enough) {
		d->max_bound = fmax(most, d->max);
		return;
	}
	push_faces(ctx, j, &q);
	search(ctx, j, &q, effort, opts->tolerance, scale, d);
}

/* ---- quantiles ---- */

/* The distance that this share of the weight does not exceed: Hoare's selection, by weight; NaN of none. */
static double
quantile(sample *s, size_t n, double share)
{
	double target = 0;

	for (size_t i = 0; i < n; i++)
		target += share * s[i].weight;
	while (n > 1) {
		double pivot = s[(n - 1) / 2].distance, below = 0;
		size_t i = 0, j = n - 1;
		for (;; i++, j--) {
			while (s[i].distance < pivot)
				i++;
			while (s[j].distance > pivot)
				j--;
			if (i >= j)
				break;
			sample kept = s[i];
			s[i] = s[j];
			s[j] = kept;
		}
		for (i = 0; i <= j; i++)
			below += s[i].weight;
		if (target <= below) {
			n = j + 1;
		} else {
			target -= below;
			s += j + 1;
			n -= j + 1;
		}
	}
	return target > 0 ? s->distance : NAN;
}

/* Scales the weights so that they add up to 1; the mean distance. */
static double
weigh(sample *s, size_t n)
{
	double weight = 0, sum = 0;

	for (size_t i = 0; i < n; i++) {
		weight += s[i].weight;
		sum += s[i].weight * s[i].distance;
	}
	for (size_t i = 0; weight > 0 && i < n; i++)
		s[i].weight /= weight;
	return sum / weight;
}

/* Quantiles of all samples, a's first: four each of a to b, b to a, both; at last of the angles. */
static void
find_quantiles(sample *s, size_t from_a, size_t n, mr_comparison *c)
{
	static const double share[4] = { 0.5, 0.9, 0.95, 0.99 };
	mr_distance *d[3] = { &c->ab, &c->ba, &c->both };
	sample *const begin[3] = { s, s + from_a, s };
	const size_t count[3] = { from_a, n - from_a, n };

	for (int angles = 0; angles < 2; angles++) {
		for (size_t i = 0; angles && i < n; i++) {
			bool known = !isnan(s[i].angle);
			s[i].distance = known ? s[i].angle : 0;
			s[i].weight = known ? s[i].weight : 0;
		}
		for (int k = 0; k < 3; k++) {
			double mean = weigh(begin[k], count[k]);
			double *to = angles ? d[k]->normal_quantile : d[k]->quantile;
			for (int i = 0; i < 4; i++)
				to[i] = quantile(begin[k], count[k], share[i]);
			if (angles)
				d[k]->normal_mean = mean;
		}
	}
}

/* ---- one direction ---- */

static mr_distance
distance_of(const sample *s, size_t n)
{
	mr_distance d = { .min = INFINITY };
	double weight = 0, sum = 0, square = 0;

	for (; n > 0; n--, s++) {
		if (s->weight == 0)
			continue;
		d.min = fmin(d.min, s->distance);
		d.max = d.max_bound = fmax(d.max, s->distance);
		weight += s->weight;
		sum += s->weight * s->distance;
		square += s->weight * s->distance * s->distance;
		d.samples++;
	}
	d.mean = sum / weight;
	d.rms = sqrt(square / weight);
	return d;
}

/* All that was measured: for quantiles. */
typedef struct samples {
	sample *s;
	size_t n, room;
} samples;

/* From a mesh with area, n pieces of its faces: with its vertices for the extremes. */
static void
measure_surface(mr_ctx *ctx, job *j, size_t n, const mr_compare_opts *opts, double scale, mr_distance *d)
{
	job corners = *j;
	mr_distance of_vertices;

	corners.samples = MR_NEW_ZERO(ctx, j->a->nv, sample);
	mr_parallel(ctx, j->a->nv, GRAIN, measure_vertices, &corners);
	of_vertices = distance_of(corners.samples, j->a->nv);
	j->bound = MR_NEW(ctx, j->a->nf, double);
	mr_parallel(ctx, j->a->nf, GRAIN, measure_faces, j);
	*d = distance_of(j->samples, n);
	d->min = fmin(d->min, of_vertices.min);
	d->max = fmax(d->max, of_vertices.max);
	bound_max(ctx, j, opts, scale, d);
}

/* Makes room for the samples of every face, in pieces of this area at most, or of every vertex. */
static size_t
begin_samples(mr_ctx *ctx, job *j, samples *all)
{
	size_t n = 0;

	if (j->piece_area > 0)
		j->first = MR_NEW(ctx, j->a->nf, size_t);
	for (size_t f = 0; j->first && f < j->a->nf; f++) {
		j->first[f] = n;
		n += (size_t)mr_square(parts_of_side(j, f));
	}
	n = j->first ? n : j->a->nv;
	MR_RESERVE(ctx, all->s, all->n, n, &all->room);
	j->samples = all->s + all->n;
	memset(j->samples, 0, n * sizeof *j->samples);
	all->n += n;
	return n;
}

/* From a to b, which have faces, of area or not.  alike: their faces have the same corners by number.  scale:
 * a length that bounds are rounded by. */
static void
compare_one_way(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *opts, bool alike,
    double scale, samples *all, mr_distance *out)
{
	double area = opts->vertices_only ? 0 : mr_mesh_area(ctx, a);
	double count = opts->samples ? (double)opts->samples : SAMPLES;
	job j = { .a = a, .b = b, .alike = alike && !opts->vertices_only, .piece_area = area / count };

	size_t n = begin_samples(ctx, &j, all);
	MR_SCOPE(ctx);
	mr_bvh *bvh;

	mr_bvh_build(ctx, b, &bvh);
	j.bvh = bvh;
	if (a->nf > 0 && !opts->vertices_only)
		mr_vertices_used(ctx, a->t, a->nf, a->nv, &j.used, &(size_t){ 0 });
	if (area > 0) {
		measure_surface(ctx, &j, n, opts, scale, out);
	} else {
		mr_parallel(ctx, a->nv, GRAIN, measure_vertices, &j);
		*out = distance_of(j.samples, n);
	}
}

/* ---- both, and of one connectivity ---- */

/* A cloud as a mesh of faces without area, one a point. */
static mr_status
with_faces(mr_ctx *ctx, const mr_mesh *m, mr_mesh *out)
{
	mr_tri *t;

	*out = *m;
	if (m->nf)
		return MR_OK;
	if (m->nv == 0)
		return mr_fail(ctx, MR_EMESH, "%s: no points to compare", m->name);
	if (m->nv > (MR_NONE - 1) / 3)
		return mr_fail(
		    ctx, MR_ERANGE, "%s: %zu points are more than %u", m->name, m->nv, (MR_NONE - 1) / 3);
	t = MR_NEW(ctx, m->nv, mr_tri);
	for (uint32_t i = 0; i < m->nv; i++)
		t[i] = (mr_tri){ { i, i, i } };
	out->t = t;
	out->nf = m->nv;
	return MR_OK;
}

static void
measure_deviation(const mr_mesh *a, const mr_mesh *b, mr_deviation *d)
{
	double sum = 0, square = 0;

	d->max = -1;
	for (size_t i = 0; i < a->nv; i++) {
		double x = mr_dist(a->p[i], b->p[i]);
		if (x > d->max) {
			d->max = x;
			d->vertex = i;
		}
		sum += x;
		square += x * x;
	}
	d->mean = sum / (double)a->nv;
	d->rms = sqrt(square / (double)a->nv);
}

static void
measure_stretch(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, mr_deviation *d)
{
	MR_SCOPE(ctx);
	double low = INFINITY, high = 0, sum = 0;
	mr_edges edges;
	size_t n = 0;

	mr_edges_build(ctx, a, &edges);
	for (size_t e = 0; e < edges.count; e++) {
		uint32_t h = edges.he[edges.start[e]], from = mr_he_from(a, h), to = mr_he_to(a, h);
		double stretch = mr_dist(b->p[from], b->p[to]) / mr_dist(a->p[from], a->p[to]);
		if (isnan(stretch)) /* of length 0 in both */
			continue;
		low = fmin(low, stretch);
		high = fmax(high, stretch);
		sum += stretch;
		n++;
	}
	d->stretch_min = n ? low : NAN;
	d->stretch_max = n ? high : NAN;
	d->stretch_mean = n ? sum / (double)n : NAN;
}

static mr_distance
join(const mr_distance *a, const mr_distance *b)
{
	return (mr_distance){ .min = fmin(a->min, b->min),
		.max = fmax(a->max, b->max),
		.max_bound = fmax(a->max_bound, b->max_bound),
		.mean = (a->mean + b->mean) / 2,
		.rms = sqrt((a->rms * a->rms + b->rms * b->rms) / 2),
		.samples = a->samples + b->samples };
}

static mr_status
compare(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *o, mr_comparison *out)
{
	MR_SCOPE(ctx);
	mr_comparison c = { .corresponds = mr_same_triangles(a, b), .diagonal = mr_mesh_diagonal(b) };
	double scale = fmax(mr_mesh_diagonal(a), c.diagonal);
	mr_mesh fa, fb;
	samples all = { 0 };
	size_t from_a;

	MR_TRY(mr_check_number(ctx, "tolerance", o->tolerance, 1e-9, 1));
	MR_TRY(with_faces(ctx, a, &fa));
	MR_TRY(with_faces(ctx, b, &fb));
	compare_one_way(ctx, &fa, &fb, o, c.corresponds, scale, &all, &c.ab);
	from_a = all.n;
	compare_one_way(ctx, &fb, &fa, o, c.corresponds, scale, &all, &c.ba);
	c.both = join(&c.ab, &c.ba);
	find_quantiles(all.s, from_a, all.n, &c);
	if (c.corresponds) {
		measure_deviation(a, b, &c.deviation);
		measure_stretch(ctx, a, b, &c.deviation);
	}
	*out = c;
	return MR_OK;
}

mr_status
mr_compare(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *opts, mr_comparison *out)
{
	static const mr_compare_opts defaults = MR_COMPARE_DEFAULTS;

	MR_ENTER(ctx);
	return compare(ctx, a, b, opts ? opts : &defaults, out);
}

/* ---- a map ---- */

typedef struct map_job {
	const mr_mesh *a, *b;
	const mr_bvh *bvh;       /* of b */
	const mr_topology *topo; /* NULL: distances have no sign */
	mr_v3 *normal;           /* of b's vertices */
	double *distance;
} map_job;

/* The normal that separates inside from outside: of a face; of an edge the sum of both; of a vertex the mean
 * by angles (Baerentzen, Aanaes 2005). */
static mr_v3
side_normal(const map_job *j, mr_place at)
{
	const double w[3] = { at.bary.x, at.bary.y, at.bary.z };
	uint32_t f = at.face, twin = MR_NONE;

	for (uint32_t i = 0; i < 3; i++) {
		if (w[i] == 0 && w[(i + 1) % 3] == 0)
			return j->normal[j->b->t[f].v[(i + 2) % 3]];
		if (w[i] == 0)
			twin = j->topo->twin[3 * f + (i + 1) % 3] / 3;
	}
	mr_v3 n = mr_unit(mr_face_cross(j->b, f));
	return twin == MR_NONE ? n : mr_add(n, mr_unit(mr_face_cross(j->b, twin)));
}

static void
map_vertices(void *arg, size_t begin, size_t end)
{
	const map_job *j = arg;

	for (size_t i = begin; i < end; i++) {
		mr_closest near = mr_bvh_closest(j->bvh, j->a->p[i]);
		double d = sqrt(near.dist2);
		bool within = j->topo && mr_dot(side_normal(j, near.at), mr_sub(j->a->p[i], near.point)) < 0;
		j->distance[i] = within ? -d : d;
	}
}

static bool
is_closed(const mr_topology *topo, size_t nf)
{
	for (size_t h = 0; h < 3 * nf; h++)
		if (topo->twin[h] == MR_NONE)
			return false;
	return true;
}

mr_status
mr_compare_put(
    mr_ctx *ctx, mr_frame *f, const char *layer, const char *column, const mr_mesh *a, const mr_mesh *b)
{
	MR_ENTER(ctx);
	double *distance = MR_NEW(ctx, a->nv, double);
	map_job j = { .a = a, .distance = distance };
	mr_topology topo;
	mr_mesh fb;
	mr_bvh *bvh;

	MR_TRY(with_faces(ctx, b, &fb));
	j.b = &fb;
	if (b->nf && mr_topology_build(ctx, b, &topo) == MR_OK && is_closed(&topo, b->nf)) {
		j.topo = &topo;
		j.normal = MR_NEW(ctx, b->nv, mr_v3);
		mr_vertex_normals(b, j.normal);
	}
	mr_bvh_build(ctx, &fb, &bvh);
	j.bvh = bvh;
	mr_parallel(ctx, a->nv, GRAIN, map_vertices, &j);
	return mr_frame_put(ctx, f, layer, column, (mr_shape){ 'v', 'd', 1 }, distance, a->nv);
}
