/* mr-shrinkwrap -- draw a closed mesh tight around points.  See man/mr-shrinkwrap.1. */
#include "wrap/shrinkwrap.h"
#include "cmd.h"
#include "mesh/layers.h"

static mr_wrap_opts opts = MR_WRAP_DEFAULTS;
static bool template;

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
	{ 0, "template", CMD_FLAG, &template, 0, 0, "", "wrap the mesh that is in control", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (opts.grid && opts.method == MR_WRAP_CUBE)
		return mr_fail(&c->ctx, MR_EUSAGE, "--grid has no effect on -m cube");
	if (template && (opts.grid || opts.resolution || opts.method != MR_WRAP_AUTO))
		return mr_fail(&c->ctx, MR_EUSAGE,
		    "--template wraps the mesh that is there: -m, -r and --grid have no effect");
	return MR_OK;
}

/* The triangles stay, and with them all that the layer has but what followed from the positions; the heights
 * were over the surface as it was. */
static mr_status
wrap_control(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_mesh *points)
{
	mr_mesh control;
	mr_v3 *p;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	p = MR_NEW(ctx, control.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_prefix(ctx, mr_wrap_template(ctx, points->p, points->nv, &control, &opts, p), "%s", layer));
	return mr_layer_move(ctx, f, "control", MR_RESHAPED, p, control.nv);
}

static mr_status
shrinkwrap_frame(cmd *c, mr_frame *f)
{
	static const char *const reads[] = { "points", NULL };
	const char *layer;
	mr_mesh points, out;

	MR_TRY(mr_layer_choose(&c->ctx, f, c->layer, reads, &layer));
	MR_TRY(mr_layer_points(&c->ctx, f, layer, &points));
	if (template)
		return wrap_control(&c->ctx, f, layer, &points);
	MR_TRY(mr_prefix(&c->ctx, mr_shrinkwrap(&c->ctx, points.p, points.nv, &opts, &out), "%s", layer));
	return mr_layer_put_mesh(&c->ctx, f, "control", &out);
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
