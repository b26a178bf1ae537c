/* Contacts of components, by the nearest faces of others. */
#include "space/contact.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "space/bvh_labels.h"

#include <math.h>

void
mr_components_label(mr_ctx *ctx, const mr_mesh *m, uint32_t **component, bool *several)
{
	uint32_t *set = mr_sets_new(ctx, m->nv);
	size_t count;
	bool *used;

	mr_vertices_used(ctx, m->t, m->nf, m->nv, &used, &count);
	for (size_t f = 0; f < m->nf; f++) {
		mr_sets_join(set, m->t[f].v[0], m->t[f].v[1]);
		mr_sets_join(set, m->t[f].v[1], m->t[f].v[2]);
	}
	for (uint32_t v = 0; v < m->nv; v++)
		set[v] = mr_sets_root(set, v);
	for (uint32_t v = 0; v < m->nv; v++)
		set[v] = used[v] ? set[v] : MR_NONE;
	*several = false;
	for (size_t f = 1; f < m->nf; f++)
		*several |= set[m->t[f].v[0]] != set[m->t[0].v[0]];
	*component = set;
}

/* Vertices of the same component at the same place, in rings. */
typedef struct slits {
	uint32_t *next; /* itself where it is alone */
	uint32_t *face; /* the first of each vertex */
	bool any;
} slits;

/* A table of open addresses of the first vertices at each place, by cells. */
typedef struct grid {
	const mr_mesh *m;
	const uint32_t *component;
	uint32_t *table;
	size_t slots;
	double near, cell;
} grid;

/*
 * What is as near as this is at one place: sides of a seam are apart by what their coordinates were rounded
 * to, which of single precision is 1e-7 of the diagonal.  Where an edge is a hundred times as long as that no
 * more, it is the edges that bound it, and not the diagonal, which of a model with a stray part says nothing.
 */
static double
same_place(const mr_ctx *ctx, const mr_mesh *m)
{
	const double rounding = 1e-6, edge = 0.01, least = 1e-12;
	double diagonal = mr_mesh_diagonal(m);

	return fmax(
	    mr_mesh_tolerance(m, least), fmin(rounding * diagonal, edge * mr_mesh_edge_scale(ctx, m)));
}

static mr_v3
cell_of(const grid *g, mr_v3 p)
{
	return mr_vec(floor(p.x / g->cell) + 0.0, floor(p.y / g->cell) + 0.0, floor(p.z / g->cell) + 0.0);
}

static size_t
slot_of(const grid *g, mr_v3 cell, uint32_t component)
{
	uint64_t bits[3], hash = component;

	memcpy(bits, &cell, sizeof bits);
	for (int i = 0; i < 3; i++)
		hash = (hash ^ bits[i] ^ bits[i] >> 32) * 0x9e3779b97f4a7c15u;
	return (size_t)(hash >> 20) % g->slots;
}

/* The lowest of the cell that is where v is, or `best`. */
static uint32_t
lowest_in(const grid *g, mr_v3 cell, uint32_t v, uint32_t best)
{
	size_t i = slot_of(g, cell, g->component[v]);

	for (; g->table[i] != MR_NONE; i = (i + 1) % g->slots) {
		uint32_t u = g->table[i];
		if (u < best && g->component[u] == g->component[v] &&
		    mr_dist(g->m->p[u], g->m->p[v]) <= g->near)
			best = u;
	}
	return best;
}

/* The first vertex where v is, or v: in the cells that are near enough, mostly one or two. */
static uint32_t
first_at(const grid *g, uint32_t v)
{
	mr_v3 p = g->m->p[v], reach = mr_vec(g->near, g->near, g->near);
	mr_v3 low = cell_of(g, mr_sub(p, reach)), high = cell_of(g, mr_add(p, reach));
	int across = low.x != high.x ? 2 : 1, along = low.y != high.y ? 2 : 1, up = low.z != high.z ? 2 : 1;
	uint32_t best = v;

	for (int i = 0; i < across; i++)
		for (int j = 0; j < along; j++)
			for (int k = 0; k < up; k++)
				best = lowest_in(g,
				    mr_vec(i ? high.x : low.x, j ? high.y : low.y, k ? high.z : low.z), v,
				    best);
	return best;
}

static void
put(grid *g, uint32_t v)
{
	size_t i = slot_of(g, cell_of(g, g->m->p[v]), g->component[v]);

	while (g->table[i] != MR_NONE)
		i = (i + 1) % g->slots;
	g->table[i] = v;
}

static void
find_slits(mr_ctx *ctx, const mr_mesh *m, const uint32_t *component, slits *s)
{
	grid g = { .m = m, .component = component, .slots = 2 * m->nv + 1, .near = same_place(ctx, m) };

	g.cell = g.near > 0 ? 4 * g.near : 1;
	g.table = MR_NEW(ctx, g.slots, uint32_t);
	*s = (slits){ MR_NEW(ctx, m->nv, uint32_t), MR_NEW(ctx, m->nv, uint32_t), false };
	memset(g.table, 0xff, g.slots * sizeof *g.table);
	for (uint32_t v = 0; v < m->nv; v++) {
		uint32_t first;
		s->next[v] = v;
		if (component[v] == MR_NONE)
			continue;
		first = first_at(&g, v);
		if (first == v)
			put(&g, v);
		s->any |= first != v;
		s->next[v] = s->next[first];
		s->next[first] = v;
	}
	for (size_t f = m->nf; f-- > 0;)
		for (int k = 0; k < 3; k++)
			s->face[m->t[f].v[k]] = (uint32_t)f;
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

static void
make_tree(mr_ctx *ctx, search *s)
{
	uint32_t *label = MR_NEW(ctx, s->m->nf, uint32_t);
	mr_bvh *bvh;

	for (size_t f = 0; f < s->m->nf; f++)
		label[f] = s->component[s->m->t[f].v[0]];
	mr_bvh_build(ctx, s->m, &bvh);
	mr_bvh_label(ctx, bvh, label, &s->components);
}

/* Calls `each` with a search, where there is something to search for.  Its workspace is gone after that, so
 * that what was found lies below. */
static void
search_by(mr_ctx *ctx, const mr_mesh *m, double reach, mr_contacts *c,
    void (*each)(void *arg, size_t begin, size_t end))
{
	mr_mark mark = mr_mark_take(ctx);
	search s = { .m = m, .reach2 = reach * reach, .c = c };

	mr_components_label(ctx, m, &s.component, &s.several);
	find_slits(ctx, m, s.component, &s.slits);
	if (s.several)
		make_tree(ctx, &s);
	if (s.several || s.slits.any)
		mr_parallel(ctx, m->nv, 1024, each, &s);
	mr_mark_release(ctx, mark);
}

void
mr_contacts_find(mr_ctx *ctx, const mr_mesh *m, double reach, mr_contacts *contacts)
{
	mr_contacts c = { .start = MR_NEW_ZERO(ctx, m->nv + 1, size_t) };

	search_by(ctx, m, reach, &c, count_contacts);
	for (size_t v = 0; v < m->nv; v++) {
		c.vertices += c.start[v + 1] > 0;
		c.start[v + 1] += c.start[v];
	}
	c.at = MR_NEW(ctx, c.start[m->nv], mr_place);
	if (c.vertices)
		search_by(ctx, m, reach, &c, list_contacts);
	*contacts = c;
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
