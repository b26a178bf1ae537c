/* MTL (Wavefront, "Advanced Visualizer", appendix B2): newmtl, Kd, Ke, d or Tr, map_Kd, and Pr, Pm and norm,
 * which others have added; the rest is for other programs. */
#include "formats/materials.h"

#include "base/name_table.h"
#include "formats/filename.h"
#include "formats/format.h"
#include "mesh/name_lists.h"

#include <sys/stat.h>

typedef struct finder {
	mr_ctx *ctx;
	const mr_model *model;
	const char *folder;  /* or NULL */
	mr_name_table names; /* of the model's materials */
	mr_material *list,
	    *current;        /* current: that the statements at hand speak of; NULL: none of the model's */
	bool *known;         /* a file speaks of it */
	size_t files, wrong; /* that are there; statements without their numbers */
} finder;

const mr_material mr_material_plain = { .opacity = 1, .roughness = 0.9 };

/* ---- files ---- */

static bool
is_file(const char *path)
{
	struct stat st;

	return stat(path, &st) == 0 && S_ISREG(st.st_mode);
}

const char *
mr_file_in(mr_ctx *ctx, const char *folder, const char *name, size_t bytes)
{
	char *here = mr_format(ctx, "%.*s", (int)bytes, name);
	const char *last, *path;

	for (char *c = here; *c; c++)
		if (*c == '\\')
			*c = '/';
	path = mr_format(ctx, "%s/%s", folder, here);
	if (*here != '/' && !strstr(here, "..") && is_file(path))
		return path;
	last = strrchr(here, '/');
	path = last ? mr_format(ctx, "%s%s", folder, last) : NULL;
	return path && is_file(path) ? path : NULL;
}

const char *
mr_file_beside(mr_ctx *ctx, const char *model, const char *name, size_t bytes)
{
	const char *slash = strrchr(model, '/');

	if (!*model || !strcmp(model, "-"))
		return NULL;
	return mr_file_in(
	    ctx, slash ? mr_format(ctx, "%.*s", (int)(slash - model), model) : ".", name, bytes);
}

mr_file
mr_file_attached(const mr_model *m, const char *name, size_t bytes)
{
	for (size_t i = 0; i < m->files; i++)
		if (strlen(m->file[i].name) == bytes && !memcmp(m->file[i].name, name, bytes))
			return m->file[i];
	return (mr_file){ 0 };
}

static mr_file
find_file(const finder *f, const char *name, size_t bytes)
{
	mr_file file = { .name = f->folder ? mr_file_in(f->ctx, f->folder, name, bytes) : NULL };

	return file.name ? file : mr_file_attached(f->model, name, bytes);
}

/* ---- statements ---- */

/* After options only the last word is the picture's name. */
static mr_file
picture(finder *f, mr_scan *t)
{
	const char *last;
	mr_file found;
	size_t n;

	mr_skip_blanks(t);
	if (t->p < t->end && *t->p == '-')
		for (mr_scan ahead = *t; mr_scan_word(&ahead, &last, &n);)
			t->p = last;
	found = find_file(f, t->p, (size_t)(t->end - t->p));
	mr_tell(f->ctx, MR_MISSING, !found.name, "%.*s", (int)(t->end - t->p), t->p);
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

/* The value that a statement gives a material; false where it lacks its numbers. */
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
		return shares(t, &m->opacity, 1);
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
begin_material(finder *f, const mr_scan *t, size_t count)
{
	size_t bytes = (size_t)(t->end - t->p), i;
	char *name = mr_alloc(f->ctx, bytes + 1, 1);

	bytes = mr_clean_name(name, t->p, bytes, false);
	i = mr_name_number(f->ctx, &f->names, name, bytes);
	f->current = bytes && i < count ? &f->list[i] : NULL;
	if (f->current) {
		*f->current = mr_material_plain;
		f->known[i] = true;
	}
}

static mr_status
statements(finder *f, size_t count, const unsigned char *data, size_t size)
{
	mr_scan text, line;

	MR_ENTER(f->ctx);
	mr_skip_mark(&data, &size);
	if (size && memchr(data, 0, size))
		return mr_fail(f->ctx, MR_EFORMAT, "a zero byte: not a text file");
	f->current = NULL;
	text = mr_scan_of(f->ctx, data, size);
	while (mr_scan_line(&text, &line)) {
		while (line.end > line.p && mr_is_blank(line.end[-1]))
			line.end--;
		if (mr_scan_accept(&line, "newmtl")) {
			mr_skip_blanks(&line);
			begin_material(f, &line, count);
		} else if (f->current)
			f->wrong += !describe(f, f->current, &line);
	}
	return MR_OK;
}

static mr_status
read_library(finder *f, size_t count, const mr_file *file)
{
	mr_file_bytes b = { 0 };

	f->files++;
	MR_TRY(mr_file_read(f->ctx, file, &b));
	return mr_prefix(
	    f->ctx, mr_file_bytes_end(&b, statements(f, count, b.data, b.size)), "%s", file->name);
}

/* A line names one file, whose name may have blanks in it. */
static mr_status
read_libraries(finder *f, size_t count, mr_lines files)
{
	mr_scan text = mr_scan_of(f->ctx, (const unsigned char *)files.text, files.bytes), line;

	while (mr_scan_line(&text, &line)) {
		mr_file file = find_file(f, line.p, (size_t)(line.end - line.p));
		if (file.name)
			MR_TRY(read_library(f, count, &file));
		mr_tell(
		    f->ctx, MR_MISSING, f->folder && !file.name, "%.*s", (int)(line.end - line.p), line.p);
	}
	return MR_OK;
}

/* The model's materials that no file speaks of. */
static void
say_unknown(const finder *f, const char *const *name, size_t count)
{
	size_t unknown = 0, first = 0;

	for (size_t i = count; i-- > 0;)
		if (!f->known[i] && name[i + 1] > name[i] + 1) {
			first = i;
			unknown++;
		}
	if (f->files)
		mr_tell(f->ctx, MR_MISSING, unknown, "material %.*s%s",
		    (int)(name[first + 1] - name[first]) - 1, name[first],
		    unknown > 1 ? ", and others," : "");
}

mr_status
mr_materials_find(mr_ctx *ctx, const mr_model *m, const char *folder, mr_material **list, size_t *count)
{
	finder f = { .ctx = ctx, .model = m, .folder = folder };
	const char **name;

	*list = NULL;
	*count = 0;
	if (!m->material || !m->materials.text)
		return MR_OK;
	mr_line_starts(ctx, m->materials.text, m->materials.bytes, &name, count);
	f.list = MR_NEW(ctx, *count, mr_material);
	f.known = MR_NEW_ZERO(ctx, *count, bool);
	for (size_t i = 0; i < *count; i++) {
		f.list[i] = mr_material_plain;
		mr_name_add(ctx, &f.names, name[i], (size_t)(name[i + 1] - name[i]) - 1);
	}
	MR_TRY(read_libraries(&f, *count, m->mtllib));
	mr_lost(ctx, NULL, f.wrong, "statements of materials");
	say_unknown(&f, name, *count);
	*list = f.list;
	return MR_OK;
}

static void
put_numbers(mr_text *t, const char *word, const double *x, int n)
{
	mr_text_add(t, "%s", word);
	for (int i = 0; i < n; i++)
		mr_text_add(t, " %.9g", x[i]);
	mr_text_add(t, "\n");
}

void
mr_material_put(mr_text *t, const char *name, const mr_material *m)
{
	mr_text_add(t, "newmtl %s\n", name);
	if (m->colored)
		put_numbers(t, "Kd", m->color, 3);
	if (m->emission[0] > 0 || m->emission[1] > 0 || m->emission[2] > 0)
		put_numbers(t, "Ke", m->emission, 3);
	if (m->opacity < 1)
		put_numbers(t, "d", &m->opacity, 1);
	if (m->roughness != mr_material_plain.roughness)
		put_numbers(t, "Pr", &m->roughness, 1);
	if (m->metal > 0)
		put_numbers(t, "Pm", &m->metal, 1);
	if (m->file.name)
		mr_text_add(t, "map_Kd %s\n", m->file.name);
	if (m->normals.name)
		mr_text_add(t, "norm %s\n", m->normals.name);
}

/* ---- written ---- */

static const char MARK[] = "# by mr\n";

bool
mr_may_replace(const char *path, const void *data, size_t size)
{
	const unsigned char *p = data, *end = p + size;
	FILE *file = is_file(path) ? fopen(path, "rb") : NULL;
	int c = file ? getc(file) : EOF;
	bool may = c == EOF;

	while (c != EOF && p < end && c == *p) {
		c = getc(file);
		p++;
	}
	if (file)
		fclose(file);
	return may || p == end;
}

mr_status
mr_library_check(mr_ctx *ctx, const char *name, bool *own)
{
	const char *path = mr_format(ctx, "%s.mtl", name);
	bool may = mr_may_replace(path, MARK, sizeof MARK - 1);

	if (own)
		*own = may && is_file(path);
	return may ? MR_OK
	           : mr_fail(ctx, MR_EUSAGE,
			 "%s.mtl was not written by mr, and would be lost: give another name",
			 mr_file_name(name));
}

mr_status
mr_library_write(mr_ctx *ctx, const char *name, const char *statements)
{
	mr_sink sink;

	MR_TRY(mr_sink_open(ctx, mr_format(ctx, "%s.mtl", name), false, &sink));
	mr_put(&sink, MARK, sizeof MARK - 1);
	mr_put(&sink, statements, strlen(statements));
	return mr_sink_close(&sink, MR_OK);
}

void
mr_libraries_missing(mr_ctx *ctx, const char *path, mr_lines files)
{
	mr_scan text = mr_scan_of(ctx, (const unsigned char *)files.text, files.bytes), line;

	while (strcmp(path, "-") && mr_scan_line(&text, &line))
		mr_tell(ctx, MR_MISSING, !mr_file_beside(ctx, path, line.p, (size_t)(line.end - line.p)),
		    "%.*s", (int)(line.end - line.p), line.p);
}
