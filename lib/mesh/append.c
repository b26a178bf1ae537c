/* Layers appended: columns are joined by name, and indices in them follow what they refer to. */
#include "mesh/append.h"

#include "base/name_table.h"
#include "base/text.h"
#include "mesh/name_lists.h"

/* One column of a layer in all frames. */
typedef struct joined {
	mr_frame *const *frames;
	size_t n;
	const mr_column *first;
	const char *layer, *name;
} joined;

static size_t
rows_of(const mr_frame *f, const char *layer, char element)
{
	for (size_t i = 0; i < f->count; i++)
		if (!strcmp(f->columns[i].layer, layer) && f->columns[i].shape.element == element)
			return (size_t)f->columns[i].rows;
	return 0;
}

/* Whether every frame with rows of the element has the column in the same shape, or something stands for it.
 */
static bool
all_have(const joined *j)
{
	bool needed = mr_column_missing(j->first) == MR_NEEDED;

	for (size_t i = 0; i < j->n; i++) {
		const mr_column *c = mr_frame_find(j->frames[i], j->layer, j->name);
		if (c ? !mr_same_shape(c->shape, j->first->shape)
		      : needed && rows_of(j->frames[i], j->layer, j->first->shape.element) > 0)
			return false;
	}
	return true;
}

/* ---- text ---- */

/* number: of each line of the text among those of all frames; in the arena. */
static void
add_lines(mr_ctx *ctx, mr_name_table *all, const char *text, size_t bytes, uint32_t **number, size_t *count)
{
	const char **start;

	mr_line_starts(ctx, text, bytes, &start, count);
	*number = MR_NEW(ctx, *count, uint32_t);
	for (size_t i = 0; i < *count; i++)
		(*number)[i] = mr_name_number(ctx, all, start[i], (size_t)(start[i + 1] - start[i]) - 1);
}

/* The names of frame i, or the one of rows without. */
static mr_status
add_names(mr_ctx *ctx, const joined *j, size_t i, const char *list, mr_name_table *all, uint32_t **number,
    size_t *n)
{
	const void *text = strcmp(list, "groups") ? "" : "default";
	size_t bytes = strlen(text);

	if (mr_layer_has(j->frames[i], j->layer, list))
		MR_TRY(mr_frame_get(
		    ctx, j->frames[i], j->layer, list, (mr_shape){ '-', 't', 1 }, &text, &bytes));
	bytes -= bytes > 0 && !*j->layer && ((const char *)text)[bytes - 1] == '\n';
	add_lines(ctx, all, text, bytes, number, n);
	return MR_OK;
}

static bool
is_list(const char *name)
{
	for (size_t i = 0; i < MR_NAMINGS; i++)
		if (!strcmp(mr_namings[i].list, name))
			return true;
	return false;
}

/* Texts of no row: the lines of all, each once; of no layer each ends with a newline. */
static mr_status
join_text(mr_ctx *ctx, const joined *j, mr_frame *out)
{
	mr_name_table l = { 0 };
	uint32_t *number;
	size_t count;

	for (size_t i = 0; i < j->n; i++)
		if (mr_layer_has(j->frames[i], j->layer, j->name) ||
		    (is_list(j->name) && rows_of(j->frames[i], j->layer, 'f') > 0))
			MR_TRY(add_names(ctx, j, i, j->name, &l, &number, &count));
	if (l.count == 0)
		return MR_OK;
	return mr_frame_put(
	    ctx, out, j->layer, j->name, (mr_shape){ '-', 't', 1 }, l.text, l.bytes - (*j->layer != 0));
}

/* ---- rows ---- */

static mr_status
shift(mr_ctx *ctx, const joined *j, uint32_t *x, size_t n, uint64_t by)
{
	for (size_t i = 0; i < n; i++) {
		if (x[i] + by >= MR_NONE)
			return mr_fail(ctx, MR_ERANGE, "%s: %s goes beyond %u in one frame", j->layer,
			    j->name, MR_NONE - 1);
		x[i] = (uint32_t)(x[i] + by);
	}
	return MR_OK;
}

/* How many rows of the column's element all frames have. */
static uint64_t
rows_of_all(const joined *j)
{
	uint64_t n = 0;

	for (size_t i = 0; i < j->n; i++)
		n += rows_of(j->frames[i], j->layer, j->first->shape.element);
	return n;
}

/* The rows and names of the frames so far, by which indices of the next are shifted. */
typedef struct following {
	uint64_t rows; /* of what they number: vertices, faces or polygons */
	mr_name_table names;
} following;

/* Names of frame i, of which x has the numbers. */
static mr_status
follow_names(mr_ctx *ctx, const joined *j, size_t i, const char *names, uint32_t *x, size_t n, following *w)
{
	uint32_t *number;
	size_t count;

	if (n == 0)
		return MR_OK;
	MR_TRY(add_names(ctx, j, i, names, &w->names, &number, &count));
	if (!mr_layer_has(j->frames[i], j->layer, names) && mr_layer_has(j->frames[i], j->layer, j->name))
		return MR_OK;
	for (size_t k = 0; k < n; k++) {
		if (x[k] >= count)
			return mr_fail(ctx, MR_ERANGE, "%s: row %zu of %s is %u of %zu", j->layer, k, j->name,
			    x[k], count);
		x[k] = number[x[k]];
	}
	return MR_OK;
}

/* x, n numbers of `more` rows, behind those of the frames before. */
static mr_status
follow_rows(mr_ctx *ctx, const joined *j, uint32_t *x, size_t n, size_t more, following *w)
{
	MR_TRY(shift(ctx, j, x, n, w->rows));
	w->rows += more;
	return MR_OK;
}

/* Shifts or renumbers the indices of frame i. */
static mr_status
follow(mr_ctx *ctx, const joined *j, size_t i, uint32_t *x, size_t n, following *w)
{
	const mr_column_info *info = mr_column_of(j->layer, j->name);
	const char *names = mr_names_of(j->name);

	if (names)
		return follow_names(ctx, j, i, names, x, n, w);
	if (info && info->kind == MR_NUMBER)
		return follow_rows(ctx, j, x, n, rows_of(j->frames[i], info->refers, 'f'), w);
	if (!strcmp(j->name, "triangles"))
		return follow_rows(ctx, j, x, n, rows_of(j->frames[i], j->layer, 'v'), w);
	return strcmp(j->name, "polygon") ? MR_OK : follow_rows(ctx, j, x, n, n, w);
}

/* Values for n rows of a frame without the column. */
static void
stand_in(const joined *j, void *x, size_t n)
{
	size_t values = n * j->first->shape.components;
	mr_missing as = mr_column_missing(j->first);

	memset(x, as == MR_WHITE ? 255 : 0, values * mr_type_size(j->first->shape.type));
	for (size_t i = 0; as == MR_NAN && i < values; i++)
		((double *)x)[i] = (double)NAN;
	for (size_t i = 0; as == MR_COUNTED && i < n; i++)
		((uint32_t *)x)[i] = (uint32_t)i;
}

/* The rows of frame i to x; *n: how many. */
static mr_status
copy_rows(mr_ctx *ctx, const joined *j, size_t i, void *x, size_t *n)
{
	const void *rows;

	if (mr_layer_has(j->frames[i], j->layer, j->name)) {
		MR_TRY(mr_frame_get(ctx, j->frames[i], j->layer, j->name, j->first->shape, &rows, n));
		memcpy(x, rows, *n * mr_type_size(j->first->shape.type) * j->first->shape.components);
	} else {
		*n = rows_of(j->frames[i], j->layer, j->first->shape.element);
		stand_in(j, x, *n);
	}
	return MR_OK;
}

static mr_status
join_rows(mr_ctx *ctx, const joined *j, mr_frame *out)
{
	size_t each = j->first->shape.components, width = mr_type_size(j->first->shape.type) * each;
	uint64_t rows = rows_of_all(j);
	char *x = mr_alloc(ctx, (size_t)rows, width);
	size_t at = 0, n;
	following w = { 0 };

	for (size_t i = 0; i < j->n; i++) {
		MR_TRY(copy_rows(ctx, j, i, x + at * width, &n));
		if (j->first->shape.type == 'u')
			MR_TRY(follow(ctx, j, i, (uint32_t *)(void *)(x + at * width), n * each, &w));
		at += n;
	}
	return mr_frame_put(ctx, out, j->layer, j->name, j->first->shape, x, at);
}

/* ---- frames ---- */

/* How many frames have the layer. */
static size_t
frames_with(const joined *j, const char *layer)
{
	size_t n = 0;

	for (size_t i = 0; i < j->n; i++)
		n += mr_frame_has_layer(j->frames[i], layer);
	return n;
}

/* Whether the column describes all points of its layer together. */
static bool
is_of_all_rows(const joined *j)
{
	const mr_column_info *info = mr_column_of(j->layer, j->name);

	return info && info->kind == MR_SAMPLED;
}

/* Whether the column belongs to one frame alone. */
static bool
is_of_one(const joined *j)
{
	if (!strcmp(j->layer, "handles"))
		return j->n > 1;
	if (!strcmp(j->layer, "displacement"))
		return frames_with(j, "control") > 1 || frames_with(j, "displacement") > 1;
	return frames_with(j, j->layer) > 1 && is_of_all_rows(j);
}

/* *left: the column does not stay. */
static mr_status
join_column(mr_ctx *ctx, const joined *j, mr_frame *out, bool *left)
{
	bool rows = j->first->shape.element != '-', text = j->first->shape.type == 't',
	     list = text && (is_list(j->name) || !strcmp(j->name, "mtllib"));

	*left = rows ? !all_have(j) : !list && frames_with(j, j->layer) > 1;
	if (*left)
		return MR_OK;
	return rows   ? join_rows(ctx, j, out)
	       : list ? join_text(ctx, j, out)
	              : mr_frame_pass(ctx, out, j->first);
}

/* Whether an earlier frame than i has the column. */
static bool
came_before(const joined *j, size_t i, const char *name)
{
	while (i-- > 0)
		if (mr_layer_has(j->frames[i], j->layer, name))
			return true;
	return false;
}

static mr_status
put_at_corners(mr_ctx *ctx, mr_frame *f, const char *layer)
{
	const void *from, *corner;
	size_t nv, nf;
	double *to;

	MR_TRY(mr_layer_get(ctx, f, layer, "texcoord", &from, &nv));
	MR_TRY(mr_layer_get(ctx, f, layer, "triangles", &corner, &nf));
	to = MR_NEW(ctx, 6 * nf, double);
	for (size_t c = 0; c < 3 * nf; c++) {
		uint32_t v = ((const uint32_t *)corner)[c];
		if (v >= nv)
			return mr_fail(ctx, MR_ERANGE, "%s: triangles go beyond %zu vertices", layer, nv);
		memcpy(to + 2 * c, (const double *)from + 2 * v, 2 * sizeof *to);
	}
	mr_frame_drop(f, layer, "texcoord", 0);
	return mr_layer_put(ctx, f, layer, "corner_texcoord", to, nf);
}

/* Moves texture coordinates of vertices to corners if another frame has them at corners. */
static mr_status
join_texcoords(mr_ctx *ctx, const joined *j)
{
	bool corners = false;

	for (size_t i = 0; i < j->n; i++)
		corners |= mr_layer_has(j->frames[i], j->layer, "corner_texcoord");
	for (size_t i = 0; corners && i < j->n; i++) {
		mr_frame *f = j->frames[i];
		if (mr_layer_has(f, j->layer, "texcoord") && mr_layer_has(f, j->layer, "triangles") &&
		    !mr_layer_has(f, j->layer, "corner_texcoord"))
			MR_TRY(put_at_corners(ctx, f, j->layer));
	}
	return MR_OK;
}

static mr_status
join_layer(mr_ctx *ctx, joined *j, mr_frame *out)
{
	MR_TRY(join_texcoords(ctx, j));
	for (size_t i = 0; i < j->n; i++)
		for (size_t k = 0; k < j->frames[i]->count; k++) {
			const mr_column *c = &j->frames[i]->columns[k];
			bool leave;
			if (strcmp(c->layer, j->layer) || came_before(j, i, c->name))
				continue;
			j->first = c;
			j->name = c->name;
			leave = is_of_one(j);
			if (!leave)
				MR_TRY(join_column(ctx, j, out, &leave));
			if (leave && !is_of_all_rows(j))
				mr_lost(ctx, j->layer, 1, j->name);
		}
	return MR_OK;
}

static bool
seen_before(const joined *j, size_t i, size_t k)
{
	for (size_t before = 0; before < i; before++)
		if (mr_frame_has_layer(j->frames[before], j->frames[i]->columns[k].layer))
			return true;
	return !mr_frame_begins_layer(j->frames[i], k);
}

static mr_status
pass_files(mr_ctx *ctx, const mr_frame *from, mr_frame *to)
{
	for (const mr_column *c = from->columns; c < from->columns + from->count; c++)
		if (mr_column_is_file(c) && !mr_frame_find(to, "", c->name))
			MR_TRY(mr_frame_pass(ctx, to, c));
	return MR_OK;
}

mr_status
mr_frames_append(mr_ctx *ctx, mr_frame *const *frames, size_t n, mr_frame **out)
{
	static const char *const texts[] = { "history", "findings", "latest" };
	joined j = { .frames = frames, .n = n };
	mr_frame *f;

	MR_TRY(mr_frame_new(ctx, frames[0]->name, &f));
	for (size_t i = 0; i < n; i++)
		for (size_t k = 0; k < frames[i]->count; k++) {
			j.layer = frames[i]->columns[k].layer;
			if (!seen_before(&j, i, k))
				MR_TRY(join_layer(ctx, &j, f));
		}
	for (size_t i = 0; i < n; i++)
		MR_TRY(pass_files(ctx, frames[i], f));
	j.layer = "";
	for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
		j.name = texts[i];
		MR_TRY(join_text(ctx, &j, f));
	}
	*out = f;
	return MR_OK;
}
