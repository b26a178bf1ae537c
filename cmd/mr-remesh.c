/* mr-remesh -- remesh a surface isotropically with equal vertex areas.  See man/mr-remesh.1. */
#include "cmd.h"

static mr_remesh_opts opts = MR_REMESH_DEFAULTS;

static const cmd_opt table[] = {
	{ 'L', "length", CMD_LENGTH, CMD_LENGTH_OF(mr_remesh_opts, opts, length), 0, 1e300, "LENGTH",
	    "target edge length; 0: by --ratio", NULL },
	{ 'r', "ratio", CMD_SHARE, &opts.ratio, 1e-6, 1e6, "RATIO",
	    "target edge length, in edges of the equilateral triangle of mean area", NULL },
	{ 'n', "rounds", CMD_COUNT, &opts.rounds, 0, 1000, "N", "rounds of split, collapse, flip, relocate",
	    NULL },
	{ 'a', "area-passes", CMD_COUNT, &opts.area_passes, 0, 1000, "N", "passes of area-based smoothing",
	    NULL },
	{ 0, "gravity", CMD_REAL, &opts.gravity, 0, 4, "E",
	    "exponent of the vertex area in the centroid; 1: the paper's", NULL },
	{ 0, "vertices", CMD_COUNT, &opts.vertices, 0, 1e9, "N",
	    "choose the length to give about so many; 0: do not", NULL },
	{ 0, "faces", CMD_COUNT, &opts.faces, 0, 2e9, "N",
	    "choose the length to give about so many; 0: do not", NULL },
	{ 0, "feature", CMD_REAL, &opts.feature, 0, 180, "auto|DEGREES",
	    "keep edges whose faces meet at more; 180: none", NULL },
	{ 0, "adaptive", CMD_LENGTH, CMD_LENGTH_OF(mr_remesh_opts, opts, adaptive), 0, 1e300, "DISTANCE",
	    "lengths by curvature: how far an edge may be from the surface; 0: uniform", NULL },
	{ 0, "no-project", CMD_OFF, &opts.project, 0, 0, "", "let the vertices leave the surface", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	MR_TRY(cmd_idle(c, "ratio", opts.length > 0, "with --length"));
	MR_TRY(cmd_idle(c, "vertices", opts.faces > 0, "with --faces"));
	MR_TRY(cmd_idle(c, "length ratio", opts.faces + opts.vertices > 0, "with --vertices or --faces"));
	if (opts.feature < 0)
		opts.feature = 40; /* between the facets of round things and the edges of machined ones */
	return cmd_idle(c, "gravity", opts.area_passes == 0, "without area passes");
}

#define FIGURE(field) CMD_FIGURE(mr_remesh_result, field)
static const cmd_field figures[] = { FIGURE(length), FIGURE(splits), FIGURE(collapses), FIGURE(flips),
	FIGURE(vertices), FIGURE(faces), FIGURE(area_variance_before), FIGURE(area_variance_after),
	FIGURE(flipped), FIGURE(folded), { 0 } };

static mr_status
remesh_frame(cmd *c, mr_frame *f)
{
	opts.layer = c->layer;
	return mr_remesh_frame(&c->ctx, f, &opts, c->result);
}

const cmd_tool cmd_this = {
	.summary = "remesh a surface isotropically, with equal vertex areas",
	.options = table,
	.prepare = prepare,
	.frame = remesh_frame,
	.figures = figures,
	.judged = true,
};
