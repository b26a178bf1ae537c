/* A surface of other triangles against its source: area, volume, distance, parts, intersections. */
#include "judge/judge.h"

#include "measure/gaps.h"
#include "mesh/repair.h"
#include "space/contact.h"
#include "space/self_intersect.h"

static const double MUCH = 0.1; /* of the area or volume */

static void
judge_size(mr_ctx *ctx, const mr_mesh *then, const mr_mesh *now, bool several)
{
	double area = mr_mesh_area(ctx, then), lost = area > 0 ? 1 - mr_mesh_area(ctx, now) / area : 0,
	       change = 0;
	bool *boundary, open;

	mr_boundary_label(ctx, then, &boundary, &open);
	if (!open && !several) /* parts may be turned inside out */
		change = mr_mesh_volume(ctx, now) / mr_mesh_volume(ctx, then) - 1;
	if (fabs(change) > fmax(MUCH, lost) && isfinite(change))
		mr_found(ctx, &(mr_finding){ .kind = MR_VOLUME, .layer = now->name, .value = change });
	else if (lost > MUCH)
		mr_found(ctx, &(mr_finding){ .kind = MR_SHRUNK, .layer = now->name, .value = lost });
}

/* part: of each vertex, the first that stands for its part.  Those at one place belong together, as seams do.
 */
static void
label_parts(mr_ctx *ctx, const mr_mesh *m, uint32_t **part)
{
	uint32_t *map = MR_NEW(ctx, m->nv, uint32_t), *first = MR_NEW(ctx, m->nv, uint32_t), *joined;
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);
	size_t n;
	bool several;

	mr_weld(ctx, m->p, m->nv, 1e-8 * mr_mesh_diagonal(m), map, &n);
	for (size_t v = m->nv; v-- > 0;)
		first[map[v]] = (uint32_t)v;
	for (size_t v = 0; v < m->nv; v++)
		map[v] = first[map[v]];
	for (size_t h = 0; h < 3 * m->nf; h++)
		t[h / 3].v[h % 3] = map[m->t[h / 3].v[h % 3]];
	mr_components_label(ctx, &(mr_mesh){ m->name, m->p, t, m->nv, m->nf }, &joined, &several);
	for (size_t v = 0; v < m->nv; v++)
		map[v] = joined[map[v]];
	*part = map;
}

/* The area of each part, by the vertex of `whole` that stands for it: of a face the nearest one of whole. */
static void
add_areas(const mr_mesh *m, const uint32_t *part, double *area)
{
	for (size_t f = 0; f < m->nf; f++)
		area[part[m->t[f].v[0]]] += mr_norm(mr_face_cross(m, f));
}

/* For each vertex of now, by its part, the part of then that a face of it is nearest to. */
static void
match_parts(mr_ctx *ctx, const mr_mesh *then, const uint32_t *of, const mr_bvh *bvh, const mr_mesh *now,
    uint32_t **match)
{
	uint32_t *own, *to = MR_NEW(ctx, now->nv, uint32_t);
	bool several;

	mr_components_label(ctx, now, &own, &several);
	memset(to, 0xff, now->nv * sizeof *to);
	for (size_t f = 0; f < now->nf; f++) {
		const uint32_t *v = now->t[f].v;
		mr_closest c;
		if (to[own[*v]] != MR_NONE)
			continue;
		c = mr_bvh_closest(bvh, mr_mean3(now->p[v[0]], now->p[v[1]], now->p[v[2]]));
		to[own[*v]] = of[then->t[c.at.face].v[0]];
	}
	for (size_t v = 0; v < now->nv; v++)
		own[v] = own[v] == MR_NONE ? MR_NONE : to[own[v]];
	*match = own;
}

/* Parts that have lost over half of their area. */
static void
judge_parts(mr_ctx *ctx, const mr_mesh *then, const mr_mesh *now)
{
	const double half = 0.5;
	double *was = MR_NEW_ZERO(ctx, then->nv, double), *is = MR_NEW_ZERO(ctx, then->nv, double),
	       least = half;
	mr_finding f = { .kind = MR_GONE, .layer = now->name, .vertex = MR_NO_VERTEX };
	uint32_t *of, *match;
	mr_bvh *bvh;

	label_parts(ctx, then, &of);
	mr_bvh_build(ctx, then, &bvh);
	match_parts(ctx, then, of, bvh, now, &match);
	add_areas(then, of, was);
	add_areas(now, match, is);
	for (size_t v = 0; v < then->nv; v++) {
		f.of += was[v] > 0;
		if (!(is[v] < half * was[v]))
			continue;
		f.count++;
		if (is[v] < least * was[v]) {
			least = is[v] / was[v];
			f.placed = true;
			f.at = then->p[v];
		}
	}
	if (f.count)
		mr_found(ctx, &f);
}

/* Some of the faces, evenly. */
static mr_mesh
thinned(mr_ctx *ctx, const mr_mesh *m)
{
	enum { MOST = 8192 };
	mr_mesh some = *m;
	mr_tri *t = MR_NEW(ctx, MOST, mr_tri);

	for (some.nf = 0; some.nf < MOST && some.nf < m->nf; some.nf++)
		t[some.nf] = m->t[m->nf > MOST ? some.nf * m->nf / MOST : some.nf];
	some.t = t;
	return some;
}

/* Distances to some old faces come first: where they are small, those to all are. */
static void
judge_distance(mr_ctx *ctx, const mr_mesh *then, const mr_mesh *now, const mr_bvh *bvh)
{
	enum { SAMPLES = 2048 };
	mr_mesh some = thinned(ctx, then);
	double diagonal = mr_mesh_diagonal(then), most = 0.05 * diagonal;
	mr_mesh_gaps g = { .widest = 0 }, near;
	mr_bvh *bvh_then;

	mr_gaps_add(ctx, then, bvh, SAMPLES, INFINITY, &g);
	near = g;
	mr_bvh_build(ctx, &some, &bvh_then);
	mr_gaps_add(ctx, now, bvh_then, SAMPLES, INFINITY, &near);
	if (!(near.widest > most))
		return;
	mr_bvh_build(ctx, then, &bvh_then);
	mr_gaps_add(ctx, now, bvh_then, SAMPLES, INFINITY, &g);
	if (g.widest > most)
		mr_found(ctx, &(mr_finding){ .kind = MR_DISTANT,
				  .layer = now->name,
				  .value = g.widest / diagonal,
				  .placed = true,
				  .vertex = MR_NO_VERTEX,
				  .at = g.at });
}

/* If the source intersects itself already, a coarser surface has fewer pairs of it, or some more. */
static void
judge_intersections(mr_ctx *ctx, const mr_mesh *then, const mr_mesh *now, const mr_bvh *bvh)
{
	enum { FEW = 5 };
	bool *crosses = MR_NEW(ctx, now->nf, bool);
	size_t pairs, old, f = 0;

	mr_self_intersections(ctx, bvh, now, crosses, &pairs);
	if (pairs <= FEW)
		return;
	mr_self_intersections(ctx, NULL, then, NULL, &old);
	if (pairs <= FEW + 2 * old)
		return;
	while (!crosses[f])
		f++;
	mr_found(ctx, &(mr_finding){ .kind = MR_CROSSING,
			  .layer = now->name,
			  .count = pairs - old,
			  .of = now->nf,
			  .placed = true,
			  .vertex = now->t[f].v[0],
			  .at = now->p[now->t[f].v[0]] });
}

void
mr_judge_remade(mr_ctx *ctx, const mr_mesh *then, const mr_mesh *now)
{
	uint32_t *of;
	bool several;
	mr_bvh *bvh;

	mr_components_label(ctx, then, &of, &several);
	judge_size(ctx, then, now, several);
	if (!(mr_mesh_area(ctx, then) > 0 && mr_mesh_area(ctx, now) > 0))
		return;
	if (several)
		judge_parts(ctx, then, now);
	mr_bvh_build(ctx, now, &bvh);
	judge_distance(ctx, then, now, bvh);
	judge_intersections(ctx, then, now, bvh);
}
