/* Wavefront OBJ: polygons, corners with texture coordinates and normals of their own, and what faces are
 * marked with.  Lines are counted first, so that an index can be checked at once. */
#include "formats/format.h"

typedef struct obj {
	mr_ctx *ctx;
	mr_scan text; /* of the whole file */
	mr_builder b;
	size_t v, vt, vn; /* lines so far */
	size_t v_all, vt_all, vn_all, f_all;
	double *uv;             /* vt_all pairs */
	mr_v3 *vn_values;       /* vn_all */
	mr_rows rows;           /* of vertices: positions and colours */
	size_t numbers, others; /* what is left out: of vertices and texture coordinates; statements */
	size_t odd_texcoords;   /* that are not finite */
	size_t no_normals, no_texcoords; /* corners that name one that is not there */
	uint32_t *corner[3];             /* of the face at hand: vertices, texture coordinates, normals */
	size_t room[3];
} obj;

/* ---- lines ---- */

/* Behind a backslash, unless that ends a comment. */
static bool
continues(const char *begin, const char *end)
{
	if (end == begin || end[-1] != '\\')
		return false;
	for (const char *p = begin; (p = memchr(p, '#', (size_t)(end - p))); p++)
		if (p == begin || mr_is_blank(p[-1]))
			return false;
	return true;
}

/* The text with lines that go on behind a backslash put together, and empty ones in place of what follows:
 * each keeps its number.  In the arena where there are such lines. */
static void
unfold(mr_scan *t)
{
	mr_scan rest = *t, line;
	size_t empty = 0;
	char *to;

	if (!memchr(t->p, '\\', (size_t)(t->end - t->p)))
		return;
	to = mr_alloc(t->ctx, (size_t)(t->end - t->p) + 1, 1);
	*t = (mr_scan){ t->ctx, to, to, to, false };
	while (mr_scan_line(&rest, &line)) {
		size_t n = (size_t)(line.end - line.p);
		bool more = continues(line.p, line.end) && rest.p < rest.end;
		memcpy(to, line.p, n);
		to += n;
		if (more)
			to[-1] = ' ';
		for (empty++; !more && empty > 0; empty--)
			*to++ = '\n';
	}
	t->end = to;
}

static bool
begins(const mr_scan *line, const char *word)
{
	size_t n = strlen(word);

	return (size_t)(line->end - line->p) >= n && !memcmp(line->p, word, n) &&
	       (line->p + n == line->end || mr_is_blank(line->p[n]));
}

/* ---- v, vt, vn ---- */

/* The numbers of a line. */
static mr_status
numbers(mr_scan *line, const char *what, size_t least, size_t most, double *x, size_t *count)
{
	size_t n = 0;

	for (; mr_skip_blanks(line), line->p < line->end && *line->p != '#'; n++) {
		if (n == most)
			return mr_scan_fail(line, line->p, "%s has more than %zu numbers", what, most);
		MR_TRY(mr_scan_real(line, what, &x[n]));
	}
	if (n < least)
		return mr_scan_fail(line, line->p, "%s has %zu numbers, not %zu", what, n, least);
	*count = n;
	return MR_OK;
}

/* v x y z [w | r g b [a]]: with four numbers the last is a weight, with six or seven there is a colour. */
static mr_status
position(obj *o, mr_scan *line)
{
	double x[7] = { 0 };
	size_t n = 0;

	MR_TRY(numbers(line, "a vertex", 3, 7, x, &n));
	if (n == 5)
		return mr_scan_fail(line, line->p, "a vertex has 5 numbers, not 3, 4, 6 or 7");
	if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2]))
		return mr_scan_fail(line, line->p, "a coordinate is not finite");
	o->numbers += (n == 4 && x[3] != 1) || (n > 6 && x[6] != 1);
	o->rows.odd_colors += n > 4 && !isfinite(x[3] + x[4] + x[5]);
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

	MR_TRY(numbers(line, "a texture coordinate", 1, 3, x, &n));
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

	MR_TRY(numbers(line, "a normal", 3, 3, x, &n));
	o->vn_values[o->vn] = mr_vec(x[0], x[1], x[2]);
	o->vn++;
	return MR_OK;
}

/* ---- faces ---- */

/* An index from 1, or from the last one back, of at most nine digits; *p goes behind it. */
static bool
read_index(const char **p, const char *end, int *index)
{
	bool back = *p < end && **p == '-';
	const char *digits = *p += back;
	int value = 0;

	for (; *p < end && mr_is_digit(**p) && *p - digits < 9; ++*p)
		value = 10 * value + (**p - '0');
	*index = back ? -value : value;
	return value != 0;
}

/* v, v/vt, v//vn or v/vt/vn, where an index after a slash may be left out: its end, or NULL where it is none.
 */
static const char *
read_corner(const char *p, const char *end, int index[3])
{
	index[1] = index[2] = 0;
	if (!read_index(&p, end, &index[0]))
		return NULL;
	for (int k = 1; k < 3 && p < end && *p == '/'; k++) {
		p++;
		if (p < end && *p != '/' && !mr_is_blank(*p) && !read_index(&p, end, &index[k]))
			return NULL;
	}
	return p == end || mr_is_blank(*p) ? p : NULL;
}

static mr_status
bad_corner(mr_scan *line)
{
	char shown[MR_SHOWN];
	const char *w;
	size_t n;

	mr_scan_word(line, &w, &n);
	return mr_scan_fail(line, w, "'%s' is not a corner: v, v/vt, v//vn or v/vt/vn, counted from 1",
	    mr_word_shown(w, n, shown));
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
face(obj *o, mr_scan *line)
{
	bool uv = false, vn = false;
	int index[3];
	size_t n = 0;

	for (line->p++; mr_skip_blanks(line), line->p < line->end && *line->p != '#'; n++) {
		const char *e = read_corner(line->p, line->end, index);
		if (!e)
			return bad_corner(line);
		for (int k = 0; k < 3 && n == o->room[k]; k++)
			MR_RESERVE(o->ctx, o->corner[k], n, 1, &o->room[k]);
		if (!resolve(index[0], o->v, o->v_all, &o->corner[0][n]))
			return mr_scan_fail(line, line->p, "vertex %d of %zu", index[0], o->v_all);
		o->corner[1][n] = place_of(index[1], o->vt, o->vt_all, &o->no_texcoords);
		o->corner[2][n] = place_of(index[2], o->vn, o->vn_all, &o->no_normals);
		uv |= o->corner[1][n] != MR_NONE;
		vn |= o->corner[2][n] != MR_NONE;
		line->p = e;
	}
	if (n != 3 || uv || vn ||
	    !mr_build_triangle(&o->b, o->corner[0][0], o->corner[0][1], o->corner[0][2]))
		mr_build_face(&o->b, o->corner[0], uv ? o->corner[1] : NULL, vn ? o->corner[2] : NULL, n);
	return MR_OK;
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
		mr_build_smoothing(&o->b, (uint32_t)group);
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
		mr_build_library(&o->b, line->p, (size_t)(line->end - line->p));
	else
		mr_build_mark(&o->b, words[i].what, line->p, (size_t)(line->end - line->p), false);
	return true;
}

/* ---- the file ---- */

/* Of any other statement only that it begins as one. */
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

static mr_status
one_line(obj *o, mr_scan *line)
{
	size_t left = (size_t)(line->end - line->p);
	char c = left ? *line->p : '#', d = left > 1 ? line->p[1] : ' ';

	if (c == '#')
		return MR_OK;
	if (c == 'v' && mr_is_blank(d))
		return line->p++, position(o, line);
	if (c == 'v' && (d == 't' || d == 'n') && (left == 2 || mr_is_blank(line->p[2])))
		return line->p += 2, d == 't' ? texcoord(o, line) : normal(o, line);
	if (c == 'f' && mr_is_blank(d))
		return face(o, line);
	return is_mark(o, line) ? MR_OK : other_statement(o, line);
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

/* Counts the lines of each kind, so that arrays have their size and an index can be checked at once. */
static void
count_lines(obj *o)
{
	mr_scan start = o->text, line;

	while (next_line(o, &line)) {
		size_t left = (size_t)(line.end - line.p);
		char c = left ? *line.p : '#', d = left > 1 ? line.p[1] : ' ';
		if (c == 'v') {
			bool alone = left <= 2 || mr_is_blank(line.p[2]);
			o->v_all += mr_is_blank(d);
			o->vt_all += d == 't' && alone;
			o->vn_all += d == 'n' && alone;
		} else if (c == 'f')
			o->f_all += mr_is_blank(d);
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

	if (are_of_vertices(o, o->b.corner_uv, o->no_texcoords, o->vt)) {
		if (mr_all_left(o->ctx, o->odd_texcoords, o->vt, what))
			o->b.texcoord = o->uv;
		return;
	}
	if (!mr_left_out(o->ctx, o->odd_texcoords, o->vt, what))
		o->b.corner_uv = NULL;
	mr_lost(o->ctx, NULL, o->no_texcoords, "texture coordinates that are not there");
}

static void
finish_normals(obj *o)
{
	bool of_vertices = are_of_vertices(o, o->b.corner_vn, o->no_normals, o->vn);

	if (!mr_normals_left(o->ctx, o->vn_values, o->vn))
		o->b.corner_vn = NULL;
	else if (of_vertices)
		o->b.normal = o->vn_values;
	mr_lost(o->ctx, NULL, o->no_normals, "normals that are not there");
}

static mr_status
finish(obj *o, mr_model *m)
{
	o->b.uv = o->uv;
	o->b.vn = o->vn_values;
	mr_rows_end(&o->rows);
	finish_texcoords(o);
	finish_normals(o);
	mr_lost(o->ctx, NULL, o->numbers, "weights, alpha or third texture coordinates");
	mr_lost(o->ctx, NULL, o->others, "other statements");
	return mr_build_finish(&o->b, m);
}

static mr_status
begin_vertices(obj *o)
{
	static const mr_role roles[] = { MR_X, MR_Y, MR_Z, MR_RED, MR_GREEN, MR_BLUE };

	o->rows.b = &o->b;
	o->rows.sparse = true;
	for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
		mr_rows_add(&o->rows, roles[i], "", 0, NULL);
	mr_rows_begin(&o->rows);
	return mr_rows_room(&o->rows, o->v_all);
}

mr_status
mr_obj_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	obj o = {
		.ctx = ctx, .text = mr_scan_of(ctx, data, size), .b = { .ctx = ctx, .ungrouped = "default" }
	};
	mr_scan line;

	unfold(&o.text);
	count_lines(&o);
	if (o.vn_all >= MR_NONE || o.vt_all >= MR_NONE)
		return mr_fail(ctx, MR_ERANGE, "more normals or texture coordinates than indices can name");
	MR_TRY(begin_vertices(&o));
	MR_TRY(mr_build_reserve(&o.b, o.f_all));
	o.uv = MR_NEW(ctx, 2 * o.vt_all, double);
	o.vn_values = MR_NEW(ctx, o.vn_all, mr_v3);
	while (next_line(&o, &line))
		MR_TRY(one_line(&o, &line));
	return finish(&o, m);
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
