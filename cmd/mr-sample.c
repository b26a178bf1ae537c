/* mr-sample -- sample the displacement of a subdivision surface to points or a mesh.  See man/mr-sample.1. */
#include "cmd.h"
#include "sample/sample.h"
#include "tool/tool.h"

static mr_sample_opts opts = MR_SAMPLE_DEFAULTS;

static const cmd_opt table[] = {
	{ 'n', "level", CMD_COUNT, &opts.level, 0, MR_LEVEL_MAX, "LEVEL",
	    "subdivisions of the control mesh (default: as many vertices as points, at least 1)", NULL },
	{ 'm', "method", CMD_CHOICE, &opts.method, 0, 0, "auto|triangle|robust", "how to find the heights",
	    NULL },
	{ 'K', "neighbours", CMD_COUNT, &opts.neighbours, 3, MR_SAMPLE_MOST, "K",
	    "nearest points looked at for each vertex", NULL },
	{ 0, "refine", CMD_COUNT, &opts.refine, 0, 100, "N",
	    "passes that fit the heights to the points; 0: the paper's heights", NULL },
	{ 0 },
};

#define FIGURE(field) CMD_FIGURE(mr_sample_result, field)
static const cmd_field figures[] = { FIGURE(level), FIGURE(vertices), FIGURE(outliers), FIGURE(tries_1),
	FIGURE(tries_4), FIGURE(tries_10), FIGURE(missed), FIGURE(spikes), FIGURE(filled), FIGURE(fairness),
	FIGURE(gap_mean), FIGURE(gap_max), FIGURE(area_ratio), FIGURE(folds), { 0 } };

static mr_status
sample_frame(cmd *c, mr_frame *f)
{
	bool on_mesh = mr_sample_meets_faces(f, c->layer);
	mr_sample_result result;

	opts.layer = c->layer;
	MR_TRY(cmd_idle(c, "method neighbours", on_mesh, "on a mesh: its triangles are met"));
	MR_TRY(mr_sample_frame(&c->ctx, f, &opts, &result));
	cmd_figures(c, figures, &result);
	cmd_gaps(c, &result.gaps);
	return MR_OK;
}

const cmd_tool cmd_this = {
	.summary = "sample the displacement of a subdivision surface to points or a mesh",
	.options = table,
	.frame = sample_frame,
};
