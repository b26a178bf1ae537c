/*
 * Wavefront OBJ.  tinyobj reads faces and names, through obj_shim; this file reads v, vt and vn lines, whose
 * numbers must be exact, joins continued lines, and checks each face line before tinyobj sees it: tinyobj
 * takes any word for an index and lets indices wrap.
 */
#include "formats/format.h"
#include "formats/obj_shim.h"

/* Of a vertex's normal: none yet; more than one. */
static const uint32_t UNSET = 0x7fffffff, SEVERAL = 0x80000000;

typedef struct obj {
	mr_ctx *ctx;
	mr_scan text; /* of the whole file */
	mr_builder b;
	const char *line; /* the line at hand, for errors */
	char *joined;     /* continued lines, put together, and lines that need a newline */
	size_t joined_room;
	size_t v, vt, vn; /* lines so far */
	size_t v_all, vt_all, vn_all, f_all;
	double *uv;          /* vt_all pairs */
	mr_v3 *vn_values;    /* vn_all */
	uint32_t *normal_of; /* per vertex, its normal's index */
	float *rgb;          /* three per vertex, NAN where it has none; NULL without any */
	bool bright;         /* colours beyond 1: in 255ths */
	size_t lines_and_points, weights;
	const char *odd_normal, *odd_texcoord, *odd_color; /* why the column cannot be kept; NULL: it can */
	bool slashes;      /* the face at hand has a slash with nothing behind it */
	uint32_t *corners; /* of the face at hand */
	size_t corner_room;
	mr_obj_naming naming; /* what names the groups of this file */
	char *name;           /* of the g line at hand: its words so far */
	size_t name_bytes, name_room;
	const char *name_line;
	mr_status status; /* of the first failure, after which nothing is read */
} obj;

/* ---- lines ---- */

static bool
continues(const char *begin, const char *end)
{
	return end > begin && end[-1] == '\\' && *begin != '#';
}

/* Puts a line that goes on behind a backslash together with what follows. */
static mr_status
join(obj *o, mr_scan *line)
{
	size_t n = 0;
	bool more = true;

	while (more) {
		size_t bytes = (size_t)(line->end - line->p);
		more = continues(line->p, line->end);
		MR_TRY(MR_RESERVE(o->ctx, o->joined, n, bytes + 1, &o->joined_room));
		memcpy(o->joined + n, line->p, bytes);
		n += bytes;
		if (more)
			o->joined[n - 1] = ' ';
		more = more && mr_scan_line(&o->text, line);
	}
	o->joined[n] = '\n';
	*line = (mr_scan){ o->ctx, o->joined, o->joined, o->joined + n };
	return MR_OK;
}

/* The next line, without leading blanks and joined where it goes on; MR_END at the end. */
static mr_status
next_line(obj *o, mr_scan *line)
{
	o->line = o->text.p < o->text.end ? o->text.p : o->line;
	if (!mr_scan_line(&o->text, line))
		return MR_END;
	mr_skip_blanks(line);
	return continues(line->p, line->end) ? join(o, line) : MR_OK;
}

/* "line N: ..." for the line at hand: a failure found in a part of it says nothing of places. */
static mr_status MR_PRINTF(2, 3) bad(obj *o, const char *format, ...)
{
	char sentence[MR_ERROR_MAX / 2];
	va_list args;

	va_start(args, format);
	vsnprintf(sentence, sizeof sentence, format, args);
	va_end(args);
	return mr_scan_fail(&o->text, o->line, "%s", sentence);
}

static bool
begins(const mr_scan *line, const char *word)
{
	size_t n = strlen(word);

	return (size_t)(line->end - line->p) >= n && !memcmp(line->p, word, n) &&
	       (line->p + n == line->end || mr_is_blank(line->p[n]));
}

/* ---- v, vt, vn ---- */

/* A word that is no number: NAN where it is one such as nan. */
static mr_status
odd_number(obj *o, mr_scan *line, const char *what, double *x)
{
	char shown[MR_SHOWN];
	const char *w;
	size_t n;

	mr_scan_word(line, &w, &n);
	*x = NAN;
	return mr_word_not_finite(w, n)
	           ? MR_OK
	           : bad(o, "%s has '%s' for a number", what, mr_word_shown(w, n, shown));
}

/* The numbers of a line into x, which has a place more than `most`. */
static mr_status
numbers(obj *o, mr_scan *line, const char *what, size_t least, size_t most, double *x, size_t *count)
{
	size_t n = 0;

	mr_skip_blanks(line);
	for (; line->p < line->end && *line->p != '#'; n++) {
		const char *e = mr_real_read(line->p, line->end, &x[n]);
		if (n == most)
			return bad(o, "%s has more than %zu numbers", what, most);
		if (e && (e == line->end || mr_is_blank(*e)))
			line->p = e;
		else
			MR_TRY(odd_number(o, line, what, &x[n]));
		mr_skip_blanks(line);
	}
	if (n < least)
		return bad(o, "%s has %zu numbers, not %zu", what, n, least);
	*count = n;
	return MR_OK;
}

static const char not_finite[] = "one is not a finite number",
		  not_there[] = "a face names one that does not stand before it";

static mr_status
set_color(obj *o, const double *c)
{
	if (!o->rgb) {
		o->rgb = MR_NEW(o->ctx, 3 * o->v_all, float);
		if (!o->rgb)
			return MR_EMEM;
		for (size_t i = 0; i < 3 * o->v_all; i++)
			o->rgb[i] = NAN;
	}
	for (int i = 0; i < 3; i++) {
		o->rgb[3 * o->v + (size_t)i] = (float)c[i];
		o->bright |= c[i] > 1;
		if (!isfinite(c[i]))
			o->odd_color = not_finite;
	}
	return MR_OK;
}

/* v x y z [w | r g b [a]]: with four numbers the last is a weight, with six or seven there is a colour. */
static mr_status
position(obj *o, mr_scan *line)
{
	double x[8];
	size_t n = 0;

	MR_TRY(numbers(o, line, "a vertex", 3, 7, x, &n));
	if (n == 5)
		return bad(o, "a vertex has 5 numbers, not 3, 4, 6 or 7");
	if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2]))
		return bad(o, "a coordinate is not finite");
	o->b.p[o->v] = mr_vec(x[0], x[1], x[2]);
	o->weights += n == 4 && x[3] != 1;
	if (n > 4)
		MR_TRY(set_color(o, x + 3));
	o->v++;
	return MR_OK;
}

static mr_status
texcoord(obj *o, mr_scan *line)
{
	double x[4] = { 0 };
	size_t n;

	MR_TRY(numbers(o, line, "a texture coordinate", 1, 3, x, &n));
	if (!isfinite(x[0]) || !isfinite(x[1]))
		o->odd_texcoord = not_finite;
	o->uv[2 * o->vt] = x[0];
	o->uv[2 * o->vt + 1] = x[1];
	o->vt++;
	return MR_OK;
}

static mr_status
normal(obj *o, mr_scan *line)
{
	double x[4];
	size_t n;

	MR_TRY(numbers(o, line, "a normal", 3, 3, x, &n));
	o->vn_values[o->vn] = mr_vec(x[0], x[1], x[2]);
	if (!mr_finite(o->vn_values[o->vn]))
		o->odd_normal = not_finite;
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
corner_end(const char *p, const char *end, bool *open)
{
	p = index_end(p, end);
	for (int slash = 0; slash < 2 && p && p < end && *p == '/'; slash++) {
		p++;
		if (p < end && *p != '/' && !mr_is_blank(*p))
			p = index_end(p, end);
		else
			*open = true;
	}
	return p && (p == end || mr_is_blank(*p)) ? p : NULL;
}

static mr_status
bad_corner(obj *o, const char *p, const char *end)
{
	mr_scan rest = { o->ctx, p, p, end };
	char shown[MR_SHOWN];
	const char *w;
	size_t n;

	mr_scan_word(&rest, &w, &n);
	return bad(
	    o, "'%s' is not a corner: v, v/vt, v//vn or v/vt/vn, counted from 1", mr_word_shown(w, n, shown));
}

static mr_status
check_face(obj *o, mr_scan *line)
{
	const char *p = line->p + 1;

	o->slashes = false;
	while (p < line->end && mr_is_blank(*p))
		p++;
	while (p < line->end) {
		const char *e = corner_end(p, line->end, &o->slashes);
		if (*p == '#') { /* tinyobj would read on */
			line->end = p;
			break;
		}
		if (!e)
			return bad_corner(o, p, line->end);
		for (p = e; p < line->end && mr_is_blank(*p); p++)
			;
	}
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

static mr_status
see_normal(obj *o, uint32_t v, uint32_t n)
{
	uint32_t *of;

	if (!o->normal_of) {
		o->normal_of = MR_NEW(o->ctx, o->v_all, uint32_t);
		if (!o->normal_of)
			return MR_EMEM;
		for (size_t i = 0; i < o->v_all; i++)
			o->normal_of[i] = UNSET;
	}
	of = &o->normal_of[v];
	if (*of == UNSET)
		*of = n;
	else if (*of != n && !(*of & SEVERAL) && memcmp(&o->vn_values[*of], &o->vn_values[n], sizeof(mr_v3)))
		*of |= SEVERAL;
	return MR_OK;
}

static mr_status
add_corner(obj *o, const mr_obj_corner *c, uint32_t *v)
{
	uint32_t t, n;

	if (!resolve(c->v, o->v, o->v_all, v))
		return bad(o, "vertex %d of %zu", c->v, o->v_all);
	if (c->vt && !(resolve(c->vt, o->vt, o->vt_all, &t) && t < o->vt))
		o->odd_texcoord = not_there;
	else if (c->vt)
		MR_TRY(mr_build_texcoord(&o->b, *v, o->uv[2 * (size_t)t], o->uv[2 * (size_t)t + 1]));
	if (c->vn && !(resolve(c->vn, o->vn, o->vn_all, &n) && n < o->vn))
		o->odd_normal = not_there;
	else if (c->vn)
		return see_normal(o, *v, n);
	return MR_OK;
}

static mr_status
add_face(obj *o, const mr_obj_corner *c, size_t n)
{
	MR_TRY(MR_RESERVE(o->ctx, o->corners, 0, n, &o->corner_room));
	for (size_t i = 0; i < n; i++)
		MR_TRY(add_corner(o, &c[i], &o->corners[i]));
	if (n == 3 && mr_build_triangle(&o->b, o->corners[0], o->corners[1], o->corners[2]))
		return MR_OK;
	return mr_build_face(&o->b, o->corners, n);
}

static void
face_call(void *user, const mr_obj_corner *c, int n)
{
	obj *o = user;

	if (o->status == MR_OK)
		o->status = add_face(o, c, (size_t)n);
}

/* ---- groups ---- */

/* The words of one g line are one name. */
static mr_status
add_name(obj *o, const char *word)
{
	size_t n = strlen(word);

	if (o->name_line != o->line)
		o->name_bytes = 0;
	o->name_line = o->line;
	MR_TRY(MR_RESERVE(o->ctx, o->name, o->name_bytes, n + 2, &o->name_room));
	if (o->name_bytes)
		o->name[o->name_bytes++] = ' ';
	memcpy(o->name + o->name_bytes, word, n);
	o->name_bytes += n;
	return MR_OK;
}

static void
name_call(void *user, mr_obj_naming kind, const char *name)
{
	obj *o = user;

	if (o->status == MR_OK && kind == o->naming)
		o->status = add_name(o, name);
}

/* A name takes effect when the next line is asked for: then it is complete. */
static mr_status
take_name(obj *o)
{
	if (!o->name_line)
		return MR_OK;
	o->name_line = NULL;
	return mr_build_group(&o->b, o->name, o->name_bytes);
}

/* ---- the file ---- */

/* Statements whose loss changes no surface of vertices and faces. */
static bool
known(const mr_scan *line)
{
	static const char *const words[] = { "s", "mtllib", "vp", "vw", "cstype", "deg", "bmat", "step",
		"curv", "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con", "mg", "bevel",
		"c_interp", "d_interp", "lod", "usemap", "maplib", "shadow_obj", "trace_obj", "ctech",
		"stech", "call", "csh", "t", NULL };

	for (const char *const *w = words; *w; w++)
		if (begins(line, *w))
			return true;
	return false;
}

static mr_status
unknown_statement(obj *o, mr_scan *line)
{
	char shown[MR_SHOWN];
	const char *w;
	size_t n;

	mr_scan_word(line, &w, &n);
	return bad(o, "'%s' begins no statement of OBJ", mr_word_shown(w, n, shown));
}

/* Reads one line here; *pass where tinyobj is to see it. */
static mr_status
one_line(obj *o, mr_scan *line, bool *pass)
{
	size_t left = (size_t)(line->end - line->p);
	char c = left ? *line->p : '#', d = left > 1 ? line->p[1] : ' ';

	*pass = o->slashes = false;
	if (c == '#')
		return MR_OK;
	if (c == 'v' && mr_is_blank(d))
		return line->p++, position(o, line);
	if (c == 'v' && (d == 't' || d == 'n') && (left == 2 || mr_is_blank(line->p[2])))
		return line->p += 2, d == 't' ? texcoord(o, line) : normal(o, line);
	if (c == 'f' && mr_is_blank(d)) {
		*pass = true;
		return check_face(o, line);
	}
	if (begins(line, "g") || begins(line, "o") || begins(line, "usemtl"))
		*pass = true;
	else if (begins(line, "l") || begins(line, "p"))
		o->lines_and_points++;
	else if (!known(line))
		return unknown_statement(o, line);
	return MR_OK;
}

/*
 * A line for tinyobj: a copy where it lacks its newline, holds a blank that tinyobj does not know, or a slash
 * with nothing behind it: there tinyobj takes the next corner's index.
 */
static mr_status
hand_over(obj *o, const mr_scan *line, const char **begin, const char **end)
{
	size_t n = (size_t)(line->end - line->p);
	bool whole = line->end < o->text.end && *line->end == '\n' && line->p != o->joined && n > 1 &&
	             !o->slashes;

	for (size_t i = 0; whole && i < n; i++)
		whole = (unsigned char)line->p[i] >= ' ' || line->p[i] == '\t';
	if (whole) {
		*begin = line->p;
		*end = line->end + 1;
		return MR_OK;
	}
	if (o->joined_room < n + 2 || line->p == o->joined) {
		o->joined_room = 2 * n + 256;
		o->joined = mr_grow(o->ctx, NULL, 0, o->joined_room, 1);
		if (!o->joined)
			return MR_EMEM;
	}
	o->joined[n] = ' '; /* tinyobj wants a blank behind a lone g */
	o->joined[n + 1] = '\n';
	for (size_t i = n; i-- > 0;) {
		char c = line->p[i];
		bool open = c == '/' && o->slashes && o->joined[i + 1] == ' ';
		o->joined[i] = open || (unsigned char)c < ' ' ? ' ' : c;
	}
	*begin = o->joined;
	*end = o->joined + n + 2;
	return MR_OK;
}

static mr_status
next_for_tinyobj(obj *o, const char **begin, const char **end)
{
	mr_scan line;
	bool pass = false;

	MR_TRY(take_name(o));
	while (!pass) {
		mr_status status = next_line(o, &line);
		if (status != MR_OK)
			return status;
		MR_TRY(one_line(o, &line, &pass));
	}
	return hand_over(o, &line, begin, end);
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
static mr_status
count_lines(obj *o)
{
	mr_scan start = o->text, line;
	bool groups = false, objects = false;
	mr_status status;

	while ((status = next_line(o, &line)) == MR_OK) {
		size_t left = (size_t)(line.end - line.p);
		char c = left ? *line.p : '#', d = left > 1 ? line.p[1] : ' ';
		if (c == 'v') {
			bool alone = left <= 2 || mr_is_blank(line.p[2]);
			o->v_all += mr_is_blank(d);
			o->vt_all += d == 't' && alone;
			o->vn_all += d == 'n' && alone;
		} else if (c == 'f')
			o->f_all += mr_is_blank(d);
		else if (mr_is_blank(d)) {
			groups |= c == 'g' && left > 2;
			objects |= c == 'o' && left > 2;
		}
	}
	o->text = start;
	o->naming = groups ? MR_OBJ_GROUP : objects ? MR_OBJ_OBJECT : MR_OBJ_MATERIAL;
	return status < 0 ? status : MR_OK;
}

/* ---- the model ---- */

static unsigned char
byte_of(double x)
{
	return (unsigned char)(x <= 0 ? 0 : x >= 255 ? 255 : x + 0.5);
}

static mr_status
finish_colors(obj *o)
{
	float scale = o->bright ? 1 : 255;
	size_t missing = 0;

	if (!o->rgb)
		return MR_OK;
	if (o->odd_color) {
		mr_dropped(o->ctx, &o->b.counts->dropped_colors, "colors", o->odd_color);
		return MR_OK;
	}
	o->b.color = MR_NEW(o->ctx, 4 * o->v_all, unsigned char);
	if (!o->b.color)
		return MR_EMEM;
	for (size_t i = 0; i < o->v_all; i++) {
		bool none = isnan(o->rgb[3 * i]);
		for (size_t k = 0; k < 3; k++)
			o->b.color[4 * i + k] = none ? 255 : byte_of((double)(scale * o->rgb[3 * i + k]));
		o->b.color[4 * i + 3] = 255;
		missing += none;
	}
	if (missing)
		mr_note(o->ctx, "%zu vertices without a colour are white", missing);
	return MR_OK;
}

/* A normal per vertex where its faces agree, or where a cloud has as many as points. */
static mr_status
finish_normals(obj *o)
{
	size_t several = 0;

	if (o->odd_normal) {
		mr_dropped(o->ctx, &o->b.counts->dropped_normals, "normals", o->odd_normal);
		return MR_OK;
	}
	if (o->b.faces == 0 && o->vn_all == o->v_all) {
		o->b.normal = o->vn_values;
		return MR_OK;
	}
	if (!o->normal_of)
		return MR_OK;
	for (size_t i = 0; i < o->v_all; i++)
		several += (o->normal_of[i] & SEVERAL) != 0;
	o->b.counts->crease_vertices = several;
	if (several) {
		mr_dropped(o->ctx, &o->b.counts->dropped_normals, "normals",
		    "some vertices have several, as on creases");
		return MR_OK;
	}
	o->b.normal = MR_NEW(o->ctx, o->v_all, mr_v3);
	if (!o->b.normal)
		return MR_EMEM;
	for (size_t i = 0; i < o->v_all; i++)
		o->b.normal[i] = o->normal_of[i] == UNSET ? mr_vec(0, 0, 0) : o->vn_values[o->normal_of[i]];
	return MR_OK;
}

static mr_status
finish(obj *o, mr_model *m)
{
	if (o->odd_texcoord) {
		mr_dropped(o->ctx, &o->b.counts->dropped_texcoords, "texcoords", o->odd_texcoord);
		o->b.texcoord = NULL;
		o->b.corner_seen = NULL;
	}
	MR_TRY(finish_colors(o));
	MR_TRY(finish_normals(o));
	if (o->lines_and_points)
		mr_note(o->ctx, "%zu line and point elements left out", o->lines_and_points);
	if (o->weights)
		mr_note(o->ctx, "%zu weights of vertices left out", o->weights);
	return mr_build_finish(&o->b, m);
}

mr_status
mr_obj_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	obj o = {
		.ctx = ctx, .text = mr_scan_of(ctx, data, size), .b = { .ctx = ctx, .counts = &m->counts }
	};
	mr_obj_calls calls = { line_call, face_call, name_call, &o };

	MR_TRY(count_lines(&o));
	if (o.vn_all >= UNSET || o.vt_all >= UNSET)
		return mr_fail(ctx, MR_ERANGE, "more normals or texture coordinates than indices can name");
	MR_TRY(mr_build_vertices(&o.b, o.v_all));
	MR_TRY(mr_build_reserve(&o.b, o.f_all));
	o.uv = MR_NEW(ctx, 2 * o.vt_all, double);
	o.vn_values = MR_NEW(ctx, o.vn_all, mr_v3);
	if (!o.uv || !o.vn_values)
		return MR_EMEM;
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
		return known(&line) && !begins(&line, "end");
	}
	return false;
}
