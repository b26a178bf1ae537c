/*
 * The bumpy creature: a smooth implicit body around a skeleton, polygonised and relaxed
 * until its edges are about equal, refined by halving edges, under a skin of scales.
 */
#include "shape/parts.h"

#include "base/parallel.h"
#include "base/random.h"

/* A round cone from a to b. */
typedef struct bone {
	mr_v3 a, b;
	double ra, rb;
} bone;

static const bone bones[] = {
	{ { 0.00, -0.10, 0.00 }, { 0.00, 0.48, 0.05 }, 0.56, 0.40 }, /* trunk */
	{ { 0.00, 0.60, 0.08 }, { 0.00, 1.06, 0.22 }, 0.27, 0.38 },  /* neck and head */
	{ { 0.00, 1.00, 0.35 }, { 0.00, 0.94, 0.74 }, 0.25, 0.17 },  /* snout */
	{ { 0.24, 1.32, 0.12 }, { 0.42, 1.68, 0.00 }, 0.16, 0.10 },  /* ears */
	{ { -0.24, 1.32, 0.12 }, { -0.42, 1.68, 0.00 }, 0.16, 0.10 },
	{ { 0.38, 0.45, 0.05 }, { 0.90, 0.32, 0.18 }, 0.20, 0.16 }, /* one arm is raised */
	{ { 0.90, 0.32, 0.18 }, { 1.24, 0.82, 0.40 }, 0.16, 0.19 },
	{ { -0.38, 0.45, 0.05 }, { -0.86, 0.14, 0.16 }, 0.20, 0.16 }, /* one points ahead */
	{ { -0.86, 0.14, 0.16 }, { -1.02, 0.12, 0.72 }, 0.16, 0.19 },
	{ { 0.28, -0.40, 0.00 }, { 0.46, -0.82, 0.16 }, 0.31, 0.23 }, /* legs */
	{ { 0.46, -0.82, 0.16 }, { 0.48, -1.24, 0.02 }, 0.20, 0.18 },
	{ { 0.48, -1.26, 0.02 }, { 0.53, -1.28, 0.36 }, 0.19, 0.15 },
	{ { -0.28, -0.40, 0.00 }, { -0.46, -0.82, 0.16 }, 0.31, 0.23 },
	{ { -0.46, -0.82, 0.16 }, { -0.48, -1.24, 0.02 }, 0.20, 0.18 },
	{ { -0.48, -1.26, 0.02 }, { -0.53, -1.28, 0.36 }, 0.19, 0.15 },
	{ { 0.00, -0.32, -0.25 }, { 0.06, -0.72, -0.84 }, 0.34, 0.23 }, /* tail */
	{ { 0.06, -0.72, -0.84 }, { 0.34, -0.82, -1.32 }, 0.22, 0.16 },
	{ { 0.34, -0.82, -1.32 }, { 0.82, -0.50, -1.54 }, 0.16, 0.11 },
};
enum { BONES = sizeof bones / sizeof *bones };

static const double BLEND = 14, CELL = 0.16, DEPTH = 0.05, AREA = 14.6;
static const mr_box SPACE = { { -1.35, -1.65, -1.85 }, { 1.55, 1.95, 1.1 } };

/* The distance of x from a bone, and the direction from it. */
static double
bone_distance(const bone *b, mr_v3 x, mr_v3 *direction)
{
	mr_v3 along = mr_sub(b->b, b->a), d = mr_sub(x, b->a);
	double t = fmin(fmax(mr_dot(d, along) / mr_norm2(along), 0), 1), length;

	d = mr_axpy(-t, along, d);
	length = mr_norm(d);
	*direction = length > 0 ? mr_mul(1 / length, d) : d;
	return length - b->ra - t * (b->rb - b->ra);
}

/* The body is where this is negative: a smooth minimum of the distances from bones, with its gradient. */
static double
body(mr_v3 x, mr_v3 *gradient)
{
	double distance[BONES], least = INFINITY, sum = 0;
	mr_v3 direction[BONES], g = mr_vec(0, 0, 0);

	for (size_t i = 0; i < BONES; i++) {
		distance[i] = bone_distance(&bones[i], x, &direction[i]);
		least = fmin(least, distance[i]);
	}
	for (size_t i = 0; i < BONES; i++) {
		double w = BLEND * (distance[i] - least);
		if (w > 30)
			continue;
		w = exp(-w);
		g = mr_axpy(w, direction[i], g);
		sum += w;
	}
	*gradient = mr_mul(1 / sum, g);
	return least - log(sum) / BLEND;
}

static double
body_field(void *arg, mr_v3 x)
{
	mr_v3 gradient;

	(void)arg;
	return body(x, &gradient);
}

/* x brought to the body by Newton steps along the gradient. */
static mr_v3
project(mr_v3 x, int steps)
{
	for (int i = 0; i < steps; i++) {
		mr_v3 g;
		double f = body(x, &g);
		x = mr_axpy(-f / fmax(mr_norm2(g), 0.25), g, x);
	}
	return x;
}

/* The seed point of a cell of the lattice that the scales grow from. */
static mr_v3
scale_seed(long i, long j, long k)
{
	mr_random r = { (uint64_t)(i + 4096) << 40 | (uint64_t)(j + 4096) << 20 | (uint64_t)(k + 4096) };
	double x = mr_random_real(&r), y = mr_random_real(&r), z = mr_random_real(&r);

	return mr_vec((double)i + 0.15 + 0.7 * x, (double)j + 0.15 + 0.7 * y, (double)k + 0.15 + 0.7 * z);
}

/* Worley's cellular noise (1996): how much nearer the nearest seed is than the next, in cells. */
static double
scales(mr_v3 x)
{
	mr_v3 q = mr_mul(1 / CELL, x);
	long a = (long)floor(q.x), b = (long)floor(q.y), c = (long)floor(q.z);
	double first = INFINITY, second = INFINITY;

	for (int n = 0; n < 27; n++) {
		double d = mr_dist(q, scale_seed(a + n % 3 - 1, b + n / 3 % 3 - 1, c + n / 9 - 1));
		second = fmin(second, fmax(first, d));
		first = fmin(first, d);
	}
	return second - first;
}

/* The height of the skin over the body: domed scales with grooves between, finer waves over all. */
static double
skin(mr_v3 x)
{
	double groove = scales(x), dome = 1 - exp(-5 * groove * sqrt(groove));
	double waves = sin(31 * x.x + 2 * sin(9 * x.y)) * sin(29 * x.y) * sin(33 * x.z + 2 * sin(7 * x.x));

	return DEPTH * (dome - 0.5) + 0.2 * DEPTH * waves;
}

static mr_v3
skin_point(mr_v3 x)
{
	mr_v3 gradient;

	body(x, &gradient);
	return mr_axpy(skin(x), mr_unit(gradient), x);
}

/* Splits each face in four, with new vertices in the middles of edges. */
static mr_status
refine(mr_ctx *ctx, const mr_solid_build *old, mr_solid_build *b)
{
	mr_mark mark;
	mr_solid_weld w;

	MR_TRY(mr_solid_begin(ctx, 4 * old->nv - 6, 4 * old->nf, b)); /* V + E, with E = 3 V - 6 */
	mark = mr_mark_take(ctx);
	mr_weld_begin(ctx, 3 * old->nv, &w);
	for (; b->nv < old->nv; b->nv++)
		b->p[b->nv] = old->p[b->nv];
	for (size_t f = 0; f < old->nf; f++) {
		const uint32_t *v = old->t[f].v;
		uint32_t m[3];
		for (int i = 0; i < 3; i++) {
			uint32_t a = v[i], c = v[(i + 1) % 3];
			bool is_new;
			uint32_t *slot = mr_weld_slot(
			    &w, a < c ? (uint64_t)a << 32 | c : (uint64_t)c << 32 | a, &is_new);
			if (is_new)
				*slot = mr_solid_add_vertex(b, mr_lerp(0.5, old->p[a], old->p[c]));
			m[i] = *slot;
		}
		for (int i = 0; i < 3; i++)
			mr_solid_add_face(b, v[i], m[i], m[(i + 2) % 3]);
		mr_solid_add_face(b, m[0], m[1], m[2]);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

typedef struct relaxing {
	const mr_adjacency *a;
	const mr_v3 *from;
	mr_v3 *to;
} relaxing;

/* Moves vertices towards their neighbours, the more the farther those are, and back to the body. */
static void
relax_body(void *arg, size_t begin, size_t end)
{
	const relaxing *r = arg;

	for (size_t i = begin; i < end; i++) {
		mr_v3 here = r->from[i], sum = mr_vec(0, 0, 0);
		double weight = 0;
		for (size_t k = r->a->start[i]; k < r->a->start[i + 1]; k++) {
			mr_v3 edge = mr_sub(r->from[r->a->adj[k]], here);
			double w = mr_norm(edge);
			sum = mr_axpy(w, edge, sum);
			weight += w;
		}
		r->to[i] = project(mr_axpy(weight > 0 ? 0.45 / weight : 0, sum, here), 1);
	}
}

static mr_status
relax(mr_ctx *ctx, mr_solid_build *b, int rounds)
{
	mr_mesh m = { .name = "bumpy", .p = b->p, .t = b->t, .nv = b->nv, .nf = b->nf };
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *other = MR_NEW(ctx, b->nv, mr_v3);
	mr_adjacency a;

	MR_TRY(mr_adjacency_build(ctx, &m, &a));
	for (int i = 0; i < 2 * rounds; i++) { /* an even number: the result ends in b->p */
		relaxing r = { &a, i % 2 ? other : b->p, i % 2 ? b->p : other };
		mr_parallel(ctx, b->nv, 1024, relax_body, &r);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static void
clothe_body(void *arg, size_t begin, size_t end)
{
	mr_v3 *p = arg;

	for (size_t i = begin; i < end; i++)
		p[i] = skin_point(project(p[i], 3));
}

mr_status
mr_bumpy(mr_ctx *ctx, size_t n, mr_solid_build *b)
{
	enum { LEAST = 5000, MOST = 80000 };
	double vertices = n > LEAST ? (double)n : LEAST; /* fewer would cut off the ears */
	int levels = 0;

	for (; vertices > MOST; vertices /= 4)
		levels++;
	MR_TRY(mr_march(ctx, body_field, NULL, SPACE, sqrt(4.49 * AREA / vertices), b));
	MR_TRY(relax(ctx, b, 8));
	for (int i = 0; i < levels; i++) {
		mr_solid_build old = *b;
		MR_TRY(refine(ctx, &old, b));
		MR_TRY(relax(ctx, b, 1));
	}
	mr_parallel(ctx, b->nv, 1024, clothe_body, b->p);
	return MR_OK;
}
