/* mr-normals -- normals of points and surfaces.  See man/mr-normals.1. */
#include "cmd.h"

static mr_normals_opts opts;
static mr_v3 from;

static const cmd_opt table[] = {
	{ 'n', "neighbours", CMD_COUNT, &opts.neighbours, 0, 128, "N",
	    "nearest points that give a point's plane, itself included; 0: by the noise", NULL },
	{ 'f', "from", CMD_VECTOR, &from, 0, 0, "X,Y,Z",
	    "where the points were seen from: normals point there (default: to the column scanner, else "
	    "outward)",
	    NULL },
	{ 0, "keep", CMD_FLAG, &opts.keep, 0, 0, "", "keep present normals that fit", NULL },
	{ 0, "flip", CMD_FLAG, &opts.flip, 0, 0, "", "reverse all normals at the end", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	opts.from = cmd_given(c, "from") ? &from : NULL;
	if (opts.neighbours == 1 || opts.neighbours == 2)
		return mr_fail(&c->ctx, MR_EUSAGE, "--neighbours: %zu points show no plane", opts.neighbours);
	return MR_OK;
}

#define FIGURE(field) CMD_FIGURE(mr_normals_result, field)
static const cmd_field figures[] = { FIGURE(kept), FIGURE(estimated), FIGURE(outliers), FIGURE(agree),
	{ 0 } };

static mr_status
normals_frame(cmd *c, mr_frame *f)
{
	opts.layer = c->layer;
	return mr_normals_frame(&c->ctx, f, &opts, c->result);
}

const cmd_tool cmd_this = {
	.summary = "estimate and orient normals of points, or of a surface",
	.options = table,
	.prepare = prepare,
	.frame = normals_frame,
	.figures = figures,
};
