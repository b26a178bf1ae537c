/* mr-import -- files of models to a stream.  See man/mr-import.1. */
#include "cmd.h"
#include "formats/model.h"

#include <unistd.h>

static const char *format;
static bool points, repair;
static cmd_length weld = { -1, false };

static const cmd_opt table[] = {
	{ 'f', "format", CMD_TEXT, &format, 0, 0, "FORMAT",
	    "read the files as this format (default: by their bytes)", NULL },
	{ 0, "points", CMD_FLAG, &points, 0, 0, NULL, "leave out the faces", NULL },
	{ 0, "weld", CMD_LENGTH, &weld, 0, 1e300, "EPS", "join vertices no further apart; -1: none", NULL },
	{ 0, "repair", CMD_FLAG, &repair, 0, 0, NULL, "make an oriented manifold of the faces", NULL },
	{ 0 },
};

static mr_status
check(cmd *c)
{
	bool binary;

	MR_TRY(cmd_idle(c, "repair", points, "with --points, which leaves no face"));
	if (c->operand_count == 0 && isatty(STDIN_FILENO))
		return mr_fail(&c->ctx, MR_EUSAGE, "stdin is a terminal: pipe a file in, or name a FILE");
	MR_TRY(cmd_layer_name(c, "--layer", c->layer));
	return mr_format_check(&c->ctx, "", format, false, &binary);
}

static mr_status
import(cmd *c, const char *path)
{
	const char *name = mr_format_stem(&c->ctx, path);
	mr_frame *f;
	mr_model m;

	if (!name)
		return MR_EMEM;
	MR_TRY(mr_model_read(&c->ctx, path, format, &m));
	if (points)
		mr_model_to_points(&m);
	if (weld.value >= 0)
		MR_TRY(
		    mr_model_weld(&c->ctx, cmd_length_of(weld, mr_box_diagonal(mr_box_of(m.p, m.nv))), &m));
	if (repair)
		MR_TRY(mr_prefix(&c->ctx, mr_model_repair(&c->ctx, &m), "%s", path));
	MR_TRY(mr_frame_new(&c->ctx, name, &f));
	MR_TRY(mr_model_put(&c->ctx, f, c->layer, &m));
	return cmd_send(c, f);
}

static mr_status
import_all(cmd *c)
{
	return cmd_each_operand(c, import);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "read models from files",
		.operands = "[FILE...]",
		.options = table,
		.prepare = check,
		.source = import_all });
}
