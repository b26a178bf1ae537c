/* mr-cat -- streams one after another, merged frame by frame, or appended to each other.  See man/mr-cat.1.
 */
#include "cmd.h"
#include "mesh/append.h"

static bool pack, unpack, merge, append;

static const cmd_opt table[] = {
	{ 'z', "pack", CMD_FLAG, &pack, 0, 0, NULL, "pack the columns, where that makes them smaller", NULL },
	{ 'u', "unpack", CMD_FLAG, &unpack, 0, 0, NULL, "unpack the columns", NULL },
	{ 0, "merge", CMD_FLAG, &merge, 0, 0, NULL, "put the layers of all FILEs into one frame", NULL },
	{ 0, "append", CMD_FLAG, &append, 0, 0, NULL,
	    "make one frame of all: layers of one name become one, their rows one after another", NULL },
	{ 0 },
};

/* With --merge: the FILEs after the first, which the command layer reads and which gives the frames their
 * names. */
static mr_side *sides;
static size_t side_count;

/* With --append: the frames that came so far, in the arena that lasts. */
static mr_frame **kept;
static size_t kept_count, kept_room;

/* Takes the operands after the first away from the command layer. */
static mr_status
open_sides(cmd *c)
{
	if (c->operand_count < 2)
		return mr_fail(&c->ctx, MR_EUSAGE, "--merge takes two FILEs or more");
	side_count = c->operand_count - 1;
	c->operand_count = 1;
	sides = MR_NEW(&c->keep, side_count, mr_side);
	for (size_t i = 0; i < side_count; i++)
		MR_TRY(cmd_side(c, c->operands[i + 1], &sides[i]));
	return MR_OK;
}

static mr_status
prepare(cmd *c)
{
	if (pack && unpack)
		return mr_fail(&c->ctx, MR_EUSAGE, "-z and -u exclude each other");
	if (append && merge)
		return mr_fail(&c->ctx, MR_EUSAGE, "--append and --merge exclude each other");
	c->packing = pack ? MR_PACK : unpack ? MR_UNPACK : MR_KEEP;
	return merge ? open_sides(c) : MR_OK;
}

static mr_status
keep_frame(cmd *c, mr_frame *f)
{
	MR_RESERVE(&c->keep, kept, kept_count, 1, &kept_room);
	MR_TRY(mr_frame_keep(&c->ctx, &c->keep, f, &kept[kept_count]));
	kept_count++;
	return MR_OK;
}

static mr_status
cat_frame(cmd *c, mr_frame *f)
{
	if (append)
		return keep_frame(c, f);
	for (size_t i = 0; i < side_count; i++) {
		mr_side *s = &sides[i];
		MR_TRY(mr_side_take(&c->ctx, s, f->number));
		MR_TRY(mr_prefix(&c->ctx, mr_frame_merge(&c->ctx, f, s->frame), "%s", s->path));
		f->key |= s->frame->key && s->frame->number == f->number;
	}
	return cmd_send(c, f);
}

static mr_status
finish(cmd *c)
{
	mr_frame *all;

	if (kept_count == 0)
		return MR_OK;
	MR_TRY(mr_frames_append(&c->ctx, kept, kept_count, &all));
	return cmd_send(c, all);
}

const cmd_tool cmd_this = {
	.summary = "put streams one after another, or merge their layers or frames",
	.options = table,
	.prepare = prepare,
	.frame = cat_frame,
	.finish = finish,
	.sends = true,
	.fixed_layers = true,
};
