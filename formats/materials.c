/* MTL (Wavefront, "Advanced Visualizer", appendix B2): newmtl, Kd, Ke, d or Tr, map_Kd, and Pr, Pm and norm,
 * which others have added; the rest is for other programs. */
#include "formats/materials.h"

#include "base/name_table.h"
#include "formats/format.h"
#include "mesh/name_lists.h"

#include <sys/stat.h>

typedef struct finder {
	mr_ctx *ctx;
	const char *folder;
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

/* ---- statements ---- */

/* Behind options only the last word is the picture's name. */
static const char *
picture(finder *f, mr_scan *t)
{
	const char *found;
	size_t n;

	mr_skip_blanks(t);
	if (t->p < t->end && *t->p == '-')
		for (mr_scan ahead = *t; mr_scan_word(&ahead, &found, &n);)
			t->p = found;
	found = mr_file_in(f->ctx, f->folder, t->p, (size_t)(t->end - t->p));
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
read_library(finder *f, size_t count, const char *path)
{
	mr_file_bytes b = { 0 };

	f->files++;
	MR_TRY(mr_file_bytes_read(f->ctx, path, &b));
	return mr_prefix(f->ctx, mr_file_bytes_end(&b, statements(f, count, b.data, b.size)), "%s", path);
}

/* A line names one file, whose name may have blanks in it. */
static mr_status
read_libraries(finder *f, size_t count, mr_lines files)
{
	mr_scan text = mr_scan_of(f->ctx, (const unsigned char *)files.text, files.bytes), line;

	while (mr_scan_line(&text, &line)) {
		const char *path = mr_file_in(f->ctx, f->folder, line.p, (size_t)(line.end - line.p));
		if (path)
			MR_TRY(read_library(f, count, path));
		mr_tell(f->ctx, MR_MISSING, !path, "%.*s", (int)(line.end - line.p), line.p);
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
	finder f = { .ctx = ctx, .folder = folder };
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

void
mr_libraries_missing(mr_ctx *ctx, const char *path, mr_lines files)
{
	mr_scan text = mr_scan_of(ctx, (const unsigned char *)files.text, files.bytes), line;

	while (strcmp(path, "-") && mr_scan_line(&text, &line))
		mr_tell(ctx, MR_MISSING, !mr_file_beside(ctx, path, line.p, (size_t)(line.end - line.p)),
		    "%.*s", (int)(line.end - line.p), line.p);
}
