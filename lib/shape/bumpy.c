/* The bumpy creature: an implicit body around a skeleton, relaxed, subdivided, under a skin of scales. */
#include "shape/shape.h"

#include "base/parallel.h"
#include "base/random.h"
#include "subdivide/loop.h"
#include "volume/isosurface.h"

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

static void
relax(mr_ctx *ctx, const mr_mesh *m, mr_v3 *p, int rounds)
{
	MR_SCOPE(ctx);
	mr_v3 *other = MR_NEW(ctx, m->nv, mr_v3);
	mr_adjacency a;

	mr_adjacency_build(ctx, m, &a);
	for (int i = 0; i < 2 * rounds; i++) { /* an even number: the result ends in p */
		relaxing r = { &a, i % 2 ? other : p, i % 2 ? p : other };
		mr_parallel(ctx, m->nv, 1024, relax_body, &r);
	}
}

static void
clothe_body(void *arg, size_t begin, size_t end)
{
	mr_v3 *p = arg;

	for (size_t i = begin; i < end; i++)
		p[i] = skin_point(project(p[i], 3));
}

typedef struct sampling {
	mr_grid g;
	float *f;
} sampling;

static void
sample_layers(void *arg, size_t begin, size_t end)
{
	const sampling *s = arg;
	mr_v3 gradient;

	for (size_t z = begin; z < end; z++)
		for (size_t y = 0; y < s->g.n[1]; y++)
			for (size_t x = 0; x < s->g.n[0]; x++)
				s->f[mr_grid_index(&s->g, x, y, z)] = (float)body(
				    mr_grid_place(&s->g, x, y, z), &gradient);
}

/* The body, of about so many vertices. */
static mr_status
polygonise(mr_ctx *ctx, double vertices, mr_mesh *m)
{
	sampling s = { .g = { .origin = SPACE.min, .step = sqrt(1.5 * AREA / vertices) } };
	mr_v3 size = mr_sub(SPACE.max, SPACE.min);

	for (int k = 0; k < 3; k++)
		s.g.n[k] = (size_t)ceil(mr_coordinate(size, k) / s.g.step) + 1;
	s.f = MR_NEW(ctx, mr_grid_nodes(&s.g), float);
	mr_parallel(ctx, s.g.n[2], 1, sample_layers, &s);
	return mr_isosurface(ctx, &s.g, s.f, 0, m);
}

mr_status
mr_bumpy(mr_ctx *ctx, size_t n, mr_mesh *m)
{
	enum { LEAST = 5000, MOST = 20000, LEVELS = 10 };
	double vertices = n > LEAST ? (double)n : LEAST; /* fewer would cut off the ears */
	mr_loop level[LEVELS + 1];
	size_t levels = 0;
	mr_mesh coarse, fine;
	mr_v3 *p, *q;

	for (; vertices > MOST; vertices /= 4)
		levels++;
	MR_TRY(polygonise(ctx, vertices, &coarse));
	p = MR_NEW(ctx, coarse.nv, mr_v3);
	memcpy(p, coarse.p, coarse.nv * sizeof *p);
	relax(ctx, &coarse, p, 8);
	MR_TRY(mr_loop_levels(ctx, &coarse, 180, NULL, levels, level));
	fine = (mr_mesh){
		.name = "bumpy", .t = level[levels].t, .nv = level[levels].nv, .nf = level[levels].nf
	};
	q = MR_NEW(ctx, fine.nv, mr_v3);
	mr_loop_values(ctx, level, levels, 3, (const double *)p, (double *)q);
	if (levels)
		relax(ctx, &fine, q, 2);
	mr_parallel(ctx, fine.nv, 1024, clothe_body, q);
	fine.p = q;
	*m = fine;
	return MR_OK;
}
