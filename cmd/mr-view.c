/* mr-view -- all frames as a page for browsers.  See man/mr-view.1. */
#include "cmd.h"
#include "formats/outname.h"
#include "formats/page.h"

#include <unistd.h>

extern const char mr_page_html[]; /* formats/page, in one text */

static mr_page page;

static const cmd_opt table[] = {
	{ 0, "intersections", CMD_FLAG, &page.intersections, 0, 0, NULL,
	    "look for faces that intersect, to mark them", NULL },
	{ 0 },
};

static const cmd_field figures[] = {
	CMD_COUNTED(mr_page_result, layers),
	CMD_COUNTED(mr_page_result, columns),
	CMD_COUNTED(mr_page_result, left_out),
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (c->operand_count != 1)
		return mr_fail(&c->ctx, MR_EUSAGE, "one PAGE.html is expected, not %zu%s", c->operand_count,
		    c->operand_count ? ": the stream to read is -i FILE or stdin" : "");
	if (!mr_outname_suits(c->operands[0], ".html"))
		return mr_fail(&c->ctx, MR_EUSAGE, "%s does not end in .html: the stream to read is -i FILE",
		    c->operands[0]);
	if (!strcmp(c->operands[0], "-") && isatty(STDOUT_FILENO))
		return mr_fail(&c->ctx, MR_EUSAGE, "a page is not written to a terminal");
	return MR_OK;
}

static mr_status
view_frame(cmd *c, mr_frame *f)
{
	mr_page_result result;

	MR_TRY(mr_page_add(&c->ctx, &page, f, c->layer, &result));
	cmd_figures(c, figures, &result);
	return MR_OK;
}

static mr_status
finish(cmd *c)
{
	mr_outfile held = { 0 };

	if (page.frames == 0)
		return mr_fail(&c->ctx, MR_EMISSING, "the stream has no frame to show");
	MR_TRY(mr_page_write(&c->ctx, &page, mr_page_html, c->operands[0], &held));
	cmd_hold(c, &held);
	mr_page_free(&page);
	return MR_OK;
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "write all frames as a page for browsers",
		.operands = "PAGE.html",
		.options = table,
		.prepare = prepare,
		.frame = view_frame,
		.finish = finish,
		.sink = true,
		.names_output = true });
}
