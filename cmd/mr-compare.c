/* mr-compare -- measure how far two surfaces or clouds are apart.  See man/mr-compare.1. */
#include "alg/report.h"
#include "cmd.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

static mr_compare_opts opts = MR_COMPARE_DEFAULTS;
static const char *layer_a, *layer_b;
static bool json;

static const cmd_opt table[] = {
	{ 'a', "from", CMD_TEXT, &layer_a, 0, 0, "LAYER",
	    "first layer; default mesh, else control, base or points", NULL },
	{ 'b', "to", CMD_TEXT, &layer_b, 0, 0, "LAYER",
	    "second layer; default with FILE_B the name of the first, else base, control or points", NULL },
	{ 0, "json", CMD_FLAG, &json, 0, 0, NULL, "one JSON object a frame, one a line", NULL },
	{ 0, "samples", CMD_COUNT, &opts.samples, 0, 1e9, "N",
	    "pieces that each surface is integrated over, at least one a face; 0 is 100,000", NULL },
	{ 0, "vertices", CMD_FLAG, &opts.vertices_only, 0, 0, NULL, "measure from the vertices alone", NULL },
	{ 0, "tolerance", CMD_REAL, &opts.tolerance, 1e-9, 1, "T",
	    "share of max within which its upper bound is sought", NULL },
	{ 0 },
};

/* The stream FILE_B, frame by frame beside the first. */
static mr_reader *other;
static mr_frame *other_frame;
static unsigned long long other_count;
static bool other_ended;

static mr_status
open_other(cmd *c)
{
	const char *path;
	int fd;

	if (c->operand_count > 1)
		return mr_fail(
		    &c->ctx, MR_EUSAGE, "at most one FILE_B is expected, not %zu", c->operand_count);
	if (c->operand_count == 0)
		return MR_OK;
	path = c->operands[0];
	if (!strcmp(path, "-"))
		return mr_fail(&c->ctx, MR_EUSAGE, "FILE_B must be a file: stdin is the first stream");
	fd = open(path, O_RDONLY);
	if (fd < 0)
		return mr_fail(&c->ctx, MR_EIO, "%s: %s", path, strerror(errno));
	return mr_prefix(&c->ctx, mr_reader_open(&c->keep, fd, &other), "%s", path);
}

static mr_status
next_other(cmd *c)
{
	mr_status status = mr_reader_next(&c->ctx, other, &other_frame);

	other_ended = status == MR_END;
	other_count += status == MR_OK;
	return mr_prefix(&c->ctx, status, "%s", c->operands[0]);
}

/* The frame that goes with f: that of the same number in FILE_B, or its only one. */
static mr_status
second_frame(cmd *c, mr_frame *f, mr_frame **second)
{
	*second = f;
	if (!other)
		return MR_OK;
	if (!other_ended)
		MR_TRY(next_other(c));
	if (other_count == 0 || (other_ended && other_count > 1))
		return mr_fail(&c->ctx, MR_ERANGE, "%s has only %llu frames", c->operands[0], other_count);
	*second = other_frame;
	return MR_OK;
}

static mr_status
choose_layers(cmd *c, mr_frame *f, mr_frame *second, const char **a, const char **b)
{
	static const char *const firsts[] = { "mesh", "control", "base", "points", NULL };
	static const char *const seconds[] = { "base", "control", "points", NULL };

	MR_TRY(mr_layer_choose(&c->ctx, f, layer_a ? layer_a : c->layer, firsts, a));
	if (second != f)
		return mr_layer_choose(&c->ctx, second, layer_b ? layer_b : *a, NULL, b);
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

static mr_status
surface_or_cloud(cmd *c, mr_frame *f, const char *layer, mr_mesh *m)
{
	const mr_column *faces = mr_frame_find(f, layer, "triangles");

	return faces && faces->rows ? mr_layer_mesh(&c->ctx, f, layer, m)
	                            : mr_layer_points(&c->ctx, f, layer, m);
}

static mr_status
compare(cmd *c, mr_frame *f)
{
	mr_text text = { .ctx = &c->ctx };
	const char *a, *b;
	mr_frame *second;
	mr_comparison r;
	mr_mesh ma, mb;

	MR_TRY(second_frame(c, f, &second));
	MR_TRY(choose_layers(c, f, second, &a, &b));
	MR_TRY(surface_or_cloud(c, f, a, &ma));
	MR_TRY(surface_or_cloud(c, second, b, &mb));
	MR_TRY(mr_compare(&c->ctx, &ma, &mb, &opts, &r));
	mr_stat_set(&c->ctx, "max", r.both.max);
	mr_stat_set(&c->ctx, "max_bound", r.both.max_bound);
	mr_stat_set(&c->ctx, "mean", r.both.mean);
	mr_stat_set(&c->ctx, "rms", r.both.rms);
	mr_report_comparison(&r, f, a, b, json, &text);
	MR_TRY(mr_text_done(&text));
	cmd_print(c, "%s", text.s);
	return MR_OK;
}

/* Drains FILE_B: it must end well, and hold no more frames than the first stream. */
static mr_status
finish(cmd *c)
{
	unsigned long long compared = other_count;

	while (other && !other_ended)
		MR_TRY(next_other(c));
	mr_reader_free(other);
	if (other_count > compared)
		return mr_fail(&c->ctx, MR_ERANGE, "%s has %llu frames, the first stream %llu",
		    c->operands[0], other_count, compared);
	return MR_OK;
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "measure how far two surfaces or clouds are apart",
		.operands = "[FILE_B]",
		.options = table,
		.prepare = open_other,
		.frame = compare,
		.finish = finish,
		.sink = true });
}
