/* mr-cat -- streams one after another, or merged frame by frame.  See man/mr-cat.1. */
#include "cmd.h"
#include "stream/side_stream.h"

static bool pack, unpack, merge;

static const cmd_opt table[] = {
	{ 'z', "pack", CMD_FLAG, &pack, 0, 0, NULL, "pack the columns, where that makes them smaller", NULL },
	{ 'u', "unpack", CMD_FLAG, &unpack, 0, 0, NULL, "unpack the columns", NULL },
	{ 0, "merge", CMD_FLAG, &merge, 0, 0, NULL, "put the layers of all FILEs into one frame", NULL },
	{ 0 },
};

/* With --merge: the FILEs behind the first, which the command layer reads and which gives the frames their
 * names. */
static mr_side *sides;
static size_t side_count;

/* Takes the operands behind the first away from the command layer. */
static mr_status
open_sides(cmd *c)
{
	if (c->operand_count < 2)
		return mr_fail(&c->ctx, MR_EUSAGE, "--merge takes two FILEs or more");
	side_count = c->operand_count - 1;
	c->operand_count = 1;
	sides = MR_NEW(&c->keep, side_count, mr_side);
	if (!sides)
		return MR_EMEM;
	for (size_t i = 0; i < side_count; i++)
		MR_TRY(mr_side_open(&c->ctx, c->operands[i + 1], &sides[i]));
	return MR_OK;
}

static mr_status
prepare(cmd *c)
{
	if (pack && unpack)
		return mr_fail(&c->ctx, MR_EUSAGE, "-z and -u exclude each other");
	c->packing = pack ? MR_PACK : unpack ? MR_UNPACK : MR_KEEP;
	return merge ? open_sides(c) : MR_OK;
}

static mr_status
cat_frame(cmd *c, mr_frame *f)
{
	for (size_t i = 0; i < side_count; i++) {
		mr_side *s = &sides[i];
		MR_TRY(mr_side_take(&c->ctx, s, f->number));
		MR_TRY(mr_prefix(&c->ctx, mr_frame_merge(&c->ctx, f, s->frame), "%s", s->path));
		f->key |= s->frame->key && s->frame->number == f->number;
	}
	return MR_OK;
}

static mr_status
finish(cmd *c)
{
	for (size_t i = 0; i < side_count; i++)
		MR_TRY(mr_side_end(&c->ctx, &sides[i], c->frame));
	return MR_OK;
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "put streams one after another, or merge their layers",
		.options = table,
		.prepare = prepare,
		.frame = cat_frame,
		.finish = finish,
		.fixed_layers = true });
}
