/* Rounds: bad faces hold back their corners, then what that may have changed is looked at again. */
#include "mesh/guarded_move.h"

#include "base/parallel.h"
#include "mesh/dynmesh.h"

enum { GRAIN = 256 };

typedef struct move {
	const mr_guard *g;
	const mr_v3 *from;
	mr_v3 *to;
	bool *asked; /* faces that are to be looked at */
	bool *bad;   /* of those */
	bool *held;  /* vertices that were held back in this round */
	unsigned round;
} move;

static void
judge(void *arg, size_t begin, size_t end)
{
	const move *w = arg;

	for (size_t f = begin; f < end; f++)
		w->bad[f] = w->asked[f] && w->g->t[f].v[0] != MR_NONE && w->g->is_bad(w->g->arg, (uint32_t)f);
}

/* False where v stays already, or went back in this round; else the faces around it are to be looked at. */
static bool
hold_back(move *w, uint32_t v)
{
	uint32_t first = w->g->topo.out[v], h = first;

	if (w->held[v] || memcmp(&w->to[v], &w->from[v], sizeof *w->to) == 0)
		return false;
	w->held[v] = true;
	w->to[v] = w->round < w->g->halves ? mr_lerp(0.5, w->from[v], w->to[v]) : w->from[v];
	do {
		w->asked[h / 3] = true;
		h = mr_he_ccw(&w->g->topo, h);
	} while (h != MR_NONE && h != first);
	return true;
}

/* Bad faces, one after the other, hold their corners back, but those that have become good by that. */
static bool
hold_corners(move *w)
{
	bool any = false;

	memset(w->asked, w->g->look != NULL, w->g->nf * sizeof *w->asked);
	memset(w->held, 0, w->g->nv * sizeof *w->held);
	for (uint32_t f = 0; f < w->g->nf; f++) {
		if (!w->bad[f] || !w->g->is_bad(w->g->arg, f))
			continue;
		for (int k = 0; k < 3; k++)
			any |= hold_back(w, w->g->t[f].v[k]);
	}
	return any;
}

mr_status
mr_guarded_move(mr_ctx *ctx, const mr_guard *guard, const mr_v3 *from, mr_v3 *to)
{
	MR_SCOPE(ctx);
	move w = { guard, from, to, MR_NEW(ctx, guard->nf, bool), MR_NEW(ctx, guard->nf, bool),
		MR_NEW(ctx, guard->nv, bool), 0 };

	memset(w.asked, true, guard->nf * sizeof *w.asked);
	for (bool any = true; any; w.round++) {
		if (guard->look)
			MR_TRY(guard->look(ctx, guard->arg));
		mr_parallel(ctx, guard->nf, GRAIN, judge, &w);
		any = hold_corners(&w);
	}
	return MR_OK;
}

/* Cosine of 60 degrees, by which a face may turn at once: at 90 wraps of few points fold in. */
static const double TURN = 0.5;

/* For 2 degrees: a new fold turns one of its faces by more, so most faces need no look. */
static const double STILL = 0.999390827019096;

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
	double turn = mr_dot(before, after), area2 = mr_norm2(after);
	double least = s->needle * mr_dyn_longest2(q[v[0]], q[v[1]], q[v[2]]);

	if (area2 < least * least &&
	    mr_dyn_shape(q[v[0]], q[v[1]], q[v[2]]) < mr_dyn_shape(p[v[0]], p[v[1]], p[v[2]]))
		return true;
	if (turn <= 0 || turn * turn <= TURN * TURN * mr_norm2(before) * area2)
		return true;
	return turn * turn <= STILL * STILL * mr_norm2(before) * area2 &&
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
