/* Moving least squares with affine maps, in space: Schaefer, McPhail, Warren 2006: Image deformation using
 * moving least squares. */
#include "judge/mend.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/rotation.h"
#include "judge/judge.h"
#include "space/contact.h"

/* A patch reaches REACH rings beyond the harm, and FURTHER rings more for each round that leaves it.  AROUND
 * rings of nodes surround it. */
enum { ROUNDS = 4, REACH = 3, FURTHER = 2, AROUND = 2, OUTSIDE = 255 };
/* A patch has at most NODES nodes, at equal strides. */
enum { NODES = 512, GRAIN = 64 };

/* Draws maps towards rotations, by this share of the nodes' spread: nodes in a plane leave a map
 * undetermined. */
static const double RIGID = 0.01;

/* A vertex moves by at most so many edge lengths.  Larger moves squash patches and pull limbs away. */
static const double FURTHEST = 3;

/* A patch must lose harm, and must not gain any other fault. */
typedef struct tally {
	size_t harm[2], other[2]; /* vertices, now and mended */
} tally;

/* Positions, and the faults of each vertex: the marks of mr_harm_find, APART, and the number of changed
 * edges. */
enum { APART = 8, HARM = MR_HARM_NEAR | MR_HARM_FOLD, OTHER = MR_HARM_FOLD | MR_HARM_FAR | APART };
typedef struct state {
	mr_v3 *p;
	uint8_t *marks, *changes;
	size_t folds; /* edges */
} state;

typedef struct mending {
	const mr_mesh *then;
	const bool *held; /* or NULL */
	mr_contacts contacts;
	state now, mended;
	double *edge2;   /* of each vertex the longest edge, squared */
	uint8_t *times;  /* in how many rounds a vertex was harmed, of the last ones */
	uint8_t *ring;   /* of each vertex around these, or OUTSIDE */
	int reach;       /* rings that are mended */
	uint32_t *patch; /* of each vertex within reach and around: the patch's least */
	uint32_t *node;  /* by patches */
	size_t *start;   /* of the nodes of each patch */
	uint32_t *inner; /* vertices to mend */
	size_t count;    /* of these */
	tally *tally;    /* of each patch */
} mending;

static bool
is_held(const mending *w, size_t v)
{
	return w->held && w->held[v];
}

static bool
is_inner(const mending *w, size_t v)
{
	return w->ring[v] <= w->reach && !is_held(w, v);
}

static void
draw_near(mending *w, const uint32_t v[3], int ring)
{
	for (int i = 0; i < 3; i++)
		w->ring[v[i]] = w->ring[v[i]] < ring ? w->ring[v[i]] : (uint8_t)ring;
}

/* Whether ring k + 1 goes on from v.  Held vertices stop it. */
static bool
goes_on(const mending *w, uint32_t v, int k)
{
	return w->ring[v] == k && !is_held(w, v);
}

/* Rings spread over faces, and to touching parts. */
static void
find_rings(mending *w, int round)
{
	const mr_mesh *m = w->then;

	for (size_t v = 0; v < m->nv; v++)
		w->ring[v] = w->times[v] ? (uint8_t)(FURTHER * (round - w->times[v])) : OUTSIDE;
	for (int k = 0; k < w->reach + AROUND; k++) {
		for (size_t f = 0; f < m->nf; f++) {
			const uint32_t *v = m->t[f].v;
			if (goes_on(w, v[0], k) || goes_on(w, v[1], k) || goes_on(w, v[2], k))
				draw_near(w, v, k + 1);
		}
		for (uint32_t v = 0; v < m->nv; v++)
			for (size_t c = w->contacts.start[v];
			     goes_on(w, v, k) && c < w->contacts.start[v + 1]; c++)
				draw_near(w, m->t[w->contacts.at[c].face].v, k + 1);
	}
}

static void
join_near(mending *w, uint32_t a, uint32_t b)
{
	if (w->ring[a] != OUTSIDE && w->ring[b] != OUTSIDE)
		mr_sets_join(w->patch, a, b);
}

/* Joins the connected and the touching vertices into patches. */
static void
find_patches(mending *w)
{
	const mr_mesh *m = w->then;

	mr_sets_begin(w->patch, m->nv);
	for (size_t f = 0; f < m->nf; f++)
		for (int i = 0; i < 3; i++)
			join_near(w, m->t[f].v[i], m->t[f].v[(i + 1) % 3]);
	for (uint32_t v = 0; v < m->nv; v++)
		for (size_t c = w->contacts.start[v]; c < w->contacts.start[v + 1]; c++)
			join_near(w, v, m->t[w->contacts.at[c].face].v[0]);
	for (uint32_t v = 0; v < m->nv; v++)
		w->patch[v] = mr_sets_root(w->patch, v);
}

/* Lists the vertices to mend, and the nodes by patches. */
static void
list_vertices(mending *w)
{
	size_t nv = w->then->nv;

	memset(w->start, 0, (nv + 2) * sizeof *w->start);
	w->count = 0;
	for (uint32_t v = 0; v < nv; v++) {
		if (is_inner(w, v))
			w->inner[w->count++] = v;
		else if (w->ring[v] != OUTSIDE)
			w->start[w->patch[v] + 2]++;
	}
	for (size_t v = 0; v < nv; v++)
		w->start[v + 2] += w->start[v + 1];
	for (uint32_t v = 0; v < nv; v++)
		if (w->ring[v] != OUTSIDE && !is_inner(w, v))
			w->node[w->start[w->patch[v] + 1]++] = v;
}

/* The affine map at a point: the weighted means of the nodes, and a linear part. */
typedef struct local_map {
	mr_v3 then, now;
	mr_mat3 linear;
} local_map;

static local_map
map_at(const mending *w, const uint32_t *node, size_t n, size_t stride, mr_v3 x)
{
	local_map m = { { 0, 0, 0 }, { 0, 0, 0 }, { { 0 } } };
	mr_mat3 spread = { { 0 } }, both = { { 0 } }, rotation, unit = mr_mat3_identity();
	double all = 0, little;

	for (size_t i = 0; i < n; i += stride) {
		double share = 1 / mr_norm2(mr_sub(w->then->p[node[i]], x));
		m.then = mr_axpy(share, w->then->p[node[i]], m.then);
		m.now = mr_axpy(share, w->now.p[node[i]], m.now);
		all += share;
	}
	m.then = mr_mul(1 / all, m.then);
	m.now = mr_mul(1 / all, m.now);
	for (size_t i = 0; i < n; i += stride) {
		double share = 1 / mr_norm2(mr_sub(w->then->p[node[i]], x));
		mr_v3 from = mr_sub(w->then->p[node[i]], m.then), to = mr_sub(w->now.p[node[i]], m.now);
		mr_mat3_add_product(&spread, share, from, from);
		mr_mat3_add_product(&both, share, to, from);
	}
	little = RIGID * (spread.m[0] + spread.m[4] + spread.m[8]);
	rotation = mr_rotation_nearest(&both);
	both = mr_mat3_axpy(little, &rotation, &both);
	spread = mr_mat3_axpy(little, &unit, &spread);
	spread = mr_mat3_inverse_transposed(&spread);
	m.linear = mr_mat3_multiply(&both, &spread);
	return m;
}

static void
mend_vertices(void *arg, size_t begin, size_t end)
{
	mending *w = arg;

	for (size_t i = begin; i < end; i++) {
		uint32_t v = w->inner[i], root = w->patch[v];
		const uint32_t *node = w->node + w->start[root];
		size_t n = w->start[root + 1] - w->start[root];
		local_map m;
		mr_v3 to;
		if (n < 3)
			continue;
		m = map_at(w, node, n, (n + NODES - 1) / NODES, w->then->p[v]);
		to = mr_add(m.now, mr_mat3_apply(&m.linear, mr_sub(w->then->p[v], m.then)));
		/* a vertex that would go farther stays, and counts as a fault */
		if (mr_norm2(mr_sub(to, w->now.p[v])) <= FURTHEST * FURTHEST * w->edge2[v])
			w->mended.p[v] = to;
		else
			w->mended.marks[v] = MR_HARM_FAR;
	}
}

static void
look(mr_ctx *ctx, const mending *w, state *s)
{
	MR_SCOPE(ctx);
	mr_motion motion = mr_motion_of(ctx, w->then, s->p);
	double width = MR_APART_BY * motion.diagonal;
	mr_harm h;

	mr_harm_find(ctx, &motion, s->marks, &h);
	s->folds = h.folds;
	memset(s->changes, 0, w->then->nv);
	for (size_t i = 0; i < motion.changes; i++) {
		uint8_t *n = &s->changes[mr_he_from(w->then, motion.changed[i])];
		*n = (uint8_t)(*n + (*n < UINT8_MAX));
	}
	for (uint32_t v = 0; v < w->then->nv; v++)
		if (mr_contact_widened(&w->contacts, w->then, s->p, width, v) > width)
			s->marks[v] |= APART;
}

static void
add_up(const mending *w)
{
	const state *s[] = { &w->now, &w->mended };

	memset(w->tally, 0, w->then->nv * sizeof *w->tally);
	for (uint32_t v = 0; v < w->then->nv; v++)
		for (int k = 0; w->ring[v] != OUTSIDE && k < 2; k++) {
			tally *t = &w->tally[w->patch[v]];
			t->harm[k] += (s[k]->marks[v] & HARM) != 0;
			t->other[k] += (size_t)s[k]->changes[v] + ((s[k]->marks[v] & OTHER) != 0);
		}
}

/* Accepts the improved patches. */
static void
accept(mending *w)
{
	bool any = false;

	for (uint32_t v = 0; v < w->then->nv; v++) {
		const tally *t = &w->tally[w->patch[v]];
		if (w->ring[v] == OUTSIDE || t->harm[1] >= t->harm[0] || t->other[1] > t->other[0])
			continue;
		w->now.p[v] = w->mended.p[v];
		w->now.marks[v] = w->mended.marks[v];
		w->now.changes[v] = w->mended.changes[v];
		any = true;
	}
	w->now.folds = any ? w->mended.folds : w->now.folds;
}

/* Counts the rounds that left a vertex harmed. */
static void
count_times(mending *w)
{
	for (size_t v = 0; v < w->then->nv; v++)
		w->times[v] = w->now.marks[v] & HARM ? (uint8_t)(w->times[v] + 1) : 0;
}

static void
mend(mr_ctx *ctx, mending *w, int round)
{
	size_t nv = w->then->nv;

	w->reach = REACH + FURTHER * (round - 1);
	count_times(w);
	find_rings(w, round);
	find_patches(w);
	list_vertices(w);
	memcpy(w->mended.p, w->now.p, nv * sizeof *w->now.p);
	memset(w->mended.marks, 0, nv);
	mr_parallel(ctx, w->count, GRAIN, mend_vertices, w);
	look(ctx, w, &w->mended);
	add_up(w);
	if (w->mended.folds <= w->now.folds)
		accept(w);
}

static void
measure_edges(const mending *w)
{
	for (uint32_t h = 0; h < 3 * w->then->nf; h++) {
		uint32_t a = mr_he_from(w->then, h), b = mr_he_to(w->then, h);
		double length2 = mr_norm2(mr_sub(w->then->p[b], w->then->p[a]));
		w->edge2[a] = fmax(w->edge2[a], length2);
		w->edge2[b] = fmax(w->edge2[b], length2);
	}
}

static void
make_room(mr_ctx *ctx, mending *w)
{
	size_t nv = w->then->nv;

	w->mended = (state){ MR_NEW(ctx, nv, mr_v3), MR_NEW(ctx, nv, uint8_t), MR_NEW(ctx, nv, uint8_t), 0 };
	w->now.changes = MR_NEW(ctx, nv, uint8_t);
	w->edge2 = MR_NEW_ZERO(ctx, nv, double);
	measure_edges(w);
	w->times = MR_NEW_ZERO(ctx, nv, uint8_t);
	w->ring = MR_NEW(ctx, nv, uint8_t);
	w->patch = MR_NEW(ctx, nv, uint32_t);
	w->node = MR_NEW(ctx, nv, uint32_t);
	w->start = MR_NEW(ctx, nv + 2, size_t);
	w->inner = MR_NEW(ctx, nv, uint32_t);
	w->tally = MR_NEW(ctx, nv, tally);
	mr_contacts_find(ctx, w->then, MR_TOUCH * mr_mesh_diagonal(w->then), &w->contacts);
}

void
mr_mend(mr_ctx *ctx, const mr_mesh *then, const bool *held, mr_v3 *now)
{
	MR_SCOPE(ctx);
	mending w = {
		.then = then, .held = held, .now = { now, MR_NEW_ZERO(ctx, then->nv, uint8_t), NULL, 0 }
	};
	mr_motion motion = mr_motion_of(ctx, then, now);
	mr_harm h;

	mr_harm_find(ctx, &motion, NULL, &h);
	if (!mr_harm_folds(&h, then->nf) && !mr_harm_crosses(&h, then->nf))
		return;
	make_room(ctx, &w);
	look(ctx, &w, &w.now);
	for (int round = 1; round <= ROUNDS; round++)
		mend(ctx, &w, round);
}
