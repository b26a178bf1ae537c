/* mr-import -- files of models to a stream.  See man/mr-import.1. */
#include "cmd.h"
#include "formats/model.h"

#include <unistd.h>

static mr_import_opts opts = MR_IMPORT_DEFAULTS;

static const cmd_opt table[] = {
	{ 'f', "format", CMD_TEXT, &opts.format, 0, 0, "FORMAT",
	    "read the files as this format (default: by their bytes)", NULL },
	{ 0, "points", CMD_FLAG, &opts.points, 0, 0, NULL, "leave out the faces", NULL },
	{ 0, "weld", CMD_LENGTH, CMD_LENGTH_OF(mr_import_opts, opts, weld), 0, 1e300, "auto|EPS",
	    "join vertices no further apart (default: none is joined)", NULL },
	{ 0, "repair", CMD_FLAG, &opts.repair, 0, 0, NULL, "make an oriented manifold of the faces", NULL },
	{ 0, "outward", CMD_FLAG, &opts.outward, 0, 0, NULL, "turn parts that are inside out", NULL },
	{ 0 },
};

static mr_status
check(cmd *c)
{
	bool binary;

	opts.layer = c->layer;
	opts.welds = cmd_given(c, "weld");
	MR_TRY(cmd_idle(c, "repair outward", opts.points, "with --points, which leaves no face"));
	if (c->operand_count == 0 && isatty(STDIN_FILENO))
		return mr_fail(&c->ctx, MR_EUSAGE, "stdin is a terminal: pipe a file in, or name a FILE");
	MR_TRY(cmd_layer_name(c, "--layer", c->layer));
	return mr_format_check(&c->ctx, "", opts.format, false, &binary);
}

#define FIGURE(field) CMD_FIGURE(mr_import_result, field)
static const cmd_field figures[] = { FIGURE(vertices), FIGURE(triangles), FIGURE(polygons),
	FIGURE(seam_vertices), FIGURE(crease_vertices), { 0 } };

static mr_status
import(cmd *c, const char *path)
{
	mr_import_result result;
	mr_frame *f;

	MR_TRY(mr_import(&c->ctx, path, &opts, &f, &result));
	cmd_figures(c, figures, &result);
	return cmd_send(c, f);
}

const cmd_tool cmd_this = {
	.summary = "read models from files",
	.operands = "[FILE...] [OUT.mrs]",
	.options = table,
	.prepare = check,
	.source = import,
};
