/* mr-split -- a frame for each connected part.  See man/mr-split.1. */
#include "cmd.h"

static mr_split_opts opts;

static const cmd_opt table[] = {
	{ 'd', "distance", CMD_LENGTH, CMD_LENGTH_OF(mr_split_opts, opts, distance), 0, 1e300, "DISTANCE",
	    "connect points up to this distance; 0: four times the distance of neighbours", NULL },
	{ 'n', "least", CMD_COUNT, &opts.least, 0, 4294967295, "N",
	    "leave out parts of fewer vertices; 0: of points below a hundredth of the largest part, of a "
	    "mesh isolated vertices",
	    NULL },
	{ 0 },
};

#define FIGURE(field) CMD_FIGURE(mr_split_result, field)
static const cmd_field figures[] = { FIGURE(parts), FIGURE(largest), FIGURE(smallest), FIGURE(dropped),
	FIGURE(dropped_vertices), { 0 } };

static mr_status
split_frame(cmd *c, mr_frame *f)
{
	mr_split_result result;
	mr_frame **part;

	opts.layer = c->layer;
	MR_TRY(mr_split_frame(&c->ctx, f, &opts, &part, &result));
	cmd_figures(c, figures, &result);
	for (size_t k = 0; k < result.parts; k++)
		MR_TRY(cmd_send(c, part[k]));
	return MR_OK;
}

const cmd_tool cmd_this = {
	.summary = "make a frame of each connected part of a surface or a cloud",
	.options = table,
	.frame = split_frame,
	.sends = true,
};
