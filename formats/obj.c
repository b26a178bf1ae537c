/* Wavefront OBJ.  tinyobj reads faces, through obj_shim, once their line is checked: it takes any word for an
 * index.  v, vt and vn lines, whose numbers must be exact, and names with blanks are read here. */
#include "formats/format.h"
#include "formats/obj_shim.h"

typedef struct obj {
	mr_ctx *ctx;
	mr_scan text;     /* of the whole file */
	const char *line; /* the face at hand, for errors */
	char *face;       /* its line, as tinyobj reads it */
	size_t face_room;
	size_t v, vt, vn; /* lines so far */
	size_t v_all, vt_all, vn_all, f_all;
	double *uv;             /* vt_all pairs */
	mr_v3 *vn_values;       /* vn_all */
	mr_rows rows;           /* of vertices: positions and colours */
	size_t numbers, others; /* what is left out: of vertices and texture coordinates; statements */
	size_t odd_texcoords;   /* that are not finite */
	size_t no_normals, no_texcoords; /* corners that name one that is not there */
	uint32_t *corners;               /* of the face at hand: vertices, texture coordinates, normals */
	size_t corner_room;
	mr_status status; /* of the first failure, after which nothing is read */
} obj;

/* ---- lines ---- */

static bool
begins(const mr_scan *line, const char *word)
{
	size_t n = strlen(word);

	return (size_t)(line->end - line->p) >= n && !memcmp(line->p, word, n) &&
	       (line->p + n == line->end || mr_is_blank(line->p[n]));
}

/* ---- v, vt, vn ---- */

/* v x y z [w | r g b [a]]: with four numbers the last is a weight, with six or seven there is a colour. */
static mr_status
position(obj *o, mr_scan *line)
{
	double x[7] = { 0 };
	size_t n = 0;

	MR_TRY(mr_scan_reals(line, "a vertex", 3, 7, x, &n));
	if (n == 5)
		return mr_scan_fail(line, line->p, "a vertex has 5 numbers, not 3, 4, 6 or 7");
	o->numbers += (n == 4 && x[3] != 1) || (n > 6 && x[6] != 1);
	if (n <= 4)
		x[3] = x[4] = x[5] = (double)NAN;
	o->v++;
	mr_rows_put(&o->rows, x);
	return MR_OK;
}

static mr_status
texcoord(obj *o, mr_scan *line)
{
	double x[3] = { 0 };
	size_t n = 0;

	MR_TRY(mr_scan_reals(line, "a texture coordinate", 1, 3, x, &n));
	if (!isfinite(x[0]) || !isfinite(x[1])) {
		x[0] = x[1] = NAN; /* none */
		o->odd_texcoords++;
	}
	o->numbers += n == 3 && x[2] != 0;
	o->uv[2 * o->vt] = x[0];
	o->uv[2 * o->vt + 1] = x[1];
	o->vt++;
	return MR_OK;
}

static mr_status
normal(obj *o, mr_scan *line)
{
	double x[3] = { 0 };
	size_t n;

	MR_TRY(mr_scan_reals(line, "a normal", 3, 3, x, &n));
	o->vn_values[o->vn] = mr_vec(x[0], x[1], x[2]);
	o->vn++;
	return MR_OK;
}

/* ---- faces ---- */

/* Checks one index of at most nine digits, and not 0. */
static const char *
index_end(const char *p, const char *end)
{
	const char *digits;
	bool zero = true;

	if (p < end && *p == '-')
		p++;
	for (digits = p; p < end && mr_is_digit(*p); p++)
		zero &= *p == '0';
	return p == digits || p - digits > 9 || zero ? NULL : p;
}

/* v, v/vt, v//vn or v/vt/vn; an index after a slash may be left out. */
static const char *
corner_end(const char *p, const char *end)
{
	p = index_end(p, end);
	for (int slash = 0; slash < 2 && p && p < end && *p == '/'; slash++) {
		p++;
		if (p < end && *p != '/' && !mr_is_blank(*p))
			p = index_end(p, end);
	}
	return p && (p == end || mr_is_blank(*p)) ? p : NULL;
}

/* Up to a comment, which tinyobj would read. */
static mr_status
check_face(mr_scan *line)
{
	char shown[MR_SHOWN];
	mr_scan at = *line;
	const char *w, *e;
	size_t n;

	for (at.p++; mr_skip_blanks(&at), at.p < at.end && *at.p != '#'; at.p = e) {
		e = corner_end(at.p, at.end);
		if (!e) {
			mr_scan_word(&at, &w, &n);
			return mr_scan_fail(line, w,
			    "'%s' is not a corner: v, v/vt, v//vn or v/vt/vn, counted from 1",
			    mr_word_shown(w, n, shown));
		}
	}
	line->end = at.p;
	return MR_OK;
}

/* The index from 0, or false where it is outside 0 .. all - 1. */
static bool
resolve(int index, size_t so_far, size_t all, uint32_t *i)
{
	long long at = index > 0 ? (long long)index - 1 : (long long)so_far + index;

	*i = (uint32_t)at;
	return at >= 0 && (unsigned long long)at < all;
}

/* The place of a value that a corner names, which may stand behind it; MR_NONE where it names none. */
static uint32_t
place_of(int index, size_t so_far, size_t all, size_t *odd)
{
	uint32_t i;

	if (index == 0)
		return MR_NONE;
	if (resolve(index, so_far, all, &i))
		return i;
	++*odd;
	return MR_NONE;
}

static mr_status
add_face(obj *o, const mr_obj_corner *c, size_t n)
{
	bool uv = false, vn = false;
	uint32_t *v, *t, *s;

	MR_RESERVE(o->ctx, o->corners, 0, 3 * n, &o->corner_room);
	v = o->corners, t = v + n, s = t + n;
	for (size_t i = 0; i < n; i++) {
		if (!resolve(c[i].v, o->v, o->v_all, &v[i]))
			return mr_scan_fail(&o->text, o->line, "vertex %d of %zu", c[i].v, o->v_all);
		t[i] = place_of(c[i].vt, o->vt, o->vt_all, &o->no_texcoords);
		s[i] = place_of(c[i].vn, o->vn, o->vn_all, &o->no_normals);
		uv |= t[i] != MR_NONE;
		vn |= s[i] != MR_NONE;
	}
	if (n == 3 && !uv && !vn && mr_build_triangle(&o->rows.b, v[0], v[1], v[2]))
		return MR_OK;
	mr_build_face(&o->rows.b, v, uv ? t : NULL, vn ? s : NULL, n);
	return MR_OK;
}

/* Nothing unwinds through tinyobj. */
static mr_status
enter_face(obj *o, const mr_obj_corner *c, size_t n)
{
	MR_ENTER(o->ctx);
	return add_face(o, c, n);
}

static void
face_call(void *user, const mr_obj_corner *c, int n)
{
	obj *o = user;

	if (o->status == MR_OK)
		o->status = enter_face(o, c, (size_t)n);
}

/* ---- names ---- */

/* A number or "off"; other words count as left out. */
static void
smoothing(obj *o, mr_scan *line)
{
	uint64_t group = 0;
	const char *p = line->p;

	for (; p < line->end && mr_is_digit(*p) && group <= UINT32_MAX; p++)
		group = 10 * group + (uint64_t)(*p - '0');
	if (p > line->p ? group <= UINT32_MAX && (p == line->end || mr_is_blank(*p)) : begins(line, "off"))
		mr_build_smoothing(&o->rows.b, (uint32_t)group);
	else
		o->others++;
}

/* A statement that marks the faces to come, or names materials' files; false for any other. */
static bool
is_mark(obj *o, mr_scan *line)
{
	static const struct {
		const char *word;
		mr_marking what;
	} words[] = { { "g", MR_GROUP }, { "o", MR_OBJECT }, { "usemtl", MR_MATERIAL }, { "s", MR_SMOOTHING },
		{ "mtllib", MR_MARKINGS } };
	size_t i = 0;

	while (i < sizeof words / sizeof *words && !begins(line, words[i].word))
		i++;
	if (i == sizeof words / sizeof *words)
		return false;
	line->p += strlen(words[i].word);
	mr_skip_blanks(line);
	if (words[i].what == MR_SMOOTHING)
		smoothing(o, line);
	else if (words[i].what == MR_MARKINGS)
		mr_build_library(&o->rows.b, line->p, (size_t)(line->end - line->p));
	else
		mr_build_mark(&o->rows.b, words[i].what, line->p, (size_t)(line->end - line->p), false);
	return true;
}

/* ---- the file ---- */

/* Other statements are skipped, if they begin with a word as statements do. */
static mr_status
other_statement(obj *o, mr_scan *line)
{
	char shown[MR_SHOWN];
	const char *w;
	size_t n;

	mr_scan_word(line, &w, &n);
	if ((*w | 32) < 'a' || (*w | 32) > 'z')
		return mr_scan_fail(line, w, "'%s' begins no statement of OBJ", mr_word_shown(w, n, shown));
	o->others++;
	return MR_OK;
}

/* What the numbers of a line are of: v, t or n; f, # of nothing, or 0 of another statement. */
static char
kind_of(const mr_scan *line)
{
	size_t left = (size_t)(line->end - line->p);
	char c = left ? *line->p : '#', d = left > 1 ? line->p[1] : ' ';

	if (c == '#' || ((c == 'v' || c == 'f') && mr_is_blank(d)))
		return c;
	return c == 'v' && (d == 't' || d == 'n') && (left == 2 || mr_is_blank(line->p[2])) ? d : 0;
}

/* Reads one line here; *pass where tinyobj is to see it. */
static mr_status
one_line(obj *o, mr_scan *line, bool *pass)
{
	char kind = kind_of(line);

	*pass = kind == 'f';
	switch (kind) {
	case '#':
		return MR_OK;
	case 'v':
		return line->p++, position(o, line);
	case 't':
		return line->p += 2, texcoord(o, line);
	case 'n':
		return line->p += 2, normal(o, line);
	case 'f':
		return check_face(line);
	default:
		return is_mark(o, line) ? MR_OK : other_statement(o, line);
	}
}

/* A line for tinyobj, which knows few blanks, and takes the next corner's index behind a slash with nothing
 * behind it. */
static void
hand_over(obj *o, const mr_scan *line, const char **begin, const char **end)
{
	size_t n = (size_t)(line->end - line->p);

	MR_RESERVE(o->ctx, o->face, 0, n + 2, &o->face_room);
	o->face[n] = ' ';
	o->face[n + 1] = '\n';
	for (size_t i = n; i-- > 0;) {
		char c = line->p[i];
		o->face[i] = mr_is_blank(c) || (c == '/' && o->face[i + 1] == ' ') ? ' ' : c;
	}
	*begin = o->face;
	*end = o->face + n + 2;
}

/* The next line, without leading blanks. */
static bool
next_line(obj *o, mr_scan *line)
{
	if (!mr_scan_line(&o->text, line))
		return false;
	mr_skip_blanks(line);
	return true;
}

static mr_status
next_for_tinyobj(obj *o, const char **begin, const char **end)
{
	mr_scan line;
	bool pass = false;

	MR_ENTER(o->ctx);
	while (!pass) {
		if (!next_line(o, &line))
			return MR_END;
		MR_TRY(one_line(o, &line, &pass));
	}
	o->line = line.p;
	hand_over(o, &line, begin, end);
	return MR_OK;
}

static bool
line_call(void *user, const char **begin, const char **end)
{
	obj *o = user;

	if (o->status == MR_OK)
		o->status = next_for_tinyobj(o, begin, end);
	return o->status == MR_OK;
}

/* Counts the lines of each kind, so that arrays have their size and an index can be checked at once. */
static void
count_lines(obj *o)
{
	mr_scan start = o->text, line;

	while (next_line(o, &line)) {
		char kind = kind_of(&line);
		o->v_all += kind == 'v';
		o->vt_all += kind == 't';
		o->vn_all += kind == 'n';
		o->f_all += kind == 'f';
	}
	o->text = start;
}

/* ---- the model ---- */

/* As many values as there are vertices, of which no corner names one, are those of the vertices. */
static bool
are_of_vertices(const obj *o, const uint32_t *place, size_t astray, size_t n)
{
	return !place && !astray && n == o->v_all;
}

static void
finish_texcoords(obj *o)
{
	const char *what = "texture coordinates";

	if (are_of_vertices(o, o->rows.b.corner_uv, o->no_texcoords, o->vt)) {
		if (mr_all_left(o->ctx, o->odd_texcoords, o->vt, what))
			o->rows.b.m.texcoord = o->uv;
		return;
	}
	if (!mr_left_out(o->ctx, o->odd_texcoords, o->vt, what))
		o->rows.b.corner_uv = NULL;
	mr_lost(o->ctx, NULL, o->no_texcoords, "texture coordinates that are not there");
}

static void
finish_normals(obj *o)
{
	bool of_vertices = are_of_vertices(o, o->rows.b.corner_vn, o->no_normals, o->vn);

	if (!mr_normals_left(o->ctx, o->vn_values, o->vn))
		o->rows.b.corner_vn = NULL;
	else if (of_vertices)
		o->rows.b.m.normal = o->vn_values;
	mr_lost(o->ctx, NULL, o->no_normals, "normals that are not there");
}

static mr_status
finish(obj *o, mr_model *m)
{
	o->rows.b.uv = o->uv;
	o->rows.b.vn = o->vn_values;
	mr_rows_end(&o->rows);
	finish_texcoords(o);
	finish_normals(o);
	mr_lost(o->ctx, NULL, o->numbers, "weights, alpha or third texture coordinates");
	mr_lost(o->ctx, NULL, o->others, "other statements");
	return mr_build_finish(&o->rows.b, m);
}

static mr_status
begin_vertices(obj *o)
{
	o->rows.sparse = true;
	mr_rows_add_unnamed(&o->rows, MR_X, 3);
	mr_rows_add_unnamed(&o->rows, MR_RED, 3);
	mr_rows_begin(&o->rows);
	return mr_rows_room(&o->rows, o->v_all);
}

mr_status
mr_obj_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	obj o = { .ctx = ctx,
		.text = mr_scan_of(ctx, data, size),
		.rows.b = { .ctx = ctx, .ungrouped = "default" } };
	mr_obj_calls calls = { line_call, face_call, &o };

	count_lines(&o);
	if (o.vn_all >= MR_NONE || o.vt_all >= MR_NONE)
		return mr_fail(ctx, MR_ERANGE, "more normals or texture coordinates than indices can name");
	MR_TRY(begin_vertices(&o));
	MR_TRY(mr_build_reserve(&o.rows.b, o.f_all));
	o.uv = MR_NEW(ctx, 2 * o.vt_all, double);
	o.vn_values = MR_NEW(ctx, o.vn_all, mr_v3);
	if (!mr_obj_parse(&calls))
		return mr_fail(ctx, MR_EMEM, "no memory for a line of the file");
	return o.status < 0 ? o.status : finish(&o, m);
}

/* The first line that says something must be a statement of OBJ. */
bool
mr_obj_sniff(const unsigned char *data, size_t size)
{
	static const char *const words[] = { "v", "vn", "vt", "vp", "f", "g", "o", "s", "l", "p", "usemtl",
		"mtllib", NULL };
	mr_scan text = mr_scan_of(NULL, data, size), line;

	if (memchr(data, 0, size < 4096 ? size : 4096))
		return false;
	while (mr_scan_line(&text, &line)) {
		mr_skip_blanks(&line);
		if (line.p == line.end || *line.p == '#')
			continue;
		for (const char *const *w = words; *w; w++)
			if (begins(&line, *w))
				return true;
		return false;
	}
	return false;
}
