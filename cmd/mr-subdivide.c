/* mr-subdivide -- refine a mesh by Loop subdivision.  See man/mr-subdivide.1. */
#include "subdivide/displaced.h"
#include "subdivide/columns.h"
#include "cmd.h"

static size_t levels = 1;
static bool limit;
static double crease = 180;

static const cmd_opt table[] = {
	{ 'n', "level", CMD_COUNT, &levels, 0, MR_LEVEL_MAX, "LEVEL",
	    "how many times each triangle becomes four", NULL },
	{ 0, "limit", CMD_FLAG, &limit, 0, 0, "", "move the vertices onto the limit surface", NULL },
	{ 0, "crease", CMD_REAL, &crease, 0, 180, "DEGREES", "keep edges whose faces meet at more; 180: none",
	    NULL },
	{ 0 },
};

static mr_level_cache kept;

/* The finer mesh, and its limit normals (NULL: not asked for). */
static mr_status
refine(mr_ctx *ctx, const mr_mesh *m, const mr_loop *level, mr_mesh *out, const mr_v3 **normal)
{
	const mr_loop *l = &level[levels];
	mr_domain d;
	mr_v3 *p;

	*normal = NULL;
	if (limit) {
		MR_TRY(mr_domain_on(ctx, m, level, levels, &d));
		*normal = d.normal;
		*out = d.m;
		return MR_OK;
	}
	p = MR_NEW(ctx, l->nv, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_loop_values(ctx, level, levels, 3, (const double *)m->p, (double *)p));
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

static mr_status
subdivide_frame(cmd *c, mr_frame *f)
{
	static const char *const reads[] = { "control", "mesh", NULL };
	mr_carried carried[MR_CARRIED];
	const mr_loop *level;
	const mr_v3 *normal;
	const char *layer;
	mr_mesh m, out;
	double start;

	MR_TRY(mr_layer_choose(&c->ctx, f, c->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(&c->ctx, f, layer, &m));
	start = mr_seconds();
	MR_TRY(mr_level_cache_get(&kept, &c->keep, f, &m, crease, levels, &level));
	MR_TRY(refine(&c->ctx, &m, level, &out, &normal));
	mr_stat_set(&c->ctx, "seconds", mr_seconds() - start);
	mr_stat_set(&c->ctx, "vertices", (double)out.nv);
	mr_stat_set(&c->ctx, "faces", (double)out.nf);
	MR_TRY(mr_subdivide_columns(&c->ctx, f, layer, level, levels, carried));
	return put(&c->ctx, f, layer, &out, normal, carried);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){
		.summary = "refine a mesh by Loop subdivision", .options = table, .frame = subdivide_frame });
}
