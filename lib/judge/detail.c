/* Edges that base does not account for: torn ones, and long ones that cut across what base does. */
#include "judge/judge.h"

#include "base/rotation.h"

enum { LOOKS = 1 << 16, FEW = 5 };

static double
length2(const mr_v3 *p, const mr_mesh *m, uint32_t h)
{
	return mr_norm2(mr_sub(p[mr_he_from(m, h)], p[mr_he_to(m, h)]));
}

/* By how much a length has changed, as a factor of at least 1; its square. */
static double
change2(const mr_v3 *now, const mr_mesh *then, uint32_t h)
{
	double was = length2(then->p, then, h), is = length2(now, then, h);

	return was == 0 || is == was /* both beyond what has squares */ ? 1
	       : is >= was                                              ? is / was
	       : is > 0                                                 ? was / is
	                                                                : INFINITY;
}

/* The most that an edge of the face of base has on which the vertex stands. */
static double
base_change2(const mr_ground *g, uint32_t vertex)
{
	uint32_t h = 3 * g->face[vertex];

	return fmax(change2(g->now, &g->then, h),
	    fmax(change2(g->now, &g->then, h + 1), change2(g->now, &g->then, h + 2)));
}

static mr_finding
find_torn(const mr_motion *m, const mr_ground *g, uint32_t *from)
{
	const double much2 = 4;
	mr_finding torn = { .kind = MR_TORN, .of = 3 * m->then->nf / 2 };
	double most2 = 1;

	for (size_t i = 0; i < m->changes; i++) {
		uint32_t h = m->changed[i];
		double change = change2(m->now, m->then, h);
		if (change <= much2 * base_change2(g, mr_he_from(m->then, h)) ||
		    change <= much2 * base_change2(g, mr_he_to(m->then, h)))
			continue;
		torn.count++;
		if (change > most2) {
			most2 = change;
			*from = mr_he_from(m->then, h);
		}
	}
	return torn;
}

/* An orthonormal frame of a face: along its first side, across it, and its normal. */
static mr_mat3
frame_of(const mr_mesh *m, const mr_v3 *p, uint32_t f)
{
	const uint32_t *v = m->t[f].v;
	mr_v3 side = mr_sub(p[v[1]], p[v[0]]), x = mr_unit(side);
	mr_v3 z = mr_unit(mr_cross(side, mr_sub(p[v[2]], p[v[0]]))), y = mr_cross(z, x);

	return (mr_mat3){ { x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z } };
}

/* How base has turned where a vertex stands, from its frame there to what that has become. */
static mr_mat3
turn_at(const mr_ground *g, uint32_t vertex)
{
	mr_mat3 then = frame_of(&g->then, g->then.p, g->face[vertex]);
	mr_mat3 now = frame_of(&g->then, g->now, g->face[vertex]);

	return mr_mat3_multiply_transposed(&now, &then);
}

/* How far the middle of an edge is from its arc on base: the angle between base's turns at both ends, times
 * an eighth of the length. */
static double
off_arc(const mr_motion *m, const mr_ground *g, uint32_t h)
{
	mr_mat3 a = turn_at(g, mr_he_from(m->then, h)), b = turn_at(g, mr_he_to(m->then, h));
	mr_mat3 between = mr_mat3_multiply_transposed(&a, &b);
	double cosine = (between.m[0] + between.m[4] + between.m[8] - 1) / 2;

	return sqrt(length2(m->then->p, m->then, h)) * acos(fmax(-1, fmin(1, cosine))) / 8;
}

/* Long edges across which base turns much.  Edges no longer than the limit would go within far. */
static void
judge_chords(mr_ctx *ctx, const mr_motion *m, const mr_ground *g, double far)
{
	size_t halves = 3 * m->then->nf, stride = 1 + halves / LOOKS, n = 0, looked = 0;
	double farthest = far, enough = INFINITY;
	uint32_t worst = MR_NONE;

	for (size_t i = 0; i < halves; i += stride) {
		uint32_t h = (uint32_t)i;
		double length = length2(m->then->p, m->then, h), off;
		looked++;
		if (!(length > 16 * far * far))
			continue;
		off = off_arc(m, g, h);
		if (!(off > far))
			continue;
		n++;
		enough = fmin(enough, sqrt(length * far / off));
		if (off > farthest) {
			farthest = off;
			worst = mr_he_from(m->then, h);
		}
	}
	if (n)
		mr_motion_found(ctx, m,
		    (mr_finding){ .kind = MR_COARSE,
			.count = (n * stride + 1) / 2,
			.of = looked * stride / 2,
			.limit = fmin(enough, mr_mesh_edge_scale(ctx, &g->then)) },
		    worst);
}

void
mr_judge_detail(mr_ctx *ctx, const mr_motion *m, const mr_ground *g)
{
	const double far = 0.01 * m->diagonal;
	uint32_t from = 0;
	mr_finding torn = find_torn(m, g, &from);

	if (torn.count > FEW)
		mr_motion_found(ctx, m, torn, from);
	if (m->longest > 4 * far)
		judge_chords(ctx, m, g, far);
}
