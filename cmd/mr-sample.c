/* mr-sample -- sample the displacement of a subdivision surface to points or a mesh.  See man/mr-sample.1. */
#include "sample/sample.h"
#include "cmd.h"

static mr_sample_opts opts = MR_SAMPLE_DEFAULTS;
static const char *level_text;
static size_t level;

static const cmd_opt table[] = {
	{ 'n', "level", CMD_TEXT, &level_text, 0, 0, "LEVEL",
	    "subdivisions of the control mesh (default: as many vertices as points, at least 1)", NULL },
	{ 'm', "method", CMD_CHOICE, &opts.method, 0, 0, "triangle|robust", "how to find the heights", NULL },
	{ 'K', "neighbours", CMD_COUNT, &opts.neighbours, 3, MR_SAMPLE_MOST, "K",
	    "nearest points looked at for each vertex", NULL },
	{ 0, "refine", CMD_COUNT, &opts.refine, 0, 100, "N",
	    "passes that fit the heights to the points; 0: the paper's heights", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (!level_text)
		return MR_OK;
	return cmd_parse_count(&c->ctx, "--level", level_text, 0, MR_LEVEL_MAX, &level);
}

/* Options that look for heights in points alone. */
static mr_status
check_mesh_options(cmd *c)
{
	MR_TRY(cmd_idle(c, "method", true, "on a mesh: its triangles are met"));
	return cmd_idle(c, "neighbours", true, "on a mesh: its triangles are met");
}

/* The layer to sample: points, or else the mesh, as its points alone where it has no faces. */
static mr_status
get_target(cmd *c, mr_frame *f, mr_mesh *target)
{
	static const char *const reads[] = { "points", "mesh", NULL };
	const char *layer;

	MR_TRY(mr_layer_choose(&c->ctx, f, c->layer, reads, &layer));
	if (!strcmp(layer, "points"))
		return mr_layer_points(&c->ctx, f, layer, target);
	return mr_layer_surface_or_points(&c->ctx, f, layer, target);
}

static mr_status
sample_frame(cmd *c, mr_frame *f)
{
	mr_ctx *ctx = &c->ctx;
	mr_mesh control, target;
	mr_domain d;
	double *height;
	size_t n = level;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	MR_TRY(get_target(c, f, &target));
	if (target.nf)
		MR_TRY(check_mesh_options(c));
	if (!level_text) {
		MR_TRY(mr_domain_level(ctx, &control, target.nv, &n));
		n = n ? n : 1; /* the triangles of level 0 are far from the surface that was fitted */
	}
	MR_TRY(mr_domain_build(ctx, &control, n, &d));
	height = MR_NEW(ctx, d.m.nv, double);
	if (!height)
		return MR_EMEM;
	if (target.nf)
		MR_TRY(mr_sample_mesh(ctx, &d, &target, &opts, height));
	else
		MR_TRY(mr_sample_points(ctx, &d, target.p, target.nv, &opts, height));
	mr_stat_set(ctx, "level", (double)n);
	mr_stat_set(ctx, "vertices", (double)d.m.nv);
	return mr_displacement_put(ctx, f, &d, height);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "sample the displacement of a subdivision surface to points or a mesh",
		.options = table,
		.prepare = prepare,
		.frame = sample_frame });
}
