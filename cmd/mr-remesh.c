/* mr-remesh -- remesh a surface isotropically with equal vertex areas.  See man/mr-remesh.1. */
#include "remesh/remesh.h"
#include "cmd.h"
#include "mesh/layers.h"

static mr_remesh_opts opts = MR_REMESH_DEFAULTS;
static cmd_length length, adaptive;

static const cmd_opt table[] = {
	{ 'L', "length", CMD_LENGTH, &length, 0, 1e300, "LENGTH", "target edge length; 0: by --ratio", NULL },
	{ 'r', "ratio", CMD_REAL, &opts.ratio, 1e-6, 1e6, "RATIO",
	    "target edge length, in edges of the equilateral triangle of mean area", NULL },
	{ 'n', "rounds", CMD_COUNT, &opts.rounds, 0, 1000, "N", "rounds of split, collapse, flip, relocate",
	    NULL },
	{ 'a', "area-passes", CMD_COUNT, &opts.area_passes, 0, 1000, "N", "passes of area-based smoothing",
	    NULL },
	{ 0, "gravity", CMD_REAL, &opts.gravity, 0, 4, "E",
	    "exponent of the vertex area in the centroid; 1: the paper's", NULL },
	{ 0, "feature", CMD_REAL, &opts.feature, 0, 180, "DEGREES",
	    "keep edges whose faces meet at more; 180: none", NULL },
	{ 0, "adaptive", CMD_LENGTH, &adaptive, 0, 1e300, "DISTANCE",
	    "lengths by curvature: how far an edge may be from the surface; 0: uniform", NULL },
	{ 0, "no-project", CMD_OFF, &opts.project, 0, 0, "", "let the vertices leave the surface", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	MR_TRY(cmd_idle(c, "ratio", length.value > 0, "with --length"));
	return cmd_idle(c, "gravity", opts.area_passes == 0, "without area passes");
}

static mr_status
remesh_frame(cmd *c, mr_frame *f)
{
	static const char *const reads[] = { "base", "mesh", NULL };
	const char *layer;
	mr_mesh m, out;
	mr_source_map over, map;
	bool mapped;

	MR_TRY(mr_layer_choose(&c->ctx, f, c->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(&c->ctx, f, layer, &m));
	opts.length = cmd_length_of(length, mr_mesh_diagonal(&m));
	opts.adaptive = cmd_length_of(adaptive, mr_mesh_diagonal(&m));
	MR_TRY(mr_remesh(&c->ctx, &m, &opts, &out, &over));
	MR_TRY(mr_source_map_follow(&c->ctx, f, &m, &over, out.nv, &map, &mapped));
	MR_TRY(mr_layer_put_mesh(&c->ctx, f, "base", &out));
	return mapped ? mr_source_map_put(&c->ctx, f, &map, out.nv) : MR_OK;
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "remesh a surface isotropically, with equal vertex areas",
		.options = table,
		.prepare = prepare,
		.frame = remesh_frame,
		.lean = true });
}
