/* Which layer was worked on last, column `latest`, and what a tool takes that shows or writes one layer. */
#include "mesh/layers.h"

static const mr_shape TEXT = { '-', 't', 1 };

/* Whether a frame with this layer has any other. */
static bool
has_others(const mr_frame *f, const char *layer)
{
	for (size_t i = 0; i < f->count; i++)
		if (*f->columns[i].layer && strcmp(f->columns[i].layer, layer) != 0)
			return true;
	return false;
}

/* Whether a line of the text is this word. */
static bool
has_line(const char *text, size_t n, const char *word)
{
	size_t length = strlen(word);

	for (const char *end = text + n, *stop; text < end; text = stop + 1) {
		stop = memchr(text, '\n', (size_t)(end - text));
		stop = stop ? stop : end;
		if ((size_t)(stop - text) == length && !memcmp(text, word, length))
			return true;
	}
	return false;
}

mr_status
mr_layer_worked(mr_ctx *ctx, mr_frame *f, const char *layer)
{
	bool there = mr_layer_has(f, "", "latest");
	const void *old;
	size_t n = 0;
	char *line;

	if (!there && !has_others(f, layer))
		return MR_OK;
	if (there)
		MR_TRY(mr_frame_get(ctx, f, "", "latest", TEXT, &old, &n));
	if (n == strlen(layer) + 1 && has_line(old, n, layer))
		return MR_OK;
	line = mr_format(ctx, "%s\n", layer);
	return line ? mr_frame_put(ctx, f, "", "latest", TEXT, line, strlen(line)) : MR_EMEM;
}

/* The layers that are there and said to be the latest, up to two: several where frames were merged. */
static mr_status
find_latest(mr_ctx *ctx, mr_frame *f, const char *layer[2])
{
	const void *text;
	size_t n, found = 0;

	layer[0] = layer[1] = NULL;
	if (!mr_layer_has(f, "", "latest"))
		return MR_OK;
	MR_TRY(mr_frame_get(ctx, f, "", "latest", TEXT, &text, &n));
	for (size_t i = 0; i < f->count && found < 2; i++) {
		const char *one = f->columns[i].layer;
		if (!*one || !has_line(text, n, one) || (found && !strcmp(layer[0], one)))
			continue;
		layer[found] = mr_format(ctx, "%s", one);
		if (!layer[found++])
			return MR_EMEM;
	}
	return MR_OK;
}

mr_status
mr_layer_latest(mr_ctx *ctx, mr_frame *f, const char **layer)
{
	const char *found[2];

	MR_TRY(find_latest(ctx, f, found));
	*layer = found[1] ? NULL : found[0];
	return MR_OK;
}

/* The tools that are missing where what was worked on shows in no surface yet, with what that is; else NULL.
 */
static const char *
missing_tools(const mr_frame *f, const char *latest, const char **what)
{
	bool detail = mr_layer_has(f, "mesh", "detail_face"), heights = mr_frame_has_layer(f, "displacement");
	bool response = mr_layer_has(f, "base", "response") || mr_layer_has(f, "control", "response");

	if (!strcmp(latest, "handles")) {
		*what = "handles are posed, and nothing has followed them";
		return response ? "mr-decode" : detail || heights ? "mr-solve | mr-decode" : "mr-solve";
	}
	if (!strcmp(latest, "base") && detail) {
		*what = "base has moved, and mesh has not followed it";
		return "mr-decode";
	}
	if (!strcmp(latest, "displacement") || (!strcmp(latest, "control") && heights)) {
		*what = "the heights over control are no surface yet";
		return "mr-decode";
	}
	return NULL;
}

mr_status
mr_layer_finished(mr_ctx *ctx, mr_frame *f)
{
	const char *layer[2], *tools, *what;

	MR_TRY(find_latest(ctx, f, layer));
	for (int i = 0; i < 2 && layer[i]; i++)
		if ((tools = missing_tools(f, layer[i], &what)))
			return mr_fail(ctx, MR_EMISSING,
			    "%s: %s goes before this, or -l names a layer to take as it is", what, tools);
	return MR_OK;
}

mr_status
mr_layer_finished_or_warn(mr_ctx *ctx, mr_frame *f)
{
	mr_status status = mr_layer_finished(ctx, f);

	if (status != MR_EMISSING)
		return status;
	if (f->key)
		mr_warn(ctx, "%s", ctx->error);
	*ctx->error = '\0';
	return MR_OK;
}

mr_status
mr_layer_result(mr_ctx *ctx, mr_frame *f, const char *only, const char **layer)
{
	static const char *const layers[] = { "mesh", "control", "points", "base", NULL };
	const char *latest[2] = { NULL, NULL };

	if (!only) {
		MR_TRY(mr_layer_finished(ctx, f));
		MR_TRY(find_latest(ctx, f, latest));
	}
	if (latest[1])
		return mr_fail(ctx, MR_EMISSING,
		    "%s and %s were each worked on last, in frames that were merged: -l names the one to "
		    "take",
		    latest[0], latest[1]);
	return mr_layer_choose(ctx, f, only ? only : latest[0], layers, layer);
}

mr_status
mr_layer_choose_warned(
    mr_ctx *ctx, mr_frame *f, const char *only, const char *const *layers, const char **layer)
{
	const char *latest;

	MR_TRY(mr_layer_choose(ctx, f, only, layers, layer));
	MR_TRY(mr_layer_latest(ctx, f, &latest));
	if (!only && f->key && latest && strcmp(latest, *layer) != 0 && mr_layer_has(f, latest, "position"))
		mr_warn(ctx, "%s is taken, not %s, which was worked on last: -l %s takes that", *layer,
		    latest, latest);
	return MR_OK;
}
