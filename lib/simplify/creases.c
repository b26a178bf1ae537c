/* An edge is sharp where two planes meet in it that the points along it lie on. */
#include "simplify/creases.h"

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "space/local_planes.h"

/* Points that far from an edge show its planes. */
enum { NEAREST = 40, ROUNDS = 8, LEAST = 5 };
static const double REACH = 4;

/* How far its ends are from both planes, at most. */
static const double OFF = 1.5;

/* Degrees between the planes; a quarter of that between the faces of 1,988 of 2,000 sharp edges. */
static const double ANGLE = 40;

/* Of a curve along which pieces are sharp, edges: of the bunny, igea and the armadillo none has more. */
enum { PIECE = 8 };

typedef struct plane {
	mr_v3 at, normal;
	double squares; /* of the distances of its n points */
	size_t n;
} plane;

static double
distance(const plane *p, mr_v3 q)
{
	return fabs(mr_dot(mr_sub(q, p->at), p->normal));
}

/* The plane of least squares, its normal on the side that it was; false where the points make none. */
static bool
fit(const mr_v3 *p, size_t n, double width, plane *out)
{
	double sum[6], value[3];
	mr_v3 vector[3], mean = { 0, 0, 0 };

	if (n < LEAST)
		return false;
	for (size_t i = 0; i < n; i++)
		mean = mr_axpy(1 / (double)n, p[i], mean);
	mr_covariance(p, n, 1 / width, sum);
	mr_eigen_sym3(sum, value, vector);
	if (value[1] < 0.1 * (double)n) /* a row */
		return false;
	if (mr_dot(vector[0], out->normal) < 0)
		vector[0] = mr_mul(-1, vector[0]);
	*out = (plane){ mean, vector[0], fmax(0, value[0]) * width * width, n };
	return true;
}

/* Points to the nearer plane, planes to their points, by turns (Bradley, Mangasarian 2000: k-plane
 * clustering); what is far from both is of neither.  work: n. */
static bool
fit_two(const mr_v3 *p, size_t n, double width, plane two[2], mr_v3 *work)
{
	double far = width;

	for (int round = 0; round < ROUNDS; round++) {
		size_t a = 0, b = n;
		for (size_t i = 0; i < n; i++) {
			double x = distance(&two[0], p[i]), y = distance(&two[1], p[i]);
			if (x < y && x <= far)
				work[a++] = p[i];
			else if (y <= far)
				work[--b] = p[i];
		}
		if (!fit(work, a, width, &two[0]) || !fit(work + b, n - b, width, &two[1]))
			return false;
		far = fmax(
		    0.3 * width, 3 * sqrt((two[0].squares + two[1].squares) / (double)(two[0].n + two[1].n)));
	}
	return true;
}

/*
 * Whether n points show two planes that meet at an edge, not an arc: planes along the halves of one that
 * turns by `angle` from half to half, 2 REACH wide, are off by REACH angle / (12 sqrt 5) of it, root mean
 * square.  With half of that allowed, 0.4 finds a tenth less of the sharp edges of fandisk, 0.6 finds some on
 * igea.
 */
static bool
is_sharp(const plane two[2], size_t n, double width)
{
	double angle = mr_angle(two[0].normal, two[1].normal);
	size_t counted = two[0].n + two[1].n;
	double off = sqrt((two[0].squares + two[1].squares) / (double)counted);

	return angle * 180 / MR_PI > ANGLE && off < 0.5 * REACH * angle / (12 * sqrt(5)) * width &&
	       (double)counted > 0.85 * (double)n;
}

typedef struct finder {
	const mr_mesh *m;
	const mr_simplify_cloud *c;
	double width;
} finder;

/* The points along a segment, but for its ends where it is long: others meet there.  None along one that is
 * longer than they would reach, two widths each.  p: in the arena. */
static mr_status
points_along(mr_ctx *ctx, const finder *f, mr_v3 a, mr_v3 b, mr_v3 **p, size_t *n)
{
	mr_v3 e = mr_sub(b, a);
	double length = mr_norm(e), margin = length > 6 * f->width ? f->width / length : 0;
	double stretches = length / (2 * f->width);
	size_t steps = stretches <= (double)f->c->n ? (size_t)stretches + 2 : 0, count = 0,
	       kept = steps * NEAREST;
	mr_v3 *at = MR_NEW(ctx, steps, mr_v3);
	uint32_t *index = MR_NEW(ctx, kept, uint32_t);

	*p = MR_NEW(ctx, kept, mr_v3);
	for (size_t i = 0; i < steps; i++)
		at[i] = mr_lerp((double)i / (double)(steps - 1), a, b);
	MR_TRY(mr_near_query(ctx, f->c->near, at, steps, NEAREST, index, NULL));
	kept = mr_sort_unique(index, kept);
	for (size_t i = 0; i < kept && index[i] != UINT32_MAX; i++) {
		mr_v3 r = mr_sub(f->c->p[index[i]], a);
		double t = mr_dot(r, e) / mr_norm2(e);
		if (t >= margin && t <= 1 - margin && mr_norm(mr_axpy(-t, e, r)) <= REACH * f->width)
			(*p)[count++] = f->c->p[index[i]];
	}
	*n = count;
	return MR_OK;
}

/* Whether the edge with half-edges h and g is sharp. */
static mr_status
look_at(mr_ctx *ctx, const finder *f, uint32_t h, uint32_t g, bool *sharp)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 a = f->m->p[mr_he_from(f->m, h)], b = f->m->p[mr_he_to(f->m, h)], *p, *work;
	mr_v3 middle = mr_lerp(0.5, a, b);
	plane two[2] = { { .at = middle, .normal = mr_unit(mr_face_cross(f->m, h / 3)) },
		{ .at = middle, .normal = mr_unit(mr_face_cross(f->m, g / 3)) } };
	size_t n;

	*sharp = false;
	if (mr_angle(two[0].normal, two[1].normal) * 180 / MR_PI < ANGLE / 4)
		return MR_OK;
	MR_TRY(points_along(ctx, f, a, b, &p, &n));
	work = MR_NEW(ctx, n, mr_v3);
	if (fit_two(p, n, f->width, two, work) && is_sharp(two, n, f->width)) {
		double off = 0;
		for (int k = 0; k < 2; k++)
			off = fmax(off, fmax(distance(&two[k], a), distance(&two[k], b)));
		*sharp = off < OFF * f->width;
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static mr_status
mark_edges(mr_ctx *ctx, const finder *f, const mr_topology *topo, uint8_t *mark)
{
	memset(mark, 0, 3 * f->m->nf);
	for (uint32_t h = 0; h < 3 * f->m->nf; h++) {
		uint32_t g = topo->twin[h];
		bool sharp;
		if (g == MR_NONE || g < h)
			continue;
		MR_TRY(look_at(ctx, f, h, g, &sharp));
		mark[h] = mark[g] = sharp;
	}
	return MR_OK;
}

/* Takes back what is short: of marked edges that hang together, fewer than PIECE. */
static void
drop_pieces(mr_ctx *ctx, const mr_mesh *m, uint8_t *mark, size_t *count)
{
	uint32_t *set = mr_sets_new(ctx, m->nv), *half = MR_NEW_ZERO(ctx, m->nv, uint32_t);

	for (uint32_t h = 0; h < 3 * m->nf; h++)
		if (mark[h])
			mr_sets_join(set, mr_he_from(m, h), mr_he_to(m, h));
	for (uint32_t h = 0; h < 3 * m->nf; h++)
		half[mr_sets_root(set, mr_he_from(m, h))] += mark[h];
	*count = 0;
	for (uint32_t h = 0; h < 3 * m->nf; h++) {
		mark[h] = mark[h] && half[mr_sets_root(set, mr_he_from(m, h))] >= 2 * PIECE;
		*count += mark[h];
	}
	*count /= 2;
}

mr_status
mr_find_creases(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, uint8_t *mark, size_t *count)
{
	mr_mark here = mr_mark_take(ctx);
	finder f = { m, c, c->sampling.usual };
	mr_topology topo;

	MR_TRY(mr_topology_build(ctx, m, &topo));
	MR_TRY(mark_edges(ctx, &f, &topo, mark));
	drop_pieces(ctx, m, mark, count);
	mr_mark_release(ctx, here);
	return MR_OK;
}
