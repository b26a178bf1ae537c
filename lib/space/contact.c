/* Contacts of components, by the nearest faces of others. */
#include "space/contact.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "mesh/repair.h"
#include "space/bvh_tree.h"

void
mr_components_label(mr_ctx *ctx, const mr_mesh *m, uint32_t **component, bool *several)
{
	uint32_t *set = MR_NEW(ctx, m->nv, uint32_t);

	memset(set, 0xff, m->nv * sizeof *set);
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		for (int k = 0; k < 3; k++)
			if (set[v[k]] == MR_NONE)
				set[v[k]] = v[k];
		mr_sets_join(set, v[0], v[1]);
		mr_sets_join(set, v[1], v[2]);
	}
	*several = false;
	for (uint32_t v = 0, first = MR_NONE; v < m->nv; v++) {
		if (set[v] == MR_NONE)
			continue;
		set[v] = mr_sets_root(set, v);
		first = first == MR_NONE ? set[v] : first;
		*several |= set[v] != first;
	}
	*component = set;
}

/* Around an inner vertex each neighbour comes once before another one and once after it. */
void
mr_boundary_label(mr_ctx *ctx, const mr_mesh *m, bool **boundary, bool *any)
{
	uint32_t *sum = MR_NEW_ZERO(ctx, m->nv, uint32_t);
	bool *at = MR_NEW(ctx, m->nv, bool);

	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		sum[v[0]] += v[1] - v[2];
		sum[v[1]] += v[2] - v[0];
		sum[v[2]] += v[0] - v[1];
	}
	*any = false;
	for (size_t v = 0; v < m->nv; v++) {
		at[v] = sum[v] != 0;
		*any |= at[v];
	}
	*boundary = at;
}

/* ---- near faces of other labels than one's own ---- */

/* A tree over a mesh whose faces have labels. */
typedef struct labels {
	const mr_bvh *bvh;
	const uint32_t *face; /* of each face */
	uint32_t *node;       /* what all faces below a node have, MR_NONE where they have several */
} labels;

/* Nodes; by a third of these too no contact of 23 models changes. */
enum { NODES = 300 };

/* The label of a and b; MR_NONE if they differ. */
static uint32_t
common(uint32_t a, uint32_t b)
{
	return a == b ? a : MR_NONE;
}

static uint32_t
label_of_leaf(const labels *l, uint32_t first, uint32_t count)
{
	uint32_t label = l->face[l->bvh->face[first]];

	for (uint32_t i = 1; i < count; i++)
		label = common(label, l->face[l->bvh->face[first + i]]);
	return label;
}

/* A node's first child is there. */
static uint32_t
label_node(labels *l, uint32_t node)
{
	const mr_bvh_node *d = &l->bvh->nodes[node];
	uint32_t label = MR_NONE;

	for (int c = 0; c < BVH_WIDE && d->child[c] != MR_NONE; c++) {
		uint32_t is = d->count[c] ? label_of_leaf(l, d->child[c], d->count[c])
		                          : label_node(l, d->child[c]);
		label = c == 0 ? is : common(label, is);
	}
	return l->node[node] = label;
}

/* label: one a face, MR_NONE for none; kept, as is bvh.  In the arena. */
static labels
label_tree(mr_ctx *ctx, const mr_bvh *bvh, const uint32_t *label)
{
	labels l = { bvh, label, MR_NEW(ctx, bvh_node_bound(bvh->mesh->nf), uint32_t) };

	if (bvh->mesh->nf)
		label_node(&l, 0);
	return l;
}

/* A search of bvh.c that skips its own label and labels already found nearer. */
typedef struct others {
	const labels *l;
	mr_v3 q;
	uint32_t own;
	double dist2;
	size_t most, n;
	mr_closest *found; /* the nearest first */
} others;

/* The index of the label among the found ones; n if it is missing. */
static size_t
place_of(const others *s, uint32_t label)
{
	size_t i = 0;

	while (i < s->n && s->l->face[s->found[i].at.face] != label)
		i++;
	return i;
}

/* The squared distance beyond which what has this label, or several, is of no account. */
static double
limit_of(const others *s, uint32_t label)
{
	size_t i = place_of(s, label);

	if (label == s->own)
		return -1;
	return i < s->n ? s->found[i].dist2 : s->n == s->most ? s->found[s->n - 1].dist2 : s->dist2;
}

static bool
is_nearer(const mr_closest *a, const mr_closest *b)
{
	return a->dist2 < b->dist2 || (a->dist2 == b->dist2 && a->at.face < b->at.face);
}

/* Takes the place of what its label had, or else of the last where there is no room. */
static void
keep(others *s, const mr_closest *c)
{
	size_t i = place_of(s, s->l->face[c->at.face]);

	if (i == s->n && s->n < s->most) {
		s->n++;
	} else {
		i -= i == s->n;
		if (!is_nearer(c, &s->found[i]))
			return;
	}
	for (; i > 0 && is_nearer(c, &s->found[i - 1]); i--)
		s->found[i] = s->found[i - 1];
	s->found[i] = *c;
}

static void
look_at_leaf(others *s, bvh_entry leaf)
{
	const mr_bvh *bvh = s->l->bvh;

	for (uint32_t i = 0; i < leaf.count; i++) {
		uint32_t f = bvh->face[leaf.child + i];
		double limit = limit_of(s, s->l->face[f]);
		mr_closest c;
		if (limit < 0)
			continue;
		c = mr_face_closest(bvh->mesh, f, s->q);
		if (c.dist2 <= limit)
			keep(s, &c);
	}
}

/*
 * Finds the `most` nearest labels other than `own` within sqrt(dist2), and the nearest point of each: out,
 * the nearest first, of several the lowest face.  Returns how many.  Overlapping boxes of many faces may hide
 * a near one: NODES nodes are looked at, near boxes first.  No label is MR_NONE.
 */
static size_t
closest_others(const labels *l, mr_v3 q, uint32_t own, double dist2, size_t most, mr_closest *out)
{
	const mr_bvh *bvh = l->bvh;
	others s = { l, q, own, dist2, most, 0, out };
	mr_v3 u = bvh_unit(bvh, q);
	double unit2 = bvh->scale * bvh->scale, bound[BVH_WIDE];
	bvh_entry stack[BVH_STACK], *top = stack;
	size_t looks = 0;

	if (bvh->mesh->nf)
		*top++ = (bvh_entry){ 0, 0, 0 };
	while (top > stack && looks < NODES) {
		bvh_entry e = *--top;
		if (e.bound > limit_of(&s, e.count ? MR_NONE : l->node[e.child]) * unit2)
			continue;
		if (e.count) {
			look_at_leaf(&s, e);
		} else {
			looks++;
			bvh_box_distances(&bvh->nodes[e.child], u, bound);
			top = bvh_push_sorted(
			    top, &bvh->nodes[e.child], bound, limit_of(&s, MR_NONE) * unit2);
		}
	}
	return s.n;
}

/* ---- contacts ---- */

/* Vertices of the same component at the same place, in rings. */
typedef struct slits {
	uint32_t *next; /* itself where it is alone */
	uint32_t *face; /* the first of each vertex */
	bool any, closed;
} slits;

/* The mean area of some faces. */
static double
some_area(const mr_mesh *m)
{
	enum { LOOKS = 1 << 12 };
	size_t stride = 1 + m->nf / LOOKS, n = 0;
	double sum = 0;

	for (size_t f = 0; f < m->nf; f += stride, n++)
		sum += mr_norm(mr_face_cross(m, f)) / 2;
	return sum / (double)n;
}

/*
 * Vertices this near are at one place, of n at the boundary: the sides of a seam differ by the rounding of
 * their coordinates, 1e-7 of the diagonal in single precision.  At most a hundredth of an edge: a stray part
 * makes the diagonal meaningless.
 */
static double
same_place(const mr_mesh *m, const mr_v3 *p, size_t n)
{
	const double rounding = 1e-6, edge = 0.01, least = 1e-12;
	mr_box box = mr_box_of(p, n);

	return fmax(mr_box_tolerance(box, least),
	    fmin(rounding * mr_box_diagonal(box), edge * sqrt(2 * some_area(m))));
}

/* The vertices of the boundary. */
static uint32_t *
list_boundary(mr_ctx *ctx, const mr_mesh *m, const bool *boundary, mr_v3 *p, size_t *n)
{
	uint32_t *list = MR_NEW(ctx, m->nv, uint32_t);

	*n = 0;
	for (uint32_t v = 0; v < m->nv; v++)
		if (boundary[v]) {
			p[*n] = m->p[v];
			list[(*n)++] = v;
		}
	return list;
}

/* Welded vertices of one component become rings. */
static void
find_slits(mr_ctx *ctx, const mr_mesh *m, const uint32_t *component, slits *s)
{
	mr_v3 *p = MR_NEW(ctx, m->nv, mr_v3);
	uint32_t *list, *place, *other, *head;
	bool *boundary, any;
	size_t n, places;

	*s = (slits){ .next = mr_sets_new(ctx, m->nv), .face = MR_NEW(ctx, m->nv, uint32_t) };
	mr_boundary_label(ctx, m, &boundary, &any);
	s->closed = !any;
	if (!any)
		return;
	list = list_boundary(ctx, m, boundary, p, &n);
	place = MR_NEW(ctx, n, uint32_t);
	mr_weld(ctx, p, n, same_place(m, p, n), place, &places);
	head = MR_NEW(
	    ctx, places, uint32_t); /* the first of each component at a place, and `other`, the next */
	other = MR_NEW(ctx, m->nv, uint32_t);
	memset(head, 0xff, places * sizeof *head);
	for (size_t i = 0; i < n; i++) {
		uint32_t v = list[i], u = head[place[i]];
		while (u != MR_NONE && component[u] != component[v])
			u = other[u];
		if (u != MR_NONE) {
			s->next[v] = s->next[u];
			s->next[u] = v;
			s->any = true;
		} else {
			other[v] = head[place[i]];
			head[place[i]] = v;
		}
	}
	for (size_t f = m->nf; f-- > 0;)
		for (int k = 0; k < 3; k++)
			s->face[m->t[f].v[k]] = (uint32_t)f;
}

typedef struct search {
	const mr_mesh *m;
	labels components;
	uint32_t *component;
	slits slits;
	bool several; /* components */
	double reach2;
	mr_contacts *c; /* at first each start is how many the vertex before has */
} search;

/* Faces at the other vertices of the ring of v, without those that have v itself. */
static size_t
across_slit(const search *s, uint32_t v, mr_closest *out)
{
	size_t n = 0;

	for (uint32_t i = s->slits.next[v]; i != v && n < MR_CONTACTS; i = s->slits.next[i])
		if (!mr_has_corner(s->m->t[s->slits.face[i]], v))
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
	return n + closest_others(
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
	s->components = label_tree(ctx, bvh, label);
}

void
mr_contacts_find(mr_ctx *ctx, const mr_mesh *m, double reach, mr_contacts *contacts)
{
	mr_contacts c = { .start = MR_NEW_ZERO(ctx, m->nv + 1, size_t) };
	search s = { .m = m, .reach2 = reach * reach, .c = &c };

	mr_components_label(ctx, m, &s.component, &s.several);
	find_slits(ctx, m, s.component, &s.slits);
	c.closed = s.slits.closed;
	*contacts = c;
	if (!s.several && !s.slits.any)
		return;
	if (s.several)
		make_tree(ctx, &s);
	mr_parallel(ctx, m->nv, 1024, count_contacts, &s);
	for (size_t v = 0; v < m->nv; v++) {
		c.vertices += c.start[v + 1] > 0;
		c.start[v + 1] += c.start[v];
	}
	c.at = MR_NEW(ctx, c.start[m->nv], mr_place);
	if (c.vertices)
		mr_parallel(ctx, m->nv, 1024, list_contacts, &s);
	*contacts = c;
}

static double
width_of(const mr_mesh *m, uint32_t v, mr_place at)
{
	return mr_dist(m->p[v], mr_place_point(m, at));
}

double
mr_contact_widened(
    const mr_contacts *contacts, const mr_mesh *m, const mr_v3 *after, double width, uint32_t v)
{
	mr_mesh moved = *m;
	double widened = 0;

	moved.p = after;
	for (size_t i = contacts->start[v]; i < contacts->start[v + 1]; i++)
		if (width_of(m, v, contacts->at[i]) <= width)
			widened = fmax(widened, width_of(&moved, v, contacts->at[i]));
	return widened;
}

size_t
mr_contacts_open(
    const mr_contacts *contacts, const mr_mesh *m, const mr_v3 *after, double width, uint32_t *widest)
{
	double most = 0;
	size_t n = 0;

	*widest = MR_NONE;
	for (uint32_t v = 0; v < m->nv; v++) {
		double widened = mr_contact_widened(contacts, m, after, width, v);
		n += widened > width;
		if (widened > fmax(width, most)) {
			most = widened;
			*widest = v;
		}
	}
	return n;
}
