#include "fit/guard_limit.h"

#include "subdivide/loop_self_intersect.h"
#include "fit/guard_control.h"
#include "base/parallel.h"
#include "mesh/fold.h"

enum { GRAIN = 1024 };

/* A smaller share of a step is none. */
static const double LEAST = 1. / 16;

struct mr_fit_guard {
	const mr_fit_surface *s;
	mr_mesh fine;          /* the triangles of the finest level at their limit points */
	mr_v3 *p;              /* these */
	mr_v3 *before, *after; /* unit normals of these triangles, when the vertices came to rest and now */
	bool *crosses;         /* of each: passes through another */
	bool *bad;             /* of each control face */
	bool *crossed;         /* the same: a part of it passes through another */
	bool *moved;           /* the same: since it was looked at last */
	bool all;              /* all have */
	mr_fit_control control;
};

typedef mr_fit_guard guard;

typedef struct normals_job {
	const mr_mesh *m;
	mr_v3 *normal;
} normals_job;

static void
normals(void *arg, size_t begin, size_t end)
{
	normals_job *j = arg;

	for (size_t f = begin; f < end; f++)
		j->normal[f] = mr_unit(mr_face_cross(j->m, f));
}

static bool
face_is_bad(const guard *g, uint32_t f)
{
	const uint32_t *twin = g->s->level[MR_FIT_FINE].topo.twin;

	if (mr_dot(g->before[f], g->after[f]) < 0)
		return true;
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++) {
		uint32_t o = twin[h] == MR_NONE ? f : twin[h] / 3;
		double now = mr_dot(g->after[f], g->after[o]);
		if (now < MR_NEAR_FOLD && now < mr_dot(g->before[f], g->before[o]))
			return true;
	}
	return false;
}

static void
judge(void *arg, size_t begin, size_t end)
{
	guard *g = arg;
	size_t parts = g->fine.nf / g->s->level[0].nf;

	for (size_t f = begin; f < end; f++) {
		g->bad[f] = g->crossed[f] = false;
		for (size_t k = parts * f; k < parts * f + parts; k++) {
			g->bad[f] |= face_is_bad(g, (uint32_t)k);
			g->crossed[f] |= g->crosses[k];
		}
	}
}

/* Brings the finest level to where the control vertices are at x. */
static mr_status
refine(mr_ctx *ctx, guard *g, const mr_v3 *x)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *p = MR_NEW(ctx, g->fine.nv, mr_v3);

	if (!p)
		return MR_EMEM;
	MR_TRY(mr_loop_values(ctx, g->s->level, MR_FIT_FINE, 3, (const double *)x, (double *)p));
	mr_loop_limit(ctx, &g->s->level[MR_FIT_FINE], p, g->p, NULL);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Looks at the surface where the control vertices are at x. */
static mr_status
look(mr_ctx *ctx, guard *g, const mr_v3 *x)
{
	MR_TRY(refine(ctx, g, x));
	mr_parallel(ctx, g->fine.nf, GRAIN, normals, &(normals_job){ &g->fine, g->after });
	MR_TRY(mr_find_crossings(ctx, g->s->level, MR_FIT_FINE, g->p, g->all ? NULL : g->moved, g->crosses));
	mr_parallel(ctx, g->s->level[0].nf, GRAIN / MR_FIT_CHILDREN, judge, g);
	return MR_OK;
}

/* The vertices are where they were when it was looked at last. */
static void
rest(guard *g)
{
	mr_v3 *swap = g->before;

	g->before = g->after;
	g->after = swap;
	g->all = true;
}

mr_status
mr_fit_guard_new(mr_ctx *ctx, const mr_fit_surface *s, const mr_v3 *x, mr_fit_guard **out)
{
	const mr_loop *l = &s->level[MR_FIT_FINE];
	guard *g = MR_NEW(ctx, 1, guard);
	mr_v3 *p = MR_NEW(ctx, l->nv, mr_v3);

	if (!g || !p)
		return MR_EMEM;
	*g = (guard){ s, { s->m.name, p, l->t, l->nv, l->nf }, p, MR_NEW_ZERO(ctx, l->nf, mr_v3),
		MR_NEW(ctx, l->nf, mr_v3), MR_NEW(ctx, l->nf, bool), MR_NEW(ctx, s->level[0].nf, bool),
		MR_NEW(ctx, s->level[0].nf, bool), MR_NEW(ctx, s->level[0].nf, bool), .all = true };
	if (!g->before || !g->after || !g->crosses || !g->bad || !g->crossed || !g->moved)
		return MR_EMEM;
	MR_TRY(mr_fit_control_new(ctx, s->level, x, &g->control));
	MR_TRY(look(ctx, g, x));
	rest(g);
	*out = g;
	return MR_OK;
}

const bool *
mr_fit_crossed(const mr_fit_guard *g)
{
	return g->crossed;
}

/* Steps */

/* Lets the vertices of bad faces go no more than `most` of the way; returns whether that is less for any. */
static bool
damp(const guard *g, const mr_fit_lists *patch, double most, double *share)
{
	bool any = false;

	for (size_t f = 0; f < patch->count; f++)
		for (size_t i = patch->start[f]; g->bad[f] && i < patch->start[f + 1]; i++) {
			int v = patch->member[i];
			any |= most < share[v];
			share[v] = fmin(share[v], most);
		}
	return any;
}

/* The faces that depend on a vertex which goes elsewhere than when they were looked at. */
static void
find_moved(guard *g, const mr_fit_lists *patch, const mr_v3 *looked, const mr_v3 *to)
{
	g->all = false;
	for (size_t f = 0; f < patch->count; f++) {
		g->moved[f] = false;
		for (size_t i = patch->start[f]; i < patch->start[f + 1]; i++)
			g->moved[f] |= memcmp(&looked[patch->member[i]], &to[patch->member[i]], sizeof *to) !=
			               0;
	}
}

/* Whether a face that crosses is new: none of the vertices that it depends on is one of a face that crossed,
 * for what is tangled has to pass through itself to come apart. */
static bool
newly_crosses(const guard *g, const mr_fit_lists *patch, const bool *tangled, size_t f)
{
	for (size_t i = patch->start[f]; i < patch->start[f + 1]; i++)
		if (tangled[patch->member[i]])
			return false;
	return g->crossed[f];
}

/* The vertices that faces which cross depend on.  tangled: one a vertex, the caller's. */
static void
find_tangled(const mr_fit_lists *patch, const bool *crossed, size_t nv, bool *tangled)
{
	memset(tangled, 0, nv * sizeof *tangled);
	for (size_t f = 0; f < patch->count; f++)
		for (size_t i = patch->start[f]; crossed[f] && i < patch->start[f + 1]; i++)
			tangled[patch->member[i]] = true;
}

/* Marks the bad faces of the surface where the control vertices are at x. */
static mr_status
examine(mr_ctx *ctx, guard *g, const mr_fit_lists *patch, const mr_v3 *x, const bool *tangled)
{
	MR_TRY(look(ctx, g, x));
	for (size_t f = 0; f < patch->count; f++)
		g->bad[f] |= newly_crosses(g, patch, tangled, f);
	return MR_OK;
}

mr_status
mr_fit_step(mr_ctx *ctx, mr_fit_surface *s, mr_fit_guard *g, const mr_fit_lists *patch, mr_v3 *x, mr_v3 *z,
    size_t *damped)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = s->level[0].nv;
	mr_v3 *to = MR_NEW(ctx, nv, mr_v3), *looked = MR_NEW(ctx, nv, mr_v3);
	double *share = MR_NEW(ctx, nv, double), most = 1;
	bool *tangled = MR_NEW(ctx, nv, bool);

	if (!to || !share || !looked || !tangled)
		return MR_EMEM;
	find_tangled(patch, g->crossed, nv, tangled);
	for (size_t v = 0; v < nv; v++)
		share[v] = 1;
	MR_TRY(mr_fit_control_limit(ctx, &g->control, x, z, share, to));
	for (;;) {
		MR_TRY(examine(ctx, g, patch, to, tangled));
		memcpy(looked, to, nv * sizeof *to);
		most = most > LEAST ? most / 2 : 0;
		if (!damp(g, patch, most, share))
			break;
		MR_TRY(mr_fit_control_limit(ctx, &g->control, x, z, share, to));
		find_moved(g, patch, looked, to);
	}
	rest(g);
	mr_fit_control_rest(&g->control);
	mr_fit_surface_move(ctx, s, to);
	*damped = 0;
	for (size_t v = 0; v < nv; v++)
		*damped += share[v] < 1;
	memcpy(x, to, nv * sizeof *x);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
