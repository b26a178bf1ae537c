/* mr-shrinkwrap -- draw a mesh tight around points.  See man/mr-shrinkwrap.1. */
#include "cmd.h"

static mr_wrap_opts opts = MR_WRAP_DEFAULTS;

static const cmd_opt table[] = {
	{ 'm', "method", CMD_CHOICE, &opts.method, 0, 0, "auto|cube|volume", "how to begin", NULL },
	{ 0, "lids", CMD_CHOICE, &opts.lids, 0, 0, "auto|all|none", "openings of the points to close", NULL },
	{ 'r', "resolution", CMD_COUNT, &opts.resolution, 0, 10000, "EDGES",
	    "edges of the wrap, so many along a side of the bounding cube; 0: by the points", NULL },
	{ 0, "grid", CMD_COUNT, &opts.grid, 0, 4096, "N",
	    "cells along the longest side of the volume; 0: by the density of the points", NULL },
	{ 0, "alpha", CMD_SHARE, &opts.alpha, 0, 1, "A", "share of the way to the nearest point", NULL },
	{ 0, "lambda", CMD_SHARE, &opts.lambda, 0, 1, "L", "of tangential smoothing", NULL },
	{ 'n', "iterations", CMD_COUNT, &opts.iterations, 0, 1e6, "N",
	    "of projection and smoothing; 0: as the method needs", NULL },
	{ 0, "ignore-normals", CMD_FLAG, &opts.ignore_normals, 0, 0, "",
	    "ignore normals and the scanner's places", NULL },
	{ 0, "template", CMD_FLAG, &opts.template_mesh, 0, 0, "", "wrap the mesh that is in control", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	MR_TRY(cmd_idle(c, "grid lids ignore-normals", opts.method == MR_WRAP_CUBE, "on -m cube"));
	if (opts.template_mesh &&
	    (opts.grid || opts.resolution || opts.lids || opts.ignore_normals || opts.method != MR_WRAP_AUTO))
		return mr_fail(&c->ctx, MR_EUSAGE,
		    "--template wraps the mesh that is there: -m, -r, --grid, --lids and --ignore-normals "
		    "have no effect");
	return MR_OK;
}

#define FIGURE(field) CMD_FIGURE(mr_wrap_result, field)
static const cmd_field figures[] = { FIGURE(method), FIGURE(places), FIGURE(outliers), FIGURE(sampling),
	FIGURE(resolution), FIGURE(iterations), FIGURE(faces), FIGURE(folded_edges),
	FIGURE(intersecting_pairs), FIGURE(unreached), FIGURE(openings), FIGURE(holes), { 0 } };

#undef FIGURE
#define FIGURE(field) CMD_FIGURE(mr_volume_result, field)
static const cmd_field volume_figures[] = { FIGURE(samples), FIGURE(sided), FIGURE(spacing), FIGURE(cell),
	FIGURE(noise), FIGURE(euler), { 0 } };

static mr_status
shrinkwrap_frame(cmd *c, mr_frame *f)
{
	mr_wrap_result result;

	opts.layer = c->layer;
	MR_TRY(mr_shrinkwrap_frame(&c->ctx, f, &opts, &result));
	cmd_figures(c, figures, &result);
	cmd_gaps(c, &result.gaps);
	cmd_figures(c, volume_figures, &result.volume);
	return MR_OK;
}

const cmd_tool cmd_this = {
	.summary = "draw a mesh tight around points",
	.options = table,
	.prepare = prepare,
	.frame = shrinkwrap_frame,
};
