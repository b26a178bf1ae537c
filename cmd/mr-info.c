/* mr-info -- list the contents of a stream, and measure its surfaces.  See man/mr-info.1. */
#include "cmd.h"
#include "findings.h"
#include "measure/report.h"

static mr_report_opts opts;
static bool judge;
static unsigned long long broken_frames;
static const char *first; /* law that is broken, with its frame: in c->keep */

static const cmd_opt table[] = {
	{ 0, "json", CMD_FLAG, &opts.json, 0, 0, NULL, "one JSON object a frame, one a line", NULL },
	{ 0, "check", CMD_FLAG, &opts.check, 0, 0, NULL,
	    "check every column and the laws of the layers; exit 1 if one is broken", NULL },
	{ 0, "verdict", CMD_FLAG, &judge, 0, 0, NULL,
	    "print only good, poor: WHY or unusable: WHY for each frame, by the findings of earlier tools",
	    NULL },
	{ 0, "no-intersections", CMD_FLAG, &opts.skip_intersections, 0, 0, NULL,
	    "do not look for faces that intersect", NULL },
	{ 0 },
};

static mr_status
report_verdict(cmd *c, mr_frame *f)
{
	findings all = { 0 };
	const char *why;
	verdict v;

	MR_TRY(findings_read(&c->ctx, f, &all));
	v = findings_verdict(&all, &why);
	cmd_print(c, *why ? "%s: %s\n" : "%s\n", verdict_name(v), why);
	return MR_OK;
}

static mr_status
report(cmd *c, mr_frame *f)
{
	mr_text text = { .ctx = &c->ctx };
	const char *broken = NULL;

	if (judge)
		return report_verdict(c, f);
	opts.layer = c->layer;
	MR_TRY(mr_report_frame(&c->ctx, f, &opts, &text, &broken));
	cmd_print(c, "%s", text.s);
	if (broken && broken_frames++ == 0)
		first = mr_format(
		    &c->keep, "frame %llu (%s): %s", (unsigned long long)f->number, f->name, broken);
	return MR_OK;
}

/* All frames are reported before the sentence: the input is drained. */
static mr_status
fail_where_broken(cmd *c)
{
	if (broken_frames == 0)
		return MR_OK;
	return mr_fail(&c->ctx, MR_EFORMAT, "%s (%llu frame%s broken)", first, broken_frames,
	    broken_frames == 1 ? " is" : "s are");
}

const cmd_tool cmd_this = {
	.summary = "list the contents of a stream, and measure its surfaces",
	.options = table,
	.frame = report,
	.finish = fail_where_broken,
	.sink = true,
};
