/* The middles of long edges, encoded over the base as if they were vertices, and decoded. */
#include "edit/chord.h"

#include "space/contact.h"

static mr_v3
middle(const mr_v3 *p, const mr_mesh *m, uint32_t h)
{
	return mr_lerp(0.5, p[mr_he_from(m, h)], p[mr_he_to(m, h)]);
}

/* The first half-edge of each edge that is longer than `length`; how many there are. */
static size_t
find_long(const mr_mesh *m, const mr_edges *edges, double length, uint32_t *side)
{
	size_t n = 0;

	for (size_t e = 0; e < edges->count; e++) {
		uint32_t h = edges->he[edges->start[e]];
		if (mr_norm2(mr_sub(m->p[mr_he_from(m, h)], m->p[mr_he_to(m, h)])) <= length * length)
			continue;
		if (side)
			side[n] = h;
		n++;
	}
	return n;
}

/* Whether both faces are of one part of base: where parts touch, the nearest one to a middle may be of
 * another. */
static bool
are_joined(const mr_mesh *base, const uint32_t *component, uint32_t f, uint32_t g)
{
	return component[base->t[f].v[0]] == component[base->t[g].v[0]];
}

mr_status
mr_chords_find(mr_ctx *ctx, const mr_mesh *mesh, const mr_edges *edges, const mr_v3 *p, const mr_mesh *base,
    const mr_incidence *inc, const mr_detail *d, double far, mr_chords *found)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t n = find_long(mesh, edges, 4 * far, NULL);
	uint32_t *side = MR_NEW(ctx, n, uint32_t), *component;
	mr_v3 *before = MR_NEW(ctx, n, mr_v3), *after = MR_NEW(ctx, n, mr_v3);
	mr_mesh middles = { .name = mesh->name, .p = before, .nv = n }, rest = *base;
	mr_chords c = { .vertex = MR_NONE, .enough = INFINITY };
	mr_detail detail;
	bool several;

	*found = c;
	if (!side || !before || !after)
		return MR_EMEM;
	if (n == 0)
		return MR_OK;
	find_long(mesh, edges, 4 * far, side);
	for (size_t i = 0; i < n; i++)
		before[i] = middle(mesh->p, mesh, side[i]);
	rest.p = d->rest;
	MR_TRY(mr_components_label(ctx, base, &component, &several));
	MR_TRY(mr_encode(ctx, &middles, &rest, NULL, &detail, NULL));
	detail.rest_normal = d->rest_normal;
	MR_TRY(mr_decode(ctx, base, inc, &detail, 1, after));
	for (size_t i = 0; i < n; i++) {
		double off = mr_dist(after[i], middle(p, mesh, side[i]));
		if (several &&
		    !are_joined(base, component, detail.at.face[i], d->at.face[mr_he_from(mesh, side[i])]))
			continue;
		if (off > c.farthest) {
			c.farthest = off;
			c.vertex = mr_he_from(mesh, side[i]);
		}
		if (off > far) {
			double length = mr_dist(
			    mesh->p[mr_he_from(mesh, side[i])], mesh->p[mr_he_to(mesh, side[i])]);
			c.enough = fmin(c.enough, length * sqrt(far / off));
			c.edges++;
		}
	}
	mr_mark_release(ctx, mark);
	*found = c;
	return MR_OK;
}
