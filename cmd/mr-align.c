/* mr-align -- move each frame onto another by a rigid motion.  See man/mr-align.1. */
#include "cmd.h"
#include "formats/filename.h"

#include <unistd.h>

static mr_align_opts opts = MR_ALIGN_DEFAULTS;
static const char *matrix;
static mr_string_set given;
static mr_side reference;

static const cmd_opt table[] = {
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

/* The key frame of a sequence is aligned; the frames after it are moved as it was, so the film stays a film.
 */
static mr_status
align_frame(cmd *c, mr_frame *f)
{
	static mr_align_result r;

	opts.layer = c->layer;
	MR_TRY(mr_side_take(&c->ctx, &reference, f->number));
	if (!f->key)
		return r.found ? mr_transform_frame(&c->ctx, f, c->layer, r.map) : MR_OK;
	MR_TRY(mr_align_frame(&c->ctx, f, reference.frame, &opts, &r));
	cmd_figures(c, figures, &r);
	return matrix ? write_matrix(c, f, r.map) : MR_OK;
}

const cmd_tool cmd_this = {
	.summary = "move a surface or cloud onto another",
	.operands = "[FILE] REFERENCE",
	.options = table,
	.prepare = open_reference,
	.frame = align_frame,
};
