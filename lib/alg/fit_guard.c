#include "alg/fit_guard.h"

#include "alg/crossing.h"
#include "base/parallel.h"

enum { GRAIN = 1024 };

/* Neighbours beyond 150 degrees count as folding where they come closer than they were. */
static const double SHARPEST = -0.866;

/* A smaller share of a step is none. */
static const double LEAST = 1. / 16;

typedef struct guard {
	const mr_fit_surface *s;
	mr_v3 *before, *after; /* unit normals of the faces of level 2 */
	bool *bad;             /* of each control face */
	bool *crosses;         /* the same: passes through another */
} guard;

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
	const uint32_t *twin = g->s->level[MR_FIT_LEVEL].topo.twin;

	if (mr_dot(g->before[f], g->after[f]) < 0)
		return true;
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++) {
		uint32_t o = twin[h] == MR_NONE ? f : twin[h] / 3;
		double now = mr_dot(g->after[f], g->after[o]);
		if (now < SHARPEST && now < mr_dot(g->before[f], g->before[o]))
			return true;
	}
	return false;
}

static void
judge(void *arg, size_t begin, size_t end)
{
	guard *g = arg;

	for (size_t f = begin; f < end; f++) {
		g->bad[f] = false;
		for (uint32_t k = 0; k < MR_FIT_CHILDREN && !g->bad[f]; k++)
			g->bad[f] = face_is_bad(g, (uint32_t)(MR_FIT_CHILDREN * f) + k);
	}
}

mr_status
mr_fit_crossings(mr_ctx *ctx, const mr_fit_surface *s, const mr_v3 *x, bool *crosses)
{
	mr_mark mark = mr_mark_take(ctx);
	const mr_loop *l = &s->level[MR_FIT_FINE];
	mr_v3 *p = MR_NEW(ctx, l->nv, mr_v3), *limit = MR_NEW(ctx, l->nv, mr_v3);
	bool *fine = MR_NEW(ctx, l->nf, bool);
	size_t parts = l->nf / s->level[0].nf;

	if (!p || !limit || !fine)
		return MR_EMEM;
	MR_TRY(mr_loop_values(ctx, s->level, MR_FIT_FINE, 3, (const double *)x, (double *)p));
	mr_loop_limit(ctx, l, p, limit, NULL);
	MR_TRY(mr_find_crossings(ctx, s->level, MR_FIT_FINE, limit, fine));
	memset(crosses, 0, s->level[0].nf * sizeof *crosses);
	for (size_t f = 0; f < l->nf; f++)
		crosses[f / parts] |= fine[f];
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Steps */

/* Lets the vertices of bad faces go no more than `most` of the way; returns whether that is less for any. */
static bool
damp(const guard *g, const mr_fit_lists *patch, double most, double *share)
{
	bool less = false;

	for (size_t f = 0; f < patch->count; f++)
		for (size_t i = patch->start[f]; g->bad[f] && i < patch->start[f + 1]; i++) {
			double *v = &share[patch->member[i]];
			less |= most < *v;
			*v = fmin(*v, most);
		}
	return less;
}

/* Whether a face that crosses is new: none of the vertices that it depends on is one of a face that crossed,
 * for what is tangled has to pass through itself to come apart. */
static bool
newly_crosses(const guard *g, const mr_fit_lists *patch, const bool *tangled, size_t f)
{
	for (size_t i = patch->start[f]; i < patch->start[f + 1]; i++)
		if (tangled[patch->member[i]])
			return false;
	return g->crosses[f];
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

/* Marks the bad faces of the surface as it is now. */
static mr_status
examine(mr_ctx *ctx, guard *g, const mr_fit_lists *patch, const mr_v3 *x, const bool *tangled)
{
	const mr_fit_surface *s = g->s;
	size_t nf = s->level[0].nf;

	mr_parallel(ctx, s->m.nf, GRAIN, normals, &(normals_job){ &s->m, g->after });
	mr_parallel(ctx, nf, GRAIN / MR_FIT_CHILDREN, judge, g);
	MR_TRY(mr_fit_crossings(ctx, s, x, g->crosses));
	for (size_t f = 0; f < nf; f++)
		g->bad[f] |= newly_crosses(g, patch, tangled, f);
	return MR_OK;
}

static mr_status
prepare(mr_ctx *ctx, const mr_fit_surface *s, guard *g)
{
	*g = (guard){ s, MR_NEW(ctx, s->m.nf, mr_v3), MR_NEW(ctx, s->m.nf, mr_v3),
		MR_NEW(ctx, s->level[0].nf, bool), MR_NEW(ctx, s->level[0].nf, bool) };
	if (!g->before || !g->after || !g->bad || !g->crosses)
		return MR_EMEM;
	mr_parallel(ctx, s->m.nf, GRAIN, normals, &(normals_job){ &s->m, g->before });
	return MR_OK;
}

mr_status
mr_fit_step(mr_ctx *ctx, mr_fit_surface *s, const mr_fit_lists *patch, bool *crossed, mr_v3 *x,
    const mr_v3 *z, size_t *damped)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = s->level[0].nv;
	mr_v3 *to = MR_NEW(ctx, nv, mr_v3);
	double *share = MR_NEW(ctx, nv, double), most = 1;
	bool *tangled = MR_NEW(ctx, nv, bool);
	guard g;

	if (!to || !share || !tangled)
		return MR_EMEM;
	find_tangled(patch, crossed, nv, tangled);
	for (size_t v = 0; v < nv; v++)
		share[v] = 1;
	MR_TRY(prepare(ctx, s, &g));
	do {
		for (size_t v = 0; v < nv; v++)
			to[v] = mr_axpy(share[v], z[v], x[v]);
		mr_fit_surface_move(ctx, s, to);
		MR_TRY(examine(ctx, &g, patch, to, tangled));
		most = most > LEAST ? most / 2 : 0;
	} while (damp(&g, patch, most, share));
	*damped = 0;
	for (size_t v = 0; v < nv; v++)
		*damped += share[v] < 1;
	memcpy(x, to, nv * sizeof *x);
	memcpy(crossed, g.crosses, patch->count * sizeof *crossed);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
