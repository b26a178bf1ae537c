/*
 * Volino, Magnenat Thalmann 1994: Efficient self-collision detection on smoothly discretized surface
 * animations using geometrical shape regularity.
 *
 * The triangles of all levels are the tree: 4 f to 4 f + 3 are the parts of f.
 */
#include "subdivide/loop_self_intersect.h"

#include "base/parallel.h"
#include "mesh/zorder.h"
#include "space/self_intersect.h"

enum { GRAIN = 16, LEVELS = 16 };

/* Regions that touch do not cross where their normals lie within twice this of one another, in radians. */
static const float NARROW = 1.0472F;

static const float NONE = -1; /* the angle of a region without a normal */

/* A box around a region and a cone around its normals. */
typedef struct node {
	float lo[3], hi[3];
	float axis[3], angle;
} node;

struct mr_loop_tree {
	const mr_loop *level;
	size_t n;
	const mr_v3 *p;
	mr_v3 center;        /* of the surface's box when all of it was looked at first */
	double unit;         /* about one over its size; 0 before */
	node *node[LEVELS];  /* of the triangles of each level */
	uint32_t *order;     /* the roots, the triangles of level 0, along the Z curve */
	node *above[LEVELS]; /* boxes of 4^k roots in that order, from k = 1 to the one box of all */
	size_t top;          /* k of it */
	const bool *moved;   /* roots; NULL: all */
	bool *due;           /* roots of which all crossings are looked for */
	bool *crosses;
};

typedef mr_loop_tree tree;

/* A float that is not greater than x, which is at most about 1: rounding, twice, is within a quarter of that.
 */
static float
below(double x)
{
	return (float)x - 0x1p-22F;
}

static float
above(double x)
{
	return (float)x + 0x1p-22F;
}

static float
dot3(const float a[3], const float b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* An upper bound of the angle between unit vectors, by their chord c, that is less than a hundredth above:
 * 2 asin(c / 2) <= c + 0.0555 c^3 up to a right angle; beyond, pi. */
static float
angle_between(const float a[3], const float b[3])
{
	float d[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] }, c2 = dot3(d, d);

	return c2 > 2 ? 3.1416F : sqrtf(c2) * (1 + 0.0555F * c2);
}

static void
corners(const tree *x, uint32_t f, mr_v3 q[3])
{
	for (int k = 0; k < 3; k++)
		q[k] = x->p[x->level[x->n].t[f].v[k]];
}

static void
make_leaf(const tree *x, uint32_t f, node *d)
{
	mr_v3 q[3], u[3], n;
	mr_box b;

	corners(x, f, q);
	for (int k = 0; k < 3; k++)
		u[k] = mr_mul(x->unit, mr_sub(q[k], x->center)); /* never turns the order of two around */
	b = mr_box_of(u, 3);
	n = mr_unit(mr_cross(mr_sub(u[1], u[0]), mr_sub(u[2], u[0])));
	*d = (node){ { below(b.min.x), below(b.min.y), below(b.min.z) },
		{ above(b.max.x), above(b.max.y), above(b.max.z) }, { (float)n.x, (float)n.y, (float)n.z },
		mr_norm2(n) > 0 ? 0 : NONE };
}

static void
enclose(node *d, const node *part)
{
	for (int i = 0; i < 3; i++) {
		d->lo[i] = fminf(d->lo[i], part->lo[i]);
		d->hi[i] = fmaxf(d->hi[i], part->hi[i]);
	}
}

/* The box and the cone of the four parts. */
static void
join(const node *part, node *d)
{
	float sum[3] = { 0, 0, 0 }, length;

	*d = part[0];
	d->angle = NONE;
	for (int k = 0; k < 4; k++) {
		enclose(d, &part[k]);
		for (int i = 0; i < 3; i++)
			sum[i] += part[k].angle < 0 ? 0 : part[k].axis[i];
	}
	length = sqrtf(dot3(sum, sum));
	for (int i = 0; i < 3; i++)
		d->axis[i] = length > 0 ? sum[i] / length : 0;
	for (int k = 0; k < 4; k++)
		if (part[k].angle >= 0)
			d->angle = fmaxf(d->angle, part[k].angle + angle_between(d->axis, part[k].axis));
}

/* Nodes of the moved triangles of level 0, and of their parts. */
static void
make_nodes(void *arg, size_t begin, size_t end)
{
	const tree *x = arg;

	for (size_t root = begin; root < end; root++)
		for (size_t k = x->moved && !x->moved[root] ? 0 : x->n + 1; k-- > 0;)
			for (size_t f = root << 2 * k; f < (root + 1) << 2 * k; f++)
				if (k == x->n)
					make_leaf(x, (uint32_t)f, &x->node[k][f]);
				else
					join(&x->node[k + 1][4 * f], &x->node[k][f]);
}

static bool
apart(const node *a, const node *b)
{
	bool is = false;

	for (int i = 0; i < 3; i++) /* without branches, which could not be foretold */
		is |= (a->hi[i] < b->lo[i]) | (b->hi[i] < a->lo[i]);
	return is;
}

static bool
touch(mr_tri a, mr_tri b)
{
	for (int i = 0; i < 3; i++)
		if (mr_has_corner(b, a.v[i]))
			return true;
	return false;
}

/* True where the normals of both lie within a narrow cone. */
static bool
agree(const node *a, const node *b)
{
	float most = 2 * NARROW;

	if (a->angle + b->angle > most || a->angle > NARROW || b->angle > NARROW)
		return false;
	return a->angle + b->angle + angle_between(a->axis, b->axis) < most;
}

/* Leaves that touch: to 60 degrees. */
static bool
leaves_agree(const node *a, const node *b)
{
	return dot3(a->axis, b->axis) > 0.5F;
}

static bool
crosses(const tree *x, uint32_t f)
{
	return __atomic_load_n(&x->crosses[f], __ATOMIC_RELAXED);
}

static void
test_leaves(const tree *x, uint32_t f, uint32_t g)
{
	const node *a = &x->node[x->n][f], *b = &x->node[x->n][g];
	const mr_tri *t = x->level[x->n].t;
	mr_v3 p[3], q[3];

	if (a->angle < 0 || b->angle < 0 || (crosses(x, f) && crosses(x, g)) ||
	    (leaves_agree(a, b) && touch(t[f], t[g])))
		return;
	corners(x, f, p);
	corners(x, g, q);
	if (mr_triangles_intersect(p, q) && !mr_triangle_degenerate(p[0], p[1], p[2]) &&
	    !mr_triangle_degenerate(q[0], q[1], q[2])) {
		__atomic_store_n(&x->crosses[f], true, __ATOMIC_RELAXED);
		__atomic_store_n(&x->crosses[g], true, __ATOMIC_RELAXED);
	}
}

/* Marks the parts of f and of g that pass through one another. */
static void
test_pair(const tree *x, size_t k, uint32_t f, uint32_t g)
{
	const node *a = &x->node[k][f], *b = &x->node[k][g];
	const mr_tri *t = x->level[k].t;

	if (a->angle < 0 || b->angle < 0 || apart(a, b))
		return; /* what has no normal anywhere crosses nothing, and all of it may be at one place */
	if (k == x->n) {
		test_leaves(x, f, g);
		return;
	}
	if (agree(a, b) && touch(t[f], t[g]))
		return;
	for (uint32_t i = 4 * f; i < 4 * f + 4; i++)
		for (uint32_t j = apart(&x->node[k + 1][i], b) ? 4 * g + 4 : 4 * g; j < 4 * g + 4; j++)
			test_pair(x, k + 1, i, j);
}

/* Marks the parts of f that pass through one another. */
static void
test_self(const tree *x, size_t k, uint32_t f)
{
	if (k == x->n || x->node[k][f].angle < NARROW)
		return;
	for (uint32_t i = 4 * f; i < 4 * f + 4; i++) {
		test_self(x, k + 1, i);
		for (uint32_t j = i + 1; j < 4 * f + 4; j++)
			test_pair(x, k + 1, i, j);
	}
}

static size_t
count_above(const tree *x, size_t k)
{
	return (x->level[0].nf + (((size_t)1 << 2 * k) - 1)) >> 2 * k;
}

/* Tests root f against the roots of the i-th box of 4^k, each pair once. */
static void
test_above(const tree *x, size_t k, size_t i, uint32_t f)
{
	size_t end;

	if (k == 0) {
		uint32_t g = x->order[i];
		if (g > f || (g < f && !x->due[g]))
			test_pair(x, 0, f, g);
		return;
	}
	if (apart(&x->above[k][i], &x->node[0][f]))
		return;
	end = count_above(x, k - 1);
	for (size_t j = 4 * i; j < 4 * i + 4 && j < end; j++)
		test_above(x, k - 1, j, f);
}

/* Marks the parts of due roots that pass through any, and these. */
static void
search(void *arg, size_t begin, size_t end)
{
	const tree *x = arg;

	for (size_t f = begin; f < end; f++) {
		if (!x->due[f] || x->node[0][f].angle < 0)
			continue; /* without a normal anywhere it crosses nothing */
		test_self(x, 0, (uint32_t)f);
		test_above(x, x->top, 0, (uint32_t)f);
	}
}

/* Forgets what roots cross that have moved, or crossed what may have. */
static void
find_due(tree *x)
{
	size_t parts = (size_t)1 << 2 * x->n;

	for (size_t f = 0; f < x->level[0].nf; f++) {
		bool *own = x->crosses + parts * f;
		x->due[f] = !x->moved || x->moved[f] || memchr(own, 1, parts);
		if (x->due[f])
			memset(own, 0, parts * sizeof *own);
	}
}

static void
choose_units(tree *x)
{
	mr_box b = mr_box_of(x->p, x->level[x->n].nv);
	mr_v3 size = mr_sub(b.max, b.min);
	double most = fmax(size.x, fmax(size.y, size.z));

	x->center = mr_axpy(0.5, size, b.min);
	x->unit = most > 0 ? 1 / most : 1;
}

static void
sort_roots(mr_ctx *ctx, tree *x)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nf = x->level[0].nf;
	mr_v3 *p = MR_NEW(ctx, nf, mr_v3);

	for (size_t f = 0; f < nf; f++) {
		const node *d = &x->node[0][f];
		p[f] = mr_vec((double)(d->lo[0] + d->hi[0]), (double)(d->lo[1] + d->hi[1]),
		    (double)(d->lo[2] + d->hi[2]));
	}
	mr_zorder(ctx, p, nf, MR_ZORDER_CELLS, x->order);
	mr_mark_release(ctx, mark);
}

static void
make_above(tree *x)
{
	for (size_t k = 1; k <= x->top; k++)
		for (size_t i = 0, below = count_above(x, k - 1); i < below; i++) {
			const node *part = k == 1 ? &x->node[0][x->order[i]] : &x->above[k - 1][i];
			if (i % 4 == 0)
				x->above[k][i / 4] = *part;
			else
				enclose(&x->above[k][i / 4], part);
		}
}

mr_loop_tree *
mr_loop_tree_new(mr_ctx *ctx, const mr_loop *level, size_t n)
{
	tree *x = MR_NEW_ZERO(ctx, 1, tree);

	x->level = level;
	x->n = n;
	for (size_t k = 0; k <= n; k++)
		x->node[k] = MR_NEW(ctx, level[k].nf, node);
	x->order = MR_NEW(ctx, level->nf, uint32_t);
	x->due = MR_NEW(ctx, level->nf, bool);
	do {
		x->top++;
		x->above[x->top] = MR_NEW(ctx, count_above(x, x->top), node);
	} while (count_above(x, x->top) > 1);
	return x;
}

void
mr_find_crossings(mr_ctx *ctx, mr_loop_tree *x, const mr_v3 *p, const bool *moved, bool *crosses)
{
	bool first = !moved || !(x->unit > 0);

	x->p = p;
	x->moved = moved;
	x->crosses = crosses;
	if (first)
		choose_units(x);
	mr_parallel(ctx, x->level[0].nf, GRAIN, make_nodes, x);
	if (first)
		sort_roots(ctx, x);
	make_above(x);
	find_due(x);
	mr_parallel(ctx, x->level[0].nf, GRAIN, search, x);
}
