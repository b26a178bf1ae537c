/* MTL (Wavefront, "Advanced Visualizer", appendix B2): newmtl, Kd, Ke, d or Tr, map_Kd and disp, and norm,
 * which others have added; the rest is for other programs. */
#include "formats/materials.h"

#include "formats/format.h"

#include <ctype.h>
#include <limits.h>
#include <strings.h>
#include <sys/stat.h>

typedef struct finder {
	mr_ctx *ctx;
	const char *folder;
	const char **name; /* of the model's materials: count + 1 starts */
	mr_material *list;
	size_t count;
	bool *match;           /* a file speaks of it */
	size_t *at, ats;       /* the materials that the file speaks of */
	size_t read;           /* files that are there */
	size_t wrong, clipped; /* statements without their numbers, numbers that are not from 0 to 1 */
	size_t options;        /* of pictures, that are not followed */
} finder;

const mr_material mr_material_plain = { .opacity = 1, .roughness = 0.9 };

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

static const char *
next_word(const char *s)
{
	s += word_length(s);
	return s + strspn(s, " \t");
}

/* Options of maps: values that change nothing, the first and the others; `word`: it has one, that is none. */
static const struct {
	const char *name;
	double first, others;
	bool word;
} map_options[] = { { "-s", 1, 1, false }, { "-o", 0, 0, false }, { "-t", 0, 0, false },
	{ "-mm", 0, 1, false }, { "-boost", 0, 0, false }, { "-bm", 1, 1, false }, { "-clamp", 0, 0, false },
	{ "-cc", 0, 0, false }, { "-blendu", 1, 1, false }, { "-blendv", 1, 1, false },
	{ "-imfchan", 0, 0, true }, { "-type", 0, 0, true } };

enum { MAP_OPTIONS = sizeof map_options / sizeof *map_options };

/* Whether a text begins with this word. */
static bool
is_word(const char *s, const char *word)
{
	return word_length(s) == strlen(word) && !strncmp(s, word, strlen(word));
}

/* Which option a word is; MAP_OPTIONS: none of these. */
static size_t
map_option(const char *s)
{
	size_t k = 0;

	while (k < MAP_OPTIONS && !is_word(s, map_options[k].name))
		k++;
	return k;
}

static bool
is_option(const char *s)
{
	return *s == '-' && isalpha((unsigned char)s[1]);
}

/* A number, "on" or "off", as a number; false: the word is none. */
static bool
is_value(const char *s, double *x)
{
	const char *end = s + word_length(s);

	if (is_word(s, "on") || is_word(s, "off")) {
		*x = is_word(s, "on");
		return true;
	}
	return mr_real_read(s, end, x) == end;
}

/* The file name behind the options of a map. */
static const char *
behind_options(const char *s)
{
	double x;

	while (is_option(s)) {
		size_t k = map_option(s);
		s = next_word(s);
		if (k < MAP_OPTIONS && map_options[k].word)
			s = next_word(s);
		while (is_value(s, &x))
			s = next_word(s);
	}
	return s;
}

/* Of line i of mr_lines_starts. */
static size_t
line_bytes(const char **line, size_t i)
{
	return (size_t)(line[i + 1] - line[i]) - 1;
}

static bool
is_same_line(const char **line, size_t i, size_t k)
{
	size_t bytes = line_bytes(line, i);

	return line_bytes(line, k) == bytes && !memcmp(line[i], line[k], bytes);
}

static size_t
name_bytes(const finder *f, size_t i)
{
	return line_bytes(f->name, i);
}

/* The last description of a name holds. */
static void
new_material(finder *f, const char *name)
{
	size_t bytes = strlen(name);

	f->ats = 0;
	for (size_t i = 0; bytes && i < f->count; i++) {
		if (name_bytes(f, i) != bytes || memcmp(f->name[i], name, bytes))
			continue;
		f->list[i] = mr_material_plain;
		f->match[i] = true;
		f->at[f->ats++] = i;
	}
}

/* Numbers of a line, at most three, before what is none; how many. */
static size_t
numbers(const char *s, double x[3])
{
	const char *end = s + strlen(s), *behind_one;
	size_t n = 0;

	while (n < 3 && (behind_one = mr_real_read(s, end, &x[n])) && isfinite(x[n]) &&
	       strchr(" \t#", *behind_one)) {
		n++;
		s = behind_one + strspn(behind_one, " \t");
	}
	return n;
}

static double
share(finder *f, double x)
{
	f->clipped += x < 0 || x > 1;
	return x > 0 ? x < 1 ? x : 1 : 0;
}

/* One number is grey.  false, and `to` as it is, where there is no colour. */
static bool
set_color(finder *f, const char *s, double to[3])
{
	double x[3];
	size_t n = numbers(s, x);

	if (n != 1 && n != 3)
		return false;
	for (size_t k = 0; k < n; k++)
		to[k] = share(f, x[k]);
	if (n == 1)
		to[1] = to[2] = to[0];
	return true;
}

/* One number from 0 to 1. */
static bool
set_share(finder *f, const char *s, double *to)
{
	double x[3];

	if (numbers(s, x) == 0)
		return false;
	*to = share(f, x[0]);
	return true;
}

/* d, with or without -halo, is 0 of what cannot be seen. */
static bool
dissolve(finder *f, mr_material *m, const char *s)
{
	if (!strncmp(s, "-halo", 5))
		s += 5 + strspn(s + 5, " \t");
	return set_share(f, s, &m->opacity) && (m->dissolved = true);
}

/* Tr is the reverse of d, which goes before it; some programs write it as what d is, and 1 for all. */
static bool
turn_transparent(finder *f, mr_material *m, const char *s)
{
	double opaque;

	if (!set_share(f, s, &opaque))
		return false;
	if (!m->dissolved)
		m->opacity = opaque < 1 ? 1 - opaque : 1;
	return true;
}

/* Takes what a statement of numbers says; false: it has not those that it wants. */
static bool
set_numbers(finder *f, mr_material *m, const char *line)
{
	const char *rest;

	if ((rest = behind(line, "Kd")))
		return set_color(f, rest, m->color) && (m->colored = true);
	if ((rest = behind(line, "Ke")))
		return set_color(f, rest, m->emission);
	if ((rest = behind(line, "d")))
		return dissolve(f, m, rest);
	if ((rest = behind(line, "Tr")))
		return turn_transparent(f, m, rest);
	if ((rest = behind(line, "Pr")))
		return set_share(f, rest, &m->roughness);
	if ((rest = behind(line, "Pm")))
		return set_share(f, rest, &m->metal);
	return true;
}

/* Statements that nothing is made of: those of numbers say nothing where all are neutral.  Ka, Ni, Ns and
 * illum go with others, or are of a program's lights. */
static const struct {
	const char *name;
	double neutral;
} unused[] = { { "Ks", 0 }, { "Tf", 1 }, { "Ps", 0 }, { "Pc", 0 }, { "Pcr", 0 }, { "aniso", 0 },
	{ "anisor", 0 }, { "map_Ka", 0 }, { "map_Ks", 0 }, { "map_Ns", 0 }, { "map_d", 0 }, { "map_Ke", 0 },
	{ "bump", 0 }, { "map_bump", 0 }, { "decal", 0 }, { "refl", 0 }, { "map_Pr", 0 }, { "map_Pm", 0 },
	{ "map_Ps", 0 } };

enum { UNUSED = sizeof unused / sizeof *unused };

_Static_assert(UNUSED <= 32, "a bit for each");

static bool
says_something(const char *s, double neutral)
{
	double x[3];
	size_t n = numbers(s, x), same = 0;

	while (same < n && x[same] == neutral)
		same++;
	return n == 0 || same < n;
}

static void
note_unused(mr_material *m, const char *line)
{
	const char *rest;

	for (size_t k = 0; k < UNUSED; k++)
		if ((rest = behind(line, unused[k].name)) && says_something(rest, unused[k].neutral))
			m->lost |= 1u << k;
}

/* Whether an option, its values up to `end`, is as if it were not there. */
static bool
changes_nothing(const char *s, const char *end)
{
	size_t k = map_option(s), n = 0;
	bool nothing = k < MAP_OPTIONS && !map_options[k].word;
	double x;

	for (s = next_word(s); nothing && s < end && !is_option(s) && is_value(s, &x); s = next_word(s))
		nothing = x == (n++ ? map_options[k].others : map_options[k].first);
	return nothing;
}

/* Counts options of a picture that nothing here follows, but for the range of heights. */
static void
count_options(finder *f, const char *s, const char *file, bool heights)
{
	for (; s < file; s = next_word(s)) {
		bool followed = is_word(s, "-texres") || (heights && is_word(s, "-mm"));
		f->options += is_option(s) && !followed && !changes_nothing(s, file);
	}
}

/* to: the picture of material i. */
static mr_status
map(finder *f, size_t i, const char *s, const char **to)
{
	const char *file = behind_options(s);

	count_options(f, s, file, to == &f->list[i].heights);
	MR_TRY(find_file(f, file, to));
	mr_tell(f->ctx, MR_MISSING, !*to, "%s", file);
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
describe(finder *f, size_t i, const char *line)
{
	mr_material *m = &f->list[i];
	const char *rest;

	f->wrong += !set_numbers(f, m, line);
	if ((rest = behind(line, "map_Kd")))
		MR_TRY(map(f, i, rest, &m->file));
	if ((rest = behind(line, "norm")) || (rest = behind(line, "map_Kn")))
		MR_TRY(map(f, i, rest, &m->normals));
	if ((rest = behind(line, "disp")) || (rest = behind(line, "map_disp"))) {
		modify(m, rest);
		MR_TRY(map(f, i, rest, &m->heights));
	}
	note_unused(m, line);
	return MR_OK;
}

static const char *
text_of(mr_ctx *ctx, mr_scan line)
{
	ptrdiff_t n = line.end - line.p;

	return mr_format(ctx, "%.*s", (int)(n < INT_MAX ? n : INT_MAX), line.p);
}

static mr_status
statement(finder *f, mr_scan line)
{
	const char *text, *name;

	mr_skip_blanks(&line);
	while (line.end > line.p && mr_is_blank(line.end[-1]))
		line.end--;
	text = text_of(f->ctx, line);
	if (!text)
		return MR_EMEM;
	if ((name = behind(text, "newmtl")))
		new_material(f, name);
	for (size_t k = 0; k < f->ats; k++)
		MR_TRY(describe(f, f->at[k], text));
	return MR_OK;
}

static mr_status
statements(finder *f, const unsigned char *data, size_t size)
{
	mr_scan text, line;

	MR_TRY(mr_as_text(f->ctx, &data, &size));
	if (size && memchr(data, 0, size))
		return mr_fail(f->ctx, MR_EFORMAT, "a zero byte: not a text file");
	text = mr_scan_of(f->ctx, data, size);
	while (mr_scan_line(&text, &line))
		MR_TRY(statement(f, line));
	return MR_OK;
}

static mr_status
read_library(finder *f, const char *path)
{
	mr_file_bytes b = { 0 };
	mr_status status;

	MR_TRY(mr_file_bytes_read(f->ctx, path, &b));
	f->ats = 0;
	status = statements(f, b.data, b.size);
	return mr_prefix(f->ctx, mr_file_bytes_end(f->ctx, &b, status), "%s", path);
}

/* The file of a name; *there: whether it is. */
static mr_status
try_library(finder *f, const char *name, bool *there)
{
	const char *path = NULL;

	MR_TRY(find_file(f, name, &path));
	*there = path != NULL;
	if (!path)
		return MR_OK;
	f->read++;
	return read_library(f, path);
}

/* A line names one file, whose name may have blanks in it, or several. */
static mr_status
read_libraries(finder *f, const char *line, size_t bytes)
{
	const char *end = line + bytes, *name = mr_format(f->ctx, "%.*s", (int)bytes, line);
	bool there;

	if (!name)
		return MR_EMEM;
	MR_TRY(try_library(f, name, &there));
	for (const char *p = line, *e; p < end && !there; p = e + 1) {
		bool found = true;
		e = memchr(p, ' ', (size_t)(end - p));
		e = e ? e : end;
		if (!(name = mr_format(f->ctx, "%.*s", (int)(e - p), p)))
			return MR_EMEM;
		if (e > p)
			MR_TRY(try_library(f, name, &found));
		mr_tell(f->ctx, MR_MISSING, !found, "%s", name);
	}
	return MR_OK;
}

/* The model's materials that no file speaks of. */
static void
say_unknown(const finder *f)
{
	size_t unknown = 0, first = 0;

	for (size_t i = f->count; i-- > 0;)
		if (!f->match[i] && name_bytes(f, i)) {
			first = i;
			unknown++;
		}
	if (f->read)
		mr_tell(f->ctx, MR_MISSING, unknown, "material %.*s%s", (int)name_bytes(f, first),
		    f->name[first], unknown > 1 ? ", and others," : "");
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
	f.list = MR_NEW(ctx, f.count, mr_material);
	f.match = MR_NEW_ZERO(ctx, f.count, bool);
	f.at = MR_NEW(ctx, f.count, size_t);
	if (!f.list || !f.match || !f.at)
		return MR_EMEM;
	for (size_t i = 0; i < f.count; i++)
		f.list[i] = mr_material_plain;
	if (m->mtllib.text && m->mtllib.bytes) {
		MR_TRY(mr_lines_starts(ctx, m->mtllib, &library, &libraries));
		for (size_t i = 0; i < libraries; i++)
			if (i == 0 || !is_same_line(library, i - 1, i))
				MR_TRY(read_libraries(&f, library[i], line_bytes(library, i)));
		mr_lost(ctx, NULL, f.wrong, "statements of materials");
		mr_lost(ctx, NULL, f.options, "options of pictures");
		mr_tell(ctx, MR_ROUNDED, f.clipped, "numbers of materials");
		say_unknown(&f);
	}
	*list = f.list;
	*count = f.count;
	return MR_OK;
}

void
mr_materials_lost(mr_ctx *ctx, unsigned lost)
{
	for (size_t k = 0; k < UNUSED; k++)
		mr_lost(ctx, "materials", lost >> k & 1, unused[k].name);
}
