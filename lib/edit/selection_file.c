/* Regions as a text: read, and given to a mesh that has the same triangles. */
#include "edit/selection_file.h"

#include "base/text_file.h"

#include <errno.h>

enum { VERSION = 1 };

/* FNV-1a (Fowler, Noll, Vo 1991), a corner at a time: a page and a script have it in a line as well. */
static uint32_t
checksum_of(const mr_mesh *m)
{
	uint32_t sum = 2166136261u;

	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++)
			sum = (sum ^ m->t[f].v[k]) * 16777619u;
	return sum;
}

/* The next word of the line, of n bytes; NULL behind the last. */
static const char *
next_word(const char **at, size_t *n)
{
	const char *word = *at + strspn(*at, " \t");

	*n = strcspn(word, " \t");
	*at = word + *n;
	return *n ? word : NULL;
}

static bool
is_word(const char *word, size_t n, const char *wanted)
{
	return word && n == strlen(wanted) && !strncmp(word, wanted, n);
}

/* Takes a whole number that is a word of the line. */
static bool
take_number(const char **at, uint64_t most, uint64_t *x)
{
	const char *word;
	size_t n;

	word = next_word(at, &n);
	return word && mr_whole(&word, most, x) && word == *at;
}

/* Eight hexadecimal digits, the last word of the line. */
static bool
take_checksum(const char **at, uint32_t *sum)
{
	size_t n;
	const char *word = next_word(at, &n);

	if (n != 8 || strspn(word, "0123456789abcdef") != 8 || **at)
		return false;
	*sum = (uint32_t)strtoul(word, NULL, 16);
	return true;
}

static mr_status
parse_head(mr_ctx *ctx, const char *line, mr_selection_file *file)
{
	const char *at = line, *layer;
	uint64_t version;
	size_t n;

	layer = next_word(&at, &n);
	if (!is_word(layer, n, "mr-selection"))
		return mr_fail(ctx, MR_EFORMAT,
		    "%s:1: no selection: its first line is mr-selection 1 LAYER VERTICES FACES CHECKSUM",
		    file->path);
	if (!take_number(&at, UINT32_MAX, &version) || version != VERSION)
		return mr_fail(ctx, MR_EFORMAT, "%s:1: '%.40s' is not version %d, which this tool reads",
		    file->path, line, VERSION);
	layer = next_word(&at, &n);
	if (!layer || n > MR_LAYER_MAX)
		return mr_fail(ctx, MR_EFORMAT, "%s:1: the layer is missing or longer than %d bytes",
		    file->path, MR_LAYER_MAX);
	memcpy(file->layer, layer, n);
	if (!take_number(&at, MR_NONE, &file->nv) || !take_number(&at, MR_NONE, &file->nf) ||
	    !take_checksum(&at, &file->checksum))
		return mr_fail(ctx, MR_EFORMAT,
		    "%s:1: the layer's name is not followed by vertices, faces and a checksum of 8 digits",
		    file->path);
	return MR_OK;
}

/* "fixed", "free" or "handle N". */
static bool
take_region(const char **at, uint32_t *region)
{
	uint64_t handle;
	size_t n;
	const char *word = next_word(at, &n);

	*region = is_word(word, n, "free") ? MR_REGION_FREE : MR_REGION_FIXED;
	if (is_word(word, n, "free") || is_word(word, n, "fixed"))
		return true;
	if (!is_word(word, n, "handle") || !take_number(at, 65535, &handle))
		return false;
	*region = MR_REGION_HANDLE + (uint32_t)handle;
	return true;
}

/* "V" or "V-W". */
static mr_status
parse_range(mr_ctx *ctx, const mr_selection_file *file, const char *word, size_t n, mr_selection_range *r)
{
	const char *at = word;
	uint64_t first, last;
	bool good = mr_whole(&at, MR_NONE, &first);

	last = first;
	if (good && at < word + n && *at == '-')
		good = (at++, mr_whole(&at, MR_NONE, &last));
	if (!good || at != word + n || first > last)
		return mr_fail(ctx, MR_EFORMAT, "%s:%zu: '%.*s' is neither a vertex nor a range as 3-17",
		    file->path, r->line, (int)(n < 40 ? n : 40), word);
	if (last >= file->nv)
		return mr_fail(ctx, MR_EFORMAT, "%s:%zu: vertex %llu of %llu, which are counted from 0",
		    file->path, r->line, (unsigned long long)last, (unsigned long long)file->nv);
	r->first = (uint32_t)first;
	r->last = (uint32_t)last;
	return MR_OK;
}

static mr_status
parse_line(mr_ctx *ctx, const char *line, size_t number, mr_selection_file *file, size_t *room)
{
	mr_selection_range r = { .line = number };
	const char *at = line, *word;
	size_t n, before = file->n;

	if (!take_region(&at, &r.region))
		return mr_fail(ctx, MR_EFORMAT,
		    "%s:%zu: '%.40s' does not begin with fixed, free, or handle and its number up to 65535",
		    file->path, number, line);
	while ((word = next_word(&at, &n))) {
		MR_TRY(parse_range(ctx, file, word, n, &r));
		MR_TRY(MR_RESERVE(ctx, file->range, file->n, 1, room));
		file->range[file->n++] = r;
	}
	return file->n > before
	           ? MR_OK
	           : mr_fail(ctx, MR_EFORMAT, "%s:%zu: '%.40s' has no vertex", file->path, number, line);
}

mr_status
mr_selection_file_read(mr_ctx *ctx, const char *path, mr_selection_file *file)
{
	size_t n, room = 0;
	char **line;

	*file = (mr_selection_file){ .path = path };
	MR_TRY(mr_lines_read(ctx, path, &line, &n));
	MR_TRY(parse_head(ctx, line[0], file));
	for (size_t i = 1; i < n; i++)
		if (*line[i])
			MR_TRY(parse_line(ctx, line[i], i + 1, file, &room));
	if (file->n == 0)
		return mr_fail(ctx, MR_EFORMAT, "%s: no line gives a vertex a region", path);
	return MR_OK;
}

static mr_status
check_model(mr_ctx *ctx, const mr_selection_file *file, const mr_mesh *m)
{
	if (strcmp(file->layer, m->name))
		return mr_fail(
		    ctx, MR_EMESH, "%s has regions of %s, not of %s", file->path, file->layer, m->name);
	if (file->nv != m->nv || file->nf != m->nf)
		return mr_fail(ctx, MR_EMESH,
		    "%s is of another model: of %llu vertices and %llu faces, where %s has %zu and %zu",
		    file->path, (unsigned long long)file->nv, (unsigned long long)file->nf, m->name, m->nv,
		    m->nf);
	if (file->checksum != checksum_of(m))
		return mr_fail(ctx, MR_EMESH,
		    "%s is of another model: the %zu faces of %s have other corners, their checksum is %08lx",
		    file->path, m->nf, m->name, (unsigned long)checksum_of(m));
	return MR_OK;
}

mr_status
mr_selection_file_apply(
    mr_ctx *ctx, const mr_selection_file *file, const mr_mesh *m, uint32_t *region, size_t *selected)
{
	bool *given;

	MR_TRY(check_model(ctx, file, m));
	given = MR_NEW_ZERO(ctx, m->nv, bool);
	if (!given)
		return MR_EMEM;
	*selected = 0;
	for (size_t i = 0; i < file->n; i++)
		for (size_t v = file->range[i].first; v <= file->range[i].last; v++) {
			if (given[v])
				return mr_fail(ctx, MR_EFORMAT,
				    "%s:%zu: vertex %zu has a region already, from this line or another",
				    file->path, file->range[i].line, v);
			given[v] = true;
			region[v] = file->range[i].region;
			++*selected;
		}
	return MR_OK;
}
