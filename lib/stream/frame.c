/* Columns by name, in their order; values decoded and verified when they are asked for. */
#include "stream/frame.h"

#include "base/text.h"
#include "stream/stored.h"

#include <math.h>

enum { ROOM = 16 };

static const mr_shape TEXT = { '-', 't', 1 };

mr_status
mr_frame_new(mr_ctx *ctx, const char *name, mr_frame **frame)
{
	mr_frame *f;
	char *copy;

	MR_ENTER(ctx);
	if (!mr_frame_name_valid(name, strlen(name)))
		return mr_fail(ctx, MR_ERANGE, "a frame cannot be called '%s'", name);
	f = MR_NEW(ctx, 1, mr_frame);
	copy = mr_format(ctx, "%s", name);
	*f = (mr_frame){ .name = copy, .key = true, .columns = MR_NEW(ctx, ROOM, mr_column), .room = ROOM };
	*frame = f;
	return MR_OK;
}

void
mr_frame_copy(mr_ctx *ctx, const mr_frame *frame, mr_frame *copy)
{
	mr_column *columns = MR_NEW(ctx, frame->count + ROOM, mr_column);

	if (frame->count)
		memcpy(columns, frame->columns, frame->count * sizeof *columns);
	*copy = *frame;
	copy->columns = columns;
	copy->room = frame->count + ROOM;
}

void
mr_frame_finish(mr_frame *frame, const mr_frame *copy, void *result, const void *found, size_t bytes)
{
	*frame = *copy;
	if (result)
		memcpy(result, found, bytes);
}

static mr_column *
find(const mr_frame *f, const char *layer, const char *name)
{
	for (mr_column *c = f->columns; c < f->columns + f->count; c++)
		if (!strcmp(c->name, name) && !strcmp(c->layer, layer))
			return c;
	return NULL;
}

const mr_column *
mr_frame_find(const mr_frame *frame, const char *layer, const char *name)
{
	return frame->count ? find(frame, layer, name) : NULL;
}

const char *
mr_frame_name(const mr_frame *frame)
{
	return frame->name;
}

bool
mr_frame_column(
    const mr_frame *frame, size_t i, const char **layer, const char **name, mr_shape *shape, uint64_t *rows)
{
	const mr_column *c = frame->columns + i;

	if (i >= frame->count)
		return false;
	if (layer)
		*layer = c->layer;
	if (name)
		*name = c->name;
	if (shape)
		*shape = c->shape;
	if (rows)
		*rows = c->rows;
	return true;
}

bool
mr_frame_has_layer(const mr_frame *frame, const char *layer)
{
	for (size_t i = 0; i < frame->count; i++)
		if (!strcmp(frame->columns[i].layer, layer))
			return true;
	return false;
}

mr_status
mr_frame_get(mr_ctx *ctx, mr_frame *frame, const char *layer, const char *name, mr_shape shape,
    const void **data, size_t *rows)
{
	mr_column *c = frame->count ? find(frame, layer, name) : NULL;

	if (!c)
		return mr_fail(ctx, MR_EMISSING, "%s%sno column %s", layer, *layer ? ": " : "", name);
	if (!mr_same_shape(c->shape, shape))
		return mr_fail(ctx, MR_EMISSING, "%s%scolumn %s is %c %c%u, not %c %c%u", layer,
		    *layer ? ": " : "", name, c->shape.element, c->shape.type, c->shape.components,
		    shape.element, shape.type, shape.components);
	MR_TRY(mr_column_decode(ctx, c));
	*data = c->data;
	*rows = (size_t)c->rows;
	return MR_OK;
}

static mr_status
inflate_stored(mr_ctx *ctx, mr_stored *s)
{
	MR_ENTER(ctx);
	if (!s->inflated)
		s->inflated = mr_heap(ctx, NULL, (size_t)s->head.size);
	if (!s->inflated)
		return MR_EMEM;
	MR_TRY(mr_prefix(ctx, mr_unpack(ctx, &s->head, s->payload, s->inflated), "byte %llu",
	    (unsigned long long)s->offset));
	s->data = s->inflated;
	return MR_OK;
}

mr_status
mr_column_decode(mr_ctx *ctx, mr_column *column)
{
	mr_stored *s = column->stored;

	if (column->data)
		return MR_OK;
	if (!s->data) {
		if (s->head.codec == MR_PACKED)
			MR_TRY(inflate_stored(ctx, s));
		else
			s->data = s->payload;
	}
	column->data = s->data;
	return MR_OK;
}

double
mr_column_number(const mr_column *c, size_t row)
{
	double length = 0, x = 0;

	for (size_t k = 0; k < c->shape.components; k++) {
		size_t i = row * c->shape.components + k;
		x = c->shape.type == 'd'   ? ((const double *)c->data)[i]
		    : c->shape.type == 'u' ? ((const uint32_t *)c->data)[i]
		                           : ((const unsigned char *)c->data)[i];
		length = hypot(length, x);
	}
	return c->shape.components == 1 ? x : length;
}

/* A new column at the end; its fields are the caller's to set. */
static mr_status
append(mr_ctx *ctx, mr_frame *f, mr_column **column)
{
	if (f->count == MR_FRAME_COLUMNS)
		return mr_fail(ctx, MR_ERANGE, "a frame has no more than %d columns", MR_FRAME_COLUMNS);
	MR_RESERVE(ctx, f->columns, f->count, 1, &f->room);
	*column = &f->columns[f->count++];
	return MR_OK;
}

mr_status
mr_frame_put(mr_ctx *ctx, mr_frame *frame, const char *layer, const char *name, mr_shape shape,
    const void *data, size_t rows)
{
	static const double nothing;
	mr_column *c, put = { .shape = shape, .rows = rows, .data = data ? data : &nothing };
	uint64_t size;

	MR_ENTER(ctx);
	if (*layer && !mr_name_valid(layer, MR_LAYER_MAX))
		return mr_fail(ctx, MR_ERANGE, "a layer cannot be called '%s'", layer);
	if (!mr_name_valid(name, MR_COLUMN_MAX))
		return mr_fail(ctx, MR_ERANGE, "a column cannot be called '%s'", name);
	if (!mr_shape_size(shape, rows, &size) || size > SIZE_MAX / 2)
		return mr_fail(ctx, MR_ERANGE, "%s: column %s: no such shape: %c %c%u, %zu rows", layer, name,
		    shape.element, shape.type, shape.components, rows);
	snprintf(put.layer, sizeof put.layer, "%s", layer);
	snprintf(put.name, sizeof put.name, "%s", name);
	c = frame->count ? find(frame, layer, name) : NULL;
	if (c && c->data == data && c->rows == rows && mr_same_shape(c->shape, shape))
		return MR_OK; /* what was read is put back: it stays as it is stored */
	if (!c)
		MR_TRY(append(ctx, frame, &c));
	*c = put;
	return MR_OK;
}

mr_status
mr_frame_pass(mr_ctx *ctx, mr_frame *frame, const mr_column *column)
{
	mr_column *c = NULL;

	if (mr_frame_find(frame, column->layer, column->name))
		return mr_fail(ctx, MR_ERANGE, "%s%scolumn %s is there already", column->layer,
		    *column->layer ? ": " : "", column->name);
	MR_TRY(append(ctx, frame, &c));
	*c = *column;
	return MR_OK;
}

mr_status
mr_frame_keep(mr_ctx *ctx, mr_ctx *keep, mr_frame *frame, mr_frame **copy)
{
	mr_frame *f;

	MR_TRY(mr_frame_new(keep, frame->name, &f));
	for (mr_column *c = frame->columns; c < frame->columns + frame->count; c++) {
		size_t width = mr_type_size(c->shape.type) * c->shape.components;
		void *data = mr_alloc(keep, (size_t)c->rows, width);
		MR_TRY(mr_column_decode(ctx, c));
		memcpy(data, c->data, (size_t)c->rows * width);
		MR_TRY(mr_frame_put(keep, f, c->layer, c->name, c->shape, data, (size_t)c->rows));
	}
	*copy = f;
	return MR_OK;
}

void
mr_frame_drop(mr_frame *frame, const char *layer, const char *name, char element)
{
	size_t kept = 0;

	for (size_t i = 0; i < frame->count; i++) {
		const mr_column *c = &frame->columns[i];
		bool there = layer ? !strcmp(c->layer, layer) : *c->layer != 0;
		if (!there || (name && strcmp(c->name, name)) || (element && c->shape.element != element))
			frame->columns[kept++] = *c;
	}
	frame->count = kept;
}

mr_status
mr_frame_lines(mr_ctx *ctx, mr_frame *frame, const char *name, const char **text, size_t *n)
{
	const void *data = "";

	*n = 0;
	if (mr_frame_find(frame, "", name))
		MR_TRY(mr_frame_get(ctx, frame, "", name, TEXT, &data, n));
	*text = data;
	return MR_OK;
}

bool
mr_frame_begins_layer(const mr_frame *frame, size_t i)
{
	for (size_t k = 0; k < i; k++)
		if (!strcmp(frame->columns[k].layer, frame->columns[i].layer))
			return false;
	return *frame->columns[i].layer;
}

mr_status
mr_frame_add_history(mr_ctx *ctx, mr_frame *frame, const char *line)
{
	mr_text text = { .ctx = ctx };
	const char *lines;
	size_t n;

	MR_TRY(mr_frame_lines(ctx, frame, "history", &lines, &n));
	mr_text_bytes(&text, lines, n);
	if (n && lines[n - 1] != '\n')
		mr_text_bytes(&text, "\n", 1);
	mr_text_line(&text, line, strlen(line));
	mr_text_bytes(&text, "\n", 1);
	return mr_frame_put(ctx, frame, "", "history", TEXT, text.s, text.n);
}

static mr_status
merge_lines(mr_ctx *ctx, mr_frame *frame, mr_frame *from, const char *name)
{
	mr_text text = { .ctx = ctx };
	const char *lines;
	size_t n;

	MR_TRY(mr_frame_lines(ctx, frame, name, &lines, &n));
	mr_text_bytes(&text, lines, n);
	MR_TRY(mr_frame_lines(ctx, from, name, &lines, &n));
	mr_text_bytes(&text, lines, n);
	return mr_frame_put(ctx, frame, "", name, TEXT, text.s, text.n);
}

mr_status
mr_frame_merge(mr_ctx *ctx, mr_frame *frame, mr_frame *from)
{
	for (size_t i = 0; i < from->count; i++)
		if (*from->columns[i].layer && mr_frame_has_layer(frame, from->columns[i].layer))
			return mr_fail(ctx, MR_ERANGE, "layer %s is there already", from->columns[i].layer);
	for (size_t i = 0; i < from->count; i++) {
		const mr_column *c = &from->columns[i];
		bool joined = !*c->layer && (!strcmp(c->name, "history") || !strcmp(c->name, "findings") ||
						!strcmp(c->name, "latest")); /* sorted, one after another */
		if (mr_column_is_file(c) && mr_frame_find(frame, "", c->name))
			continue;
		MR_TRY(joined ? merge_lines(ctx, frame, from, c->name) : mr_frame_pass(ctx, frame, c));
	}
	return MR_OK;
}

mr_status
mr_frame_check_rows(mr_ctx *ctx, const mr_frame *frame, mr_status status)
{
	for (size_t i = 0; i < frame->count; i++) {
		const mr_column *c = &frame->columns[i], *first = frame->columns;
		if (c->shape.element == '-')
			continue;
		while (first->shape.element != c->shape.element || strcmp(first->layer, c->layer))
			first++;
		if (first->rows != c->rows)
			return mr_fail(ctx, status,
			    "%s: column %s has %llu rows, but %s, also of element %c, has %llu", c->layer,
			    c->name, (unsigned long long)c->rows, first->name, c->shape.element,
			    (unsigned long long)first->rows);
	}
	return MR_OK;
}
