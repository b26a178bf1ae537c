/* Rounds: bad faces hold back what is around them, then what that may have changed is looked at again. */
#include "mesh/guarded_move.h"

#include "base/parallel.h"
#include "mesh/dynmesh.h"

enum { GRAIN = 256 };

/* Numbers, each once. */
typedef struct list {
	uint32_t *at;
	size_t n;
	bool *has; /* of each number */
} list;

typedef struct move {
	const mr_guard *g;
	const mr_v3 *from;
	mr_v3 *to;
	bool all;        /* faces are to look at now; else: */
	list face, next; /* to look at now, and after */
	bool *bad;       /* of those to look at now */
	list vertex;     /* to hold back */
	unsigned round;
} move;

static void
list_new(mr_ctx *ctx, size_t room, list *l)
{
	*l = (list){ MR_NEW(ctx, room, uint32_t), 0, MR_NEW_ZERO(ctx, room, bool) };
}

static void
list_add(list *l, uint32_t x)
{
	if (l->has[x])
		return;
	l->has[x] = true;
	l->at[l->n++] = x;
}

static void
list_clear(list *l)
{
	for (size_t i = 0; i < l->n; i++)
		l->has[l->at[i]] = false;
	l->n = 0;
}

/* How many faces there are to look at. */
static size_t
count(const move *w)
{
	return w->all ? w->g->nf : w->face.n;
}

/* The i-th of them. */
static uint32_t
face_at(const move *w, size_t i)
{
	return w->all ? (uint32_t)i : w->face.at[i];
}

static void
judge(void *arg, size_t begin, size_t end)
{
	const move *w = arg;

	for (size_t i = begin; i < end; i++) {
		uint32_t f = face_at(w, i);
		w->bad[i] = w->g->t[f].v[0] != MR_NONE && w->g->is_bad(w->g->arg, f);
	}
}

/* Lists the faces around v, or their corners. */
static void
list_around(const mr_guard *g, uint32_t v, bool corners, list *l)
{
	uint32_t first = g->topo.out[v], h = first;

	do {
		if (!corners)
			list_add(l, h / 3);
		for (int k = 0; k < 3 && corners; k++)
			list_add(l, g->t[h / 3].v[k]);
		h = mr_he_ccw(&g->topo, h);
	} while (h != MR_NONE && h != first);
}

/* False where v stays already. */
static bool
hold_back(move *w, uint32_t v)
{
	if (memcmp(&w->to[v], &w->from[v], sizeof *w->to) == 0)
		return false;
	w->to[v] = w->round < w->g->halves ? mr_lerp(0.5, w->from[v], w->to[v]) : w->from[v];
	return true;
}

/* Bad faces, one after the other, hold their corners back, but those that have become good by that; then the
 * faces around what was held back are to be looked at. */
static bool
hold_corners(move *w)
{
	list looked = w->face;

	for (size_t i = 0; i < count(w); i++) {
		uint32_t f = face_at(w, i);
		if (!w->bad[i] || !w->g->is_bad(w->g->arg, f))
			continue;
		for (int k = 0; k < 3; k++)
			if (hold_back(w, w->g->t[f].v[k]))
				list_around(w->g, w->g->t[f].v[k], false, &w->next);
	}
	w->all = false;
	w->face = w->next;
	w->next = looked;
	list_clear(&w->next);
	return w->face.n > 0;
}

/* All bad faces at once hold back what is around them. */
static bool
hold_rings(move *w)
{
	bool any = false;
	size_t i = 0;

	list_clear(&w->vertex);
	for (size_t f = 0; f < w->g->nf; f++)
		for (int k = 0; k < 3 && w->bad[f]; k++)
			list_add(&w->vertex, w->g->t[f].v[k]);
	for (unsigned ring = 0; ring < w->g->rings; ring++)
		for (size_t end = w->vertex.n; i < end; i++)
			list_around(w->g, w->vertex.at[i], true, &w->vertex);
	for (i = 0; i < w->vertex.n; i++)
		any |= hold_back(w, w->vertex.at[i]);
	return any;
}

static void
move_new(mr_ctx *ctx, move *w)
{
	const mr_guard *g = w->g;

	list_new(ctx, g->nf, &w->face);
	list_new(ctx, g->nf, &w->next);
	list_new(ctx, g->nv, &w->vertex);
	w->bad = MR_NEW(ctx, g->nf, bool);
}

mr_status
mr_guarded_move(mr_ctx *ctx, const mr_guard *guard, const mr_v3 *from, mr_v3 *to)
{
	mr_mark mark = mr_mark_take(ctx);
	move w = { .g = guard, .from = from, .to = to, .all = true };

	move_new(ctx, &w);
	for (bool any = true; any; w.round++) {
		if (guard->look)
			MR_TRY(guard->look(ctx, guard->arg));
		mr_parallel(ctx, count(&w), GRAIN, judge, &w);
		any = guard->look ? hold_rings(&w) : hold_corners(&w);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Cosine of 60 degrees, by which a face may turn at once: at 90 a wrap of a handful of points folds in on
 * itself. */
static const double TURN = 0.5;

typedef struct unfolded {
	mr_mesh from, to;
	const uint32_t *twin;
	double needle;
} unfolded;

static bool
turns(const void *arg, uint32_t f)
{
	const unfolded *s = arg;
	const uint32_t *v = s->from.t[f].v;
	const mr_v3 *p = s->from.p, *q = s->to.p;
	mr_v3 before = mr_face_cross(&s->from, f), after = mr_face_cross(&s->to, f);
	double turn = mr_dot(before, after);

	double shape = mr_dyn_shape(q[v[0]], q[v[1]], q[v[2]]);

	return (shape < s->needle && shape < mr_dyn_shape(p[v[0]], p[v[1]], p[v[2]])) ||
	       turn <= TURN * sqrt(mr_norm2(before) * mr_norm2(after)) ||
	       mr_folds_more(&s->from, &s->to, s->twin, f, MR_NEAR_FOLD);
}

mr_status
mr_move_unfolded(mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, double needle, mr_v3 *to)
{
	unfolded s = { *m, *m, topo->twin, needle };
	mr_guard g = { .t = m->t, .topo = *topo, .nv = m->nv, .nf = m->nf, .is_bad = turns, .arg = &s };

	s.to.p = to;
	return mr_guarded_move(ctx, &g, m->p, to);
}
