/* mr-smooth -- low-pass filter a mesh into its base surface.  See man/mr-smooth.1. */
#include "edit/smooth.h"
#include "space/source_map.h"
#include "cmd.h"

static mr_smooth_opts opts = MR_SMOOTH_DEFAULTS;

static const cmd_opt table[] = {
	{ 'm', "method", CMD_CHOICE, &opts.method, 0, 0, "implicit|explicit|taubin", "how to smooth", NULL },
	{ 't', "time", CMD_REAL, &opts.time, 0, 1e9, "TIME", "in all, in squared mean edge lengths", NULL },
	{ 'n', "passes", CMD_COUNT, &opts.passes, 0, 1e6, "N",
	    "passes; 0: 1 of implicit, of the others 8 for each unit of time", NULL },
	{ 0 },
};

static mr_status
smooth_frame(cmd *c, mr_frame *f)
{
	static const char *const reads[] = { "base", "mesh", NULL };
	mr_ctx *ctx = &c->ctx;
	mr_source_map map;
	const char *layer;
	bool from_mesh;
	mr_mesh m;
	mr_v3 *p;

	MR_TRY(mr_layer_choose(ctx, f, c->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	from_mesh = !strcmp(layer, "mesh");
	if (from_mesh)
		MR_TRY(mr_source_map_identity(ctx, &m, &map));
	p = MR_NEW(ctx, m.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_smooth(ctx, &m, &opts, p));
	m.p = p;
	MR_TRY(mr_layer_put_mesh(ctx, f, "base", &m));
	return from_mesh ? mr_source_map_put(ctx, f, &map, m.nv) : MR_OK;
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "low-pass filter a mesh into its base surface",
		.options = table,
		.frame = smooth_frame });
}
