/* The volume of what is free, which rounds lose: pressure gives it back. */
#include "edit/deform_volume.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "mesh/edges.h"

typedef struct solid {
	const mr_volume *v;
	const mr_v3 *p; /* of the patch */
	mr_v3 origin;
} solid;

/* How often the faces of edge e run one way more than the other. */
static int
open_sides(const mr_mesh *m, const mr_edges *edges, size_t e)
{
	uint32_t first = edges->he[edges->start[e]];
	int sides = 0;

	for (size_t i = edges->start[e]; i < edges->start[e + 1]; i++)
		sides += mr_same_direction(m, first, edges->he[i]) ? 1 : -1;
	return sides;
}

/* Numbers the loops of the rim, each of which has a cap. */
static mr_status
number_caps(mr_ctx *ctx, size_t nv, mr_rim *rim, mr_volume *v)
{
	uint32_t *set = mr_sets_new(ctx, nv), *cap = MR_NEW(ctx, nv, uint32_t);

	if (!set || !cap)
		return MR_EMEM;
	for (size_t i = 0; i < nv; i++)
		cap[i] = MR_NONE;
	for (size_t e = 0; e < v->rims; e++)
		mr_sets_join(set, rim[e].from, rim[e].to);
	for (size_t e = 0; e < v->rims; e++) {
		uint32_t *own = &cap[mr_sets_root(set, rim[e].from)];
		*own = *own == MR_NONE ? (uint32_t)v->caps++ : *own;
		rim[e].cap = *own;
	}
	v->center = MR_NEW(ctx, v->caps, mr_v3);
	v->sides = MR_NEW(ctx, v->caps, double);
	return v->center && v->sides ? MR_OK : MR_EMEM;
}

/* A rim has to go as one constraint goes. */
mr_status
mr_volume_make(mr_ctx *ctx, const mr_deform *d, mr_volume *v)
{
	mr_mesh own = d->patch.mesh;
	const mr_mesh *m = &own;
	mr_edges edges;
	mr_rim *rim;

	own.nf = d->patch.own; /* without the triangles between parts that touch */
	MR_TRY(mr_edges_build(ctx, m, &edges));
	rim = MR_NEW(ctx, edges.count, mr_rim);
	if (!rim)
		return MR_EMEM;
	v->encloses = true;
	v->t = m->t;
	v->nf = m->nf;
	v->rim = rim;
	for (size_t e = 0; e < edges.count; e++) {
		uint32_t h = edges.he[edges.start[e]], a = mr_he_from(m, h), b = mr_he_to(m, h);
		uint32_t region = d->region[d->patch.vertex[a]];
		int sides = open_sides(m, &edges, e);
		if (sides == 0)
			continue;
		v->encloses &= region != MR_REGION_FREE && region == d->region[d->patch.vertex[b]];
		rim[v->rims++] = (mr_rim){ a, b, sides, 0 };
	}
	return number_caps(ctx, m->nv, rim, v);
}

static double
face_volume(void *arg, size_t f)
{
	const solid *s = arg;
	const uint32_t *v = s->v->t[f].v;

	return mr_dot(mr_sub(s->p[v[0]], s->origin),
		   mr_cross(mr_sub(s->p[v[1]], s->origin), mr_sub(s->p[v[2]], s->origin))) /
	       6;
}

/* The middle of each loop of the rim, which goes as its constraint does. */
static void
find_centers(const solid *s)
{
	memset(s->v->center, 0, s->v->caps * sizeof *s->v->center);
	memset(s->v->sides, 0, s->v->caps * sizeof *s->v->sides);
	for (size_t e = 0; e < s->v->rims; e++) {
		const mr_rim *rim = &s->v->rim[e];
		s->v->center[rim->cap] = mr_add(
		    s->v->center[rim->cap], mr_add(s->p[rim->from], s->p[rim->to]));
		s->v->sides[rim->cap] += 2;
	}
	for (size_t c = 0; c < s->v->caps; c++)
		s->v->center[c] = mr_mul(1 / fmax(s->v->sides[c], 1), s->v->center[c]);
}

double
mr_volume_of(const mr_ctx *ctx, const mr_volume *v, const mr_v3 *p)
{
	solid s = { v, p, p[0] };
	double sum = mr_parallel_sum(ctx, v->nf, face_volume, &s);

	find_centers(&s);
	for (size_t e = 0; e < v->rims; e++) {
		const mr_rim *rim = &v->rim[e];
		mr_v3 a = mr_sub(p[rim->from], s.origin), b = mr_sub(p[rim->to], s.origin);
		sum += rim->sides * mr_dot(mr_sub(v->center[rim->cap], s.origin), mr_cross(b, a)) / 6;
	}
	return sum;
}

/* How far to go along u to a volume: that is a cubic of it, which is all but straight. */
static double
way_to(const mr_ctx *ctx, const mr_deform *d, const mr_volume *v, mr_v3 *p, const double *u, double slope,
    double missing)
{
	enum { MOST = 5 };
	static const double enough = 1e-4;
	double way = 0, step = missing / slope, goal = missing, start = mr_volume_of(ctx, v, p);

	for (int i = 0; i < MOST && fabs(missing) > enough * fabs(goal); i++) {
		double left;
		for (size_t k = 0; k < d->patch.end[0]; k++)
			p[k] = mr_axpy(step, mr_vec(u[3 * k], u[3 * k + 1], u[3 * k + 2]), p[k]);
		way += step;
		left = goal - (mr_volume_of(ctx, v, p) - start);
		if (!(missing != left))
			break;
		step *= left / (missing - left);
		missing = left;
	}
	return way;
}

mr_status
mr_volume_keep(mr_ctx *ctx, mr_deform *system, const mr_volume *v, double least, const double *source,
    mr_v3 *q, mr_v3 *p)
{
	mr_patch_field f = mr_deform_field(system, 3);
	size_t n = system->patch.end[0];
	double slope = 0, way, missing = least - mr_volume_of(ctx, v, q);

	f.source = source;
	MR_TRY(mr_deform_solve_field(ctx, system, &f));
	for (size_t i = 0; i < 3 * n; i++)
		slope += f.u[i] * source[i];
	if (!(fabs(slope) > 0))
		return MR_OK;
	way = way_to(ctx, system, v, q, f.u, slope, missing);
	for (size_t i = 0; i < n; i++) {
		mr_v3 *at = &p[system->patch.vertex[i]];
		*at = mr_axpy(way, mr_vec(f.u[3 * i], f.u[3 * i + 1], f.u[3 * i + 2]), *at);
	}
	return MR_OK;
}
