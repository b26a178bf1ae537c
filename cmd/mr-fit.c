/* mr-fit -- move a control mesh so that its limit surface comes close to points.  See man/mr-fit.1. */
#include "cmd.h"

static mr_fit_opts opts = MR_FIT_DEFAULTS;

static const cmd_opt table[] = {
	{ 'm', "method", CMD_CHOICE, &opts.method, 0, 0, "local|least-squares", "how to fit", NULL },
	{ 'n', "iterations", CMD_COUNT, &opts.iterations, 0, 1e6, "ITER",
	    "how many; 0: 20 of local, 5 of least-squares", NULL },
	{ 0, "step", CMD_SHARE, &opts.step, 0, 1, "SHARE", "of the force taken in an iteration of local",
	    NULL },
	{ 0, "fairness", CMD_REAL, &opts.fairness, 0, 1e6, "WEIGHT", "of smoothness in least-squares", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	MR_TRY(cmd_idle(c, "step", opts.method != MR_FIT_LOCAL, "without -m local"));
	return cmd_idle(c, "fairness", opts.method == MR_FIT_LOCAL, "with -m local");
}

#define FIGURE(field) CMD_FIGURE(mr_fit_result, field)
static const cmd_field figures[] = { FIGURE(iterations), FIGURE(outliers), FIGURE(distance_mean_before),
	FIGURE(distance_rms_before), FIGURE(distance_max_before), FIGURE(distance_mean_after),
	FIGURE(distance_rms_after), FIGURE(distance_max_after), FIGURE(folded_edges_before),
	FIGURE(folded_edges_after), FIGURE(crossing_faces), { 0 } };

static mr_status
fit_frame(cmd *c, mr_frame *f)
{
	opts.layer = c->layer;
	return mr_fit_frame(&c->ctx, f, &opts, c->result);
}

const cmd_tool cmd_this = {
	.summary = "move a control mesh so that its limit surface comes close to points",
	.options = table,
	.prepare = prepare,
	.frame = fit_frame,
	.figures = figures,
};
