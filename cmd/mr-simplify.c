/* mr-simplify -- simplify a surface by quadric error metrics.  See man/mr-simplify.1. */
#include "cmd.h"
#include "mesh/layers.h"

static mr_simplify_opts opts = MR_SIMPLIFY_DEFAULTS;
static const char *lock;

static const cmd_opt table[] = {
	{ 'n', "faces", CMD_COUNT, &opts.faces, 0, 4e9, "N", "stop at so many; 0: no such limit", NULL },
	{ 'r', "ratio", CMD_SHARE, &opts.ratio, 0, 1, "RATIO", "stop at this share; 0: no such limit", NULL },
	{ 'e', "error", CMD_LENGTH, CMD_LENGTH_OF(mr_simplify_opts, opts, error), 0, 1e300, "LENGTH",
	    "largest distance to the planes of merged faces; 0: no such limit", NULL },
	{ 0, "boundary", CMD_REAL, &opts.boundary, 0, 1e6, "WEIGHT", "weight of boundary edges", NULL },
	{ 0, "attributes", CMD_REAL, &opts.attributes, 0, 1e6, "WEIGHT",
	    "weight of texture coordinates and colours beside distances", NULL },
	{ 0, "lock", CMD_TEXT, &lock, 0, 0, "WHAT", "vertices that stay: boundary, seams or region:N", NULL },
	{ 0, "creases", CMD_FLAG, &opts.creases, 0, 0, NULL,
	    "keep the sharp edges that points or a mesh show, or say why not", NULL },
	{ 0, "smooth", CMD_FLAG, &opts.smooth, 0, 0, NULL, "keep no sharp edges", NULL },
	{ 't', "to", CMD_TEXT, &opts.to, 0, 0, "LAYER", "write the result as that layer; the surface stays",
	    NULL },
	{ 0 },
};

#define FIGURE(field) CMD_FIGURE(mr_simplify_result, field)
static const cmd_field figures[] = { FIGURE(merges), FIGURE(error), FIGURE(vertices), FIGURE(faces),
	FIGURE(creases), { 0 } };

static mr_status
read_lock(mr_ctx *ctx)
{
	if (!lock)
		return MR_OK;
	if (!strncmp(lock, "region:", 7)) {
		opts.lock = MR_LOCK_REGION;
		return cmd_parse_count(
		    ctx, "--lock region", lock + 7, 0, MR_REGION_HANDLE + 65535, &opts.region);
	}
	opts.lock = !strcmp(lock, "boundary") ? MR_LOCK_BOUNDARY
	            : !strcmp(lock, "seams")  ? MR_LOCK_SEAMS
	                                      : MR_LOCK_NONE;
	return opts.lock ? MR_OK
	                 : mr_fail(ctx, MR_EUSAGE, "--lock: %s is none of boundary, seams, region:N", lock);
}

static mr_status
prepare(cmd *c)
{
	MR_TRY(read_lock(&c->ctx));
	MR_TRY(cmd_layer_name(c, "--to", opts.to));
	if (opts.to && mr_layer_no_surface(opts.to)) /* by convention, which other tools go by */
		return mr_fail(&c->ctx, MR_EUSAGE, "--to: layer %s holds no surface", opts.to);
	MR_TRY(
	    cmd_idle(c, "creases smooth", opts.to && strcmp(opts.to, "control"), "with --to another layer"));
	MR_TRY(cmd_idle(c, "smooth", opts.creases, "with --creases"));
	return cmd_idle(c, "ratio", opts.faces > 0, "with --faces");
}

static mr_status
simplify_frame(cmd *c, mr_frame *f)
{
	opts.layer = c->layer;
	return mr_simplify_frame(&c->ctx, f, &opts, c->result);
}

const cmd_tool cmd_this = {
	.summary = "simplify a surface by quadric error metrics",
	.options = table,
	.prepare = prepare,
	.frame = simplify_frame,
	.figures = figures,
	.judged = true,
};
