/* Fans, and the directions in which their faces lie: triangles with a common corner have more than that in
 * common where the arcs do that they are seen as from there. */
#include "space/suspects.h"

#include "base/parallel.h"
#include "mesh/alike.h"
#include "space/bvh_labels.h"
#include "space/bvh_tree.h"

/* Faces around a vertex that make a fan of them: all pairs of fewer take no longer than the index. */
enum { FAN = 256 };

typedef struct mr_fan {
	uint32_t apex;
	size_t n;
	uint32_t *face;
	mr_mesh boxes; /* of the arcs, as triangles that have these boxes */
	mr_bvh *bvh;
} mr_fan;

/* Of a face, in units of the mesh. */
typedef struct face_box {
	float lo[3], hi[3];
} face_box;

typedef struct suspects {
	const mr_bvh *bvh;
	mr_bvh_labels fans;   /* the fan that a face is of, or MR_NONE */
	const mr_fan *fan;    /* NULL without any */
	const uint32_t *node; /* all nodes, the root first */
	size_t nodes;
	face_box *box; /* in the order of the tree */
	void (*visit)(void *arg, uint32_t f, uint32_t g);
	void *arg;
} suspects;

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

static void
index_arcs(mr_ctx *ctx, const mr_mesh *m, mr_fan *fan)
{
	mr_v3 *p = MR_NEW(ctx, 2 * fan->n, mr_v3);
	mr_tri *t = MR_NEW(ctx, fan->n, mr_tri);

	for (uint32_t i = 0; i < fan->n; i++) {
		mr_box box = box_of_arc(m, fan->face[i], fan->apex);
		p[2 * i] = box.min;
		p[2 * i + 1] = box.max;
		t[i] = (mr_tri){ { 2 * i, 2 * i + 1, 2 * i } };
	}
	fan->boxes = (mr_mesh){ m->name, p, t, 2 * fan->n, fan->n };
	mr_bvh_build(ctx, &fan->boxes, &fan->bvh);
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
static void
gather(mr_ctx *ctx, const mr_mesh *m, const uint32_t *label, mr_fan *fan, uint32_t count)
{
	uint32_t *first = MR_NEW(ctx, m->nf, uint32_t);

	mr_first_alike(ctx, m, first);
	for (size_t f = 0; f < m->nf; f++)
		if (label[f] != MR_NONE)
			fan[label[f]].n += first[f] == f;
	for (uint32_t i = 0; i < count; i++) {
		fan[i].face = MR_NEW(ctx, fan[i].n, uint32_t);
		fan[i].n = 0;
	}
	for (uint32_t f = 0; f < m->nf; f++)
		if (label[f] != MR_NONE && first[f] == f)
			fan[label[f]].face[fan[label[f]].n++] = f;
	for (uint32_t i = 0; i < count; i++)
		index_arcs(ctx, m, &fan[i]);
}

static void
make_fans(mr_ctx *ctx, const mr_bvh *bvh, const uint32_t *valence, suspects *s)
{
	const mr_mesh *m = bvh->mesh;
	uint32_t *fan_of = MR_NEW(ctx, m->nv, uint32_t), *label = MR_NEW(ctx, m->nf, uint32_t), count;
	mr_fan *fan;

	count = number_fans(m, valence, fan_of);
	if (count == 0)
		return;
	fan = MR_NEW_ZERO(ctx, count, mr_fan);
	for (uint32_t v = 0; v < m->nv; v++)
		if (fan_of[v] != MR_NONE)
			fan[fan_of[v]].apex = v;
	for (size_t f = 0; f < m->nf; f++)
		label[f] = fan_of[hub_of(&m->t[f], valence)];
	gather(ctx, m, label, fan, count);
	s->fan = fan;
	mr_bvh_label(ctx, bvh, label, &s->fans);
}

static void
find_fans(mr_ctx *ctx, const mr_mesh *m, suspects *s)
{
	uint32_t *valence = MR_NEW_ZERO(ctx, m->nv, uint32_t);

	for (size_t f = 0; f < m->nf; f++)
		for (int i = 0; i < 3; i++)
			valence[m->t[f].v[i]]++;
	make_fans(ctx, s->bvh, valence, s);
}

/* Of a face in a fan: those of the same fan that its arc meets, and others that it may meet itself. */
typedef struct search {
	const suspects *s;
	uint32_t face;
} search;

static bool
visit_arc(void *arg, uint32_t i)
{
	const search *x = arg;
	uint32_t g = x->s->fan[x->s->fans.face[x->face]].face[i];

	if (g > x->face)
		x->s->visit(x->s->arg, x->face, g);
	return true;
}

/* Two of different fans find each other. */
static bool
visit_other(void *arg, uint32_t g)
{
	const search *x = arg;

	if (g > x->face || x->s->fans.face[g] == MR_NONE)
		x->s->visit(x->s->arg, x->face, g);
	return true;
}

static void
search_fans(void *arg, size_t begin, size_t end)
{
	const suspects *s = arg;
	const mr_mesh *m = s->bvh->mesh;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = m->t[f].v;
		const mr_v3 p[3] = { m->p[v[0]], m->p[v[1]], m->p[v[2]] };
		uint32_t own = s->fans.face[f];
		search x = { s, (uint32_t)f };
		if (own == MR_NONE)
			continue;
		mr_bvh_overlap(s->fan[own].bvh, box_of_arc(m, x.face, s->fan[own].apex), visit_arc, &x);
		mr_bvh_meet_others(&s->fans, own, p, visit_other, &x);
	}
}

/* All other pairs: the tree against itself, the children of each node among each other. */

static bool
in_fan(const suspects *s, uint32_t f)
{
	return s->fan && s->fans.face[f] != MR_NONE;
}

static void
visit_places(const suspects *s, uint32_t i, uint32_t j)
{
	uint32_t f = s->bvh->face[i], g = s->bvh->face[j];
	const face_box *a = &s->box[i], *b = &s->box[j];

	if (a->lo[0] > b->hi[0] || b->lo[0] > a->hi[0] || a->lo[1] > b->hi[1] || b->lo[1] > a->hi[1] ||
	    a->lo[2] > b->hi[2] || b->lo[2] > a->hi[2] || in_fan(s, f) || in_fan(s, g))
		return;
	if (f < g)
		s->visit(s->arg, f, g);
	else
		s->visit(s->arg, g, f);
}

static bool
is_of_fan(const suspects *s, const mr_bvh_node *a, int i)
{
	return s->fan && !a->count[i] && s->fans.node[a->child[i]] != MR_NONE;
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
	if (!children_meet(a, i, b, k) || is_of_fan(s, a, i) || is_of_fan(s, b, k))
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
		const uint32_t *v = m->t[s->bvh->face[i]].v;
		mr_v3 p[3] = { m->p[v[0]], m->p[v[1]], m->p[v[2]] };
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
	find_fans(ctx, bvh->mesh, &s);
	list_nodes(ctx, &s);
	mr_parallel(ctx, nf, 4096, find_boxes, &s);
	mr_parallel(ctx, s.nodes, 64, cross_nodes, &s);
	if (s.fan)
		mr_parallel(ctx, nf, 512, search_fans, &s);
	mr_mark_release(ctx, mark);
}
