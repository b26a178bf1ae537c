/* Folds and intersections that a motion makes, looked for only where it is not rigid. */
#include "judge/harm.h"

#include "base/parallel.h"
#include "base/rotation.h"
#include "mesh/fold.h"
#include "space/self_intersect.h"

enum { NEAR = 12 };

typedef struct tally {
	size_t near, far;
} tally;

typedef struct motion {
	const mr_mesh *before, *after;
	const mr_edges *edges;
	bool *fold;     /* of the edges: new */
	uint32_t *edge; /* of each half-edge; MR_NONE of a face that has a vertex twice */
	double deep;    /* what passes by less rubs, */
	double wide;    /* unless it was farther apart */
	bool *moved;    /* of the faces */
	uint32_t *harm; /* of the faces, by what is near */
	uint32_t *met;  /* by what is far */
	tally *pairs;
} motion;

/* Folds */

/* Whether the faces at half-edges h and g of an edge are folded. */
static bool
folded(const mr_mesh *m, uint32_t h, uint32_t g)
{
	mr_v3 a = mr_face_cross(m, h / 3), b = mr_face_cross(m, g / 3);

	return mr_folds(mr_same_direction(m, h, g) ? mr_mul(-1, a) : a, b, MR_FOLD);
}

static bool
folds_new(const mr_mesh *before, const mr_mesh *after, const mr_edges *edges, size_t e)
{
	const uint32_t *h = &edges->he[edges->start[e]];

	return mr_edge_faces(edges, e) == 2 && folded(after, h[0], h[1]) && !folded(before, h[0], h[1]);
}

static void
find_folds(void *arg, size_t begin, size_t end)
{
	motion *j = arg;

	for (size_t e = begin; e < end; e++)
		j->fold[e] = folds_new(j->before, j->after, j->edges, e);
}

static size_t
less(size_t a, size_t b)
{
	return a > b ? a - b : 0;
}

static size_t
count_folds(mr_ctx *ctx, motion *j)
{
	size_t came = 0, went = 0;

	mr_parallel(ctx, j->edges->count, 4096, find_folds, j);
	for (size_t e = 0; e < j->edges->count; e++)
		for (uint32_t i = 0; i < 2 && j->fold[e]; i++) {
			j->harm[j->edges->he[j->edges->start[e] + i] / 3]++;
			came += i == 0;
		}
	for (size_t e = 0; came && e < j->edges->count; e++)
		went += folds_new(j->after, j->before, j->edges, e);
	return less(came, went);
}

/* Rigidity */

static mr_v3
centroid(const mr_v3 *p, size_t n)
{
	mr_v3 sum = mr_vec(0, 0, 0);

	for (size_t i = 0; i < n; i++)
		sum = mr_add(sum, p[i]);
	return mr_mul(1 / fmax(1, (double)n), sum);
}

/* Whether all went as one rigid body, by the motion that fits best. */
static bool
went_as_one(const mr_mesh *before, const mr_mesh *after)
{
	const double little = 1e-9; /* of the diagonal */
	mr_v3 from = centroid(before->p, before->nv), to = centroid(after->p, before->nv);
	double most = mr_mesh_tolerance(before, little);
	mr_mat3 c = { { 0 } };

	for (size_t v = 0; v < before->nv; v++) {
		mr_v3 x = mr_sub(before->p[v], from), y = mr_sub(after->p[v], to);
		const double a[3] = { x.x, x.y, x.z }, b[3] = { y.x, y.y, y.z };
		for (int i = 0; i < 9; i++)
			c.m[i] += b[i / 3] * a[i % 3];
	}
	c = mr_rotation_nearest(&c);
	for (size_t v = 0; v < before->nv; v++) {
		mr_v3 y = mr_add(to, mr_mat3_apply(&c, mr_sub(before->p[v], from)));
		if (!(mr_dist(y, after->p[v]) <= most))
			return false;
	}
	return true;
}

static bool
is_same(mr_v3 a, mr_v3 b)
{
	return a.x == b.x && a.y == b.y && a.z == b.z;
}

static void
find_edges(motion *j)
{
	memset(j->edge, 0xff, 3 * j->before->nf * sizeof *j->edge);
	for (size_t e = 0; e < j->edges->count; e++)
		for (uint32_t i = j->edges->start[e]; i < j->edges->start[e + 1]; i++)
			j->edge[j->edges->he[i]] = (uint32_t)e;
	for (size_t f = 0; f < j->before->nf; f++)
		for (int k = 0; k < 3; k++) {
			uint32_t v = j->before->t[f].v[k];
			j->moved[f] |= !is_same(j->before->p[v], j->after->p[v]);
		}
}

/* Near faces */

/* Calls visit for each face over an edge of f. */
static void
for_neighbours(const motion *j, uint32_t f, void (*visit)(void *arg, uint32_t g), void *arg)
{
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
		for (uint32_t i = 0, e = j->edge[h]; e != MR_NONE && i < mr_edge_faces(j->edges, e); i++)
			visit(arg, j->edges->he[j->edges->start[e] + i] / 3);
}

/* The faces near one, as far as they find room: in a table of open addresses. */
enum { ROOM = 4096 };

typedef struct patch {
	size_t n;
	uint32_t face[ROOM], slot[2 * ROOM];
} patch;

static size_t
slot_of(const patch *s, uint32_t f)
{
	size_t i = f * 2654435761u % (2 * ROOM);

	while (s->slot[i] != MR_NONE && s->slot[i] != f)
		i = (i + 1) % (2 * ROOM);
	return i;
}

static void
patch_meets(void *arg, uint32_t g)
{
	patch *s = arg;
	size_t i = slot_of(s, g);

	if (s->slot[i] == MR_NONE && s->n < ROOM) {
		s->slot[i] = g;
		s->face[s->n++] = g;
	}
}

static void
gather_near(const motion *j, uint32_t f, patch *s)
{
	size_t done = 0;

	s->n = 0;
	memset(s->slot, 0xff, sizeof s->slot);
	patch_meets(s, f);
	for (int ring = 0; ring < NEAR; ring++)
		for (size_t end = s->n; done < end; done++)
			for_neighbours(j, s->face[done], patch_meets, s);
}

/* Intersections */

static void
corners(const mr_mesh *m, uint32_t f, mr_v3 p[3])
{
	for (int i = 0; i < 3; i++)
		p[i] = m->p[m->t[f].v[i]];
}

static bool
intersect(const mr_mesh *m, uint32_t f, uint32_t g)
{
	mr_v3 p[3], q[3];

	corners(m, f, p);
	corners(m, g, q);
	return !mr_triangle_degenerate(p[0], p[1], p[2]) && !mr_triangle_degenerate(q[0], q[1], q[2]) &&
	       mr_triangles_intersect(p, q);
}

bool
mr_faces_stand(const mr_mesh *before, const mr_mesh *after, uint32_t f, uint32_t g)
{
	const double little = 1e-3; /* of their extent */
	mr_v3 p[6], q[6];
	double most;

	corners(before, f, p);
	corners(before, g, p + 3);
	corners(after, f, q);
	corners(after, g, q + 3);
	most = little * mr_box_diagonal(mr_box_of(p, 6));
	for (int i = 0; i < 6; i++)
		for (int k = 0; k < i; k++)
			if (!(fabs(mr_dist(q[i], q[k]) - mr_dist(p[i], p[k])) <= most))
				return false;
	return true;
}

/* How far the corners p reach beyond the plane of q, on the side where they reach less; where they are all on
 * one side, less than 0 by their distance. */
static double
reach(const mr_v3 p[3], const mr_v3 q[3])
{
	mr_v3 n = mr_unit(mr_cross(mr_sub(q[1], q[0]), mr_sub(q[2], q[0])));
	double low = mr_dot(n, mr_sub(p[0], q[0])), high = low;

	for (int i = 1; i < 3; i++) {
		double d = mr_dot(n, mr_sub(p[i], q[0]));
		low = fmin(low, d);
		high = fmax(high, d);
	}
	return fmin(-low, high);
}

/* Whether faces go through each other by so much that they can be seen to, of small faces a tenth, or were as
 * far apart, as walls that go through each other at a small angle: others rub. */
static bool
passes(const motion *j, uint32_t f, uint32_t g)
{
	const double share = 0.1;
	mr_v3 p[3], q[3];
	double size;

	corners(j->after, f, p);
	corners(j->after, g, q);
	size = fmin(mr_box_diagonal(mr_box_of(p, 3)), mr_box_diagonal(mr_box_of(q, 3)));
	if (fmin(reach(p, q), reach(q, p)) > fmin(j->deep, share * size))
		return true;
	corners(j->before, f, p);
	corners(j->before, g, q);
	return fmin(reach(p, q), reach(q, p)) < -j->wide;
}

static void
add_one(uint32_t *count, const bool *moved, uint32_t f)
{
	if (moved[f])
		__atomic_fetch_add(&count[f], 1, __ATOMIC_RELAXED);
}

/* Those that intersect after and did not before. */
static void
visit(void *arg, uint32_t f, uint32_t g)
{
	const motion *j = arg;
	patch around;
	bool near;

	if (intersect(j->before, f, g) || mr_faces_stand(j->before, j->after, f, g))
		return;
	gather_near(j, f, &around);
	near = around.slot[slot_of(&around, g)] == g;
	if (!near && !passes(j, f, g))
		return;
	__atomic_fetch_add(near ? &j->pairs->near : &j->pairs->far, 1, __ATOMIC_RELAXED);
	add_one(near ? j->harm : j->met, j->moved, f);
	add_one(near ? j->harm : j->met, j->moved, g);
}

static void
search_all(mr_ctx *ctx, motion *j, tally *sum)
{
	*sum = (tally){ 0, 0 };
	j->pairs = sum;
	mr_intersections_visit(ctx, NULL, j->after, j->moved, visit, j);
}

/* More pairs than there were: where a surface intersects already, others go while some come. */
static void
count_pairs(mr_ctx *ctx, const motion *m, tally *count)
{
	const double deep = 0.001; /* of the diagonal: parts that are nearer touch */
	motion forth = *m, back;
	tally came = { 0, 0 }, went = { 0, 0 };

	*count = came;
	if (went_as_one(m->before, m->after))
		return;
	forth.deep = forth.wide = deep * mr_mesh_diagonal(m->before);
	forth.edge = MR_NEW(ctx, 3 * m->before->nf, uint32_t);
	forth.moved = MR_NEW_ZERO(ctx, m->before->nf, bool);
	find_edges(&forth);
	search_all(ctx, &forth, &came);
	if (came.near == 0 && came.far == 0)
		return;
	back = forth;
	back.before = m->after;
	back.after = m->before;
	back.wide = INFINITY;                             /* what touched and has come apart did not pass */
	back.harm = MR_NEW(ctx, m->before->nf, uint32_t); /* for no one */
	back.met = MR_NEW(ctx, m->before->nf, uint32_t);
	search_all(ctx, &back, &went);
	*count = (tally){ less(came.near, went.near), less(came.far, went.far) };
}

/* A corner of the face that has most harm, of equal ones the lowest. */
static uint32_t
worst_vertex(const mr_mesh *m, const uint32_t *harm)
{
	size_t worst = 0;

	for (size_t f = 1; f < m->nf; f++)
		if (harm[f] > harm[worst])
			worst = f;
	return m->nf && harm[worst] ? m->t[worst].v[0] : MR_NONE;
}

void
mr_harm_find(
    mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, const mr_v3 *after, size_t enough, mr_harm *harm)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_mesh moved = *m;
	motion j = { .before = m,
		.after = &moved,
		.edges = edges,
		.fold = MR_NEW(ctx, edges->count, bool),
		.harm = MR_NEW_ZERO(ctx, m->nf, uint32_t),
		.met = MR_NEW_ZERO(ctx, m->nf, uint32_t) };
	mr_harm found = { 0, MR_UNKNOWN, MR_UNKNOWN, MR_NONE, MR_NONE };
	tally pairs;

	moved.p = after;
	found.folds = count_folds(ctx, &j);
	if (found.folds >= enough) {
		count_pairs(ctx, &j, &pairs);
		found.pairs = pairs.near;
		found.far = pairs.far;
	}
	found.vertex = worst_vertex(m, j.harm);
	found.far_vertex = worst_vertex(m, j.met);
	*harm = found;
	mr_mark_release(ctx, mark);
}
