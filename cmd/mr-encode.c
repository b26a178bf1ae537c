/* mr-encode -- store a mesh as detail over its base surface.  See man/mr-encode.1. */
#include "cmd.h"

#define FIGURE(field) CMD_FIGURE(mr_encode_result, field)
static const cmd_field figures[] = { FIGURE(heights), FIGURE(offsets), FIGURE(residual_max),
	FIGURE(height_max), { 0 } };

static mr_status
encode_frame(cmd *c, mr_frame *f)
{
	return mr_encode_frame(&c->ctx, f, c->result);
}

const cmd_tool cmd_this = {
	.summary = "store a mesh as detail over its base surface",
	.frame = encode_frame,
	.figures = figures,
	.fixed_layers = true,
};
