/* The volumes of parts: six times each, as the sum of tetrahedra over its faces. */
#include "space/enclosed.h"

#include "space/contact.h"

#include <math.h>

typedef struct part {
	uint64_t open;         /* not 0 where an edge has not as many faces one way as the other */
	double rest, all, now; /* all: the sum of the tetrahedra without their signs */
} part;

/* On the vertex that stands for the part: so nothing is lost where it lies far from the origin. */
static double
tetrahedron(const mr_tri *t, const mr_v3 *p, uint32_t apex)
{
	mr_v3 a = mr_sub(p[t->v[0]], p[apex]), b = mr_sub(p[t->v[1]], p[apex]);

	return mr_dot(a, mr_cross(b, mr_sub(p[t->v[2]], p[apex])));
}

static bool
encloses(const part *p)
{
	const double little = 1e-9; /* of `all`, as rounding leaves of two sheets that lie on each other */

	return !p->open && fabs(p->rest) > little * p->all;
}

/* Of an edge, so many bits that sums of others are not 0 by chance: the last step of splitmix64. */
static uint64_t
print_of(uint32_t a, uint32_t b)
{
	uint64_t x = ((uint64_t)a << 32 | b) + 0x9e3779b97f4a7c15u;

	x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
	x = (x ^ x >> 27) * 0x94d049bb133111ebu;
	return x ^ x >> 31;
}

/* What its sides add one way and take away the other; 0 where it has a vertex twice. */
static uint64_t
print_of_sides(const uint32_t v[3])
{
	uint64_t sum = 0;

	if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0])
		return 0;
	for (int k = 0; k < 3; k++) {
		uint32_t a = v[k], b = v[(k + 1) % 3];
		sum += a < b ? print_of(a, b) : -print_of(b, a);
	}
	return sum;
}

/* parts: one for each vertex, that of the vertex which stands for it; in the arena. */
static void
find_parts(mr_ctx *ctx, const mr_mesh *m, const mr_v3 *p, part **parts)
{
	part *found = MR_NEW_ZERO(ctx, m->nv, part);
	uint32_t *of;
	bool several;

	mr_components_label(ctx, m, &of, &several);
	for (size_t f = 0; f < m->nf; f++) {
		part *own = &found[of[m->t[f].v[0]]];
		uint32_t apex = of[m->t[f].v[0]];
		double rest = tetrahedron(&m->t[f], m->p, apex);
		own->open += print_of_sides(m->t[f].v);
		own->rest += rest;
		own->all += fabs(rest);
		own->now += p == m->p ? rest : tetrahedron(&m->t[f], p, apex);
	}
	*parts = found;
}

/* Six times. */
static mr_status
sum(mr_ctx *ctx, const mr_mesh *m, const mr_v3 *p, double *rest, double *now)
{
	mr_mark mark = mr_mark_take(ctx);
	part *parts;

	find_parts(ctx, m, p, &parts);
	*rest = *now = 0;
	for (size_t v = 0; v < m->nv; v++)
		if (encloses(&parts[v])) {
			*rest += fabs(parts[v].rest);
			*now += copysign(1, parts[v].rest) * parts[v].now;
		}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_enclosed_volume(mr_ctx *ctx, const mr_mesh *m, double *volume)
{
	double rest, now;

	MR_TRY(sum(ctx, m, m->p, &rest, &now));
	*volume = rest / 6;
	return MR_OK;
}

mr_status
mr_enclosed_share(mr_ctx *ctx, const mr_mesh *m, const mr_v3 *p, double *share)
{
	double rest, now;

	MR_TRY(sum(ctx, m, p, &rest, &now));
	*share = now / rest;
	return MR_OK;
}
