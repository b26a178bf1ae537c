/* Lists of names. */
#include "mesh/name_lists.h"

const mr_naming mr_namings[MR_NAMINGS] = {
	{ "group", "groups" },
	{ "object", "objects" },
	{ "material", "materials" },
};

const char *
mr_names_of(const char *column)
{
	for (size_t i = 0; i < MR_NAMINGS; i++)
		if (!strcmp(mr_namings[i].column, column))
			return mr_namings[i].list;
	return NULL;
}

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
