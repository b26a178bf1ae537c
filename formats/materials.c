/* MTL (Wavefront, "Advanced Visualizer", appendix B2): newmtl, Kd, Ke, d or Tr, map_Kd, and Pr, Pm and norm,
 * which others have added; the rest is for other programs. */
#include "formats/materials.h"

#include "formats/format.h"

#include <ctype.h>
#include <sys/stat.h>

typedef struct finder {
	mr_ctx *ctx;
	const char *folder;
	const char **name; /* of the model's materials: count + 1 starts */
	mr_material *list;
	size_t count;
	bool *known, *current; /* a file speaks of it; the statements at hand do */
	size_t files, wrong;   /* that are there; statements without their numbers */
} finder;

const mr_material mr_material_plain = { .opacity = 1, .roughness = 0.9 };

/* ---- files ---- */

static bool
is_file(const char *path)
{
	struct stat st;

	return stat(path, &st) == 0 && S_ISREG(st.st_mode);
}

/* The file that a path of the model's author leads to, as it stands where that is below the folder, or by its
 * last name; NULL where neither is there. */
static const char *
find_file(const finder *f, const char *name, size_t bytes)
{
	char *here = mr_format(f->ctx, "%.*s", (int)bytes, name);
	const char *last, *path;

	for (char *c = here; c && *c; c++)
		if (*c == '\\')
			*c = '/';
	path = here ? mr_format(f->ctx, "%s/%s", f->folder, here) : NULL;
	if (!path)
		return NULL;
	if (*here != '/' && !strstr(here, "..") && is_file(path))
		return path;
	last = strrchr(here, '/');
	path = last ? mr_format(f->ctx, "%s%s", f->folder, last) : NULL;
	return path && is_file(path) ? path : NULL;
}

/* ---- statements ---- */

/* Skips the options of a picture and their values: numbers, on, off, or the one word of -imfchan and -type.
 */
static void
skip_options(mr_scan *t)
{
	while (mr_skip_blanks(t), t->end - t->p > 1 && *t->p == '-' && isalpha((unsigned char)t->p[1])) {
		bool named = mr_scan_accept(t, "-imfchan") || mr_scan_accept(t, "-type");
		const char *w;
		size_t n;
		double x;
		mr_scan ahead;
		if (named || !mr_scan_word(t, &w, &n))
			mr_scan_word(t, &w, &n);
		for (ahead = *t;
		     mr_scan_word(&ahead, &w, &n) && (mr_word_is(w, n, "on") || mr_word_is(w, n, "off") ||
							 mr_real_read(w, w + n, &x) == w + n);)
			*t = ahead;
	}
}

static const char *
picture(finder *f, mr_scan *t)
{
	const char *found;

	skip_options(t);
	found = find_file(f, t->p, (size_t)(t->end - t->p));
	mr_tell(f->ctx, MR_MISSING, !found, "%.*s", (int)(t->end - t->p), t->p);
	return found;
}

/* Up to n numbers from 0 to 1; how many there are. */
static size_t
shares(mr_scan *t, double *x, size_t n)
{
	size_t i = 0;

	for (const char *e;
	     mr_skip_blanks(t), i < n && (e = mr_real_read(t->p, t->end, &x[i])) && isfinite(x[i]); i++) {
		x[i] = fmin(fmax(x[i], 0), 1);
		t->p = e;
	}
	return i;
}

/* One number is grey. */
static bool
set_color(mr_scan *t, double color[3])
{
	double x[3];
	size_t n = shares(t, x, 3);

	if (n == 1)
		x[1] = x[2] = x[0];
	if (n == 1 || n == 3)
		memcpy(color, x, sizeof x);
	return n == 1 || n == 3;
}

/* What a statement says of a material; false where it lacks its numbers. */
static bool
describe(finder *f, mr_material *m, mr_scan *t)
{
	double clear;

	if (mr_scan_accept(t, "Kd"))
		return set_color(t, m->color) && (m->colored = true);
	if (mr_scan_accept(t, "Ke"))
		return set_color(t, m->emission);
	if (mr_scan_accept(t, "Pr"))
		return shares(t, &m->roughness, 1);
	if (mr_scan_accept(t, "Pm"))
		return shares(t, &m->metal, 1);
	if (mr_scan_accept(t, "d"))
		return (void)mr_scan_accept(t, "-halo"), shares(t, &m->opacity, 1);
	if (mr_scan_accept(t, "Tr")) { /* the reverse, which some programs write as 1 for all */
		if (shares(t, &clear, 1) == 0)
			return false;
		m->opacity = m->opacity == 1 && clear < 1 ? 1 - clear : m->opacity;
	} else if (mr_scan_accept(t, "map_Kd"))
		m->file = picture(f, t);
	else if (mr_scan_accept(t, "norm") || mr_scan_accept(t, "map_Kn"))
		m->normals = picture(f, t);
	return true;
}

/* The last description of a name holds. */
static void
begin_material(finder *f, const mr_scan *t)
{
	size_t bytes = (size_t)(t->end - t->p);
	char *name = mr_alloc(f->ctx, bytes + 1, 1);

	bytes = mr_clean_name(name, t->p, bytes, false);
	for (size_t i = 0; i < f->count; i++) {
		f->current[i] = bytes && (size_t)(f->name[i + 1] - f->name[i]) == bytes + 1 &&
		                !memcmp(f->name[i], name, bytes);
		f->known[i] |= f->current[i];
		if (f->current[i])
			f->list[i] = mr_material_plain;
	}
}

static mr_status
statements(finder *f, const unsigned char *data, size_t size)
{
	mr_scan text, line;

	MR_ENTER(f->ctx);
	mr_as_text(f->ctx, &data, &size);
	if (size && memchr(data, 0, size))
		return mr_fail(f->ctx, MR_EFORMAT, "a zero byte: not a text file");
	memset(f->current, 0, f->count);
	text = mr_scan_of(f->ctx, data, size);
	while (mr_scan_line(&text, &line)) {
		while (line.end > line.p && mr_is_blank(line.end[-1]))
			line.end--;
		if (mr_scan_accept(&line, "newmtl")) {
			mr_skip_blanks(&line);
			begin_material(f, &line);
		}
		for (size_t i = 0; i < f->count; i++)
			f->wrong += f->current[i] && !describe(f, &f->list[i],
							 &(mr_scan){ f->ctx, line.start, line.p, line.end });
	}
	return MR_OK;
}

/* *there: whether there is such a file. */
static mr_status
read_library(finder *f, const char *name, size_t bytes, bool *there)
{
	const char *path = find_file(f, name, bytes);
	mr_file_bytes b = { 0 };

	*there = path != NULL;
	if (!path)
		return MR_OK;
	f->files++;
	MR_TRY(mr_file_bytes_read(f->ctx, path, &b));
	return mr_prefix(f->ctx, mr_file_bytes_end(f->ctx, &b, statements(f, b.data, b.size)), "%s", path);
}

/* A line names one file, whose name may have blanks in it, or several. */
static mr_status
read_libraries(finder *f, const char *line, size_t bytes)
{
	mr_scan words = { f->ctx, line, line, line + bytes };
	const char *name;
	size_t n;
	bool there;

	MR_TRY(read_library(f, line, bytes, &there));
	while (!there && mr_scan_word(&words, &name, &n)) {
		bool found;
		MR_TRY(read_library(f, name, n, &found));
		mr_tell(f->ctx, MR_MISSING, !found, "%.*s", (int)n, name);
	}
	return MR_OK;
}

/* The model's materials that no file speaks of. */
static void
say_unknown(const finder *f)
{
	size_t unknown = 0, first = 0;

	for (size_t i = f->count; i-- > 0;)
		if (!f->known[i] && f->name[i + 1] > f->name[i] + 1) {
			first = i;
			unknown++;
		}
	if (f->files)
		mr_tell(f->ctx, MR_MISSING, unknown, "material %.*s%s",
		    (int)(f->name[first + 1] - f->name[first]) - 1, f->name[first],
		    unknown > 1 ? ", and others," : "");
}

mr_status
mr_materials_find(mr_ctx *ctx, const mr_model *m, const char *folder, mr_material **list, size_t *count)
{
	finder f = { .ctx = ctx, .folder = folder };
	const char **library;
	size_t libraries = 0;

	*list = NULL;
	*count = 0;
	if (!m->material || !m->materials.text)
		return MR_OK;
	mr_lines_starts(ctx, m->materials, &f.name, &f.count);
	f.list = MR_NEW(ctx, f.count, mr_material);
	f.known = MR_NEW_ZERO(ctx, f.count, bool);
	f.current = MR_NEW_ZERO(ctx, f.count, bool);
	for (size_t i = 0; i < f.count; i++)
		f.list[i] = mr_material_plain;
	if (m->mtllib.bytes)
		mr_lines_starts(ctx, m->mtllib, &library, &libraries);
	for (size_t i = 0; i < libraries; i++)
		MR_TRY(read_libraries(&f, library[i], (size_t)(library[i + 1] - library[i]) - 1));
	mr_lost(ctx, NULL, f.wrong, "statements of materials");
	say_unknown(&f);
	*list = f.list;
	*count = f.count;
	return MR_OK;
}

/* A line names one file, or several. */
static bool
are_there(const finder *f, mr_scan line)
{
	bool there = find_file(f, line.p, (size_t)(line.end - line.p));
	const char *word;
	size_t n;

	if (there)
		return true;
	while (mr_scan_word(&line, &word, &n)) {
		there = find_file(f, word, n);
		if (!there)
			return false;
	}
	return there;
}

void
mr_libraries_missing(mr_ctx *ctx, const char *path, mr_lines files)
{
	mr_scan text = { ctx, files.text, files.text, files.bytes ? files.text + files.bytes : files.text },
		line;
	const char *slash = strrchr(path, '/');
	const finder f = { .ctx = ctx,
		.folder = slash ? mr_format(ctx, "%.*s", (int)(slash - path), path) : "." };

	while (strcmp(path, "-") && mr_scan_line(&text, &line))
		if (!are_there(&f, line))
			mr_tell(ctx, MR_MISSING, 1, "%.*s", (int)(line.end - line.p), line.p);
}
