/* The volumes of parts: six times each, as the sum of tetrahedra over its faces. */
#include "space/enclosed.h"

#include "space/contact.h"

#include <math.h>

typedef struct part {
	bool open;
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

/* parts: one for each vertex, that of the vertex which stands for it; in the arena. */
static mr_status
find_parts(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, const mr_v3 *p, part **parts)
{
	part *found = MR_NEW_ZERO(ctx, m->nv, part);
	uint32_t *of;
	bool several;

	if (!found)
		return MR_EMEM;
	MR_TRY(mr_components_label(ctx, m, &of, &several));
	for (size_t e = 0; e < edges->count; e++)
		if (!mr_edge_is_closed(m, edges, e))
			found[of[mr_he_from(m, edges->he[edges->start[e]])]].open = true;
	for (size_t f = 0; f < m->nf; f++) {
		uint32_t own = of[m->t[f].v[0]];
		double rest = tetrahedron(&m->t[f], m->p, own);
		found[own].rest += rest;
		found[own].all += fabs(rest);
		found[own].now += tetrahedron(&m->t[f], p, own);
	}
	*parts = found;
	return MR_OK;
}

/* Six times. */
static mr_status
sum(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, const mr_v3 *p, double *rest, double *now)
{
	mr_mark mark = mr_mark_take(ctx);
	part *parts;

	MR_TRY(find_parts(ctx, m, edges, p, &parts));
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
	mr_mark mark = mr_mark_take(ctx);
	double rest, now;
	mr_edges edges;

	MR_TRY(mr_edges_build(ctx, m, &edges));
	MR_TRY(sum(ctx, m, &edges, m->p, &rest, &now));
	mr_mark_release(ctx, mark);
	*volume = rest / 6;
	return MR_OK;
}

mr_status
mr_enclosed_share(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, const mr_v3 *p, double *share)
{
	double rest, now;

	MR_TRY(sum(ctx, m, edges, p, &rest, &now));
	*share = now / rest;
	return MR_OK;
}
