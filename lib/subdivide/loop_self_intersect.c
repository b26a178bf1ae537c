/*
 * Volino, Magnenat Thalmann 1994: Efficient self-collision detection on smoothly discretized surface
 * animations using geometrical shape regularity.
 *
 * The triangles of all levels are the tree: 4 f to 4 f + 3 are the parts of f.
 */
#include "subdivide/loop_self_intersect.h"

#include "base/parallel.h"
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

typedef struct tree {
	const mr_loop *level;
	size_t n;
	const mr_v3 *p;
	mr_v3 center;       /* of the surface's box */
	double unit;        /* about one over its size */
	node *node[LEVELS]; /* of the triangles of each level */
	uint32_t *order;    /* triangles of level 0 by where their boxes begin along the axis */
	float *begin;       /* where that is, in this order */
	int axis;           /* the longest of the surface's box */
	float longest;      /* box along it */
	size_t level_of_job;
	const bool *moved; /* triangles of level 0; NULL: all */
	bool *crosses;
} tree;

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

/* The box and the cone of the four parts. */
static void
join(const node *part, node *d)
{
	float sum[3] = { 0, 0, 0 }, length;

	*d = part[0];
	d->angle = NONE;
	for (int k = 0; k < 4; k++)
		for (int i = 0; i < 3; i++) {
			d->lo[i] = fminf(d->lo[i], part[k].lo[i]);
			d->hi[i] = fmaxf(d->hi[i], part[k].hi[i]);
			sum[i] += part[k].angle < 0 ? 0 : part[k].axis[i];
		}
	length = sqrtf(dot3(sum, sum));
	for (int i = 0; i < 3; i++)
		d->axis[i] = length > 0 ? sum[i] / length : 0;
	for (int k = 0; k < 4; k++)
		if (part[k].angle >= 0)
			d->angle = fmaxf(d->angle, part[k].angle + angle_between(d->axis, part[k].axis));
}

static void
make_nodes(void *arg, size_t begin, size_t end)
{
	const tree *x = arg;
	size_t k = x->level_of_job;

	for (size_t f = begin; f < end; f++)
		if (k == x->n)
			make_leaf(x, (uint32_t)f, &x->node[k][f]);
		else
			join(&x->node[k + 1][4 * f], &x->node[k][f]);
}

static bool
apart(const node *a, const node *b)
{
	for (int i = 0; i < 3; i++)
		if (a->hi[i] < b->lo[i] || b->hi[i] < a->lo[i])
			return true;
	return false;
}

static bool
touch(mr_tri a, mr_tri b)
{
	for (int i = 0; i < 3; i++)
		if (a.v[i] == b.v[0] || a.v[i] == b.v[1] || a.v[i] == b.v[2])
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

static void
test_leaves(const tree *x, uint32_t f, uint32_t g)
{
	const node *a = &x->node[x->n][f], *b = &x->node[x->n][g];
	const mr_tri *t = x->level[x->n].t;
	mr_v3 p[3], q[3];

	if (x->crosses[f] || a->angle < 0 || b->angle < 0 || (leaves_agree(a, b) && touch(t[f], t[g])))
		return;
	corners(x, f, p);
	corners(x, g, q);
	x->crosses[f] = !mr_triangle_degenerate(p[0], p[1], p[2]) &&
	                !mr_triangle_degenerate(q[0], q[1], q[2]) && mr_triangles_intersect(p, q);
}

/* Marks the parts of f that pass through parts of g. */
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
		for (uint32_t j = 4 * g; j < 4 * g + 4; j++)
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
		for (uint32_t j = 4 * f; j < 4 * f + 4; j++)
			if (i != j)
				test_pair(x, k + 1, i, j);
	}
}

/* How many of the first triangles of the order begin before `at`. */
static size_t
count_before(const tree *x, float at)
{
	size_t low = 0, high = x->level[0].nf;

	while (low < high) {
		size_t middle = low + (high - low) / 2;
		if (x->begin[middle] < at)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

/* Whether to look at the parts of f: it or one whose box meets its own, of those in the order from i on, has
 * moved, or what a part passed through may have. */
static bool
is_due(const tree *x, uint32_t f, size_t i)
{
	size_t parts = x->level[x->n].nf / x->level[0].nf;
	const node *d = &x->node[0][f];

	if (!x->moved || x->moved[f])
		return true;
	for (size_t k = parts * f; k < parts * f + parts; k++)
		if (x->crosses[k])
			return true;
	for (; i < x->level[0].nf && x->begin[i] <= d->hi[x->axis]; i++)
		if (x->moved[x->order[i]] && !apart(d, &x->node[0][x->order[i]]))
			return true;
	return false;
}

/* Marks the parts of f that pass through any.  i: where to begin in the order. */
static void
test_all(const tree *x, uint32_t f, size_t i)
{
	size_t parts = x->level[x->n].nf / x->level[0].nf;
	float last = x->node[0][f].hi[x->axis];

	memset(x->crosses + parts * f, 0, parts * sizeof *x->crosses);
	test_self(x, 0, f);
	for (; i < x->level[0].nf && x->begin[i] <= last; i++)
		if (x->order[i] != f)
			test_pair(x, 0, f, x->order[i]);
}

static void
search(void *arg, size_t begin, size_t end)
{
	const tree *x = arg;

	for (size_t i = begin; i < end; i++) {
		uint32_t f = x->order[i];
		size_t first = count_before(x, x->node[0][f].lo[x->axis] - x->longest);
		if (is_due(x, f, first))
			test_all(x, f, first);
	}
}

/* Sorts the triangles of level 0, by merging: order and begin. */
static void
sort_roots(mr_ctx *ctx, tree *x)
{
	size_t nf = x->level[0].nf;
	uint32_t *from = MR_NEW(ctx, nf, uint32_t), *to = MR_NEW(ctx, nf, uint32_t), *swap;
	const node *d = x->node[0];
	int axis = x->axis;

	x->begin = MR_NEW(ctx, nf, float);
	for (size_t f = 0; f < nf; f++)
		from[f] = (uint32_t)f;
	for (size_t width = 1; width < nf; width *= 2) {
		for (size_t first = 0; first < nf; first += 2 * width) {
			size_t middle = first + width < nf ? first + width : nf;
			size_t end = first + 2 * width < nf ? first + 2 * width : nf;
			for (size_t i = first, j = middle, k = first; k < end; k++)
				to[k] = j == end || (i < middle && d[from[i]].lo[axis] <= d[from[j]].lo[axis])
				            ? from[i++]
				            : from[j++];
		}
		swap = from;
		from = to;
		to = swap;
	}
	x->order = from;
	for (size_t f = 0; f < nf; f++)
		x->begin[f] = d[from[f]].lo[axis];
}

static void
choose_units(tree *x)
{
	mr_box b = mr_box_of(x->p, x->level[x->n].nv);
	mr_v3 size = mr_sub(b.max, b.min);
	double e[3] = { size.x, size.y, size.z };

	for (int k = 1; k < 3; k++)
		x->axis = e[k] > e[x->axis] ? k : x->axis;
	x->center = mr_axpy(0.5, size, b.min);
	x->unit = e[x->axis] > 0 ? 1 / e[x->axis] : 1;
}

static void
measure_roots(tree *x)
{
	for (size_t f = 0; f < x->level[0].nf; f++)
		/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference) a level of faces has nodes */
		x->longest = fmaxf(x->longest, x->node[0][f].hi[x->axis] - x->node[0][f].lo[x->axis]);
	x->longest = nextafterf(x->longest, INFINITY);
}

void
mr_find_crossings(
    mr_ctx *ctx, const mr_loop *level, size_t n, const mr_v3 *p, const bool *moved, bool *crosses)
{
	mr_mark mark = mr_mark_take(ctx);
	tree x = { .level = level, .n = n, .p = p, .moved = moved, .crosses = crosses };

	choose_units(&x);
	for (size_t k = n + 1; k-- > 0;) {
		x.node[k] = MR_NEW(ctx, level[k].nf, node);
		x.level_of_job = k;
		mr_parallel(ctx, level[k].nf, 4096, make_nodes, &x);
	}
	measure_roots(&x);
	sort_roots(ctx, &x);
	mr_parallel(ctx, level[0].nf, GRAIN, search, &x);
	mr_mark_release(ctx, mark);
}
