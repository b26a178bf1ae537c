/* A guarded move (mesh/guarded_move.h) of a control mesh, whose faces answer for themselves and for the
 * surface that they make. */
#include "fit/guard.h"

#include "base/parallel.h"
#include "mesh/fold.h"
#include "mesh/guarded_move.h"
#include "subdivide/loop_self_intersect.h"

/* Over 132 fits: with half as many the mean distance is 0.4 % more and the time 17 % less, with twice as many
 * nothing changes but the time; without any the distance is 8 % more. */
enum { HALVES = 4, GRAIN = 64 };

/* Times that motions are smoothed at most.  Without, the mean distance is 1.6 % more, the rms 3 %, the
 * largest 3.5 %, with six nothing is less but that, by 0.4 %. */
enum { SMOOTHS = 3 };

/* The control mesh or the limit points, at the end of a step and as they were seen last within one. */
typedef struct layer {
	const mr_loop *level;
	size_t depth;     /* its own */
	mr_v3 *from, *to; /* its vertices */
	mr_v3 *seen;      /* the control vertices then */
	bool *moves;      /* control faces whose part had moved */
	bool *crosses;    /* its faces that pass through others */
	mr_loop_tree *tree;
} layer;

struct mr_fit_guard {
	mr_fit_surface *s;
	layer control, fine;
	bool *folds; /* control faces whose part of the surface closes too far */
};

typedef mr_fit_guard guard;

/* Whether a part of control face f passes through another. */
static bool
crosses(const layer *y, size_t f)
{
	return memchr(y->crosses + (f << 2 * y->depth), 1, (size_t)1 << 2 * y->depth);
}

/* Whether an edge of a part of control face f closes beyond the angle of that cosine. */
static bool
folds(const layer *y, size_t f, double closed)
{
	const mr_loop *l = &y->level[y->depth];
	mr_mesh from = { NULL, y->from, l->t, l->nv, l->nf }, to = { NULL, y->to, l->t, l->nv, l->nf };

	for (size_t k = f << 2 * y->depth; k < (f + 1) << 2 * y->depth; k++)
		if (mr_folds_more(&from, &to, l->topo.twin, (uint32_t)k, closed))
			return true;
	return false;
}

static bool
is_bad_control(const guard *g, uint32_t f)
{
	return crosses(&g->control, f) || folds(&g->control, f, MR_FOLD);
}

/* That the surface turns over is no reason: without it fits come 1 % closer, with fewer folds. */
static bool
is_bad(const void *arg, uint32_t f)
{
	const guard *g = arg;

	return g->folds[f] || crosses(&g->fine, f) || is_bad_control(g, f);
}

/* Marks the control faces at a vertex of those that are marked. */
static void
spread(mr_ctx *ctx, const mr_loop *l, bool *mark)
{
	mr_mark start = mr_mark_take(ctx);
	bool *near = MR_NEW_ZERO(ctx, l->nv, bool);

	for (size_t f = 0; f < l->nf; f++)
		for (int k = 0; k < 3 && mark[f]; k++)
			near[l->t[f].v[k]] = true;
	for (size_t f = 0; f < l->nf; f++)
		mark[f] = near[l->t[f].v[0]] || near[l->t[f].v[1]] || near[l->t[f].v[2]];
	mr_mark_release(ctx, start);
}

/* The control faces whose part has moved, with the control vertices at x, since it was seen last: limit
 * points of a face depend on the vertices around its corners. */
static void
find_moves(mr_ctx *ctx, layer *y, const mr_v3 *x)
{
	const mr_loop *l = &y->level[0];

	memset(y->moves, 0, l->nf * sizeof *y->moves);
	for (size_t h = 0; h < 3 * l->nf; h++) {
		uint32_t v = l->t[h / 3].v[h % 3];
		y->moves[h / 3] |= memcmp(&y->seen[v], &x[v], sizeof *x) != 0;
	}
	memcpy(y->seen, x, l->nv * sizeof *x);
	if (y->depth > 0)
		spread(ctx, l, y->moves);
}

static void
look_at_control(mr_ctx *ctx, guard *g)
{
	find_moves(ctx, &g->control, g->control.to);
	mr_find_crossings(ctx, g->control.tree, g->control.to, g->control.moves, g->control.crosses);
}

static void
find_folds(void *arg, size_t begin, size_t end)
{
	const guard *g = arg;
	const mr_loop *l = g->s->level;

	for (size_t f = begin; f < end; f++) {
		bool due = g->fine.moves[f];
		for (size_t h = 3 * f; h < 3 * f + 3; h++)
			due |= l->topo.twin[h] != MR_NONE && g->fine.moves[l->topo.twin[h] / 3];
		if (due)
			g->folds[f] = folds(&g->fine, f, MR_NEAR_FOLD);
	}
}

static mr_status
look(mr_ctx *ctx, void *arg)
{
	guard *g = arg;
	size_t nf = g->s->level[0].nf;

	look_at_control(ctx, g);
	find_moves(ctx, &g->fine, g->control.to);
	mr_fit_surface_move(ctx, g->s, g->control.to, g->fine.moves);
	mr_find_crossings(ctx, g->fine.tree, g->fine.to, g->fine.moves, g->fine.crosses);
	mr_parallel(ctx, nf, GRAIN, find_folds, g);
	return MR_OK;
}

/* The vertices stay where they were seen last. */
static void
rest(guard *g)
{
	const mr_loop *l = g->s->level;

	memcpy(g->control.from, g->control.to, l->nv * sizeof *g->control.to);
	memcpy(g->fine.from, g->fine.to, g->s->m.nv * sizeof *g->fine.to);
	memset(g->folds, 0, l->nf * sizeof *g->folds);
}

static void
layer_new(mr_ctx *ctx, const mr_loop *level, size_t depth, mr_v3 *to, layer *y)
{
	*y = (layer){ level, depth, MR_NEW(ctx, level[depth].nv, mr_v3), to, MR_NEW(ctx, level->nv, mr_v3),
		MR_NEW(ctx, level->nf, bool), MR_NEW_ZERO(ctx, level[depth].nf, bool),
		mr_loop_tree_new(ctx, level, depth) };
	memset(y->seen, 0xff, level->nv * sizeof *y->seen); /* nowhere */
}

mr_status
mr_fit_guard_new(mr_ctx *ctx, mr_fit_surface *s, const mr_v3 *x, mr_fit_guard **out)
{
	guard *g = MR_NEW(ctx, 1, guard);
	const mr_loop *l = s->level;

	g->s = s;
	g->folds = MR_NEW(ctx, l->nf, bool);
	layer_new(ctx, l, 0, MR_NEW(ctx, l->nv, mr_v3), &g->control);
	layer_new(ctx, l, MR_FIT_LEVEL, s->node, &g->fine);
	memcpy(g->control.to, x, l->nv * sizeof *x);
	rest(g);
	MR_TRY(look(ctx, g));
	*out = g;
	return MR_OK;
}

size_t
mr_fit_crossing(const mr_fit_guard *g)
{
	size_t count = 0;

	for (size_t f = 0; f < g->s->level->nf; f++)
		count += crosses(&g->fine, f);
	return count;
}

/* Steps */

/* Moves the motions of the corners of bad control faces half the way to the means of those around them. */
static void
smooth(mr_ctx *ctx, const guard *g, mr_v3 *z)
{
	mr_mark mark = mr_mark_take(ctx);
	const mr_loop *l = g->s->level;
	mr_v3 *sum = MR_NEW_ZERO(ctx, l->nv, mr_v3);
	double *count = MR_NEW_ZERO(ctx, l->nv, double);
	bool *at = MR_NEW_ZERO(ctx, l->nv, bool);

	for (uint32_t f = 0; f < l->nf; f++) {
		const uint32_t *v = l->t[f].v;
		bool bad = is_bad_control(g, f);
		for (int k = 0; k < 3; k++) {
			sum[v[k]] = mr_add(sum[v[k]], mr_add(z[v[(k + 1) % 3]], z[v[(k + 2) % 3]]));
			count[v[k]] += 2;
			at[v[k]] |= bad;
		}
	}
	for (size_t v = 0; v < l->nv; v++)
		if (at[v])
			z[v] = mr_mul(0.5, mr_axpy(1 / count[v], sum[v], z[v]));
	mr_mark_release(ctx, mark);
}

static void
aim(guard *g, const mr_v3 *z)
{
	for (size_t v = 0; v < g->s->level->nv; v++)
		g->control.to[v] = mr_add(g->control.from[v], z[v]);
}

mr_status
mr_fit_step(mr_ctx *ctx, mr_fit_guard *g, mr_v3 *x, mr_v3 *z)
{
	const mr_loop *l = g->s->level;
	mr_guard m = { l->t, l->topo, l->nv, l->nf, HALVES, look, is_bad, g };

	aim(g, z);
	for (int i = 0; i < SMOOTHS; i++) {
		look_at_control(ctx, g);
		smooth(ctx, g, z);
		aim(g, z);
	}
	MR_TRY(mr_guarded_move(ctx, &m, g->control.from, g->control.to));
	memcpy(x, g->control.to, l->nv * sizeof *x);
	rest(g);
	return MR_OK;
}
