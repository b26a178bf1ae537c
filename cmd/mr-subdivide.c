/* mr-subdivide -- refine a mesh by Loop subdivision.  See man/mr-subdivide.1. */
#include "cmd.h"

static mr_subdivide_opts opts = MR_SUBDIVIDE_DEFAULTS;

static const cmd_opt table[] = {
	{ 'n', "level", CMD_COUNT, &opts.level, 0, MR_LEVEL_MAX, "LEVEL",
	    "how many times each triangle becomes four", NULL },
	{ 0, "limit", CMD_FLAG, &opts.limit, 0, 0, "", "move the vertices onto the limit surface", NULL },
	{ 0, "crease", CMD_REAL, &opts.crease, 0, 180, "DEGREES",
	    "keep edges whose faces meet at more; 180: none", NULL },
	{ 0, "longest", CMD_LENGTH, CMD_LENGTH_OF(mr_subdivide_opts, opts, longest), 0, 1e300, "LENGTH",
	    "instead, divide longer edges without moving the surface; 0: no", NULL },
	{ 0 },
};

#define FIGURE(field) CMD_FIGURE(mr_subdivide_result, field)
static const cmd_field figures[] = { CMD_FIGURE_AS("seconds_subdivide", mr_subdivide_result, seconds),
	FIGURE(vertices), FIGURE(faces), { 0 } };

static mr_status
check(cmd *c)
{
	return cmd_idle(
	    c, "level limit crease", opts.longest > 0, "beside --longest, which leaves the surface as it is");
}

static mr_status
subdivide_frame(cmd *c, mr_frame *f)
{
	opts.layer = c->layer;
	return mr_subdivide_frame(&c->ctx, f, &opts, c->cache, c->result);
}

const cmd_tool cmd_this = {
	.summary = "refine a mesh by Loop subdivision",
	.options = table,
	.prepare = check,
	.frame = subdivide_frame,
	.figures = figures,
	.caches = true,
};
