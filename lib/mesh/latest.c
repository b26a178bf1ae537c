/* The layers in the order in which they were worked on, the last one first: column `latest`, a line each.
 * From that follows what no surface shows yet, and what a tool takes that writes one layer. */
#include "base/text.h"
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

/* The start of the layer's line; n: it has none. */
static size_t
place_of(const char *text, size_t n, const char *layer)
{
	size_t length = strlen(layer);

	for (size_t at = 0, next; at < n; at = next + 1) {
		const char *stop = memchr(text + at, '\n', n - at);
		next = stop ? (size_t)(stop - text) : n;
		if (next - at == length && !memcmp(text + at, layer, length))
			return at;
	}
	return n;
}

/* Takes the layer's line away, or makes it the first. */
static mr_status
reorder(mr_ctx *ctx, mr_frame *f, const char *layer, bool first)
{
	mr_text lines = { .ctx = ctx };
	const char *text;
	size_t n, at, rest;

	MR_TRY(mr_frame_lines(ctx, f, "latest", &text, &n));
	at = place_of(text, n, layer);
	if (first ? n && at == 0 : at == n)
		return MR_OK;
	rest = at < n ? at + strlen(layer) + 1 : n;
	if (first)
		mr_text_add(&lines, "%s\n", layer);
	mr_text_add(&lines, "%.*s", (int)at, text);
	if (rest < n)
		mr_text_add(&lines, "%.*s", (int)(n - rest), text + rest);
	return mr_frame_put(ctx, f, "", "latest", TEXT, lines.s, lines.n);
}

mr_status
mr_layer_worked(mr_ctx *ctx, mr_frame *f, const char *layer)
{
	bool alone = !mr_layer_has(f, "", "latest") && !has_others(f, layer);

	return alone ? MR_OK : reorder(ctx, f, layer, true);
}

mr_status
mr_layer_followed(mr_ctx *ctx, mr_frame *f, const char *layer)
{
	return reorder(ctx, f, layer, false);
}

/* The command that makes a pending change of a layer show in a surface. */
static mr_remedy
missing_tools(const mr_frame *f, const char *layer, const char **what)
{
	bool detail = mr_layer_has(f, "mesh", "detail_face"), heights = mr_frame_has_layer(f, "displacement");
	bool response = mr_layer_has(f, "base", "response") || mr_layer_has(f, "control", "response");

	if (!mr_frame_has_layer(f, layer))
		return MR_NO_REMEDY;
	if (!strcmp(layer, "handles") && mr_layer_has(f, "handles", "transform")) {
		*what = "handles are posed, and nothing has followed them";
		return response            ? MR_DECODE_FIRST
		       : detail || heights ? MR_SOLVE_DECODE_FIRST
		                           : MR_SOLVE_FIRST;
	}
	if (!strcmp(layer, "base") && detail) {
		*what = "base has moved, and mesh has not followed it";
		return MR_DECODE_FIRST;
	}
	if (!strcmp(layer, "displacement") || (!strcmp(layer, "control") && heights)) {
		*what = "the heights over control are no surface yet";
		return detail ? MR_DECODE_CONTROL_FIRST : MR_DECODE_FIRST;
	}
	return MR_NO_REMEDY;
}

mr_status
mr_layer_is_pending(mr_ctx *ctx, mr_frame *f, const char *layer, bool *is)
{
	const char *text, *what;
	size_t n;

	MR_TRY(mr_frame_lines(ctx, f, "latest", &text, &n));
	*is = place_of(text, n, layer) < n && missing_tools(f, layer, &what);
	return MR_OK;
}

mr_status
mr_layer_latest(mr_ctx *ctx, mr_frame *f, const char **layer)
{
	const char *text;
	size_t n, first;

	MR_TRY(mr_frame_lines(ctx, f, "latest", &text, &n));
	*layer = NULL;
	first = n;
	for (size_t i = 0; i < f->count; i++) {
		size_t at = place_of(text, n, f->columns[i].layer);
		if (*f->columns[i].layer && at < first) {
			first = at;
			*layer = mr_format(ctx, "%s", f->columns[i].layer);
		}
	}
	return MR_OK;
}

/* MR_EMISSING, with the tool that is missing, where what was done shows in no surface yet. */
static mr_status
finished(mr_ctx *ctx, mr_frame *f)
{
	static const char *const leading[] = { "handles", "base", "displacement", "control" };

	for (size_t i = 0; i < sizeof leading / sizeof *leading; i++) {
		const char *what = "";
		bool pending;
		MR_TRY(mr_layer_is_pending(ctx, f, leading[i], &pending));
		if (pending) {
			mr_remedy remedy = missing_tools(f, leading[i], &what);
			return mr_advise(ctx, remedy, mr_fail(ctx, MR_EMISSING, "%s", what));
		}
	}
	return MR_OK;
}

mr_status
mr_layer_finished_or_warn(mr_ctx *ctx, mr_frame *f)
{
	mr_status status = finished(ctx, f);

	if (status != MR_EMISSING)
		return status;
	if (f->key)
		mr_found(
		    ctx, &(mr_finding){ .kind = MR_LIMIT, .what = "a pose, or heights, are no surface yet" });
	*ctx->error = '\0';
	return MR_OK;
}

mr_status
mr_layer_result(mr_ctx *ctx, mr_frame *f, const char *only, const char **layer)
{
	static const char *const layers[] = { "mesh", "control", "points", "base", NULL };

	if (!only) {
		MR_TRY(finished(ctx, f));
		MR_TRY(mr_layer_latest(ctx, f, &only));
	}
	return mr_layer_choose(ctx, f, only, layers, layer);
}

mr_status
mr_layer_choose_warned(
    mr_ctx *ctx, mr_frame *f, const char *only, const char *const *layers, const char **layer)
{
	const char *latest;

	MR_TRY(mr_layer_choose(ctx, f, only, layers, layer));
	MR_TRY(mr_layer_latest(ctx, f, &latest));
	if (only || !f->key || !latest || !strcmp(latest, *layer) || !mr_layer_has(f, latest, "position"))
		return MR_OK;
	mr_found(ctx, &(mr_finding){ .kind = MR_LAYER, .layer = *layer, .what = latest });
	return MR_OK;
}
