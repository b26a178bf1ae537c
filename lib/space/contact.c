/* Contacts of components, by boxes around vertices. */
#include "space/contact.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "space/bvh.h"

#include <math.h>

/* component: of each vertex, the vertex that stands for it; MR_NONE where it has no face. */
static mr_status
label_components(mr_ctx *ctx, const mr_mesh *m, uint32_t **component, bool *several)
{
	uint32_t *set = mr_sets_new(ctx, m->nv);
	bool *used = MR_NEW_ZERO(ctx, m->nv, bool);

	if (!set || !used)
		return MR_EMEM;
	for (size_t f = 0; f < m->nf; f++) {
		mr_sets_join(set, m->t[f].v[0], m->t[f].v[1]);
		mr_sets_join(set, m->t[f].v[1], m->t[f].v[2]);
		for (int k = 0; k < 3; k++)
			used[m->t[f].v[k]] = true;
	}
	for (uint32_t v = 0; v < m->nv; v++)
		set[v] = mr_sets_root(set, v);
	for (uint32_t v = 0; v < m->nv; v++)
		set[v] = used[v] ? set[v] : MR_NONE;
	*several = false;
	for (size_t f = 1; f < m->nf; f++)
		*several |= set[m->t[f].v[0]] != set[m->t[0].v[0]];
	*component = set;
	return MR_OK;
}

static bool
is_same(mr_v3 a, mr_v3 b)
{
	return a.x == b.x && a.y == b.y && a.z == b.z;
}

static size_t
slot_of(mr_v3 p, size_t slots)
{
	const double c[3] = { p.x + 0.0, p.y + 0.0, p.z + 0.0 }; /* either zero */
	uint64_t bits[3], hash = 0;

	memcpy(bits, c, sizeof bits);
	for (int i = 0; i < 3; i++)
		hash = (hash ^ bits[i] ^ bits[i] >> 32) * 0x9e3779b97f4a7c15u;
	return (size_t)(hash >> 20) % slots;
}

/* slit: of each vertex, whether another one is at its place; by a table of open addresses. */
static mr_status
find_slits(mr_ctx *ctx, const mr_mesh *m, bool **slit, bool *any)
{
	size_t slots = 2 * m->nv + 1;
	uint32_t *table = MR_NEW(ctx, slots, uint32_t);

	*slit = MR_NEW_ZERO(ctx, m->nv, bool);
	if (!table || !*slit)
		return MR_EMEM;
	memset(table, 0xff, slots * sizeof *table);
	for (uint32_t v = 0; v < m->nv; v++) {
		size_t i = slot_of(m->p[v], slots);
		while (table[i] != MR_NONE && !is_same(m->p[table[i]], m->p[v]))
			i = (i + 1) % slots;
		if (table[i] == MR_NONE)
			table[i] = v;
		else
			*any = (*slit)[v] = (*slit)[table[i]] = true;
	}
	return MR_OK;
}

typedef struct search {
	const mr_mesh *m;
	const mr_bvh *bvh;
	const uint32_t *component;
	const bool *slit;
	bool several; /* components */
	double reach2;
	mr_place *at; /* nv; of face MR_NONE: no contact */
} search;

typedef struct nearest {
	const search *s;
	uint32_t vertex;
	mr_closest best;
} nearest;

/* Whether face f is beyond a slit at v. */
static bool
is_beyond(const search *s, uint32_t f, uint32_t v)
{
	const uint32_t *c = s->m->t[f].v;
	bool there = false;

	for (int k = 0; k < 3; k++) {
		if (c[k] == v)
			return false;
		there |= is_same(s->m->p[c[k]], s->m->p[v]);
	}
	return there;
}

static bool
visit(void *arg, uint32_t f)
{
	nearest *n = arg;
	const search *s = n->s;
	mr_closest c;

	if (s->component[s->m->t[f].v[0]] == s->component[n->vertex] &&
	    !(s->slit[n->vertex] && is_beyond(s, f, n->vertex)))
		return true;
	c = mr_face_closest(n->s->m, f, n->s->m->p[n->vertex]);
	if (c.dist2 < n->best.dist2 || (c.dist2 == n->best.dist2 && f < n->best.at.face))
		n->best = c;
	return true;
}

static void
search_vertices(void *arg, size_t begin, size_t end)
{
	search *s = arg;
	double reach = sqrt(s->reach2);
	mr_v3 half = mr_vec(reach, reach, reach);

	for (size_t v = begin; v < end; v++) {
		nearest n = { s, (uint32_t)v, { .at.face = MR_NONE, .dist2 = INFINITY } };
		mr_box box = { mr_sub(s->m->p[v], half), mr_add(s->m->p[v], half) };
		if (s->component[v] != MR_NONE && (s->several || s->slit[v]))
			mr_bvh_overlap(s->bvh, box, visit, &n);
		s->at[v] = n.best.at;
		if (n.best.dist2 > s->reach2)
			s->at[v].face = MR_NONE;
	}
}

static mr_status
search_all(mr_ctx *ctx, search *s)
{
	mr_bvh *bvh;

	MR_TRY(mr_bvh_build(ctx, s->m, &bvh));
	s->bvh = bvh;
	mr_parallel(ctx, s->m->nv, 1024, search_vertices, s);
	return MR_OK;
}

/* Leaves only the places that are some. */
static void
compact(mr_contacts *c, size_t nv)
{
	for (uint32_t v = 0; v < nv; v++)
		if (c->at[v].face != MR_NONE) {
			c->vertex[c->n] = v;
			c->at[c->n++] = c->at[v];
		}
}

mr_status
mr_contacts_find(mr_ctx *ctx, const mr_mesh *m, double reach, mr_contacts *contacts)
{
	mr_mark begin = mr_mark_take(ctx), mark;
	mr_contacts c = { 0, MR_NEW(ctx, m->nv, uint32_t), MR_NEW(ctx, m->nv, mr_place) };
	bool several, slits = false, *slit;
	uint32_t *component;

	if (!c.vertex || !c.at)
		return MR_EMEM;
	mark = mr_mark_take(ctx);
	MR_TRY(label_components(ctx, m, &component, &several));
	MR_TRY(find_slits(ctx, m, &slit, &slits));
	if (several || slits) {
		MR_TRY(search_all(ctx, &(search){ m, NULL, component, slit, several, reach * reach, c.at }));
		compact(&c, m->nv);
	}
	mr_mark_release(ctx, c.n ? mark : begin);
	*contacts = c;
	return MR_OK;
}

static double
width_of(const mr_contacts *c, size_t i, const mr_mesh *m)
{
	return mr_dist(m->p[c->vertex[i]], mr_place_point(m, c->at[i]));
}

size_t
mr_contacts_open(
    const mr_contacts *contacts, const mr_mesh *m, const mr_v3 *after, double width, uint32_t *widest)
{
	mr_mesh moved = *m;
	double most = 0;
	size_t n = 0;

	moved.p = after;
	*widest = MR_NONE;
	for (size_t i = 0; i < contacts->n; i++) {
		double is = width_of(contacts, i, &moved);
		if (is <= width || width_of(contacts, i, m) > width)
			continue;
		n++;
		if (is > most) {
			most = is;
			*widest = contacts->vertex[i];
		}
	}
	return n;
}
