/* mr-unpack -- packed surfaces to a stream.  See man/mr-unpack.1. */
#include "cmd.h"
#include "formats/bytes.h"

#include <unistd.h>

static mr_unpack_opts opts = MR_UNPACK_DEFAULTS;
static bool each;

static const cmd_opt table[] = {
	{ 'n', "bytes", CMD_COUNT, &opts.bytes, 1, 1e15, "N", "read the first N bytes alone", NULL },
	{ 0, "level", CMD_COUNT, &opts.level, 0, MR_LEVEL_MAX, "J", "up to level J (default: the finest)",
	    NULL },
	{ 0, "each", CMD_FLAG, &each, 0, 0, NULL, "a frame for each level, the coarsest first", NULL },
	{ 0 },
};

static mr_status
check(cmd *c)
{
	if (c->operand_count == 0 && isatty(STDIN_FILENO))
		return mr_fail(&c->ctx, MR_EUSAGE, "stdin is a terminal: pipe a file in, or name a FILE");
	return MR_OK;
}

#define FIGURE(field) CMD_FIGURE(mr_unpack_result, field)
static const cmd_field figures[] = { FIGURE(bytes), FIGURE(level), FIGURE(finest), FIGURE(vertices), { 0 } };

/* One level of the file; *finest: which is the last. */
static mr_status
send_level(cmd *c, const mr_file_bytes *file, size_t level, size_t *finest)
{
	mr_unpack_opts o = opts;
	mr_unpack_result result;
	mr_frame *f;

	o.level = level;
	MR_TRY(mr_unpack_frame(&c->ctx, file->data, file->size, &o, &f, &result));
	*finest = result.finest;
	cmd_figures(c, figures, &result);
	return cmd_send(c, f);
}

static mr_status
send_levels(cmd *c, const mr_file_bytes *file)
{
	size_t finest = opts.level;

	if (!each)
		return send_level(c, file, opts.level, &finest);
	for (size_t j = 0; j == 0 || (j <= finest && j <= opts.level); j++)
		MR_TRY(send_level(c, file, j, &finest));
	return MR_OK;
}

static mr_status
unpack(cmd *c, const char *path)
{
	mr_file_bytes file = { 0 };

	MR_TRY(mr_file_bytes_read(&c->ctx, path, &file));
	return mr_file_bytes_end(&file, mr_prefix(&c->ctx, send_levels(c, &file), "%s", path));
}

const cmd_tool cmd_this = {
	.summary = "read packed surfaces",
	.operands = "[FILE...] [OUT.mrs]",
	.options = table,
	.prepare = check,
	.source = unpack,
	.fixed_layers = true,
};
