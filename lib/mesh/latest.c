/* Which layer was worked on last, column `latest`, of which others no surface shows yet what was done to
 * them, column `pending`, and what a tool takes that shows or writes one layer. */
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

/* The lines of a column, none where it is not there. */
static mr_status
get_lines(mr_ctx *ctx, mr_frame *f, const char *column, const char **text, size_t *n)
{
	const void *data = "";

	*n = 0;
	if (mr_layer_has(f, "", column))
		MR_TRY(mr_frame_get(ctx, f, "", column, TEXT, &data, n));
	*text = data;
	return MR_OK;
}

/* Puts the lines that a frame does not have yet. */
static mr_status
put_lines(mr_ctx *ctx, mr_frame *f, const char *column, mr_text *lines)
{
	const char *old;
	size_t n;

	MR_TRY(get_lines(ctx, f, column, &old, &n));
	if (n == lines->n && (n == 0 || !memcmp(old, lines->s, n)))
		return MR_OK;
	if (lines->n)
		return mr_frame_put(ctx, f, "", column, TEXT, lines->s, lines->n);
	mr_frame_drop(f, "", column, 0);
	return MR_OK;
}

/* What is to be done where what was done to a layer shows in no surface yet, with what that is. */
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

/* Layers that another one is to follow. */
enum { LEADING = 4 };
static const char *const leading[LEADING] = { "handles", "base", "displacement", "control" };

/* Says of each of those whether it was worked on, and no surface shows that yet. */
static mr_status
find_pending(mr_ctx *ctx, mr_frame *f, bool is[])
{
	const char *latest, *pending, *what;
	size_t n, m;

	MR_TRY(get_lines(ctx, f, "latest", &latest, &n));
	MR_TRY(get_lines(ctx, f, "pending", &pending, &m));
	for (int i = 0; i < LEADING; i++)
		is[i] = (has_line(latest, n, leading[i]) || has_line(pending, m, leading[i])) &&
		        missing_tools(f, leading[i], &what);
	return MR_OK;
}

/* Puts those, but for one. */
static mr_status
put_pending(mr_ctx *ctx, mr_frame *f, const bool is[], const char *but)
{
	mr_text lines = { .ctx = ctx };

	for (int i = 0; i < LEADING; i++)
		if (is[i] && strcmp(leading[i], but) != 0)
			mr_text_add(&lines, "%s\n", leading[i]);
	return put_lines(ctx, f, "pending", &lines);
}

mr_status
mr_layer_worked(mr_ctx *ctx, mr_frame *f, const char *layer)
{
	mr_text line = { .ctx = ctx };
	bool pending[LEADING];

	if (!mr_layer_has(f, "", "latest") && !has_others(f, layer))
		return MR_OK;
	MR_TRY(find_pending(ctx, f, pending));
	mr_text_add(&line, "%s\n", layer);
	MR_TRY(put_lines(ctx, f, "latest", &line));
	return put_pending(ctx, f, pending, layer);
}

mr_status
mr_layer_is_pending(mr_ctx *ctx, mr_frame *f, const char *layer, bool *is)
{
	bool pending[LEADING];

	MR_TRY(find_pending(ctx, f, pending));
	*is = false;
	for (int i = 0; i < LEADING; i++)
		*is |= pending[i] && !strcmp(leading[i], layer);
	return MR_OK;
}

mr_status
mr_layer_followed(mr_ctx *ctx, mr_frame *f, const char *layer)
{
	bool pending[LEADING];

	MR_TRY(find_pending(ctx, f, pending));
	return put_pending(ctx, f, pending, layer);
}

/* The layers that are there and said to be the latest, up to two: several where frames were merged. */
static mr_status
find_latest(mr_ctx *ctx, mr_frame *f, const char *layer[2])
{
	const char *text;
	size_t n, found = 0;

	layer[0] = layer[1] = NULL;
	MR_TRY(get_lines(ctx, f, "latest", &text, &n));
	for (size_t i = 0; i < f->count && found < 2; i++) {
		const char *one = f->columns[i].layer;
		if (!*one || !has_line(text, n, one) || (found && !strcmp(layer[0], one)))
			continue;
		layer[found++] = mr_format(ctx, "%s", one);
	}
	return MR_OK;
}

/* The first surface of a frame that does not say which is its latest, for want of others; NULL: it has none.
 */
static const char *
first_surface(const mr_frame *f)
{
	static const char *const surfaces[] = { "mesh", "control", "base" };

	for (size_t i = 0; i < sizeof surfaces / sizeof *surfaces; i++)
		if (mr_frame_has_layer(f, surfaces[i]))
			return surfaces[i];
	return NULL;
}

/* Adds the layers of a frame that were worked on last and are not there yet. */
static mr_status
add_latest(mr_ctx *ctx, mr_frame *f, mr_text *all)
{
	const char *layer[2];

	MR_TRY(find_latest(ctx, f, layer));
	if (!mr_layer_has(f, "", "latest"))
		layer[0] = first_surface(f);
	for (int i = 0; i < 2 && layer[i]; i++)
		if (!has_line(all->n ? all->s : "", all->n, layer[i]))
			mr_text_add(all, "%s\n", layer[i]);
	return MR_OK;
}

/* Those of all frames; none where no frame says which it is. */
static mr_status
add_latest_of_all(mr_ctx *ctx, mr_frame *const *frames, size_t n, mr_text *all)
{
	bool said = false;

	for (size_t i = 0; i < n; i++)
		said |= mr_layer_has(frames[i], "", "latest");
	for (size_t i = 0; said && i < n; i++)
		MR_TRY(add_latest(ctx, frames[i], all));
	return MR_OK;
}

mr_status
mr_layer_join_latest(mr_ctx *ctx, mr_frame *const *frames, size_t n, mr_frame *out)
{
	mr_text all = { .ctx = ctx };

	MR_TRY(add_latest_of_all(ctx, frames, n, &all));
	return put_lines(ctx, out, "latest", &all);
}

mr_status
mr_layers_merge(mr_ctx *ctx, mr_frame *f, mr_frame *from)
{
	mr_frame *const both[] = { f, from };
	mr_text all = { .ctx = ctx };

	MR_TRY(add_latest_of_all(ctx, both, 2, &all));
	MR_TRY(mr_frame_merge(ctx, f, from));
	return put_lines(ctx, f, "latest", &all);
}

mr_status
mr_layer_latest(mr_ctx *ctx, mr_frame *f, const char **layer)
{
	const char *found[2];

	MR_TRY(find_latest(ctx, f, found));
	*layer = found[1] ? NULL : found[0];
	return MR_OK;
}

mr_status
mr_layer_is_latest(mr_ctx *ctx, mr_frame *f, const char *layer, bool *is)
{
	const char *text;
	size_t n;

	MR_TRY(get_lines(ctx, f, "latest", &text, &n));
	*is = has_line(text, n, layer);
	return MR_OK;
}

mr_status
mr_layer_finished(mr_ctx *ctx, mr_frame *f)
{
	bool pending[LEADING];
	const char *what;

	MR_TRY(find_pending(ctx, f, pending));
	for (int i = 0; i < LEADING; i++)
		if (pending[i]) {
			mr_remedy remedy = missing_tools(f, leading[i], &what);
			return mr_advise(ctx, remedy, mr_fail(ctx, MR_EMISSING, "%s", what));
		}
	return MR_OK;
}

mr_status
mr_layer_finished_or_warn(mr_ctx *ctx, mr_frame *f)
{
	mr_status status = mr_layer_finished(ctx, f);

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
	const char *latest[2] = { NULL, NULL };

	if (!only) {
		MR_TRY(mr_layer_finished(ctx, f));
		MR_TRY(find_latest(ctx, f, latest));
	}
	if (latest[1])
		return mr_advise(ctx, MR_NAME_LAYER,
		    mr_fail(ctx, MR_EMISSING,
			"%s and %s were each worked on last, in frames that were merged", latest[0],
			latest[1]));
	return mr_layer_choose(ctx, f, only ? only : latest[0], layers, layer);
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
