/* Folds and intersections that a motion makes, looked for only where it is not rigid. */
#include "measure/harm.h"

#include "base/parallel.h"
#include "mesh/fold.h"
#include "space/self_intersect.h"

enum { NEAR = 12, GRAIN = 256 };

typedef struct motion {
	const mr_mesh *before, *after;
	const mr_bvh *bvh; /* of after */
	const mr_edges *edges;
	bool *fold;     /* of the edges: new */
	uint32_t *edge; /* of each half-edge; MR_NONE of a face that has a vertex twice */
	bool *suspect;  /* of the faces: near one that did not move rigidly */
	uint32_t *harm; /* of the faces */
	size_t *pairs;  /* per piece of faces */
} motion;

/* Folds */

/* Whether the faces at half-edges h and g of an edge are folded. */
static bool
folded(const mr_mesh *m, uint32_t h, uint32_t g)
{
	mr_v3 a = mr_face_cross(m, h / 3), b = mr_face_cross(m, g / 3);

	return mr_folds(mr_same_direction(m, h, g) ? mr_mul(-1, a) : a, b, MR_FOLD);
}

static void
find_folds(void *arg, size_t begin, size_t end)
{
	motion *j = arg;

	for (size_t e = begin; e < end; e++) {
		const uint32_t *h = &j->edges->he[j->edges->start[e]];
		j->fold[e] = mr_edge_faces(j->edges, e) == 2 && folded(j->after, h[0], h[1]) &&
		             !folded(j->before, h[0], h[1]);
	}
}

static size_t
count_folds(mr_ctx *ctx, motion *j)
{
	size_t folds = 0;

	mr_parallel(ctx, j->edges->count, 4096, find_folds, j);
	for (size_t e = 0; e < j->edges->count; e++)
		for (int i = 0; i < 2 && j->fold[e]; i++) {
			j->harm[j->edges->he[j->edges->start[e] + (size_t)i] / 3]++;
			folds += i == 0;
		}
	return folds;
}

/* Rigidity */

/* The angle between the faces at half-edges h and g of an edge, with a sign. */
static double
bend(const mr_mesh *m, uint32_t h, uint32_t g)
{
	mr_v3 a = mr_face_cross(m, h / 3), b = mr_face_cross(m, g / 3);
	mr_v3 along = mr_unit(mr_sub(m->p[mr_he_to(m, h)], m->p[mr_he_from(m, h)]));

	return atan2(mr_dot(along, mr_cross(a, b)), mr_dot(a, b));
}

/* Whether the faces at edge e moved as one rigid body, but for what no harm comes of. */
static bool
rigid(const motion *j, size_t e)
{
	const double stretch = 1e-3, turn = 1e-2;
	const uint32_t *h = &j->edges->he[j->edges->start[e]];
	uint32_t a = mr_he_from(j->before, h[0]), b = mr_he_to(j->before, h[0]);
	double was = mr_dist(j->before->p[a], j->before->p[b]), is = mr_dist(j->after->p[a], j->after->p[b]);

	if (!(fabs(is - was) <= stretch * was))
		return false;
	return mr_edge_faces(j->edges, e) != 2 ||
	       fabs(remainder(bend(j->after, h[0], h[1]) - bend(j->before, h[0], h[1]), 2 * MR_PI)) <= turn;
}

static void
suspect(motion *j)
{
	memset(j->edge, 0xff, 3 * j->before->nf * sizeof *j->edge);
	for (size_t e = 0; e < j->edges->count; e++) {
		bool bends = !rigid(j, e);
		for (uint32_t i = j->edges->start[e]; i < j->edges->start[e + 1]; i++) {
			j->edge[j->edges->he[i]] = (uint32_t)e;
			j->suspect[j->edges->he[i] / 3] |= bends;
		}
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

typedef struct wave {
	bool *met;
	uint32_t *queue;
	size_t n;
} wave;

static void
wave_meets(void *arg, uint32_t g)
{
	wave *w = arg;

	if (!w->met[g]) {
		w->met[g] = true;
		w->queue[w->n++] = g;
	}
}

/* Suspects all faces within half of what is near: of two near faces that moved against each other one is. */
static mr_status
spread_suspicion(mr_ctx *ctx, motion *j)
{
	wave w = { j->suspect, MR_NEW(ctx, j->before->nf, uint32_t), 0 };
	size_t done = 0;

	if (!w.queue)
		return MR_EMEM;
	for (uint32_t f = 0; f < j->before->nf; f++)
		if (j->suspect[f])
			w.queue[w.n++] = f;
	for (int ring = 0; ring < NEAR / 2; ring++)
		for (size_t end = w.n; done < end; done++)
			for_neighbours(j, w.queue[done], wave_meets, &w);
	return MR_OK;
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

typedef struct search {
	const motion *j;
	uint32_t face;
	bool gathered; /* what is near: where something intersects */
	patch near;
	size_t count, later; /* of pairs; those with later faces */
} search;

static bool
visit(void *arg, uint32_t g)
{
	search *s = arg;

	if (g == s->face || !intersect(s->j->after, s->face, g) || intersect(s->j->before, s->face, g))
		return true;
	if (!s->gathered) {
		gather_near(s->j, s->face, &s->near);
		s->gathered = true;
	}
	if (s->near.slot[slot_of(&s->near, g)] == g) {
		s->count++;
		s->later += g > s->face || !s->j->suspect[g];
	}
	return true;
}

static void
search_faces(void *arg, size_t begin, size_t end)
{
	motion *j = arg;
	search s;

	s.j = j;
	for (size_t f = begin; f < end; f++) {
		mr_v3 p[3];
		if (!j->suspect[f])
			continue;
		s.face = (uint32_t)f;
		s.gathered = false;
		s.count = s.later = 0;
		corners(j->after, s.face, p);
		mr_bvh_overlap(j->bvh, mr_box_of(p, 3), visit, &s);
		j->harm[f] += (uint32_t)s.count;
		j->pairs[begin / GRAIN] += s.later;
	}
}

static mr_status
count_pairs(mr_ctx *ctx, motion *j, size_t *count)
{
	size_t pieces = (j->before->nf + GRAIN - 1) / GRAIN;
	mr_bvh *bvh;

	*count = 0;
	j->pairs = MR_NEW_ZERO(ctx, pieces, size_t);
	j->edge = MR_NEW(ctx, 3 * j->before->nf, uint32_t);
	j->suspect = MR_NEW_ZERO(ctx, j->before->nf, bool);
	if (!j->pairs || !j->edge || !j->suspect)
		return MR_EMEM;
	suspect(j);
	MR_TRY(spread_suspicion(ctx, j));
	MR_TRY(mr_bvh_build(ctx, j->after, &bvh));
	j->bvh = bvh;
	mr_parallel(ctx, j->before->nf, GRAIN, search_faces, j);
	for (size_t i = 0; i < pieces; i++)
		*count += j->pairs[i];
	return MR_OK;
}

/* A corner of the face that has most harm, of equal ones the lowest. */
static uint32_t
worst_vertex(const motion *j)
{
	size_t worst = 0;

	for (size_t f = 1; f < j->before->nf; f++)
		if (j->harm[f] > j->harm[worst])
			worst = f;
	return j->harm[worst] ? j->before->t[worst].v[0] : MR_NONE;
}

mr_status
mr_harm_find(
    mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, const mr_v3 *after, size_t enough, mr_harm *harm)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_mesh moved = *m;
	motion j = { .before = m,
		.after = &moved,
		.edges = edges,
		.fold = MR_NEW(ctx, edges->count, bool),
		.harm = MR_NEW_ZERO(ctx, m->nf, uint32_t) };
	mr_harm found = { 0, MR_UNKNOWN, MR_NONE };

	moved.p = after;
	if (!j.fold || !j.harm)
		return MR_EMEM;
	found.folds = count_folds(ctx, &j);
	if (found.folds >= enough)
		MR_TRY(count_pairs(ctx, &j, &found.pairs));
	if (m->nf)
		found.vertex = worst_vertex(&j);
	*harm = found;
	mr_mark_release(ctx, mark);
	return MR_OK;
}
