/* MTL (Wavefront, "Advanced Visualizer", appendix B2): newmtl, Kd, map_Kd and disp, and norm, which others
 * have added; the rest is for other programs. */
#include "formats/materials.h"

#include "base/text_file.h"
#include "formats/scan.h"

#include <strings.h>
#include <sys/stat.h>

typedef struct finder {
	mr_ctx *ctx;
	const char *folder;
	const char **name; /* of the model's materials: count + 1 starts */
	mr_material *list;
	size_t count;
	size_t at; /* the material that the file speaks of; count: none of the model's */
} finder;

/* ---- files ---- */

static bool
is_file(const char *path)
{
	struct stat st;

	return stat(path, &st) == 0 && S_ISREG(st.st_mode);
}

/* Whether a path stays below the folder that it starts from. */
static bool
stays_below(const char *path)
{
	return *path != '/' && !strstr(path, "..");
}

/* The file that a path of the model's author leads to, as it stands or by its last name; NULL where neither
 * is there. */
static mr_status
find_file(const finder *f, const char *path, const char **found)
{
	char *here = mr_format(f->ctx, "%s", path), *last, *whole = NULL;

	if (!here)
		return MR_EMEM;
	for (char *c = here; *c; c++)
		if (*c == '\\')
			*c = '/';
	last = strrchr(here, '/');
	*found = NULL;
	if (stays_below(here) && !(whole = mr_format(f->ctx, "%s/%s", f->folder, here)))
		return MR_EMEM;
	if (last && !(whole && is_file(whole)) && !(whole = mr_format(f->ctx, "%s%s", f->folder, last)))
		return MR_EMEM;
	if (whole && is_file(whole))
		*found = whole;
	return MR_OK;
}

/* ---- statements ---- */

/* What stands behind the word that a line begins with; NULL where it begins with another. */
static const char *
behind(const char *line, const char *word)
{
	size_t n = strlen(word);

	if (strncasecmp(line, word, n) || (line[n] != ' ' && line[n] != '\t'))
		return NULL;
	return line + n + strspn(line + n, " \t");
}

static size_t
word_length(const char *s)
{
	return strcspn(s, " \t");
}

/* The file name behind the options of a map, whose values are numbers, "on" and "off". */
static const char *
behind_options(const char *s)
{
	bool option = false;

	for (;;) {
		size_t n = word_length(s);
		double x;
		bool value = option &&
		             (mr_real_read(s, s + n, &x) == s + n || (n == 2 && !strncmp(s, "on", 2)) ||
				 (n == 3 && !strncmp(s, "off", 3)));
		if (*s != '-' && !value)
			return s;
		option = true;
		if (s[n] == 0)
			return s + n;
		s += n + strspn(s + n, " \t");
	}
}

static void
new_material(finder *f, const char *name)
{
	size_t bytes = strlen(name);

	for (f->at = 0; f->at < f->count; f->at++) {
		const char *const *start = f->name + f->at;
		if (bytes > 0 && (size_t)(start[1] - start[0]) == bytes + 1 && !memcmp(start[0], name, bytes))
			return;
	}
}

/* One number is grey. */
static void
diffuse(mr_material *m, const char *s)
{
	const char *end = s + strlen(s);
	size_t n = 0;

	while (n < 3 && (s = mr_real_read(s, end, &m->color[n]))) {
		n++;
		s += strspn(s, " \t");
	}
	m->colored = n == 1 || n == 3;
	for (; n == 1 || n == 2; n++)
		m->color[n] = m->color[0];
	for (n = 0; n < 3; n++)
		m->color[n] = m->color[n] > 0 ? m->color[n] < 1 ? m->color[n] : 1 : 0;
}

/* to: the picture, of the material at hand. */
static mr_status
map(finder *f, const char *s, const char **to)
{
	const char *file = behind_options(s), *start = f->name[f->at];

	MR_TRY(find_file(f, file, to));
	if (!*to)
		mr_warn(f->ctx, "%.100s, the picture of material %.*s, is not in %s", file,
		    (int)(f->name[f->at + 1] - start) - 1, start, f->folder);
	return MR_OK;
}

/* Option -mm base gain. */
static void
modify(mr_material *m, const char *s)
{
	const char *file = behind_options(s), *p = strstr(s, "-mm ");
	double base, gain;

	m->base = 0;
	m->gain = 1;
	if (!p || p >= file || !(p = mr_real_read(p + 4, file, &base)))
		return;
	p += strspn(p, " \t");
	if (mr_real_read(p, file, &gain) && isfinite(base) && isfinite(gain)) {
		m->base = base;
		m->gain = gain;
	}
}

static mr_status
statement(finder *f, const char *line)
{
	mr_material *m;
	const char *rest;

	if ((rest = behind(line, "newmtl")))
		new_material(f, rest);
	if (f->at == f->count)
		return MR_OK;
	m = &f->list[f->at];
	if ((rest = behind(line, "Kd")))
		diffuse(m, rest);
	if ((rest = behind(line, "map_Kd")))
		MR_TRY(map(f, rest, &m->file));
	if ((rest = behind(line, "norm")) || (rest = behind(line, "map_Kn")))
		MR_TRY(map(f, rest, &m->normals));
	if ((rest = behind(line, "disp")) || (rest = behind(line, "map_disp"))) {
		modify(m, rest);
		MR_TRY(map(f, rest, &m->heights));
	}
	return MR_OK;
}

static mr_status
read_library(finder *f, const char *path)
{
	char **line;
	size_t n;

	MR_TRY(mr_lines_read(f->ctx, path, &line, &n));
	f->at = f->count;
	for (size_t i = 0; i < n; i++)
		MR_TRY(statement(f, line[i]));
	return MR_OK;
}

/* The file of a name of so many bytes; *there: whether it is. */
static mr_status
try_library(finder *f, const char *name, size_t bytes, bool *there)
{
	char *text = mr_format(f->ctx, "%.*s", (int)bytes, name);
	const char *path = NULL;

	if (!text)
		return MR_EMEM;
	MR_TRY(find_file(f, text, &path));
	*there = path != NULL;
	return path ? read_library(f, path) : MR_OK;
}

/* A line names one file, whose name may have blanks in it, or several. */
static mr_status
read_libraries(finder *f, const char *line, size_t bytes)
{
	const char *end = line + bytes;
	bool there;

	MR_TRY(try_library(f, line, bytes, &there));
	for (const char *p = line, *e; p < end && !there; p = e + 1) {
		bool found = true;
		e = memchr(p, ' ', (size_t)(end - p));
		e = e ? e : end;
		if (e > p)
			MR_TRY(try_library(f, p, (size_t)(e - p), &found));
		if (!found)
			mr_warn(f->ctx, "%.*s is not in %s: its materials are only names", (int)(e - p), p,
			    f->folder);
	}
	return MR_OK;
}

mr_status
mr_materials_find(mr_ctx *ctx, const mr_model *m, const char *folder, mr_material **list, size_t *count)
{
	finder f = { .ctx = ctx, .folder = folder };
	const char **library;
	size_t libraries;

	*list = NULL;
	*count = 0;
	if (!m->material || !m->materials.text)
		return MR_OK;
	MR_TRY(mr_lines_starts(ctx, m->materials, &f.name, &f.count));
	f.list = MR_NEW_ZERO(ctx, f.count, mr_material);
	if (!f.list)
		return MR_EMEM;
	if (m->mtllib.text && m->mtllib.bytes) {
		MR_TRY(mr_lines_starts(ctx, m->mtllib, &library, &libraries));
		for (size_t i = 0; i < libraries; i++)
			MR_TRY(read_libraries(&f, library[i], (size_t)(library[i + 1] - library[i]) - 1));
	}
	*list = f.list;
	*count = f.count;
	return MR_OK;
}
