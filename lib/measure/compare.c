/*
 * How far two surfaces, or clouds, are from one another: distances from points of one to the nearest point of
 * the other, exact point to triangle.  Mean and root mean square are integrals over the surface by the
 * midpoint rule on a subdivision of its faces; the greatest distance lies between max, which is attained, and
 * max_bound.
 *
 * The greatest distance by branch and bound.  For a triangle t and a face f of the
 * other surface, the distance to f is convex over t, so no point of t is farther
 * from the surface than max over its corners of their distance to f (as in Tang,
 * Lee, Kim 2009, Interactive Hausdorff distance computation for general polygonal
 * models); and none is farther than the centroid's distance and t's radius.
 */
#include "mesh/mesh.h"

#include "base/options.h"
#include "base/parallel.h"
#include "base/priority_queue.h"
#include "mesh/edges.h"
#include "space/bvh.h"

enum { SAMPLES = 100000, EFFORT = 200000, GRAIN = 256, BATCH = 2048, SIDE_MOST = 2048 };

/* Below this share of the diagonal a difference of bounds is rounding. */
static const double ROUNDING = 1e-12;

/* A triangle and what is known of it: no point of it is farther than `bound`. */
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

/* The greatest distance of a corner to face f: that of no point of the triangle is greater. */
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

/* Sums over some points. */
typedef struct sums {
	double min, max, weight, sum, square;
	size_t count;
} sums;

static void
sums_add(sums *s, double d, double weight)
{
	s->min = d < s->min ? d : s->min;
	s->max = d > s->max ? d : s->max;
	s->weight += weight;
	s->sum += weight * d;
	s->square += weight * d * d;
	s->count++;
}

static void
sums_join(sums *s, const sums *t)
{
	s->min = t->min < s->min ? t->min : s->min;
	s->max = t->max > s->max ? t->max : s->max;
	s->weight += t->weight;
	s->sum += t->sum;
	s->square += t->square;
	s->count += t->count;
}

static const sums SUMS_NONE = { INFINITY, 0, 0, 0, 0, 0 };

/* One direction. */
typedef struct job {
	const mr_mesh *a, *b;
	const mr_bvh *bvh; /* of b */
	bool *used;        /* vertices of a that count; NULL: all */
	bool alike;        /* the faces of a and b have the same corners by number */
	double piece_area; /* faces are cut into pieces of at most this */
	sums *sums;        /* per grain of vertices or faces */
	double *bound;     /* per face of a */
	piece *pieces;     /* of one batch, four children each: in `children` */
	piece *children;
	double *reached; /* per child: the distance of its centroid */
	double enough;   /* pieces whose bound is not above this are done */
} job;

/* ---- vertices and integrals ---- */

/* Whether vertex i of a, which a face has, is where that of b is. */
static bool
stays(const job *j, size_t i)
{
	return j->alike && mr_dist(j->a->p[i], j->b->p[i]) == 0;
}

static void
measure_vertices(void *arg, size_t begin, size_t end)
{
	job *j = arg;
	sums s = SUMS_NONE;

	for (size_t i = begin; i < end; i++)
		if (!j->used || j->used[i])
			sums_add(&s, stays(j, i) ? 0 : sqrt(mr_bvh_closest(j->bvh, j->a->p[i]).dist2), 1);
	j->sums[begin / GRAIN] = s;
}

/* Measures the centroid of a piece; raises *bound where the piece may reach beyond what is measured so far.
 */
static void
measure_piece(const job *j, const mr_v3 v[3], double area, sums *s, double *bound)
{
	mr_v3 c = centroid(v);
	mr_closest near = mr_bvh_closest(j->bvh, c);
	double d = sqrt(near.dist2), lipschitz = d + radius(v, c), convex;

	sums_add(s, d, area);
	if (lipschitz <= s->max || lipschitz <= *bound)
		return;
	convex = convex_bound(j->b, near.at.face, v);
	*bound = fmax(*bound, fmin(lipschitz, convex));
}

/* Cuts the face into side^2 triangles of its own shape and measures each. */
static void
measure_face(const job *j, size_t f, sums *s, double *bound)
{
	const uint32_t *t = j->a->t[f].v;
	mr_v3 p = j->a->p[t[0]], area2 = mr_face_cross(j->a, f);
	double area = mr_norm(area2) / 2;
	int side = (int)fmin(SIDE_MOST, fmax(1, ceil(sqrt(area / j->piece_area) - 1e-9)));
	mr_v3 du = mr_mul(1.0 / side, mr_sub(j->a->p[t[1]], p)),
	      dv = mr_mul(1.0 / side, mr_sub(j->a->p[t[2]], p));

	area /= (double)side * side;
	for (int u = 0; u < side; u++)
		for (int w = 0; u + w < side; w++) {
			mr_v3 o = mr_axpy(u, du, mr_axpy(w, dv, p)), x = mr_add(o, du), y = mr_add(o, dv);
			measure_piece(j, (mr_v3[3]){ o, x, y }, area, s, bound);
			if (u + w < side - 1)
				measure_piece(j, (mr_v3[3]){ x, mr_add(x, dv), y }, area, s, bound);
		}
}

static void
measure_faces(void *arg, size_t begin, size_t end)
{
	job *j = arg;
	sums s = SUMS_NONE;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *t = j->a->t[f].v;
		j->bound[f] = 0;
		if (stays(j, t[0]) && stays(j, t[1]) && stays(j, t[2]))
			sums_add(&s, 0, mr_norm(mr_face_cross(j->a, f)) / 2);
		else
			measure_face(j, f, &s, &j->bound[f]);
	}
	j->sums[begin / GRAIN] = s;
}

/* Runs `body` over count things and adds up, in order. */
static void
measure(mr_ctx *ctx, job *j, size_t count, mr_body body, sums *total)
{
	MR_SCOPE(ctx);
	size_t grains = (count + GRAIN - 1) / GRAIN;

	j->sums = MR_NEW(ctx, grains, sums);
	mr_parallel(ctx, count, GRAIN, body, j);
	*total = SUMS_NONE;
	for (size_t i = 0; i < grains; i++)
		sums_join(total, &j->sums[i]);
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

/* ---- one direction ---- */

static mr_distance
distance_of(const sums *s)
{
	return (
	    mr_distance){ s->min, s->max, s->max, s->sum / s->weight, sqrt(s->square / s->weight), s->count };
}

/* From a mesh with area: its vertices for the extremes, pieces of its faces for the integrals. */
static void
measure_surface(mr_ctx *ctx, job *j, const mr_compare_opts *opts, double area, double scale, mr_distance *d)
{
	size_t samples = opts->samples ? opts->samples : SAMPLES;
	sums vertices, faces;

	j->bound = MR_NEW(ctx, j->a->nf, double);
	j->piece_area = area / (double)samples;
	measure(ctx, j, j->a->nv, measure_vertices, &vertices);
	measure(ctx, j, j->a->nf, measure_faces, &faces);
	*d = distance_of(&faces);
	d->min = fmin(d->min, vertices.min);
	d->max = fmax(d->max, vertices.max);
	bound_max(ctx, j, opts, scale, d);
}

/* From a to b, which have faces, of area or not.  alike: their faces have the same corners by number.  scale:
 * a length that bounds are rounded by. */
static void
compare_one_way(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *opts, bool alike,
    double scale, mr_distance *out)
{
	MR_SCOPE(ctx);
	job j = { .a = a, .b = b, .alike = alike && !opts->vertices_only };
	double area = opts->vertices_only ? 0 : mr_mesh_area(ctx, a);
	size_t count;
	mr_bvh *bvh;

	mr_bvh_build(ctx, b, &bvh);
	j.bvh = bvh;
	if (a->nf > 0 && !opts->vertices_only)
		mr_vertices_used(ctx, a->t, a->nf, a->nv, &j.used, &count);
	if (area > 0) {
		measure_surface(ctx, &j, opts, area, scale, out);
	} else {
		sums s;
		measure(ctx, &j, a->nv, measure_vertices, &s);
		*out = distance_of(&s);
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
	return (mr_distance){ fmin(a->min, b->min), fmax(a->max, b->max), fmax(a->max_bound, b->max_bound),
		(a->mean + b->mean) / 2, sqrt((a->rms * a->rms + b->rms * b->rms) / 2),
		a->samples + b->samples };
}

static mr_status
compare(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *o, mr_comparison *out)
{
	MR_SCOPE(ctx);
	mr_comparison c = { .corresponds = mr_same_triangles(a, b), .diagonal = mr_mesh_diagonal(b) };
	double scale = fmax(mr_mesh_diagonal(a), c.diagonal);
	mr_mesh fa, fb;

	MR_TRY(mr_check_number(ctx, "tolerance", o->tolerance, 1e-9, 1));
	MR_TRY(with_faces(ctx, a, &fa));
	MR_TRY(with_faces(ctx, b, &fb));
	compare_one_way(ctx, &fa, &fb, o, c.corresponds, scale, &c.ab);
	compare_one_way(ctx, &fb, &fa, o, c.corresponds, scale, &c.ba);
	c.both = join(&c.ab, &c.ba);
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
