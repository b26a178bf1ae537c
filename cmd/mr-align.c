/* mr-align -- move each frame onto another, or all into one frame of reference.  See man/mr-align.1. */
#include "cmd.h"
#include "formats/filename.h"

#include <unistd.h>

static mr_align_opts opts = MR_ALIGN_DEFAULTS;
static const char *matrix;
static mr_string_set given;
static mr_side reference;
static bool all;

/* With --all: the frames so far, in the arena that lasts, and the motions of key frames. */
static mr_frame **kept;
static size_t kept_count, kept_room;

static const cmd_opt table[] = {
	{ 0, "all", CMD_FLAG, &all, 0, 0, NULL, "bring all frames into one frame of reference", NULL },
	{ 0, "scale", CMD_FLAG, &opts.scale, 0, 0, NULL, "let it grow or shrink, too", NULL },
	{ 0, "from", CMD_TEXT, &opts.from, 0, 0, "LAYER",
	    "layer of both that is matched (default: the one worked on last)", NULL },
	{ 'm', "matrix", CMD_TEXT, &matrix, 0, 0, "FILE", "write the motion as text, for mr-transform -m",
	    NULL },
	{ 0 },
};

static mr_status
open_reference(cmd *c)
{
	MR_TRY(cmd_layer_name(c, "--from", opts.from));
	MR_TRY(cmd_idle(c, "scale", all, "with --all"));
	c->keeps = all;
	if (all && c->operand_count > 1)
		return mr_fail(&c->ctx, MR_EUSAGE, "--all reads one FILE, not %zu: mr-cat joins several",
		    c->operand_count);
	if (all)
		return c->operand_count ? cmd_input(c, c->operands[0]) : MR_OK;
	if (c->operand_count < 1 || c->operand_count > 2)
		return mr_fail(
		    &c->ctx, MR_EUSAGE, "a REFERENCE is expected, not %zu files", c->operand_count);
	if (c->operand_count == 2)
		MR_TRY(cmd_input(c, c->operands[0]));
	return cmd_side(c, c->operands[c->operand_count - 1], &reference);
}

#define FIGURE(field) CMD_FIGURE(mr_align_result, field)
static const cmd_field figures[] = { FIGURE(scale), FIGURE(overlap), FIGURE(residual), FIGURE(score),
	FIGURE(second), { 0 } };

static mr_status
write_matrix(cmd *c, const mr_frame *f, const double m[12])
{
	mr_outfile file;
	char *path, *text;

	MR_TRY(mr_outname_once(&c->ctx, &given, matrix, f->name, f->number, &path));
	text = mr_format(&c->ctx,
	    "%.17g %.17g %.17g %.17g\n%.17g %.17g %.17g %.17g\n%.17g %.17g %.17g %.17g\n0 0 0 1\n", m[0],
	    m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11]);
	MR_TRY(mr_outfile_open(&c->ctx, path, &file));
	if (write(file.fd, text, strlen(text)) != (ssize_t)strlen(text))
		return mr_fail(&c->ctx, MR_EIO, "%s", path);
	return mr_outfile_keep(&c->ctx, &file);
}

static mr_status
keep_frame(cmd *c, mr_frame *f)
{
	MR_RESERVE(&c->keep, kept, kept_count, 1, &kept_room);
	MR_TRY(mr_frame_keep(&c->ctx, &c->keep, f, &kept[kept_count]));
	kept[kept_count]->key = f->key;
	kept[kept_count++]->number = f->number;
	return MR_OK;
}

/* The key frame of a sequence is aligned; the frames after it are moved as it was, so the film stays a film.
 */
static mr_status
align_frame(cmd *c, mr_frame *f)
{
	static mr_align_result r;

	opts.layer = c->layer;
	if (all)
		return keep_frame(c, f);
	MR_TRY(mr_side_take(&c->ctx, &reference, f->number));
	if (!f->key)
		return r.found ? mr_transform_frame(&c->ctx, f, c->layer, r.map) : MR_OK;
	MR_TRY(mr_align_frame(&c->ctx, f, reference.frame, &opts, &r));
	cmd_figures(c, figures, &r);
	return matrix ? write_matrix(c, f, r.map) : MR_OK;
}

static const mr_align_result *motion; /* of the next key frame */

static mr_status
move_frame(cmd *c, mr_frame *f)
{
	if (!f->key)
		return motion[-1].found ? mr_transform_frame(&c->ctx, f, c->layer, motion[-1].map) : MR_OK;
	cmd_figures(c, figures, motion);
	MR_TRY(mr_align_put(&c->ctx, f, &opts, motion));
	return matrix ? write_matrix(c, f, motion++->map) : (motion++, MR_OK);
}

/* All frames were read: their motions, and each is moved and sent. */
static mr_status
finish(cmd *c)
{
	mr_align_result *r = MR_NEW(&c->keep, kept_count, mr_align_result);
	mr_frame **key = MR_NEW(&c->keep, kept_count, mr_frame *);
	size_t keys = 0;

	for (size_t i = 0; i < kept_count; i++)
		if (kept[i]->key)
			key[keys++] = kept[i];
	MR_TRY(mr_align_frames(&c->ctx, key, keys, &opts, r));
	motion = r;
	for (size_t i = 0; i < kept_count; i++)
		MR_TRY(cmd_send_kept(c, kept[i], move_frame));
	return MR_OK;
}

const cmd_tool cmd_this = {
	.summary = "move a surface or cloud onto another",
	.operands = "[FILE] REFERENCE | --all [FILE]",
	.options = table,
	.prepare = open_reference,
	.frame = align_frame,
	.finish = finish,
};
