/* mr-cat -- streams one after another, or merged frame by frame.  See man/mr-cat.1. */
#include "cmd.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

static bool pack, unpack, merge;

static const cmd_opt table[] = {
	{ 'z', "pack", CMD_FLAG, &pack, 0, 0, NULL, "pack the columns, where that makes them smaller", NULL },
	{ 'u', "unpack", CMD_FLAG, &unpack, 0, 0, NULL, "unpack the columns", NULL },
	{ 0, "merge", CMD_FLAG, &merge, 0, 0, NULL, "put the layers of all FILEs into one frame", NULL },
	{ 0 },
};

/* With --merge: the FILEs behind the first, which the command layer reads and which gives the frames their
 * names. */
static struct side {
	const char *path;
	mr_reader *reader;
	mr_frame *frame; /* the last one read; NULL: none yet */
	bool ended;
} * sides;
static size_t side_count;
static uint64_t frames; /* of the first FILE so far */

static mr_status
open_side(cmd *c, const char *path, struct side *s)
{
	int fd = strcmp(path, "-") ? open(path, O_RDONLY) : STDIN_FILENO;

	s->path = path;
	if (fd < 0)
		return mr_fail(&c->ctx, MR_EIO, "%s: %s", path, strerror(errno));
	return mr_prefix(&c->ctx, mr_reader_open(&c->ctx, fd, &s->reader), "%s", path);
}

/* Takes the operands behind the first away from the command layer. */
static mr_status
open_sides(cmd *c)
{
	if (c->operand_count < 2)
		return mr_fail(&c->ctx, MR_EUSAGE, "--merge takes two FILEs or more");
	side_count = c->operand_count - 1;
	c->operand_count = 1;
	sides = MR_NEW_ZERO(&c->keep, side_count, struct side);
	if (!sides)
		return MR_EMEM;
	for (size_t i = 0; i < side_count; i++)
		MR_TRY(open_side(c, c->operands[i + 1], &sides[i]));
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

/* Reads on until the side's frame has number `number`, or is its only one. */
static mr_status
advance(cmd *c, struct side *s, uint64_t number)
{
	while (!s->ended && (!s->frame || s->frame->number < number)) {
		mr_status status = mr_reader_next(&c->ctx, s->reader, &s->frame);
		MR_TRY(mr_prefix(&c->ctx, status, "%s", s->path));
		s->ended = status == MR_END;
	}
	if (!s->frame || (s->ended && s->frame->number > 1 && s->frame->number < number))
		return mr_fail(&c->ctx, MR_ERANGE, "%s has %llu frames, fewer than the first file", s->path,
		    s->frame ? (unsigned long long)s->frame->number : 0);
	return MR_OK;
}

static mr_status
cat_frame(cmd *c, mr_frame *f)
{
	frames = f->number;
	for (size_t i = 0; i < side_count; i++) {
		struct side *s = &sides[i];
		MR_TRY(advance(c, s, f->number));
		MR_TRY(mr_prefix(&c->ctx, mr_frame_merge(&c->ctx, f, s->frame), "%s", s->path));
		f->key |= s->frame->key && s->frame->number == f->number;
	}
	return MR_OK;
}

/* The sides must have ended, too: with as many frames as the first FILE, or with one. */
static mr_status
finish(cmd *c)
{
	for (size_t i = 0; i < side_count; i++) {
		struct side *s = &sides[i];
		mr_status status = s->ended ? MR_END : mr_reader_next(&c->ctx, s->reader, &s->frame);
		MR_TRY(mr_prefix(&c->ctx, status, "%s", s->path));
		if (status == MR_OK)
			return mr_fail(&c->ctx, MR_ERANGE,
			    "%s has more frames than the %llu of the first file", s->path,
			    (unsigned long long)frames);
		mr_reader_free(s->reader);
	}
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
		.finish = finish });
}
