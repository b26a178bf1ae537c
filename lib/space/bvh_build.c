/*
 * The tree is split top down where the surface area heuristic over sixteen bins of
 * the longest axis is least (Wald 2007), the largest part of a node first until
 * there are four.  Its upper part is built by one thread, its subtrees by all, each
 * into nodes set aside for it: the tree does not depend on their number.
 */
#include "base/parallel.h"
#include "base/sort.h"
#include "space/bvh_tree.h"

/* A quarter of the bins where few are to be parted: the tree is as good, and sooner made. */
enum { BINS = 16, FEW = 32, FEW_BINS = 4, DEEP = 32, TASKS = 32, TASK_LEAST = 12288 };

static const float SLACK = 0x1p-22f;

/* A face while the tree is built: its box in units of the mesh. */
typedef struct prim {
	float lo[3], hi[3];
	uint32_t face;
} prim;

typedef struct range {
	size_t first, n;
} range;

/* A subtree that one thread builds. */
typedef struct task {
	range r;
	int depth;
	size_t slot; /* its first bvh_node */
} task;

typedef struct builder {
	mr_bvh *bvh;
	prim *prims;
	task *tasks;
	size_t task_count, task_size; /* ranges of at most task_size become tasks; 0: none */
} builder;

static float
centroid(const prim *p, int axis)
{
	return p->lo[axis] + p->hi[axis];
}

typedef struct fbox {
	float lo[3], hi[3];
} fbox;

static fbox
fbox_empty(void)
{
	return (fbox){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
}

static void
fbox_add(fbox *b, const float lo[3], const float hi[3])
{
	for (int k = 0; k < 3; k++) {
		b->lo[k] = lo[k] < b->lo[k] ? lo[k] : b->lo[k];
		b->hi[k] = hi[k] > b->hi[k] ? hi[k] : b->hi[k];
	}
}

static double
fbox_area(const fbox *b)
{
	double x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1], z = b->hi[2] - b->lo[2];

	return x * y + y * z + z * x;
}

/* The longest axis of the centroids, its lower end and length. */
static int
longest_axis(const prim *p, size_t n, float *low, float *length)
{
	fbox b = fbox_empty();
	int best = 0;

	for (size_t i = 0; i < n; i++) {
		float c[3] = { centroid(p + i, 0), centroid(p + i, 1), centroid(p + i, 2) };
		fbox_add(&b, c, c);
	}
	for (int k = 1; k < 3; k++)
		if (b.hi[k] - b.lo[k] > b.hi[best] - b.lo[best])
			best = k;
	*low = b.lo[best];
	*length = b.hi[best] - b.lo[best];
	return best;
}

static int
bin_of(float c, float low, float factor, int bins)
{
	int b = (int)((c - low) * factor);

	return b < bins ? b : bins - 1;
}

/* The last bin of the left side where area times count, summed over both sides, is least. */
static int
best_bin(const fbox box[BINS], const size_t count[BINS], int bins)
{
	double right_cost[BINS], best = INFINITY;
	fbox side = fbox_empty();
	size_t n = 0;
	int at = 0;

	for (int b = bins - 1; b > 0; b--) {
		fbox_add(&side, box[b].lo, box[b].hi);
		n += count[b];
		right_cost[b] = n ? fbox_area(&side) * (double)n : INFINITY;
	}
	side = fbox_empty();
	n = 0;
	for (int b = 0; b < bins - 1; b++) {
		fbox_add(&side, box[b].lo, box[b].hi);
		n += count[b];
		double cost = n ? fbox_area(&side) * (double)n + right_cost[b + 1] : INFINITY;
		if (cost < best) {
			best = cost;
			at = b;
		}
	}
	return at;
}

/* Orders n >= 2 prims into two parts, neither empty, and returns the size of the first. */
static size_t
split(prim *p, size_t n, int depth)
{
	fbox box[BINS];
	size_t count[BINS] = { 0 }, i = 0, j = n;
	float low, length, factor;
	int axis = longest_axis(p, n, &low, &length), bins = n < FEW ? FEW_BINS : BINS, at;

	if (!(length > 0) || depth > DEEP)
		return n / 2;
	factor = (float)bins / length;
	if (!isfinite(factor))
		return n / 2;
	for (int b = 0; b < bins; b++)
		box[b] = fbox_empty();
	for (size_t k = 0; k < n; k++) {
		int b = bin_of(centroid(p + k, axis), low, factor, bins);
		fbox_add(&box[b], p[k].lo, p[k].hi);
		count[b]++;
	}
	at = best_bin(box, count, bins);
	while (i < j) {
		if (bin_of(centroid(p + i, axis), low, factor, bins) <= at) {
			i++;
		} else {
			prim x = p[--j];
			p[j] = p[i];
			p[i] = x;
		}
	}
	return i > 0 && i < n ? i : n / 2;
}

static void
set_child_box(mr_bvh_node *d, int c, const prim *p, size_t n)
{
	fbox b = fbox_empty();

	for (size_t i = 0; i < n; i++)
		fbox_add(&b, p[i].lo, p[i].hi);
	for (int k = 0; k < 3; k++) {
		d->lo[k][c] = b.lo[k] - SLACK;
		d->hi[k][c] = b.hi[k] + SLACK;
	}
}

/* Cuts a range of more than BVH_LEAF prims, always the largest piece, until there are four. */
static void
cut(prim *prims, range r, int depth, range out[BVH_WIDE])
{
	out[0] = r;
	for (int count = 1; count < BVH_WIDE; count++) {
		int largest = 0;
		for (int i = 1; i < count; i++)
			if (out[i].n > out[largest].n)
				largest = i;
		range *l = &out[largest];
		size_t left = split(prims + l->first, l->n, depth);
		out[count] = (range){ l->first + left, l->n - left };
		l->n = left;
	}
}

/* Builds the subtree of a range; its nodes take the places from *next on, the first its root. */
static void
build_range(builder *b, range r, int depth, size_t *next)
{
	mr_bvh_node *d = &b->bvh->nodes[(*next)++];
	range part[BVH_WIDE] = { r };
	int parts = 1;

	*d = (mr_bvh_node){ .child = { MR_NONE, MR_NONE, MR_NONE, MR_NONE } };
	for (int c = 0; c < BVH_WIDE; c++)
		for (int k = 0; k < 3; k++) {
			d->lo[k][c] = INFINITY;
			d->hi[k][c] = -INFINITY;
		}
	if (r.n > BVH_LEAF) {
		cut(b->prims, r, depth, part);
		parts = BVH_WIDE;
	}
	for (int c = 0; c < parts; c++) {
		set_child_box(d, c, b->prims + part[c].first, part[c].n);
		if (part[c].n <= BVH_LEAF) {
			d->child[c] = (uint32_t)part[c].first;
			d->count[c] = (uint8_t)part[c].n;
			continue;
		}
		d->child[c] = (uint32_t)*next;
		if (part[c].n <= b->task_size) {
			b->tasks[b->task_count++] = (task){ part[c], depth + 1, *next };
			*next += bvh_node_bound(part[c].n);
		} else {
			build_range(b, part[c], depth + 1, next);
		}
	}
}

static void
build_tasks(void *arg, size_t begin, size_t end)
{
	builder b = *(const builder *)arg;

	b.task_size = 0;
	for (size_t i = begin; i < end; i++) {
		size_t next = b.tasks[i].slot;
		build_range(&b, b.tasks[i].r, b.tasks[i].depth, &next);
	}
}

static void
fill_prims(void *arg, size_t begin, size_t end)
{
	builder *b = arg;
	const mr_mesh *m = b->bvh->mesh;

	for (size_t f = begin; f < end; f++) {
		fbox box = fbox_empty();
		for (int i = 0; i < 3; i++) {
			mr_v3 u = bvh_unit(b->bvh, m->p[m->t[f].v[i]]);
			float c[3] = { (float)u.x, (float)u.y, (float)u.z };
			fbox_add(&box, c, c);
		}
		b->prims[f].face = (uint32_t)f;
		memcpy(b->prims[f].lo, box.lo, sizeof box.lo);
		memcpy(b->prims[f].hi, box.hi, sizeof box.hi);
	}
}

/* Centre and scale: every position within [-1, 1] of the unit. */
static void
set_unit(builder *r)
{
	mr_bvh *bvh = r->bvh;
	const mr_mesh *m = bvh->mesh;
	mr_box b = mr_box_of(m->p, m->nv);
	double size = 0;
	int exponent;

	bvh->center = mr_vec(b.min.x / 2 + b.max.x / 2, b.min.y / 2 + b.max.y / 2, b.min.z / 2 + b.max.z / 2);
	size = fmax(size, fmax(b.max.x - bvh->center.x, bvh->center.x - b.min.x));
	size = fmax(size, fmax(b.max.y - bvh->center.y, bvh->center.y - b.min.y));
	size = fmax(size, fmax(b.max.z - bvh->center.z, bvh->center.z - b.min.z));
	frexp(size, &exponent);
	bvh->scale = size > 0 ? ldexp(1, exponent > -1000 ? -exponent : 1000) : 1;
}

void
mr_bvh_build(mr_ctx *ctx, const mr_mesh *m, mr_bvh **out)
{
	mr_bvh *bvh = MR_NEW(ctx, 1, mr_bvh);
	mr_bvh_node *nodes = MR_NEW(ctx, bvh_node_bound(m->nf), mr_bvh_node);
	uint32_t *face = MR_NEW(ctx, m->nf, uint32_t);
	MR_SCOPE(ctx);
	builder b = { .prims = MR_NEW(ctx, m->nf, prim), .tasks = MR_NEW(ctx, m->nf / BVH_LEAF + 1, task) };
	size_t next = 0;

	*bvh = (mr_bvh){ .mesh = m, .nodes = nodes, .face = face, .scale = 1 };
	b.bvh = bvh;
	b.task_size = m->nf / TASKS > TASK_LEAST ? m->nf / TASKS : TASK_LEAST;
	if (m->nf) {
		set_unit(&b);
		mr_parallel(ctx, m->nf, 4096, fill_prims, &b);
		build_range(&b, (range){ 0, m->nf }, 0, &next);
		mr_parallel(ctx, b.task_count, 1, build_tasks, &b);
		for (size_t i = 0; i < m->nf; i++)
			face[i] = b.prims[i].face;
	}
	*out = bvh;
}
