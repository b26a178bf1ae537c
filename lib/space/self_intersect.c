/*
 * Two triangles have a point in common when an edge of one meets the other, or one
 * lies within the other.  Only signs of volumes and, in a plane, of areas are
 * asked for (as in Guigue, Devillers 2003, Fast and robust triangle-triangle
 * overlap test using orientation predicates).
 */
#include "space/self_intersect.h"

#include "base/parallel.h"
#include "space/bvh_tree.h"
#include "space/predicates.h"

static bool
same(mr_v3 a, mr_v3 b)
{
	return a.x == b.x && a.y == b.y && a.z == b.z;
}

bool
mr_triangle_degenerate(mr_v3 a, mr_v3 b, mr_v3 c)
{
	for (int k = 0; k < 3; k++)
		if (mr_orient2d(a, b, c, k) != 0)
			return false;
	return true;
}

/* An axis along which the triangle of positive area can be projected; *turn is its sense there. */
static int
projection(const mr_v3 t[3], int *turn)
{
	for (int k = 0; k < 2; k++)
		if ((*turn = mr_orient2d(t[0], t[1], t[2], k)) != 0)
			return k;
	*turn = mr_orient2d(t[0], t[1], t[2], 2);
	return 2;
}

static bool
one_sided(const int s[3])
{
	return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
}

/* Whether a line through a side of t, in the plane without axis k, has all n points beyond it. */
static bool
side_parts(const mr_v3 t[3], const mr_v3 *q, int n, int k, int turn)
{
	for (int i = 0; i < 3; i++) {
		int j = 0;
		while (j < n && mr_orient2d(t[i], t[(i + 1) % 3], q[j], k) * turn < 0)
			j++;
		if (j == n)
			return true;
	}
	return false;
}

/* Whether the line through a and b has all of t on one side. */
static bool
line_parts(mr_v3 a, mr_v3 b, const mr_v3 t[3], int k)
{
	int s[3];

	for (int i = 0; i < 3; i++)
		s[i] = mr_orient2d(a, b, t[i], k);
	return one_sided(s);
}

/* The segment a b, in the plane of the triangle: where they are apart, its line or a side parts them. */
static bool
meets_flat(mr_v3 a, mr_v3 b, const mr_v3 t[3])
{
	int turn, k = projection(t, &turn);
	mr_v3 ends[2] = { a, b };

	return !side_parts(t, ends, 2, k, turn) && !line_parts(a, b, t, k);
}

/* Triangles of positive area in one plane: where they are apart, a side of one parts them. */
static bool
flat_intersect(const mr_v3 p[3], const mr_v3 q[3])
{
	int turn, k = projection(p, &turn), of_q = mr_orient2d(q[0], q[1], q[2], k);

	return !side_parts(p, q, 3, k, turn) && !side_parts(q, p, 3, k, of_q);
}

/* The closed segment a b, whose ends lie on the sides sa and sb of the closed triangle's plane. */
static bool
segment_meets(mr_v3 a, mr_v3 b, int sa, int sb, const mr_v3 t[3])
{
	bool left = false, right = false;

	if (sa * sb > 0)
		return false;
	if (sa == 0 && sb == 0)
		return meets_flat(a, b, t);
	for (int i = 0; i < 3; i++) {
		int s = mr_orient3d(a, b, t[i], t[(i + 1) % 3]);
		left |= s < 0;
		right |= s > 0;
	}
	return !(left && right);
}

static void
sides(const mr_v3 plane[3], const mr_v3 p[3], int out[3])
{
	for (int i = 0; i < 3; i++)
		out[i] = mr_orient3d(plane[0], plane[1], plane[2], p[i]);
}

/* Triangles without a common corner. */
static bool
apart_intersect(const mr_v3 p[3], const mr_v3 q[3])
{
	int sp[3], sq[3];

	sides(q, p, sp);
	if (one_sided(sp))
		return false;
	sides(p, q, sq);
	if (one_sided(sq))
		return false;
	if (!sp[0] && !sp[1] && !sp[2])
		return flat_intersect(p, q);
	for (int i = 0; i < 3; i++) {
		int j = (i + 1) % 3;
		if (segment_meets(p[i], p[j], sp[i], sp[j], q) || segment_meets(q[i], q[j], sq[i], sq[j], p))
			return true;
	}
	return false;
}

/* Whether n . e > 0, whatever the rounding of e, a difference, and of the product. */
static bool
surely_ahead(mr_v3 n, mr_v3 e)
{
	double x = n.x * e.x, y = n.y * e.y, z = n.z * e.z;

	return x + y + z > 8 * 0x1p-52 * (fabs(x) + fabs(y) + fabs(z)) + 1e-300;
}

/*
 * Whether the plane through the common corner 0 that is square to the difference of the triangles' directions
 * surely separates the rest of them.  In a flat fan determinants are 0, which needs exact arithmetic: around
 * a vertex of 4,000 faces this is 25 times as fast.
 */
static bool
surely_parted(const mr_v3 p[3], const mr_v3 q[3])
{
	mr_v3 a = mr_sub(p[1], p[0]), b = mr_sub(p[2], p[0]), c = mr_sub(q[1], q[0]), d = mr_sub(q[2], q[0]);
	mr_v3 n = mr_sub(mr_add(mr_unit(a), mr_unit(b)), mr_add(mr_unit(c), mr_unit(d)));
	mr_v3 m = mr_mul(-1, n);

	return surely_ahead(n, a) && surely_ahead(n, b) && surely_ahead(m, c) && surely_ahead(m, d);
}

/*
 * Triangles whose corner 0 is common.  Their intersection is convex: if it is more than the corner, it
 * reaches the edge opposite the corner in one of them.
 */
static bool
corner_intersect(const mr_v3 p[3], const mr_v3 q[3])
{
	int p1, p2, q1, q2;

	if (mr_orient3d_is_plain(p[0], p[1], p[2], q[1], &q1) &&
	    mr_orient3d_is_plain(p[0], p[1], p[2], q[2], &q2) && q1 * q2 > 0)
		return false;
	if (surely_parted(p, q))
		return false;
	q1 = mr_orient3d(p[0], p[1], p[2], q[1]);
	q2 = mr_orient3d(p[0], p[1], p[2], q[2]);
	if (q1 * q2 > 0)
		return false;
	p1 = mr_orient3d(q[0], q[1], q[2], p[1]);
	p2 = mr_orient3d(q[0], q[1], q[2], p[2]);
	return segment_meets(p[1], p[2], p1, p2, q) || segment_meets(q[1], q[2], q1, q2, p);
}

/* Triangles whose corners 0 and 1 are common: they overlap where they lie in one plane, on one side of the
 * edge. */
static bool
edge_intersect(const mr_v3 p[3], const mr_v3 q[3])
{
	int turn, k;

	if (mr_orient3d(p[0], p[1], p[2], q[2]) != 0)
		return false;
	k = projection(p, &turn);
	return mr_orient2d(p[0], p[1], q[2], k) == turn;
}

bool
mr_triangles_intersect(const mr_v3 p[3], const mr_v3 q[3])
{
	mr_v3 a[3], b[3]; /* the common corners first */
	int n = 0, in_p = 0, in_q = 0, na, nb;

	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			if (same(p[i], q[j])) {
				a[n] = b[n] = p[i];
				n++;
				in_p |= 1 << i;
				in_q |= 1 << j;
			}
	if (n == 0)
		return apart_intersect(p, q);
	if (n == 3)
		return true;
	na = nb = n;
	for (int i = 0; i < 3; i++) {
		if (!(in_p >> i & 1))
			a[na++] = p[i];
		if (!(in_q >> i & 1))
			b[nb++] = q[i];
	}
	return n == 1 ? corner_intersect(a, b) : edge_intersect(a, b);
}

/* ---- all pairs of a surface: the tree against itself, the children of each node among each other ---- */

/* Figures of a face, in units of the mesh. */
typedef struct face_box {
	float lo[3], hi[3];
} face_box;

typedef struct search {
	const mr_bvh *bvh;
	const uint32_t *node; /* all nodes, the root first */
	size_t nodes;
	face_box *box; /* in the order of the tree */
	bool *flat;    /* faces without area, alike */
	void (*visit)(void *arg, uint32_t f, uint32_t g);
	void *arg;
} search;

static void
look_at_pair(const search *s, uint32_t i, uint32_t j)
{
	uint32_t f = s->bvh->face[i], g = s->bvh->face[j];
	const face_box *a = &s->box[i], *b = &s->box[j];
	mr_v3 p[3], q[3];

	if (a->lo[0] > b->hi[0] || b->lo[0] > a->hi[0] || a->lo[1] > b->hi[1] || b->lo[1] > a->hi[1] ||
	    a->lo[2] > b->hi[2] || b->lo[2] > a->hi[2] || s->flat[i] || s->flat[j])
		return;
	mr_corners(s->bvh->mesh, f < g ? f : g, p);
	mr_corners(s->bvh->mesh, f < g ? g : f, q);
	if (mr_triangles_intersect(p, q))
		s->visit(s->arg, f < g ? f : g, f < g ? g : f);
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

/* Child i of a with child k of b, the larger one by its children; a missing child meets nothing. */
static void
cross(const search *s, const mr_bvh_node *a, int i, const mr_bvh_node *b, int k)
{
	if (!children_meet(a, i, b, k))
		return;
	if (a->count[i] && b->count[k]) {
		for (uint32_t x = a->child[i]; x < a->child[i] + a->count[i]; x++)
			for (uint32_t y = b->child[k]; y < b->child[k] + b->count[k]; y++)
				look_at_pair(s, x, y);
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
	const search *s = arg;

	for (size_t n = begin; n < end; n++) {
		const mr_bvh_node *d = &s->bvh->nodes[s->node[n]];
		for (int i = 0; i < BVH_WIDE; i++) {
			for (int k = i + 1; k < BVH_WIDE; k++)
				cross(s, d, i, d, k);
			for (uint32_t x = d->child[i]; d->count[i] && x < d->child[i] + d->count[i]; x++)
				for (uint32_t y = d->child[i]; y < x; y++)
					look_at_pair(s, x, y);
		}
	}
}

/* The nodes are in no row: each stands where there was room for its subtree. */
static void
list_nodes(mr_ctx *ctx, search *s)
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
look_at_faces(void *arg, size_t begin, size_t end)
{
	const search *s = arg;

	for (size_t i = begin; i < end; i++) {
		mr_v3 p[3];
		mr_corners(s->bvh->mesh, s->bvh->face[i], p);
		mr_box box = mr_box_of(p, 3);
		mr_v3 lo = bvh_unit(s->bvh, box.min), hi = bvh_unit(s->bvh, box.max);
		for (int k = 0; k < 3; k++) {
			s->box[i].lo[k] = (float)mr_coordinate(lo, k);
			s->box[i].hi[k] = (float)mr_coordinate(hi, k);
		}
		s->flat[i] = mr_triangle_degenerate(p[0], p[1], p[2]);
	}
}

void
mr_intersections_visit(mr_ctx *ctx, const mr_bvh *bvh, const mr_mesh *m,
    void (*visit)(void *arg, uint32_t f, uint32_t g), void *arg)
{
	MR_SCOPE(ctx);
	search s = { .box = MR_NEW(ctx, m->nf, face_box),
		.flat = MR_NEW(ctx, m->nf, bool),
		.visit = visit,
		.arg = arg };
	mr_bvh *own;

	if (m->nf == 0)
		return;
	if (!bvh) {
		mr_bvh_build(ctx, m, &own);
		bvh = own;
	}
	s.bvh = bvh;
	list_nodes(ctx, &s);
	mr_parallel(ctx, m->nf, 4096, look_at_faces, &s);
	mr_parallel(ctx, s.nodes, 64, cross_nodes, &s);
}

typedef struct counting {
	bool *crosses; /* of the faces; or NULL */
	size_t count;
} counting;

static void
count_pair(void *arg, uint32_t f, uint32_t g)
{
	counting *c = arg;

	__atomic_fetch_add(&c->count, 1, __ATOMIC_RELAXED);
	if (c->crosses) {
		__atomic_store_n(&c->crosses[f], true, __ATOMIC_RELAXED);
		__atomic_store_n(&c->crosses[g], true, __ATOMIC_RELAXED);
	}
}

void
mr_self_intersections(mr_ctx *ctx, const mr_bvh *bvh, const mr_mesh *m, bool *crosses, size_t *count)
{
	counting c = { .crosses = crosses };

	if (crosses)
		memset(crosses, 0, m->nf * sizeof *crosses);
	mr_intersections_visit(ctx, bvh, m, count_pair, &c);
	*count = c.count;
}
