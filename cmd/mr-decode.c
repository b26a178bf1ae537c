/* mr-decode -- put detail back onto its base surface, and heights onto a subdivision surface.  See
 * man/mr-decode.1. */
#include "cmd.h"

static mr_decode_opts opts = MR_DECODE_DEFAULTS;
static int from;
static bool blind;

static const cmd_opt table[] = {
	{ 'g', "gain", CMD_SHARE, &opts.gain, -1e6, 1e6, "G", "multiply the detail by G", NULL },
	{ 0, "level", CMD_COUNT, &opts.level, 0, MR_LEVEL_MAX, "J",
	    "subdivisions of the control mesh (default: as many as have heights)", NULL },
	{ 0, "from", CMD_CHOICE, &from, 0, 0, "detail|control",
	    "what to rebuild the mesh from (default: the layer worked on last)", NULL },
	{ 0, "mend", CMD_CHOICE, &opts.mend, 0, 0, "keys|all|none",
	    "frames to mend where detail folds or meets itself: of a sequence the first, all, none", NULL },
	{ 0, "no-check", CMD_FLAG, &blind, 0, 0, "", "do not look for folds and intersections", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (cmd_given(c, "from"))
		opts.from = MR_FROM_DETAIL + from;
	c->no_check = blind;
	return cmd_idle(c, "level", opts.from == MR_FROM_DETAIL, "with --from detail");
}

static mr_status
decode_frame(cmd *c, mr_frame *f)
{
	return mr_decode_frame(&c->ctx, f, &opts, c->cache);
}

const cmd_tool cmd_this = {
	.summary = "put detail or heights back onto their smooth surface",
	.options = table,
	.prepare = prepare,
	.frame = decode_frame,
	.caches = true,
	.judged = true,
	.fixed_layers = true,
};
