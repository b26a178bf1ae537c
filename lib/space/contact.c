/* Contacts of components, by the nearest faces of others. */
#include "space/contact.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "space/bvh_labels.h"

#include <math.h>

mr_status
mr_components_label(mr_ctx *ctx, const mr_mesh *m, uint32_t **component, bool *several)
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
slot_of(mr_v3 p, uint32_t component, size_t slots)
{
	const double c[3] = { p.x + 0.0, p.y + 0.0, p.z + 0.0 }; /* either zero */
	uint64_t bits[3], hash = component;

	memcpy(bits, c, sizeof bits);
	for (int i = 0; i < 3; i++)
		hash = (hash ^ bits[i] ^ bits[i] >> 32) * 0x9e3779b97f4a7c15u;
	return (size_t)(hash >> 20) % slots;
}

/* Vertices of the same component at the same place, in rings. */
typedef struct slits {
	uint32_t *next; /* itself where it is alone */
	uint32_t *face; /* the first of each vertex */
	bool any;
} slits;

/* By a table of open addresses. */
static mr_status
find_slits(mr_ctx *ctx, const mr_mesh *m, const uint32_t *component, slits *s)
{
	size_t slots = 2 * m->nv + 1;
	uint32_t *table = MR_NEW(ctx, slots, uint32_t);

	*s = (slits){ MR_NEW(ctx, m->nv, uint32_t), MR_NEW(ctx, m->nv, uint32_t), false };
	if (!table || !s->next || !s->face)
		return MR_EMEM;
	memset(table, 0xff, slots * sizeof *table);
	for (uint32_t v = 0; v < m->nv; v++) {
		size_t i = slot_of(m->p[v], component[v], slots);
		uint32_t before;
		s->next[v] = v;
		if (component[v] == MR_NONE)
			continue;
		while (table[i] != MR_NONE &&
		       !(component[table[i]] == component[v] && is_same(m->p[table[i]], m->p[v])))
			i = (i + 1) % slots;
		before = table[i] == MR_NONE ? v : table[i];
		s->any |= before != v;
		s->next[v] = s->next[before];
		s->next[before] = v;
		table[i] = before;
	}
	for (size_t f = m->nf; f-- > 0;)
		for (int k = 0; k < 3; k++)
			s->face[m->t[f].v[k]] = (uint32_t)f;
	return MR_OK;
}

typedef struct search {
	const mr_mesh *m;
	mr_bvh_labels components;
	uint32_t *component;
	slits slits;
	bool several; /* components */
	double reach2;
	mr_contacts *c; /* at first each start is how many the vertex before has */
} search;

static bool
has_corner(const mr_tri *t, uint32_t v)
{
	return t->v[0] == v || t->v[1] == v || t->v[2] == v;
}

/* Faces at the other vertices of the ring of v, without those that have v itself. */
static size_t
across_slit(const search *s, uint32_t v, mr_closest *out)
{
	size_t n = 0;

	for (uint32_t i = s->slits.next[v]; i != v && n < MR_CONTACTS; i = s->slits.next[i])
		if (!has_corner(&s->m->t[s->slits.face[i]], v))
			out[n++] = mr_face_closest(s->m, s->slits.face[i], s->m->p[v]);
	return n;
}

static size_t
contacts_of(const search *s, uint32_t v, mr_closest *out)
{
	size_t n;

	if (s->component[v] == MR_NONE)
		return 0;
	n = across_slit(s, v, out);
	if (!s->several || n == MR_CONTACTS)
		return n;
	return n + mr_bvh_closest_others(
		       &s->components, s->m->p[v], s->component[v], s->reach2, MR_CONTACTS - n, out + n);
}

static void
count_contacts(void *arg, size_t begin, size_t end)
{
	const search *s = arg;
	mr_closest found[MR_CONTACTS];

	for (size_t v = begin; v < end; v++)
		s->c->start[v + 1] = contacts_of(s, (uint32_t)v, found);
}

static void
list_contacts(void *arg, size_t begin, size_t end)
{
	const search *s = arg;
	mr_closest found[MR_CONTACTS];

	for (size_t v = begin; v < end; v++) {
		size_t first = s->c->start[v], n = s->c->start[v + 1] - first;
		if (n > 0)
			contacts_of(s, (uint32_t)v, found);
		for (size_t i = 0; i < n; i++)
			s->c->at[first + i] = found[i].at;
	}
}

static mr_status
make_tree(mr_ctx *ctx, search *s)
{
	uint32_t *label = MR_NEW(ctx, s->m->nf, uint32_t);
	mr_bvh *bvh;

	if (!label)
		return MR_EMEM;
	for (size_t f = 0; f < s->m->nf; f++)
		label[f] = s->component[s->m->t[f].v[0]];
	MR_TRY(mr_bvh_build(ctx, s->m, &bvh));
	return mr_bvh_label(ctx, bvh, label, &s->components);
}

/* Calls `each` with a search, where there is something to search for.  Its workspace is gone after that, so
 * that what was found lies below. */
static mr_status
search_by(mr_ctx *ctx, const mr_mesh *m, double reach, mr_contacts *c,
    void (*each)(void *arg, size_t begin, size_t end))
{
	mr_mark mark = mr_mark_take(ctx);
	search s = { .m = m, .reach2 = reach * reach, .c = c };

	MR_TRY(mr_components_label(ctx, m, &s.component, &s.several));
	MR_TRY(find_slits(ctx, m, s.component, &s.slits));
	if (s.several)
		MR_TRY(make_tree(ctx, &s));
	if (s.several || s.slits.any)
		mr_parallel(ctx, m->nv, 1024, each, &s);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_contacts_find(mr_ctx *ctx, const mr_mesh *m, double reach, mr_contacts *contacts)
{
	mr_contacts c = { .start = MR_NEW_ZERO(ctx, m->nv + 1, size_t) };

	if (!c.start)
		return MR_EMEM;
	MR_TRY(search_by(ctx, m, reach, &c, count_contacts));
	for (size_t v = 0; v < m->nv; v++) {
		c.vertices += c.start[v + 1] > 0;
		c.start[v + 1] += c.start[v];
	}
	c.at = MR_NEW(ctx, c.start[m->nv], mr_place);
	if (!c.at)
		return MR_EMEM;
	if (c.vertices)
		MR_TRY(search_by(ctx, m, reach, &c, list_contacts));
	*contacts = c;
	return MR_OK;
}

static double
width_of(const mr_mesh *m, uint32_t v, mr_place at)
{
	return mr_dist(m->p[v], mr_place_point(m, at));
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
	for (uint32_t v = 0; v < m->nv; v++) {
		double widened = 0;
		for (size_t i = contacts->start[v]; i < contacts->start[v + 1]; i++)
			if (width_of(m, v, contacts->at[i]) <= width)
				widened = fmax(widened, width_of(&moved, v, contacts->at[i]));
		n += widened > width;
		if (widened > fmax(width, most)) {
			most = widened;
			*widest = v;
		}
	}
	return n;
}
