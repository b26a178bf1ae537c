/* mr-view -- all frames as a page for browsers.  See man/mr-view.1. */
#include "cmd.h"
#include "formats/page.h"

extern const char mr_page_html[]; /* formats/page, in one text */

static mr_page page;
static bool beside;
static const char *name;

static const cmd_opt table[] = {
	{ 0, "texture", CMD_TEXT, &page.pictures.texture, 0, 0, "FILE", "picture on surfaces", NULL },
	{ 0, "materials", CMD_TEXT, &page.pictures.materials, 0, 0, "DIR", "folder of files of materials",
	    NULL },
	{ 0, "pack", CMD_SHARE, &page.pack, 1e-7, 0.1, "SHARE",
	    "pack displaced surfaces: mean distance from their source, relative to the diagonal", NULL },
	{ 0, "title", CMD_TEXT, &page.title, 0, 0, "TEXT", "of the page (default: file and frame)", NULL },
	{ 0, "caption", CMD_TEXT, &page.caption, 0, 0, "TEXT", "a sentence below the title", NULL },
	{ 0, "name", CMD_TEXT, &name, 0, 0, "NAME", "of the stream, in lines for the shell", NULL },
	{ 0, "beside", CMD_FLAG, &beside, 0, 0, NULL, "models after the first in files beside the page",
	    NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	MR_TRY(cmd_output_name(c, "PAGE.html", ".html"));
	MR_TRY(cmd_idle(c, "materials", page.pictures.texture != NULL, "with --texture"));
	page.pictures.keep = &c->keep;
	page.beside = beside ? c->operands[0] : NULL;
	if (beside && !strcmp(page.beside, "-"))
		return mr_fail(&c->ctx, MR_EUSAGE, "--beside wants a page with a name");
	return MR_OK;
}

static mr_status
view_frame(cmd *c, mr_frame *f)
{
	page.from = name ? name : c->file;
	return mr_page_add(&c->ctx, &page, f, c->layer);
}

static mr_status
finish(cmd *c)
{
	MR_TRY(mr_page_write(&c->ctx, &page, mr_page_html, c->operands[0], &c->held));
	mr_page_free(&page);
	return MR_OK;
}

const cmd_tool cmd_this = {
	.summary = "write all frames as a page for browsers",
	.operands = "PAGE.html [FILE...]",
	.options = table,
	.prepare = prepare,
	.frame = view_frame,
	.finish = finish,
	.sink = true,
	.names_output = true,
};
