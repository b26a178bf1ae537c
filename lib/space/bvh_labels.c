/* The searches of bvh.c, which leave out what has its own label or what is found nearer already. */
#include "space/bvh_labels.h"

#include "space/bvh_tree.h"

/* Nodes; by a third of these too no contact of 23 models changes. */
enum { LOOKS = 300 };

/* What all that has the label a or b has. */
static uint32_t
common(uint32_t a, uint32_t b)
{
	return a == b ? a : MR_NONE;
}

static uint32_t
label_of_leaf(const mr_bvh_labels *l, uint32_t first, uint32_t count)
{
	uint32_t label = l->face[l->bvh->face[first]];

	for (uint32_t i = 1; i < count; i++)
		label = common(label, l->face[l->bvh->face[first + i]]);
	return label;
}

/* A node's first child is there. */
static uint32_t
label_node(mr_bvh_labels *l, uint32_t node)
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

void
mr_bvh_label(mr_ctx *ctx, const mr_bvh *bvh, const uint32_t *label, mr_bvh_labels *labels)
{
	mr_bvh_labels l = { bvh, label, MR_NEW(ctx, bvh_node_bound(bvh->mesh->nf), uint32_t) };

	if (bvh->mesh->nf)
		label_node(&l, 0);
	*labels = l;
}

typedef struct search {
	const mr_bvh_labels *labels;
	mr_v3 q;
	uint32_t own;
	double dist2;
	size_t most, n;
	mr_closest *found; /* the nearest first */
} search;

/* Where the label is among those found; n where it is not. */
static size_t
place_of(const search *s, uint32_t label)
{
	size_t i = 0;

	while (i < s->n && s->labels->face[s->found[i].at.face] != label)
		i++;
	return i;
}

/* The squared distance beyond which what has this label, or several, is of no account. */
static double
limit_of(const search *s, uint32_t label)
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
keep(search *s, const mr_closest *c)
{
	size_t i = place_of(s, s->labels->face[c->at.face]);

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
look_at_leaf(search *s, bvh_entry leaf)
{
	const mr_bvh *bvh = s->labels->bvh;

	for (uint32_t i = 0; i < leaf.count; i++) {
		uint32_t f = bvh->face[leaf.child + i];
		double limit = limit_of(s, s->labels->face[f]);
		mr_closest c;
		if (limit < 0)
			continue;
		c = mr_face_closest(bvh->mesh, f, s->q);
		if (c.dist2 <= limit)
			keep(s, &c);
	}
}

size_t
mr_bvh_closest_others(
    const mr_bvh_labels *labels, mr_v3 q, uint32_t own, double dist2, size_t most, mr_closest *out)
{
	const mr_bvh *bvh = labels->bvh;
	search s = { labels, q, own, dist2, most, 0, out };
	mr_v3 u = bvh_unit(bvh, q);
	double unit2 = bvh->scale * bvh->scale, bound[BVH_WIDE];
	bvh_entry stack[BVH_STACK], *top = stack;
	size_t looks = 0;

	if (bvh->mesh->nf)
		*top++ = (bvh_entry){ 0, 0, 0 };
	while (top > stack && looks < LOOKS) {
		bvh_entry e = *--top;
		if (e.bound > limit_of(&s, e.count ? MR_NONE : labels->node[e.child]) * unit2)
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
