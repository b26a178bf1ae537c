/* mr-shrinkwrap -- draw a closed mesh tight around points.  See man/mr-shrinkwrap.1. */
#include "cmd.h"

static mr_wrap_opts opts = MR_WRAP_DEFAULTS;

static const cmd_opt table[] = {
	{ 'm', "method", CMD_CHOICE, &opts.method, 0, 0, "auto|cube|volume", "how to begin", NULL },
	{ 'r', "resolution", CMD_COUNT, &opts.resolution, 0, 10000, "EDGES",
	    "edges of the wrap, so many along a side of the bounding cube; 0: by the points", NULL },
	{ 0, "grid", CMD_COUNT, &opts.grid, 0, 4096, "N",
	    "cells along the longest side of the volume; 0: by the density of the points", NULL },
	{ 0, "alpha", CMD_REAL, &opts.alpha, 0, 1, "A", "share of the way to the nearest point", NULL },
	{ 0, "lambda", CMD_REAL, &opts.lambda, 0, 1, "L", "of tangential smoothing", NULL },
	{ 'n', "iterations", CMD_COUNT, &opts.iterations, 0, 1e6, "N",
	    "of projection and smoothing; 0: as the method needs", NULL },
	{ 0, "template", CMD_FLAG, &opts.template_mesh, 0, 0, "", "wrap the mesh that is in control", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (opts.grid && opts.method == MR_WRAP_CUBE)
		return mr_fail(&c->ctx, MR_EUSAGE, "--grid has no effect on -m cube");
	if (opts.template_mesh && (opts.grid || opts.resolution || opts.method != MR_WRAP_AUTO))
		return mr_fail(&c->ctx, MR_EUSAGE,
		    "--template wraps the mesh that is there: -m, -r and --grid have no effect");
	return MR_OK;
}

static mr_status
shrinkwrap_frame(cmd *c, mr_frame *f)
{
	opts.layer = c->layer;
	return mr_shrinkwrap_frame(&c->ctx, f, &opts);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "draw a closed mesh tight around points",
		.options = table,
		.prepare = prepare,
		.frame = shrinkwrap_frame });
}
