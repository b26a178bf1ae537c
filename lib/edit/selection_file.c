/* Regions as a text: read, and given to a mesh that has the same triangles. */
#include "edit/selection_file.h"

#include "base/text_file.h"

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

static mr_status
parse_head(mr_ctx *ctx, const char *line, mr_selection_file *file)
{
	static const char magic[] = "mr-selection 1 ";
	const char *at = line + sizeof magic - 1;
	size_t n = strncmp(line, magic, sizeof magic - 1) ? 0 : strcspn(at, " ");
	char *end = NULL;

	if (n > 0 && n < sizeof file->layer) {
		memcpy(file->layer, at, n);
		file->layer[n] = '\0';
		file->nv = strtoull(at + n, &end, 10);
		file->nf = strtoull(end, &end, 10);
		file->checksum = (uint32_t)strtoul(end, &end, 16);
	}
	if (!end || *end)
		return mr_fail(ctx, MR_EFORMAT,
		    "%s:1: no selection: its first line is mr-selection 1 LAYER VERTICES FACES CHECKSUM",
		    file->path);
	return MR_OK;
}

/* "fixed", "free" or "handle N", and a blank. */
static bool
take_region(const char **at, uint32_t *region)
{
	static const char *const words[] = { "fixed", "free", "handle" };
	uint64_t handle = 0;

	for (uint32_t r = 0; r <= MR_REGION_HANDLE; r++) {
		size_t n = strlen(words[r]);
		if (strncmp(*at, words[r], n))
			continue;
		*at += n + strspn(*at + n, " \t");
		if (r == MR_REGION_HANDLE && !mr_whole(at, 65535, &handle))
			return false;
		*region = r + (uint32_t)handle;
		return strchr(" \t", (*at)[r == MR_REGION_HANDLE ? 0 : -1]) != NULL;
	}
	return false;
}

/* A region, and vertices, "V", or ranges of them, "V-W". */
static mr_status
parse_line(mr_ctx *ctx, const char *line, size_t number, mr_selection_file *file)
{
	const char *at = line;
	uint32_t region;
	uint64_t first, last;

	if (!take_region(&at, &region))
		return mr_fail(ctx, MR_EFORMAT,
		    "%s:%zu: '%.40s' is not fixed, free, or handle and its number up to 65535, and vertices",
		    file->path, number, line);
	for (at += strspn(at, " \t"); *at; at += strspn(at, " \t")) {
		const char *word = at;
		bool good = mr_whole(&at, MR_NONE, &first);
		last = first;
		if (good && *at == '-')
			good = (at++, mr_whole(&at, MR_NONE, &last));
		if (!good || !strchr(" \t", *at) || first > last || last >= file->nv)
			return mr_fail(ctx, MR_EFORMAT,
			    "%s:%zu: '%.40s' does not begin with a vertex, of %llu from 0, or a range as "
			    "3-17",
			    file->path, number, word, (unsigned long long)file->nv);
		for (; first <= last; first++) {
			if (file->region[first] != MR_NONE)
				return mr_fail(ctx, MR_EFORMAT,
				    "%s:%zu: vertex %llu has a region already, from this line or another",
				    file->path, number, (unsigned long long)first);
			file->region[first] = region;
		}
	}
	return MR_OK;
}

mr_status
mr_selection_file_read(mr_ctx *ctx, const char *path, mr_selection_file *file)
{
	const uint64_t most = 1 << 28; /* vertices: a line can ask for as much memory as that takes, 1 GB */
	char **line;
	size_t n;

	*file = (mr_selection_file){ .path = path };
	MR_TRY(mr_lines_read(ctx, path, &line, &n));
	MR_TRY(parse_head(ctx, line[0], file));
	if (file->nv > most)
		return mr_fail(ctx, MR_EFORMAT, "%s:1: %llu vertices, and %llu are the most", path,
		    (unsigned long long)file->nv, (unsigned long long)most);
	file->region = MR_NEW(ctx, file->nv, uint32_t);
	memset(file->region, 0xff, file->nv * sizeof *file->region);
	for (size_t i = 1; i < n; i++)
		if (*line[i])
			MR_TRY(parse_line(ctx, line[i], i + 1, file));
	return MR_OK;
}

static mr_status
check_model(mr_ctx *ctx, const mr_selection_file *file, const mr_mesh *m)
{
	if (strcmp(file->layer, m->name))
		return mr_fail(
		    ctx, MR_EMESH, "%s has regions of %s, not of %s", file->path, file->layer, m->name);
	if (file->nv != m->nv || file->nf != m->nf || file->checksum != checksum_of(m))
		return mr_fail(ctx, MR_EMESH,
		    "%s is of another model, of %llu vertices and %llu faces of checksum %08lx: %s has %zu "
		    "and %zu of %08lx",
		    file->path, (unsigned long long)file->nv, (unsigned long long)file->nf,
		    (unsigned long)file->checksum, m->name, m->nv, m->nf, (unsigned long)checksum_of(m));
	return MR_OK;
}

mr_status
mr_selection_file_apply(
    mr_ctx *ctx, const mr_selection_file *file, const mr_mesh *m, uint32_t *region, size_t *selected)
{
	MR_TRY(check_model(ctx, file, m));
	*selected = 0;
	for (size_t v = 0; v < m->nv; v++)
		if (file->region[v] != MR_NONE) {
			region[v] = file->region[v];
			++*selected;
		}
	return MR_OK;
}
