/* mr-subdivide: a finer mesh, and its layer's columns on it. */
#include "subdivide/columns.h"
#include "tool/cache.h"

/* The finer mesh, and its limit normals (NULL: not asked for). */
static mr_status
refine(mr_ctx *ctx, const mr_mesh *m, const mr_loop *level, const mr_subdivide_opts *o, mr_mesh *out,
    const mr_v3 **normal)
{
	const mr_loop *l = &level[o->level];
	mr_domain d;
	mr_v3 *p;

	*normal = NULL;
	if (o->limit) {
		MR_TRY(mr_domain_on(ctx, m, level, o->level, &d));
		*normal = d.normal;
		*out = d.m;
		return MR_OK;
	}
	p = MR_NEW(ctx, l->nv, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_loop_values(ctx, level, o->level, 3, (const double *)m->p, (double *)p));
	*out = (mr_mesh){ m->name, p, l->t, l->nv, l->nf };
	return MR_OK;
}

static mr_status
put(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_mesh *m, const mr_v3 *normal,
    const mr_carried *carried)
{
	const mr_column *groups = mr_frame_find(f, layer, "groups");
	const void *names = NULL;
	size_t size = 0;

	if (groups)
		MR_TRY(mr_layer_get(ctx, f, layer, "groups", &names, &size));
	if (strcmp(layer, "mesh"))
		mr_frame_drop(f, "mesh", NULL, 0);
	MR_TRY(mr_layer_put_mesh(ctx, f, "mesh", m));
	if (normal)
		MR_TRY(mr_layer_put(ctx, f, "mesh", "normal", normal, m->nv));
	for (size_t i = 0; i < MR_CARRIED; i++)
		if (carried[i].data)
			MR_TRY(
			    mr_layer_put(ctx, f, "mesh", carried[i].name, carried[i].data, carried[i].rows));
	return groups ? mr_layer_put(ctx, f, "mesh", "groups", names, size) : MR_OK;
}

mr_status
mr_subdivide_frame(
    mr_ctx *ctx, mr_frame *f, const mr_subdivide_opts *opts, mr_cache *cache, mr_subdivide_result *result)
{
	static const mr_subdivide_opts defaults = MR_SUBDIVIDE_DEFAULTS;
	static const char *const reads[] = { "control", "mesh", NULL };
	const mr_subdivide_opts *o = opts ? opts : &defaults;
	mr_carried carried[MR_CARRIED];
	const mr_loop *level;
	const mr_v3 *normal;
	const char *layer;
	mr_mesh m, out;
	double start;

	MR_TRY(mr_layer_choose(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	start = mr_seconds();
	MR_TRY(mr_cache_levels(ctx, cache, f, &m, o->crease, o->level, &level));
	MR_TRY(refine(ctx, &m, level, o, &out, &normal));
	if (result)
		*result = (mr_subdivide_result){ out.nv, out.nf, mr_seconds() - start };
	MR_TRY(mr_subdivide_columns(ctx, f, layer, level, o->level, carried));
	return put(ctx, f, layer, &out, normal, carried);
}
