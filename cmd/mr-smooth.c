/* mr-smooth -- low-pass filter a mesh into its base surface.  See man/mr-smooth.1. */
#include "cmd.h"

static mr_smooth_opts opts = MR_SMOOTH_DEFAULTS;

static const cmd_opt table[] = {
	{ 'm', "method", CMD_CHOICE, &opts.method, 0, 0, "implicit|taubin", "how to smooth", NULL },
	{ 't', "time", CMD_REAL, &opts.time, 0, 1e9, "TIME", "diffusion time, in squared mean edge lengths",
	    NULL },
	{ 'n', "passes", CMD_COUNT, &opts.passes, 0, 1e6, "N",
	    "passes; 0: 1 of implicit, of taubin 8 for each unit of time", NULL },
	{ 0, "plain", CMD_FLAG, &opts.plain, 0, 0, "", "smooth thin parts for the same time, too", NULL },
	{ 0 },
};

#define FIGURE(field) CMD_FIGURE(mr_smooth_result, field)
static const cmd_field figures[] = { FIGURE(passes), FIGURE(bounded), FIGURE(iterations), FIGURE(area),
	FIGURE(volume), { 0 } };

static mr_status
smooth_frame(cmd *c, mr_frame *f)
{
	opts.layer = c->layer;
	return mr_smooth_frame(&c->ctx, f, &opts, c->result);
}

const cmd_tool cmd_this = {
	.summary = "low-pass filter a mesh into its base surface",
	.options = table,
	.frame = smooth_frame,
	.figures = figures,
};
