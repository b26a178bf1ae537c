/* mr-fill -- fill the holes of a surface smoothly.  See man/mr-fill.1. */
#include "cmd.h"

static mr_fill_opts opts = MR_FILL_DEFAULTS;

static const cmd_opt table[] = {
	{ 0, "max-length", CMD_LENGTH, CMD_LENGTH_OF(mr_fill_opts, opts, max_length), 0, 1e300, "LENGTH",
	    "leave longer loops open; 0: only the rims of open surfaces", NULL },
	{ 0, "loops", CMD_COUNT, &opts.loops, 0, 4e9, "N", "fill the N shortest; 0: all", NULL },
	{ 'k', "order", CMD_COUNT, &opts.order, 1, 3, "1|2|3",
	    "membrane, thin plate, least change of curvature", NULL },
	{ 0 },
};

#define FIGURE(field) CMD_FIGURE(mr_fill_result, field)
static const cmd_field figures[] = { FIGURE(loops), FIGURE(filled), FIGURE(crossing), FIGURE(vertices),
	FIGURE(faces), { 0 } };

static mr_status
fill_frame(cmd *c, mr_frame *f)
{
	opts.layer = c->layer;
	return mr_fill_frame(&c->ctx, f, &opts, c->result);
}

const cmd_tool cmd_this = {
	.summary = "fill the holes of a surface smoothly",
	.options = table,
	.frame = fill_frame,
	.figures = figures,
};
