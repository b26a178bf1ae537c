/* mr-compare -- measure how far two surfaces or clouds are apart.  See man/mr-compare.1. */
#include "align/align.h"
#include "cmd.h"
#include "measure/report.h"
#include "stream/record.h"

static mr_compare_opts opts = MR_COMPARE_DEFAULTS;
static const char *layer_a, *layer_b, *column;
static bool json;

static const cmd_opt table[] = {
	{ 'a', "from", CMD_TEXT, &layer_a, 0, 0, "LAYER",
	    "first layer; default: with FILE_B the one worked on last, else mesh, control, base or points",
	    NULL },
	{ 'b', "to", CMD_TEXT, &layer_b, 0, 0, "LAYER",
	    "second layer; default: with FILE_B the layer of the same name, else base, control or points",
	    NULL },
	{ 0, "json", CMD_FLAG, &json, 0, 0, NULL, "one JSON object a frame, one a line", NULL },
	{ 0, "samples", CMD_COUNT, &opts.samples, 0, 1e9, "N",
	    "pieces that each surface is integrated over, at least one a face; 0 is 100,000", NULL },
	{ 0, "vertices", CMD_FLAG, &opts.vertices_only, 0, 0, NULL, "measure from the vertices alone", NULL },
	{ 0, "tolerance", CMD_SHARE, &opts.tolerance, 1e-9, 1, "T",
	    "share of max to which its upper bound is found", NULL },
	{ 0, "column", CMD_TEXT, &column, 0, 0, "NAME",
	    "write the stream with each vertex's distance as this column of the first layer, and no report",
	    NULL },
	{ 0 },
};

static mr_side other; /* the stream FILE_B; all zero without one */

static mr_status
open_other(cmd *c)
{
	size_t n = c->operand_count;

	if (c->layer && layer_a)
		return mr_fail(&c->ctx, MR_EUSAGE, "--layer and --from name the same layer: give one");
	MR_TRY(cmd_layer_name(c, "--from", layer_a));
	MR_TRY(cmd_layer_name(c, "--to", layer_b));
	MR_TRY(cmd_idle(c, "samples tolerance", opts.vertices_only, "with --vertices"));
	MR_TRY(cmd_idle(c, "json", column != NULL, "with --column"));
	if (column && (!mr_name_valid(column, MR_COLUMN_MAX) || mr_column_of("mesh", column)))
		return mr_fail(&c->ctx, MR_EUSAGE, "--column: no column can be called '%s'", column);
	c->sink = !column;
	if (n > 2)
		return mr_fail(&c->ctx, MR_EUSAGE, "FILE_A and FILE_B are expected, not %zu files", n);
	if (n == 0)
		return MR_OK;
	if (!strcmp(c->operands[n - 1], "-"))
		return mr_fail(&c->ctx, MR_EUSAGE, "FILE_B must be a file: stdin is the first stream");
	if (n == 2)
		MR_TRY(cmd_input(c, c->operands[0]));
	return cmd_side(c, c->operands[n - 1], &other);
}

/* Two layers of one frame. */
static mr_status
choose_two(cmd *c, mr_frame *f, const char *first, const char **a, const char **b)
{
	static const char *const firsts[] = { "mesh", "control", "base", "points", NULL };
	static const char *const seconds[] = { "base", "control", "points", NULL };

	if (!first && !layer_b)
		MR_TRY(mr_layer_finished_or_warn(&c->ctx, f));
	MR_TRY(mr_layer_choose(&c->ctx, f, first, firsts, a));
	for (size_t i = 0; !layer_b && seconds[i]; i++)
		if (strcmp(seconds[i], *a) && mr_frame_has_layer(f, seconds[i])) {
			*b = seconds[i];
			return MR_OK;
		}
	if (!layer_b)
		return mr_fail(&c->ctx, MR_EMISSING,
		    "no layer to compare %s with: neither base, control nor points", *a);
	return mr_layer_choose(&c->ctx, f, layer_b, NULL, b);
}

/* The result layer of each frame; of the second the layer of the same name, if there is one. */
static mr_status
choose_results(cmd *c, mr_frame *f, mr_frame *second, const char *first, const char **a, const char **b)
{
	const char *result;

	MR_TRY(mr_layer_result(&c->ctx, f, first, a));
	if (layer_b || first)
		return mr_layer_choose(&c->ctx, second, layer_b ? layer_b : *a, NULL, b);
	MR_TRY(mr_layer_result(&c->ctx, second, NULL, &result));
	*b = mr_frame_has_layer(second, *a) ? *a : result;
	if (f->key && strcmp(*b, result) != 0)
		mr_found(&c->ctx, &(mr_finding){ .kind = MR_LAYER, .layer = *b, .what = result });
	return MR_OK;
}

#define FIGURE(field) CMD_FIGURE(mr_distance, field)
static const cmd_field figures[] = { FIGURE(max), FIGURE(max_bound), FIGURE(mean), FIGURE(rms),
	CMD_FIGURE_AS("q50", mr_distance, quantile[0]), CMD_FIGURE_AS("q90", mr_distance, quantile[1]),
	CMD_FIGURE_AS("q95", mr_distance, quantile[2]), CMD_FIGURE_AS("q99", mr_distance, quantile[3]),
	FIGURE(normal_mean), CMD_FIGURE_AS("normal_q50", mr_distance, normal_quantile[0]),
	CMD_FIGURE_AS("normal_q90", mr_distance, normal_quantile[1]),
	CMD_FIGURE_AS("normal_q95", mr_distance, normal_quantile[2]),
	CMD_FIGURE_AS("normal_q99", mr_distance, normal_quantile[3]), { 0 } };

static mr_status
compare(cmd *c, mr_frame *f)
{
	mr_text text = { .ctx = &c->ctx };
	const char *a, *b;
	const char *first = layer_a ? layer_a : c->layer;
	mr_frame *second = f;
	mr_comparison r;
	mr_mesh ma, mb;

	if (other.path) {
		MR_TRY(mr_side_take(&c->ctx, &other, f->number));
		second = other.frame;
		MR_TRY(choose_results(c, f, second, first, &a, &b));
	} else {
		MR_TRY(choose_two(c, f, first, &a, &b));
	}
	MR_TRY(mr_layer_surface_or_points(&c->ctx, f, a, &ma));
	MR_TRY(mr_layer_surface_or_points(&c->ctx, second, b, &mb));
	if (column)
		MR_TRY(mr_compare_put(&c->ctx, f, a, column, &ma, &mb));
	MR_TRY(mr_compare(&c->ctx, &ma, &mb, &opts, &r));
	cmd_figures(c, figures, &r.both);
	if (f->key)
		MR_TRY(mr_align_judge(&c->ctx, &ma, &mb, &r));
	if (column)
		return MR_OK;
	mr_report_comparison(&r, f, a, b, json, &text);
	cmd_print(c, "%s", text.s);
	return MR_OK;
}

const cmd_tool cmd_this = {
	.summary = "measure how far two surfaces or clouds are apart",
	.operands = "[[FILE_A] FILE_B]",
	.options = table,
	.prepare = open_other,
	.frame = compare,
	.sink = true,
};
