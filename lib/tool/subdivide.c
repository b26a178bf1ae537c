/* mr-subdivide: a finer mesh, and its layer's columns on it. */
#include "base/options.h"
#include "edit/detail.h"
#include "mesh/fold.h"
#include "mesh/normals.h"
#include "subdivide/longest.h"
#include "tool/cache.h"

/* The finer mesh, and its limit normals (NULL: not asked for). */
static void
refine(mr_ctx *ctx, const mr_mesh *m, const mr_loop *level, const mr_subdivide_opts *o, mr_mesh *out,
    const mr_v3 **normal)
{
	const mr_loop *l = &level[o->level];
	mr_domain d;
	mr_v3 *p;

	*normal = NULL;
	if (o->limit) {
		mr_domain_on(ctx, m, level, o->level, &d);
		*normal = d.normal;
		*out = d.m;
		return;
	}
	p = MR_NEW(ctx, l->nv, mr_v3);
	mr_loop_values(ctx, level, o->level, 3, (const double *)m->p, (double *)p);
	*out = (mr_mesh){ m->name, p, l->t, l->nv, l->nf };
}

/* Normals that went along from flat triangles turn with these as they become the finer surface. */
static void
turn_normals(mr_ctx *ctx, const mr_refined *r, const mr_carried *carried, size_t n)
{
	mr_v3 *vertex = NULL, *corner = NULL, *p;
	mr_mesh flat = r->fine;

	for (size_t i = 0; i < n; i++)
		if (!strcmp(carried[i].name, "normal"))
			vertex = carried[i].to;
		else if (!strcmp(carried[i].name, "corner_normal"))
			corner = carried[i].to;
	if (!vertex && !corner)
		return;
	p = MR_NEW(ctx, r->fine.nv, mr_v3);
	mr_refined_flat(ctx, r, p);
	flat.p = p;
	mr_turn_normals(ctx, &flat, r->fine.p, vertex, corner);
}

/* limit: normals of the limit surface, or NULL. */
static mr_status
put(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_refined *r, const mr_v3 *limit)
{
	mr_carried *carried;
	size_t n;

	MR_TRY(mr_refine_columns(ctx, f, layer, r, &carried, &n));
	if (r->level)
		turn_normals(ctx, r, carried, n);
	if (strcmp(layer, "mesh")) {
		mr_frame_drop(f, "mesh", NULL, 0);
	} else if (r->fine.nv > r->m.nv) {
		mr_layer_changed(f, "mesh", MR_RECONNECTED);
	}
	MR_TRY(mr_layer_put_mesh(ctx, f, "mesh", &r->fine));
	MR_TRY(mr_carried_put(ctx, f, "mesh", carried, n));
	return limit ? mr_layer_put(ctx, f, "mesh", "normal", limit, r->fine.nv) : MR_OK;
}

/* By Loop's rules. */
static mr_status
subdivide(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const mr_subdivide_opts *o, mr_cache *cache,
    mr_refined *r, const mr_v3 **limit)
{
	const mr_loop *level;

	MR_TRY(mr_level_cache_get(&cache->level, ctx, f, m, o->crease, o->level, &level));
	*r = (mr_refined){ .m = *m, .level = level, .n = o->level };
	refine(ctx, m, level, o, &r->fine, limit);
	return MR_OK;
}

/* Folds that the rules made of long thin triangles; the input's stay, in two edges a step. */
static void
look_for_folds(mr_ctx *ctx, const mr_refined *r)
{
	size_t before, after;

	if (!mr_listens(ctx))
		return;
	before = mr_count_folds(ctx, &r->m, r->level[0].topo.twin);
	after = mr_count_folds(ctx, &r->fine, r->level[r->n].topo.twin);
	if (after > before << r->n)
		mr_found(ctx, &(mr_finding){ .kind = MR_FOLDED, .layer = "mesh", .count = after - before });
}

static mr_status
subdivide_frame(
    mr_ctx *ctx, mr_frame *f, const mr_subdivide_opts *o, mr_cache *cache, mr_subdivide_result *result)
{
	static const char *const reads[] = { "control", "mesh", NULL };
	const mr_v3 *limit = NULL;
	const char *layer;
	mr_refined r;
	double seconds;
	mr_mesh m;

	MR_TRY(mr_check_number(ctx, "level", (double)o->level, 0, MR_LEVEL_MAX));
	MR_TRY(mr_check_number(ctx, "crease", o->crease, 0, 180));
	MR_TRY(mr_check_number(ctx, "longest", o->longest, 0, 1e300));
	MR_TRY(mr_layer_choose_warned(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	seconds = mr_seconds();
	if (o->longest > 0)
		MR_TRY(mr_prefix(ctx,
		    mr_divide_longest(
			ctx, &m, o->longest * (o->longest_relative ? mr_mesh_diagonal(&m) : 1), &r),
		    "%s", m.name));
	else
		MR_TRY(subdivide(ctx, f, &m, o, cache, &r, &limit));
	seconds = mr_seconds() - seconds;
	if (r.level)
		look_for_folds(ctx, &r);
	*result = (mr_subdivide_result){ r.fine.nv, r.fine.nf, seconds };
	MR_TRY(put(ctx, f, layer, &r, limit));
	if (!strcmp(layer, "control")) { /* without its heights, as was asked for */
		MR_TRY(mr_layer_followed(ctx, f, "control"));
		MR_TRY(mr_layer_followed(ctx, f, "displacement"));
	}
	return MR_OK;
}

mr_status
mr_subdivide_frame(
    mr_ctx *ctx, mr_frame *f, const mr_subdivide_opts *opts, mr_cache *cache, mr_subdivide_result *result)
{
	static const mr_subdivide_opts defaults = MR_SUBDIVIDE_DEFAULTS;
	mr_subdivide_result r;

	MR_ON_COPY(ctx, f, done, result, r,
	    subdivide_frame(ctx, &done, opts ? opts : &defaults, mr_cache_for(ctx, cache), &r));
}
