/* mr-crop -- keep or drop a part of a layer.  See man/mr-crop.1. */
#include "cmd.h"
#include "tool/tool.h"

static mr_selection selection = { .may_miss = true };

static mr_status
add(mr_ctx *ctx, const cmd_opt *o, const char *predicate)
{
	bool keeps = !strcmp(o->name, "keep");

	return mr_selection_add(ctx, &selection, keeps ? MR_REGION_FREE : MR_REGION_FIXED,
	    keeps ? "--keep " : "--drop ", predicate);
}

static const cmd_opt table[] = {
	{ 0, "keep", CMD_CALL, NULL, 0, 0, "P", "these vertices are kept; as the first option: they alone",
	    add },
	{ 0, "drop", CMD_CALL, NULL, 0, 0, "P", "these vertices are dropped; as the first option: they alone",
	    add },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	return selection.n ? MR_OK : mr_fail(&c->ctx, MR_EUSAGE, "nothing to do: give --keep or --drop");
}

#define FIGURE(field) CMD_FIGURE(mr_crop_result, field)
static const cmd_field figures[] = { FIGURE(vertices), FIGURE(faces), FIGURE(vertices_dropped),
	FIGURE(faces_dropped), { 0 } };

static mr_status
crop_frame(cmd *c, mr_frame *f)
{
	return mr_crop_by(&c->ctx, f, c->layer, &selection, c->result);
}

const cmd_tool cmd_this = {
	.summary = "keep or drop some vertices of a layer",
	.options = table,
	.prepare = prepare,
	.frame = crop_frame,
	.figures = figures,
};
