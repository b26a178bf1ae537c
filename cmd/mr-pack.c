/* mr-pack -- a displaced subdivision surface in few bytes.  See man/mr-pack.1. */
#include "cmd.h"
#include "formats/bytes.h"
#include "formats/filename.h"

#include <unistd.h>

static mr_pack_opts opts = MR_PACK_DEFAULTS;
static mr_string_set given;

static const cmd_opt table[] = {
	{ 'e', "error", CMD_SHARE, &opts.error, 1e-7, 0.1, "SHARE",
	    "mean distance from its source, relative to the diagonal (default 0.01%)", NULL },
	{ 'n', "bytes", CMD_COUNT, &opts.bytes, 1, 1e15, "N", "at most so many bytes", NULL },
	{ 0 },
};

static mr_status
check(cmd *c)
{
	char *name;

	if (cmd_given(c, "bytes") && !cmd_given(c, "error"))
		opts.error = 0;
	MR_TRY(cmd_output_name(c, "OUT", ".mrz"));
	if (!strcmp(c->operands[0], "-") && isatty(STDOUT_FILENO))
		return mr_fail(&c->ctx, MR_EUSAGE, "a packed surface is binary and stdout is a terminal");
	return mr_outname(&c->ctx, c->operands[0], "", 1, &name);
}

#define FIGURE(field) CMD_FIGURE(mr_pack_result, field)
static const cmd_field figures[] = { FIGURE(bytes), FIGURE(control_bytes), FIGURE(level), FIGURE(vertices),
	FIGURE(error), FIGURE(error_max), { 0 } };

/* Writes the file, which waits for the end of the stream where its name does not vary. */
static mr_status
write_file(cmd *c, const char *path, const void *byte, size_t size, bool varies)
{
	mr_sink s;

	MR_TRY(mr_sink_open(&c->ctx, path, false, &s));
	s.hold = !varies;
	mr_put(&s, byte, size);
	MR_TRY(mr_sink_close(&s, MR_OK));
	if (!varies)
		c->held = s.file;
	return MR_OK;
}

static mr_status
pack(cmd *c, mr_frame *f)
{
	const char *out = c->operands[0];
	mr_pack_result result;
	const void *byte;
	size_t size;
	char *path;

	MR_TRY(mr_pack_frame(&c->ctx, f, &opts, &byte, &size, &result));
	cmd_figures(c, figures, &result);
	MR_TRY(mr_outname_once(&c->ctx, &given, out, f->name, f->number, &path));
	return write_file(c, path, byte, size, mr_outname_varies(out));
}

const cmd_tool cmd_this = {
	.summary = "write a displaced subdivision surface in few bytes",
	.operands = "[FILE...] OUT",
	.options = table,
	.prepare = check,
	.frame = pack,
	.sink = true,
	.names_output = true,
	.fixed_layers = true,
};
