/* mr-equalize -- weigh the levels of a displacement against each other.  See man/mr-equalize.1. */
#include "cmd.h"

static const char *gains_text;
static double gain[MR_LEVEL_MAX + 1];
static size_t gains;

static const cmd_opt table[] = {
	{ 'g', "gain", CMD_TEXT, &gains_text, 0, 0, "G0,G1,...",
	    "factors of the control mesh's heights and of each level's, coarse first (default 1)", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (!gains_text)
		return MR_OK;
	gains = 1;
	for (const char *s = gains_text; *s; s++)
		gains += *s == ',';
	if (gains > MR_LEVEL_MAX + 1)
		return mr_fail(&c->ctx, MR_EUSAGE,
		    "--gain: %zu factors, but there are at most %d levels and one", gains, MR_LEVEL_MAX);
	return cmd_parse_reals(&c->ctx, "--gain", gains_text, gains, gain);
}

static mr_status
equalize_frame(cmd *c, mr_frame *f)
{
	return mr_equalize_frame(&c->ctx, f, gain, gains, c->cache);
}

const cmd_tool cmd_this = {
	.summary = "weigh the levels of a displacement against each other",
	.options = table,
	.prepare = prepare,
	.frame = equalize_frame,
	.caches = true,
	.fixed_layers = true,
};
