/* mr-select -- choose which vertices are fixed, free, or in a handle.  See man/mr-select.1. */
#include "base/text_file.h"
#include "cmd.h"
#include "tool/tool.h"

static mr_select_opts opts = MR_SELECT_DEFAULTS;
static mr_selection selection;

static mr_status
add(mr_ctx *ctx, const cmd_opt *o, const char *predicate)
{
	bool frees = !strcmp(o->name, "free");

	return mr_selection_add(ctx, &selection, frees ? MR_REGION_FREE : MR_REGION_FIXED,
	    frees ? "--free " : "--fixed ", predicate);
}

static mr_status
add_handle(mr_ctx *ctx, const cmd_opt *o, const char *text)
{
	const char *at = text;
	uint64_t handle;
	char *option;

	(void)o;
	if (!mr_whole(&at, 65535, &handle) || *at++ != '=')
		return mr_fail(
		    ctx, MR_EUSAGE, "'%s' is not a handle from 0 to 65535, = and a predicate", text);
	option = mr_format(ctx, "--handle %u=", (unsigned)handle);
	return mr_selection_add(ctx, &selection, MR_REGION_HANDLE + (uint32_t)handle, option, at);
}

static mr_status
add_file(mr_ctx *ctx, const cmd_opt *o, const char *path)
{
	(void)o;
	return mr_selection_add_file(ctx, &selection, "--from ", path);
}

static const cmd_opt table[] = {
	{ 0, "reset", CMD_FLAG, &opts.reset, 0, 0, NULL,
	    "begin with all vertices fixed (default: with the regions there are)", NULL },
	{ 0, "free", CMD_CALL, NULL, 0, 0, "P", "these vertices are free", add },
	{ 0, "fixed", CMD_CALL, NULL, 0, 0, "P", "these vertices are fixed", add },
	{ 0, "handle", CMD_CALL, NULL, 0, 0, "N=P", "these vertices are handle N", add_handle },
	{ 0, "from", CMD_CALL, NULL, 0, 0, "FILE",
	    "these vertices are what FILE says, as mr-view's page saves it", add_file },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (selection.n || opts.reset)
		return MR_OK;
	return mr_fail(
	    &c->ctx, MR_EUSAGE, "nothing to select: give --free, --fixed, --handle, --from or --reset");
}

#define FIGURE(field) CMD_FIGURE(mr_select_result, field)
static const cmd_field figures[] = { FIGURE(fixed), FIGURE(free), FIGURE(handles), { 0 } };

/* The vertices of each of the first handles, too. */
static void
count_handles(cmd *c, const mr_select_result *result)
{
	enum { SHOWN = 64 };

	for (size_t h = 0; h < SHOWN && h < result->handle_count; h++)
		if (result->handle[h])
			cmd_figure(c, mr_format(&c->ctx, "handle_%zu", h), (double)result->handle[h]);
}

static mr_status
select_frame(cmd *c, mr_frame *f)
{
	mr_select_result result;

	opts.layer = c->layer;
	MR_TRY(mr_select_by(&c->ctx, f, &selection, &opts, &result));
	cmd_figures(c, figures, &result);
	count_handles(c, &result);
	return MR_OK;
}

const cmd_tool cmd_this = {
	.summary = "choose which vertices are fixed, free, or in a handle",
	.options = table,
	.prepare = prepare,
	.frame = select_frame,
};
