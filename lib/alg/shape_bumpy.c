/*
 * The bumpy creature: a smooth star-shaped body with limbs, twisted, under a skin of
 * scales.  A geodesic sphere is laid over the body coarsely, relaxed until its edges
 * are about equal, and refined by halving edges.
 */
#include "alg/shape_parts.h"

#include "base/parallel.h"
#include "base/random.h"

/* radius(d) = core + sum height exp(-sharpness (1 - d . axis)) for a direction d */
typedef struct limb {
	mr_v3 axis;
	double height, sharpness;
} limb;

static const limb limbs[] = {
	{ { 0.000, 0.970, 0.243 }, 0.62, 7 },                                             /* head */
	{ { 0.450, 0.880, 0.150 }, 0.50, 60 },                                            /* ears */
	{ { -0.450, 0.880, 0.150 }, 0.50, 60 }, { { 0.000, 0.690, 0.724 }, 0.28, 40 },    /* snout */
	{ { 0.890, 0.190, 0.414 }, 0.95, 22 },                                            /* arms */
	{ { -0.890, 0.190, 0.414 }, 0.95, 22 }, { { 0.480, -0.850, 0.217 }, 0.95, 22 },   /* legs */
	{ { -0.480, -0.850, 0.217 }, 0.95, 22 }, { { 0.000, -0.430, -0.903 }, 1.10, 26 }, /* tail */
};
enum { LIMBS = sizeof limbs / sizeof *limbs };

static const double CORE = 0.62, TWIST = 0.35, CELL = 0.15, DEPTH = 0.045;

/* The body's point in the direction x. */
static mr_v3
body_point(mr_v3 x)
{
	mr_v3 d = mr_unit(x);
	double r = CORE;

	for (size_t i = 0; i < LIMBS; i++)
		r += limbs[i].height * exp(-limbs[i].sharpness * (1 - mr_dot(d, mr_unit(limbs[i].axis))));
	return mr_mul(r, d);
}

/* Its unit normal there: the gradient of |x| - radius(x / |x|). */
static mr_v3
body_normal(mr_v3 x)
{
	double r = mr_norm(x);
	mr_v3 d = mr_mul(1 / r, x), n = d;

	for (size_t i = 0; i < LIMBS; i++) {
		mr_v3 axis = mr_unit(limbs[i].axis);
		double along = mr_dot(d, axis), k = limbs[i].sharpness;
		double slope = limbs[i].height * k * exp(-k * (1 - along));
		n = mr_axpy(-slope / r, mr_axpy(-along, d, axis), n);
	}
	return mr_unit(n);
}

/* Turns x about the y axis by an angle that grows with y. */
static mr_v3
twist(mr_v3 x, double rate)
{
	double c = cos(rate * x.y), s = sin(rate * x.y);

	return mr_vec(c * x.x + s * x.z, x.y, c * x.z - s * x.x);
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
	double dome = 1 - exp(-3.5 * scales(x));
	double waves = sin(31 * x.x + 2 * sin(9 * x.y)) * sin(29 * x.y) * sin(33 * x.z + 2 * sin(7 * x.x));

	return DEPTH * (dome - 0.5) + 0.2 * DEPTH * waves;
}

static mr_v3
skin_point(mr_v3 x)
{
	return mr_axpy(skin(x), body_normal(x), x);
}

/* Splits each face in four, with new vertices in the middles of edges. */
static mr_status
refine(mr_ctx *ctx, const build *old, build *b)
{
	mr_mark mark;
	weld w;

	MR_TRY(mr_build_begin(ctx, 4 * old->nv - 6, 4 * old->nf, b)); /* V + E, with E = 3 V - 6 */
	mark = mr_mark_take(ctx);
	MR_TRY(mr_weld_begin(ctx, 3 * old->nv, &w));
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
			if (is_new) {
				b->p[b->nv] = mr_lerp(0.5, old->p[a], old->p[c]);
				*slot = (uint32_t)b->nv++;
			}
			m[i] = *slot;
		}
		for (int i = 0; i < 3; i++)
			mr_build_face(b, v[i], m[i], m[(i + 2) % 3]);
		mr_build_face(b, m[0], m[1], m[2]);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

typedef struct relaxing {
	const mr_adjacency *a;
	const mr_v3 *from;
	mr_v3 *to;
} relaxing;

/* Moves vertices to the mean of their neighbours, and back to the twisted body. */
static void
relax_body(void *arg, size_t begin, size_t end)
{
	const relaxing *r = arg;

	for (size_t i = begin; i < end; i++) {
		mr_v3 mean = mr_vec(0, 0, 0);
		size_t first = r->a->start[i], last = r->a->start[i + 1];
		for (size_t k = first; k < last; k++)
			mean = mr_add(mean, r->from[r->a->adj[k]]);
		mean = mr_mul(1 / (double)(last - first), mean);
		r->to[i] = twist(body_point(twist(mr_lerp(0.7, r->from[i], mean), -TWIST)), TWIST);
	}
}

static mr_status
relax(mr_ctx *ctx, build *b, int rounds)
{
	mr_mesh m = { .name = "bumpy", .p = b->p, .t = b->t, .nv = b->nv, .nf = b->nf };
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *other = MR_NEW(ctx, b->nv, mr_v3);
	mr_adjacency a;

	if (!other)
		return MR_EMEM;
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
		p[i] = twist(skin_point(twist(p[i], -TWIST)), TWIST);
}

static void
project_body(void *arg, size_t begin, size_t end)
{
	mr_v3 *p = arg;

	for (size_t i = begin; i < end; i++)
		p[i] = twist(body_point(p[i]), TWIST);
}

mr_status
mr_bumpy(mr_ctx *ctx, size_t n, build *b)
{
	enum { LEAST = 8, COARSE = 16, ROUNDS = 100, MORE = 8 };
	size_t f = mr_geodesic_frequency(n), levels = 0;

	if (f < LEAST) /* a coarser sphere would slip off the limbs and shrink away */
		f = LEAST;
	while (f >> levels >= COARSE)
		levels++;
	f = (f + (1u << levels) / 2) >> levels; /* frequencies f 2^levels: within 7 % of the one asked for */
	MR_TRY(mr_geodesic(ctx, f, b));
	mr_parallel(ctx, b->nv, 1024, project_body, b->p);
	MR_TRY(relax(ctx, b, ROUNDS));
	for (size_t i = 0; i < levels; i++) {
		build old = *b;
		MR_TRY(refine(ctx, &old, b));
		MR_TRY(relax(ctx, b, MORE));
	}
	mr_parallel(ctx, b->nv, 1024, clothe_body, b->p);
	return MR_OK;
}
