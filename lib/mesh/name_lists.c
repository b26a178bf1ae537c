/* Lists of names, read and cut down. */
#include "mesh/name_lists.h"

#include "base/sort.h"

const mr_naming mr_namings[MR_NAMINGS] = {
	{ "group", "groups" },
	{ "object", "objects" },
	{ "material", "materials" },
};

void
mr_line_starts(mr_ctx *ctx, const char *text, size_t bytes, const char ***starts, size_t *count)
{
	const char *end = text + bytes, *p = text;
	const char **start;
	size_t n = 1;

	for (size_t i = 0; i < bytes; i++)
		n += text[i] == '\n';
	start = MR_NEW(ctx, n + 1, const char *);
	for (size_t i = 0; i < n; i++) {
		const char *e = p < end ? memchr(p, '\n', (size_t)(end - p)) : NULL;
		start[i] = p;
		p = e ? e + 1 : end + 1;
	}
	start[n] = end + 1;
	*starts = start;
	*count = n;
}

mr_status
mr_name_lists_of(mr_ctx *ctx, mr_frame *f, const char *layer, mr_name_lists *l)
{
	const void *text;
	size_t bytes;

	*l = (mr_name_lists){ 0 };
	for (size_t k = 0; k < MR_NAMINGS; k++)
		if (mr_layer_has(f, layer, mr_namings[k].list)) {
			MR_TRY(mr_layer_get(ctx, f, layer, mr_namings[k].list, &text, &bytes));
			mr_line_starts(ctx, text, bytes, &l->line[k], &l->count[k]);
		}
	return MR_OK;
}

/* The place of a number among the distinct ones. */
static uint32_t
place_of(const uint32_t *sorted, size_t count, uint32_t number)
{
	size_t low = 0, high = count;

	while (high - low > 1) {
		size_t middle = (low + high) / 2;
		*(sorted[middle] <= number ? &low : &high) = middle;
	}
	return (uint32_t)low;
}

static mr_status
put_list(mr_ctx *ctx, const char **line, const uint32_t *number, size_t n, mr_frame *f, const char *layer,
    const char *name)
{
	size_t bytes = 0;
	char *text, *to;

	for (size_t i = 0; i < n; i++)
		bytes += (size_t)(line[number[i] + 1] - line[number[i]]);
	text = to = MR_NEW(ctx, bytes, char);
	for (size_t i = 0; i < n; i++) {
		size_t length = (size_t)(line[number[i] + 1] - line[number[i]]) - 1;
		memcpy(to, line[number[i]], length);
		to[length] = '\n';
		to += length + 1;
	}
	return mr_frame_put(ctx, f, layer, name, (mr_shape){ '-', 't', 1 }, text, bytes - 1);
}

static mr_status
cut(mr_ctx *ctx, const char **line, size_t count, mr_naming name, mr_frame *f, const char *layer)
{
	const mr_shape shape = { 'f', 'u', 1 };
	uint32_t *used, *number;
	const void *before;
	size_t n, left;

	MR_TRY(mr_frame_get(ctx, f, layer, name.column, shape, &before, &n));
	used = MR_NEW(ctx, n, uint32_t);
	number = MR_NEW(ctx, n, uint32_t);
	memcpy(used, before, n * sizeof *used);
	memcpy(number, before, n * sizeof *number);
	left = mr_sort_unique(used, n);
	if (n == 0 || used[left - 1] >= count || left == count)
		return MR_OK;
	for (size_t i = 0; i < n; i++)
		number[i] = place_of(used, left, number[i]);
	MR_TRY(put_list(ctx, line, used, left, f, layer, name.list));
	return mr_frame_put(ctx, f, layer, name.column, shape, number, n);
}

mr_status
mr_name_lists_cut(mr_ctx *ctx, const mr_name_lists *l, mr_frame *part, const char *layer)
{
	for (size_t k = 0; k < MR_NAMINGS; k++)
		if (l->line[k] && mr_layer_has(part, layer, mr_namings[k].column))
			MR_TRY(cut(ctx, l->line[k], l->count[k], mr_namings[k], part, layer));
	return MR_OK;
}
