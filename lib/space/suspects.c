/* The tree against itself, the children of each node among each other. */
#include "space/suspects.h"

#include "base/parallel.h"
#include "space/bvh_tree.h"

/* Of a face, in units of the mesh. */
typedef struct face_box {
	float lo[3], hi[3];
} face_box;

typedef struct suspects {
	const mr_bvh *bvh;
	const uint32_t *node; /* all nodes, the root first */
	size_t nodes;
	face_box *box; /* in the order of the tree */
	void (*visit)(void *arg, uint32_t f, uint32_t g);
	void *arg;
} suspects;

static void
visit_places(const suspects *s, uint32_t i, uint32_t j)
{
	uint32_t f = s->bvh->face[i], g = s->bvh->face[j];
	const face_box *a = &s->box[i], *b = &s->box[j];

	if (a->lo[0] > b->hi[0] || b->lo[0] > a->hi[0] || a->lo[1] > b->hi[1] || b->lo[1] > a->hi[1] ||
	    a->lo[2] > b->hi[2] || b->lo[2] > a->hi[2])
		return;
	if (f < g)
		s->visit(s->arg, f, g);
	else
		s->visit(s->arg, g, f);
}

static bool
children_meet(const mr_bvh_node *a, int i, const mr_bvh_node *b, int k)
{
	return a->lo[0][i] <= b->hi[0][k] && a->hi[0][i] >= b->lo[0][k] && a->lo[1][i] <= b->hi[1][k] &&
	       a->hi[1][i] >= b->lo[1][k] && a->lo[2][i] <= b->hi[2][k] && a->hi[2][i] >= b->lo[2][k];
}

static float
girth(const mr_bvh_node *a, int i)
{
	return a->hi[0][i] - a->lo[0][i] + a->hi[1][i] - a->lo[1][i] + a->hi[2][i] - a->lo[2][i];
}

/* Child i of a with child k of b, the larger one by its children; what is not there meets nothing. */
static void
cross(const suspects *s, const mr_bvh_node *a, int i, const mr_bvh_node *b, int k)
{
	if (!children_meet(a, i, b, k))
		return;
	if (a->count[i] && b->count[k]) {
		for (uint32_t x = a->child[i]; x < a->child[i] + a->count[i]; x++)
			for (uint32_t y = b->child[k]; y < b->child[k] + b->count[k]; y++)
				visit_places(s, x, y);
	} else if (b->count[k] || (!a->count[i] && girth(a, i) > girth(b, k))) {
		for (int c = 0; c < BVH_WIDE; c++)
			cross(s, &s->bvh->nodes[a->child[i]], c, b, k);
	} else {
		for (int c = 0; c < BVH_WIDE; c++)
			cross(s, a, i, &s->bvh->nodes[b->child[k]], c);
	}
}

static void
cross_nodes(void *arg, size_t begin, size_t end)
{
	const suspects *s = arg;

	for (size_t n = begin; n < end; n++) {
		const mr_bvh_node *d = &s->bvh->nodes[s->node[n]];
		for (int i = 0; i < BVH_WIDE; i++) {
			for (int k = i + 1; k < BVH_WIDE; k++)
				cross(s, d, i, d, k);
			for (uint32_t x = d->child[i]; d->count[i] && x < d->child[i] + d->count[i]; x++)
				for (uint32_t y = d->child[i]; y < x; y++)
					visit_places(s, x, y);
		}
	}
}

/* The nodes are in no row: each stands where there was room for its subtree. */
static void
list_nodes(mr_ctx *ctx, suspects *s)
{
	uint32_t *node = MR_NEW(ctx, bvh_node_bound(s->bvh->mesh->nf), uint32_t);
	size_t n = 0;

	node[n++] = 0;
	for (size_t i = 0; i < n; i++)
		for (int c = 0; c < BVH_WIDE; c++) {
			const mr_bvh_node *d = &s->bvh->nodes[node[i]];
			if (d->child[c] != MR_NONE && !d->count[c])
				node[n++] = d->child[c];
		}
	s->node = node;
	s->nodes = n;
}

/* No rounding takes apart what meets: all of it leaves the order of numbers as it is. */
static void
find_boxes(void *arg, size_t begin, size_t end)
{
	const suspects *s = arg;
	const mr_mesh *m = s->bvh->mesh;

	for (size_t i = begin; i < end; i++) {
		mr_v3 p[3];
		mr_corners(m, s->bvh->face[i], p);
		mr_box box = mr_box_of(p, 3);
		mr_v3 lo = bvh_unit(s->bvh, box.min), hi = bvh_unit(s->bvh, box.max);
		for (int k = 0; k < 3; k++) {
			s->box[i].lo[k] = (float)mr_coordinate(lo, k);
			s->box[i].hi[k] = (float)mr_coordinate(hi, k);
		}
	}
}

void
mr_suspects_visit(mr_ctx *ctx, const mr_bvh *bvh, void (*visit)(void *arg, uint32_t f, uint32_t g), void *arg)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nf = bvh->mesh->nf;
	suspects s = { .bvh = bvh, .box = MR_NEW(ctx, nf, face_box), .visit = visit, .arg = arg };

	if (nf == 0)
		return;
	list_nodes(ctx, &s);
	mr_parallel(ctx, nf, 4096, find_boxes, &s);
	mr_parallel(ctx, s.nodes, 64, cross_nodes, &s);
	mr_mark_release(ctx, mark);
}
