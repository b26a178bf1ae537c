/* Fans, and the directions in which their faces lie: triangles with a common corner have more than that in
 * common where the arcs do that they are seen as from there. */
#include "space/suspects.h"

#include "mesh/alike.h"
#include "space/bvh_tree.h"

/* Faces around a vertex that make a fan of them: all pairs of fewer take no longer than the index. */
enum { FAN = 256 };

struct mr_fan {
	uint32_t apex;
	size_t n;
	uint32_t *face;
	mr_mesh boxes; /* of the arcs, as triangles that have these boxes */
	mr_bvh *bvh;
};

/* A unit vector that way; false where rounding leaves none. */
static bool
direction(mr_v3 from, mr_v3 to, mr_v3 *d)
{
	*d = mr_unit(mr_sub(to, from));
	return fabs(mr_norm2(*d) - 1) < 1e-12;
}

/* Of the face's arc: no point of it is farther from its chord than their middles are apart. */
static mr_box
box_of_arc(const mr_mesh *m, uint32_t face, uint32_t apex)
{
	const uint32_t *v = m->t[face].v;
	int k = v[0] == apex ? 0 : v[1] == apex ? 1 : 2;
	mr_v3 end[2];
	mr_box box;
	double bulge;

	if (!direction(m->p[apex], m->p[v[(k + 1) % 3]], &end[0]) ||
	    !direction(m->p[apex], m->p[v[(k + 2) % 3]], &end[1]))
		return (mr_box){ { -2, -2, -2 }, { 2, 2, 2 } };
	box = mr_box_of(end, 2);
	bulge = 1 - mr_norm(mr_lerp(0.5, end[0], end[1])) + 1e-12;
	box.min = mr_sub(box.min, mr_vec(bulge, bulge, bulge));
	box.max = mr_add(box.max, mr_vec(bulge, bulge, bulge));
	return box;
}

static mr_status
index_arcs(mr_ctx *ctx, const mr_mesh *m, mr_fan *fan)
{
	mr_v3 *p = MR_NEW(ctx, 2 * fan->n, mr_v3);
	mr_tri *t = MR_NEW(ctx, fan->n, mr_tri);

	if (!p || !t)
		return MR_EMEM;
	for (uint32_t i = 0; i < fan->n; i++) {
		mr_box box = box_of_arc(m, fan->face[i], fan->apex);
		p[2 * i] = box.min;
		p[2 * i + 1] = box.max;
		t[i] = (mr_tri){ { 2 * i, 2 * i + 1, 2 * i } };
	}
	fan->boxes = (mr_mesh){ m->name, p, t, 2 * fan->n, fan->n };
	return mr_bvh_build(ctx, &fan->boxes, &fan->bvh);
}

/* The corner with most faces, of equal ones the lowest. */
static uint32_t
hub_of(const mr_tri *t, const uint32_t *valence)
{
	uint32_t hub = t->v[0];

	for (int i = 1; i < 3; i++) {
		uint32_t v = t->v[i];
		if (valence[v] > valence[hub] || (valence[v] == valence[hub] && v < hub))
			hub = v;
	}
	return hub;
}

/* Gives each fan a number: in fan_of[], by vertex.  Returns how many there are. */
static uint32_t
number_fans(const mr_mesh *m, const uint32_t *valence, uint32_t *fan_of)
{
	uint32_t count = 0;

	for (size_t v = 0; v < m->nv; v++)
		fan_of[v] = valence[v] >= FAN ? count++ : MR_NONE;
	return count;
}

/* The faces of each fan but those of which an earlier one has the same vertices.  label: one a face. */
static mr_status
gather(mr_ctx *ctx, const mr_mesh *m, const uint32_t *label, mr_fan *fan, uint32_t count)
{
	uint32_t *first = MR_NEW(ctx, m->nf, uint32_t);

	if (!first)
		return MR_EMEM;
	MR_TRY(mr_first_alike(ctx, m, first));
	for (size_t f = 0; f < m->nf; f++)
		if (label[f] != MR_NONE)
			fan[label[f]].n += first[f] == f;
	for (uint32_t i = 0; i < count; i++) {
		fan[i].face = MR_NEW(ctx, fan[i].n, uint32_t);
		if (!fan[i].face)
			return MR_EMEM;
		fan[i].n = 0;
	}
	for (uint32_t f = 0; f < m->nf; f++)
		if (label[f] != MR_NONE && first[f] == f)
			fan[label[f]].face[fan[label[f]].n++] = f;
	for (uint32_t i = 0; i < count; i++)
		MR_TRY(index_arcs(ctx, m, &fan[i]));
	return MR_OK;
}

static mr_status
make_fans(mr_ctx *ctx, const mr_bvh *bvh, const uint32_t *valence, mr_suspects *s)
{
	const mr_mesh *m = bvh->mesh;
	uint32_t *fan_of = MR_NEW(ctx, m->nv, uint32_t), *label = MR_NEW(ctx, m->nf, uint32_t), count;
	mr_fan *fan;

	if (!fan_of || !label)
		return MR_EMEM;
	count = number_fans(m, valence, fan_of);
	if (count == 0)
		return MR_OK;
	fan = MR_NEW_ZERO(ctx, count, mr_fan);
	if (!fan)
		return MR_EMEM;
	for (uint32_t v = 0; v < m->nv; v++)
		if (fan_of[v] != MR_NONE)
			fan[fan_of[v]].apex = v;
	for (size_t f = 0; f < m->nf; f++)
		label[f] = fan_of[hub_of(&m->t[f], valence)];
	MR_TRY(gather(ctx, m, label, fan, count));
	s->fan = fan;
	return mr_bvh_label(ctx, bvh, label, &s->fans);
}

mr_status
mr_suspects_find(mr_ctx *ctx, const mr_bvh *bvh, mr_suspects *s)
{
	const mr_mesh *m = bvh->mesh;
	uint32_t *valence = MR_NEW_ZERO(ctx, m->nv, uint32_t);
	mr_suspects found = { { bvh, NULL, NULL }, NULL };

	if (!valence)
		return MR_EMEM;
	for (size_t f = 0; f < m->nf; f++)
		for (int i = 0; i < 3; i++)
			valence[m->t[f].v[i]]++;
	MR_TRY(make_fans(ctx, bvh, valence, &found));
	*s = found;
	return MR_OK;
}

typedef struct arcs {
	const mr_fan *fan;
	bool (*visit)(void *arg, uint32_t face);
	void *arg;
} arcs;

static bool
visit_arc(void *arg, uint32_t i)
{
	const arcs *a = arg;

	return a->visit(a->arg, a->fan->face[i]);
}

bool
mr_suspects_of(const mr_suspects *s, uint32_t face, bool (*visit)(void *arg, uint32_t face), void *arg)
{
	const mr_mesh *m = s->fans.bvh->mesh;
	const uint32_t *v = m->t[face].v;
	const mr_v3 p[3] = { m->p[v[0]], m->p[v[1]], m->p[v[2]] };
	uint32_t own = s->fan ? s->fans.face[face] : MR_NONE;
	arcs a = { own != MR_NONE ? &s->fan[own] : NULL, visit, arg };

	if (own == MR_NONE)
		return mr_bvh_overlap(s->fans.bvh, mr_box_of(p, 3), visit, arg);
	return mr_bvh_overlap(a.fan->bvh, box_of_arc(m, face, a.fan->apex), visit_arc, &a) &&
	       mr_bvh_meet_others(&s->fans, own, p, visit, arg);
}
