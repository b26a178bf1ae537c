/* Components.  Components of points are found over a binary tree of boxes: boxes out of a point's reach, or
 * of its component already, are skipped. */
#include "space/connected.h"

#include "base/disjoint_sets.h"
#include "mesh/zorder.h"

/* The reach of a point, in its spacings. */
static const double REACH = 4;

enum { LEAF = 8 };

/* ---- numbers ---- */

typedef struct set {
	uint32_t root, first; /* first: the lowest vertex */
	size_t size;
} set;

static int
by_size(const void *a, const void *b)
{
	const set *x = a, *y = b;

	if (x->size != y->size)
		return x->size > y->size ? -1 : 1;
	return (x->first > y->first) - (x->first < y->first);
}

/* The sets as parts.  vertex: of each element, or NULL where they are the same. */
static void
number_sets(mr_ctx *ctx, uint32_t *parent, const uint32_t *vertex, size_t n, mr_connected *c)
{
	mr_connected r = { .part = MR_NEW(ctx, n, uint32_t) };
	uint32_t *at;
	set *s;

	for (uint32_t i = 0; i < n; i++)
		r.parts += parent[i] == i;
	r.size = MR_NEW(ctx, r.parts, size_t);
	MR_SCOPE(ctx);
	s = MR_NEW(ctx, r.parts, set);
	at = MR_NEW(ctx, n, uint32_t);
	r.parts = 0;
	for (uint32_t i = 0; i < n; i++) { /* the root of a set is its least element, so it comes first */
		uint32_t root = mr_sets_root(parent, i), v = vertex ? vertex[i] : i;
		if (root == i) {
			at[i] = (uint32_t)r.parts;
			s[r.parts++] = (set){ i, v, 0 };
		}
		s[at[root]].size++;
		s[at[root]].first = v < s[at[root]].first ? v : s[at[root]].first;
	}
	qsort(s, r.parts, sizeof *s, by_size);
	for (size_t k = 0; k < r.parts; k++) {
		at[s[k].root] = (uint32_t)k;
		r.size[k] = s[k].size;
	}
	for (uint32_t i = 0; i < n; i++)
		r.part[vertex ? vertex[i] : i] = at[mr_sets_root(parent, i)];
	*c = r;
}

void
mr_connected_by_faces(mr_ctx *ctx, const mr_mesh *m, mr_connected *c)
{
	uint32_t *parent = mr_sets_new(ctx, m->nv);

	for (size_t f = 0; f < m->nf; f++)
		for (int k = 1; k < 3; k++)
			mr_sets_join(parent, m->t[f].v[0], m->t[f].v[k]);
	number_sets(ctx, parent, NULL, m->nv, c);
}

/* ---- points ---- */

/* Node k has the children 2 k + 1 and 2 k + 2, with half of its points each. */
typedef struct node {
	mr_box box;
	double reach; /* the most */
	bool one;     /* all of its points are known to be of one component */
} node;

typedef struct tree {
	mr_v3 *p;
	double *reach;
	uint32_t *parent;
	node *node;
} tree;

/* A node and its points. */
typedef struct range {
	size_t node, begin, end;
} range;

static bool
is_leaf(range r)
{
	return r.end - r.begin <= LEAF;
}

static range
child(range r, int which)
{
	size_t middle = r.begin + (r.end - r.begin) / 2;

	return which ? (range){ 2 * r.node + 2, middle, r.end } : (range){ 2 * r.node + 1, r.begin, middle };
}

static void
build(tree *t, range r)
{
	node *n = &t->node[r.node];

	*n = (node){ mr_box_empty(), 0, r.end - r.begin == 1 };
	if (is_leaf(r)) {
		for (size_t i = r.begin; i < r.end; i++) {
			mr_box_add(&n->box, t->p[i]);
			n->reach = fmax(n->reach, t->reach[i]);
		}
		return;
	}
	for (int k = 0; k < 2; k++) {
		range c = child(r, k);
		build(t, c);
		mr_box_add(&n->box, t->node[c.node].box.min);
		mr_box_add(&n->box, t->node[c.node].box.max);
		n->reach = fmax(n->reach, t->node[c.node].reach);
	}
}

static double
box_distance(const mr_box *b, mr_v3 p)
{
	return mr_norm(mr_vec(fmax(0, fmax(b->min.x - p.x, p.x - b->max.x)),
	    fmax(0, fmax(b->min.y - p.y, p.y - b->max.y)), fmax(0, fmax(b->min.z - p.z, p.z - b->max.z))));
}

static bool
same_set(tree *t, size_t i, size_t j)
{
	return mr_sets_root(t->parent, (uint32_t)i) == mr_sets_root(t->parent, (uint32_t)j);
}

/* Whether all points of the node are known to be of one component. */
static bool
is_one(tree *t, range r)
{
	node *n = &t->node[r.node];
	bool one = true;

	if (n->one)
		return true;
	for (size_t i = r.begin + 1; is_leaf(r) && i < r.end && one; i++)
		one = same_set(t, r.begin, i);
	if (!is_leaf(r))
		one = t->node[child(r, 0).node].one && t->node[child(r, 1).node].one &&
		      same_set(t, r.begin, child(r, 1).begin);
	return n->one = one;
}

/* Joins point i with the points of the node that it is connected with. */
static void
join_point(tree *t, size_t i, range r)
{
	const node *n = &t->node[r.node];

	if (box_distance(&n->box, t->p[i]) > fmin(t->reach[i], n->reach) ||
	    (is_one(t, r) && same_set(t, i, r.begin)))
		return;
	for (size_t j = r.begin; is_leaf(r) && j < r.end; j++)
		if (mr_dist(t->p[i], t->p[j]) <= fmin(t->reach[i], t->reach[j]))
			mr_sets_join(t->parent, (uint32_t)i, (uint32_t)j);
	for (int k = 0; k < 2 && !is_leaf(r); k++)
		join_point(t, i, child(r, k));
	is_one(t, r);
}

/* Nodes of a tree of n points. */
static size_t
count_nodes(size_t n)
{
	size_t nodes = 1;

	for (; n > LEAF; n -= n / 2) /* the larger half */
		nodes = 2 * nodes + 1;
	return nodes;
}

void
mr_connected_by_reach(mr_ctx *ctx, const mr_v3 *p, size_t n, const double *reach, mr_connected *c)
{
	uint32_t *order = MR_NEW(ctx, n, uint32_t);
	tree t = { MR_NEW(ctx, n, mr_v3), MR_NEW(ctx, n, double), mr_sets_new(ctx, n),
		MR_NEW(ctx, count_nodes(n), node) };

	mr_zorder(ctx, p, n, MR_ZORDER_CELLS, order);
	for (size_t i = 0; i < n; i++) {
		t.p[i] = p[order[i]];
		t.reach[i] = reach[order[i]];
	}
	if (n > 0) {
		build(&t, (range){ 0, 0, n });
		for (size_t i = 0; i < n; i++)
			join_point(&t, i, (range){ 0, 0, n });
	}
	number_sets(ctx, t.parent, order, n, c);
}

/* ---- layers ---- */

static mr_status
reach_of_spacing(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, double *reach)
{
	mr_sampling s;

	/* outliers would join their neighbours */
	MR_TRY(f ? mr_sampling_of(ctx, f, m, &s) : mr_sampling_find(ctx, m->p, m->nv, NULL, &s));
	for (size_t i = 0; i < m->nv; i++)
		reach[i] = s.outlier[i] ? 0 : REACH * s.spacing[i];
	return MR_OK;
}

mr_status
mr_connected_of(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, double distance, mr_connected *c)
{
	double *reach;

	if (m->nf) {
		mr_connected_by_faces(ctx, m, c);
		return MR_OK;
	}
	reach = MR_NEW(ctx, m->nv, double);
	for (size_t i = 0; i < m->nv; i++)
		reach[i] = distance;
	if (!(distance > 0))
		MR_TRY(reach_of_spacing(ctx, f, m, reach));
	mr_connected_by_reach(ctx, m->p, m->nv, reach, c);
	return MR_OK;
}
