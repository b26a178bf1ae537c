/* mr-transform -- move, turn, scale whole frames.  See man/mr-transform.1. */
#include "cmd.h"
#include "edit/transform.h"

static mr_transform transform;

static mr_status
add(mr_ctx *ctx, const cmd_opt *o, const char *text)
{
	return mr_transform_add(ctx, &transform, o->name, text);
}

static const cmd_opt table[] = {
	{ 't', "translate", CMD_CALL, NULL, 0, 0, "X,Y,Z", "move it", add },
	{ 'r', "rotate", CMD_CALL, NULL, 0, 0, "AX,AY,AZ,DEG",
	    "turn it about this axis through the origin, by DEG degrees", add },
	{ 's', "scale", CMD_CALL, NULL, 0, 0, "S|SX,SY,SZ", "scale it about the origin", add },
	{ 'm', "matrix", CMD_CALL, NULL, 0, 0, "FILE|NUMBERS",
	    "map it by this affine map: 12 or 16 numbers, row by row", add },
	{ 'u', "up", CMD_CALL, NULL, 0, 0, "FROM:TO", "turn one axis to another: y:z makes z up where y was",
	    add },
	{ 'c', "center", CMD_CALL, NULL, 0, 0, NULL, "move the middle of its bounding box to the origin",
	    add },
	{ 'U', "unit", CMD_CALL, NULL, 0, 0, NULL,
	    "the same, and scale it so that the longest side of the box is 1", add },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	return transform.n ? MR_OK : mr_fail(&c->ctx, MR_EUSAGE, "nothing to do: give a transformation");
}

/* How the frame is mapped, row by row. */
static void
tell(cmd *c, const mr_affine *map)
{
	for (int i = 0; i < 12; i++)
		cmd_figure(c, mr_format(&c->ctx, "m%d%d", i / 4 + 1, i % 4 + 1), map->m[i]);
}

/* The frames of a sequence are mapped as their key frame is, by its box, so the film stays a film. */
static mr_status
transform_frame(cmd *c, mr_frame *f)
{
	static mr_affine map;

	if (f->key)
		MR_TRY(mr_transform_map(&c->ctx, f, c->layer, &transform, &map));
	tell(c, &map);
	return mr_transform_frame(&c->ctx, f, c->layer, map.m);
}

const cmd_tool cmd_this = {
	.summary = "move, turn and scale a whole frame",
	.options = table,
	.prepare = prepare,
	.frame = transform_frame,
};
