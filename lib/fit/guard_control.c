#include "fit/guard_control.h"

#include "subdivide/loop_self_intersect.h"
#include "mesh/fold.h"

enum { SMOOTHS = 3 };

/* A smaller share of a step is none. */
static const double LEAST = 1. / 16;

static void
normals(const mr_loop *l, const mr_v3 *p, mr_v3 *normal)
{
	for (size_t f = 0; f < l->nf; f++) {
		const uint32_t *v = l->t[f].v;
		normal[f] = mr_unit(mr_cross(mr_sub(p[v[1]], p[v[0]]), mr_sub(p[v[2]], p[v[0]])));
	}
}

mr_status
mr_fit_control_new(mr_ctx *ctx, const mr_loop *level, const mr_v3 *x, mr_fit_control *c)
{
	mr_fit_control r = { .level = level };

	r.seen = MR_NEW(ctx, level->nv, mr_v3);
	r.before = MR_NEW(ctx, level->nf, mr_v3);
	r.after = MR_NEW(ctx, level->nf, mr_v3);
	r.tangled = MR_NEW(ctx, level->nv, bool);
	r.crosses = MR_NEW(ctx, level->nf, bool);
	r.bad = MR_NEW(ctx, level->nf, bool);
	r.moved = MR_NEW(ctx, level->nf, bool);
	if (!r.seen || !r.before || !r.after || !r.tangled || !r.crosses || !r.bad || !r.moved)
		return MR_EMEM;
	memcpy(r.seen, x, level->nv * sizeof *x);
	normals(level, x, r.after);
	MR_TRY(mr_find_crossings(ctx, level, 0, x, NULL, r.crosses));
	mr_fit_control_rest(&r);
	*c = r;
	return MR_OK;
}

void
mr_fit_control_rest(mr_fit_control *c)
{
	mr_v3 *swap = c->before;

	c->before = c->after;
	c->after = swap;
	c->smooths = SMOOTHS;
	memset(c->tangled, 0, c->level->nv * sizeof *c->tangled);
	for (size_t f = 0; f < c->level->nf; f++)
		for (int k = 0; c->crosses[f] && k < 3; k++)
			c->tangled[c->level->t[f].v[k]] = true;
}

/* Whether the face is folded against a neighbour, more than it was. */
static bool
folds(const mr_fit_control *c, uint32_t f)
{
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++) {
		uint32_t twin = c->level->topo.twin[h], g = twin == MR_NONE ? f : twin / 3;
		double now = mr_dot(c->after[f], c->after[g]);
		if (now < MR_FOLD && now < mr_dot(c->before[f], c->before[g]))
			return true;
	}
	return false;
}

/* What is tangled has to pass through itself to come apart. */
static bool
is_tangled(const mr_fit_control *c, uint32_t f)
{
	const uint32_t *v = c->level->t[f].v;

	return c->tangled[v[0]] || c->tangled[v[1]] || c->tangled[v[2]];
}

/* Marks the bad faces with the vertices at `to`; *any: there are. */
static mr_status
look(mr_ctx *ctx, mr_fit_control *c, const mr_v3 *to, bool *any)
{
	for (size_t f = 0; f < c->level->nf; f++) {
		c->moved[f] = false;
		for (int k = 0; k < 3; k++) {
			uint32_t v = c->level->t[f].v[k];
			c->moved[f] |= mr_dist(to[v], c->seen[v]) > 0;
		}
	}
	memcpy(c->seen, to, c->level->nv * sizeof *to);
	normals(c->level, to, c->after);
	MR_TRY(mr_find_crossings(ctx, c->level, 0, to, c->moved, c->crosses));
	*any = false;
	for (uint32_t f = 0; f < c->level->nf; f++) {
		c->bad[f] = folds(c, f) || (c->crosses[f] && !is_tangled(c, f));
		*any |= c->bad[f];
	}
	return MR_OK;
}

/* The corners of bad faces.  at: of each vertex, the caller's. */
static void
find_corners(const mr_fit_control *c, bool *at)
{
	memset(at, 0, c->level->nv * sizeof *at);
	for (size_t f = 0; f < c->level->nf; f++)
		for (int k = 0; c->bad[f] && k < 3; k++)
			at[c->level->t[f].v[k]] = true;
}

/* Moves the motions of the marked vertices half the way to the means of those around them. */
static mr_status
smooth(mr_ctx *ctx, const mr_fit_control *c, const bool *at, mr_v3 *z)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *sum = MR_NEW_ZERO(ctx, c->level->nv, mr_v3);
	double *count = MR_NEW_ZERO(ctx, c->level->nv, double);

	if (!sum || !count)
		return MR_EMEM;
	for (size_t f = 0; f < c->level->nf; f++)
		for (int k = 0; k < 3; k++) {
			const uint32_t *v = c->level->t[f].v;
			sum[v[k]] = mr_add(sum[v[k]], mr_add(z[v[(k + 1) % 3]], z[v[(k + 2) % 3]]));
			count[v[k]] += 2;
		}
	for (size_t v = 0; v < c->level->nv; v++)
		if (at[v])
			z[v] = mr_mul(0.5, mr_axpy(1 / count[v], sum[v], z[v]));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static void
halve(const mr_fit_control *c, const bool *at, double *share)
{
	for (size_t v = 0; v < c->level->nv; v++)
		if (at[v])
			share[v] = share[v] > LEAST ? share[v] / 2 : 0;
}

/* Whether any of the marked vertices still moves. */
static bool
any_moves(const mr_fit_control *c, const bool *at, const double *share)
{
	for (size_t v = 0; v < c->level->nv; v++)
		if (at[v] && share[v] > 0)
			return true;
	return false;
}

mr_status
mr_fit_control_limit(mr_ctx *ctx, mr_fit_control *c, const mr_v3 *x, mr_v3 *z, double *share, mr_v3 *to)
{
	mr_mark mark = mr_mark_take(ctx);
	bool *at = MR_NEW(ctx, c->level->nv, bool), bad;

	if (!at)
		return MR_EMEM;
	for (;;) {
		for (size_t v = 0; v < c->level->nv; v++)
			to[v] = mr_axpy(share[v], z[v], x[v]);
		MR_TRY(look(ctx, c, to, &bad));
		find_corners(c, at);
		if (!bad || !any_moves(c, at, share))
			break;
		if (c->smooths-- > 0)
			MR_TRY(smooth(ctx, c, at, z));
		else
			halve(c, at, share);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
