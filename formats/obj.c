/* Wavefront OBJ.  Blocks of lines are read at once, then joined in order.  tinyobj reads faces, through
 * obj_shim, except plain indices, once their line is checked: it takes any word for an index.  v, vt and vn
 * lines, whose numbers must be exact, and names with blanks are read here. */
#include <ctype.h>

#include "base/parallel.h"
#include "formats/format.h"
#include "formats/obj_shim.h"

typedef enum kind { V, VT, VN, FACE, NOTHING, OTHER, KINDS } kind;

/* Counts of what the reader leaves out: surplus numbers of a v or vt line, texture coordinates that are not
 * finite, indices without a value, unknown statements. */
typedef enum loss { NUMBERS, ODD_TEXCOORDS, NO_TEXCOORDS, NO_NORMALS, STATEMENTS, LOSSES } loss;

/* The begin of a block, and how many lines of each kind come before it. */
typedef struct boundary {
	const char *begin;
	size_t lines[KINDS];
} boundary;

typedef struct obj {
	mr_ctx *ctx;
	mr_scan text;       /* of the whole file */
	boundary *boundary; /* of each block, and the end */
	size_t blocks;
	size_t all[KINDS]; /* lines */
	double *uv;        /* pairs */
	mr_v3 *vn_values;
	mr_rows rows; /* of vertices: positions and colours */
	size_t lost[LOSSES];
} obj;

/* A statement that marks all faces after it. */
typedef struct mark {
	size_t face, corner; /* of the block */
	mr_marking what;
	mr_scan name;
} mark;

enum { ROW = 7 }; /* numbers that a vertex may have */

/* Whole lines, and what has been read of them. */
typedef struct block {
	mr_ctx ctx; /* its own, as is all memory here: others are read at the same time */
	const obj *o;
	mr_scan text;
	size_t so_far[KINDS]; /* lines of the file before the one at hand */
	const char *line;     /* the face at hand, for errors */
	char *face;           /* its line, as tinyobj reads it */
	size_t face_room;
	double *row; /* of each vertex */
	size_t rows;
	uint32_t *corner[3]; /* of all faces: vertices, texture coordinates, normals */
	uint32_t *size;      /* corners of each face */
	size_t corners, faces, skipped;
	mark *mark;
	size_t marks, mark_room;
	size_t lost[LOSSES];
	mr_status status; /* of the first failure, after which nothing is read */
} block;

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
position(block *b, mr_scan *line)
{
	double *x = b->row + ROW * b->rows;
	size_t n = 0;

	MR_TRY(mr_scan_reals(line, "a vertex", 3, ROW, x, &n));
	if (n == 5)
		return mr_scan_fail(line, line->p, "a vertex has 5 numbers, not 3, 4, 6 or 7");
	b->lost[NUMBERS] += (n == 4 && x[3] != 1) || (n > 6 && x[6] != 1);
	if (n <= 4)
		x[3] = x[4] = x[5] = (double)NAN;
	b->rows++;
	return MR_OK;
}

static mr_status
texcoord(block *b, mr_scan *line)
{
	double x[3] = { 0 }, *uv = b->o->uv + 2 * b->so_far[VT];
	size_t n = 0;

	MR_TRY(mr_scan_reals(line, "a texture coordinate", 1, 3, x, &n));
	if (!isfinite(x[0]) || !isfinite(x[1])) {
		x[0] = x[1] = NAN; /* none */
		b->lost[ODD_TEXCOORDS]++;
	}
	b->lost[NUMBERS] += n == 3 && x[2] != 0;
	uv[0] = x[0], uv[1] = x[1];
	return MR_OK;
}

static mr_status
normal(block *b, mr_scan *line)
{
	double x[3] = { 0 };
	size_t n;

	MR_TRY(mr_scan_reals(line, "a normal", 3, 3, x, &n));
	b->o->vn_values[b->so_far[VN]] = mr_vec(x[0], x[1], x[2]);
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

/* The index of a value that a corner names, which may come later in the file; MR_NONE if it names none. */
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

/* Adds a face: the n corners after the last face's. */
static void
end_face(block *b, size_t n)
{
	if (n < 3) {
		b->skipped += n > 0;
		return;
	}
	b->size[b->faces++] = (uint32_t)n;
	b->corners += n;
}

/* A place of the file's line of indices from 1; NULL where there is another, or none. */
static const char *
plain_index(const char *p, const char *end, size_t all, uint32_t *place)
{
	const char *digits = p;
	uint32_t i = 0;

	for (; p < end && mr_is_digit(*p) && p - digits < 9; p++)
		i = 10 * i + (uint32_t)(*p - '0');
	*place = i - 1;
	return i > 0 && i <= all ? p : NULL;
}

/* v, v/vt, v//vn or v/vt/vn of indices from 1 that are all there; NULL of any other. */
static const char *
plain_corner(block *b, const char *p, const char *end, size_t at)
{
	const size_t *all = b->o->all;

	b->corner[1][at] = b->corner[2][at] = MR_NONE;
	p = plain_index(p, end, all[V], &b->corner[0][at]);
	if (p && p < end && *p == '/') {
		if (++p < end && *p != '/')
			p = plain_index(p, end, all[VT], &b->corner[1][at]);
		if (p && p < end && *p == '/')
			p = plain_index(p + 1, end, all[VN], &b->corner[2][at]);
	}
	return p && (p == end || mr_is_blank(*p)) ? p : NULL;
}

/* The usual case, kept short; false where tinyobj is to read the face. */
static bool
plain_face(block *b, const mr_scan *line)
{
	mr_scan at = *line;
	size_t n = 0;

	for (at.p++; mr_skip_blanks(&at), at.p < at.end && *at.p != '#'; n++) {
		at.p = plain_corner(b, at.p, at.end, b->corners + n);
		if (!at.p)
			return false;
	}
	end_face(b, n);
	return true;
}

static mr_status
add_face(block *b, const mr_obj_corner *c, size_t n)
{
	const size_t *all = b->o->all, *so_far = b->so_far;

	for (size_t i = 0, at = b->corners; i < n; i++, at++) {
		if (!resolve(c[i].v, so_far[V], all[V], &b->corner[0][at]))
			return mr_scan_fail(&b->text, b->line, "vertex %d of %zu", c[i].v, all[V]);
		b->corner[1][at] = place_of(c[i].vt, so_far[VT], all[VT], &b->lost[NO_TEXCOORDS]);
		b->corner[2][at] = place_of(c[i].vn, so_far[VN], all[VN], &b->lost[NO_NORMALS]);
	}
	end_face(b, n);
	return MR_OK;
}

static void
face_call(void *user, const mr_obj_corner *c, int n)
{
	block *b = user;

	if (b->status == MR_OK)
		b->status = add_face(b, c, (size_t)n);
}

/* ---- names ---- */

/* A number or "off"; other words count as left out. */
static void
smoothing(obj *o, const mr_scan *name)
{
	uint64_t group = 0;
	const char *p = name->p;

	for (; p < name->end && mr_is_digit(*p) && group <= UINT32_MAX; p++)
		group = 10 * group + (uint64_t)(*p - '0');
	if (p > name->p ? group <= UINT32_MAX && (p == name->end || mr_is_blank(*p)) : begins(name, "off"))
		mr_build_smoothing(&o->rows.b, (uint32_t)group);
	else
		o->lost[STATEMENTS]++;
}

static void
put_mark(obj *o, const mark *k)
{
	size_t bytes = (size_t)(k->name.end - k->name.p);

	if (k->what == MR_SMOOTHING)
		smoothing(o, &k->name);
	else if (k->what == MR_MARKINGS)
		mr_build_library(&o->rows.b, k->name.p, bytes);
	else
		mr_build_mark(&o->rows.b, k->what, k->name.p, bytes, false);
}

/* A statement that marks the faces to come, or names materials' files; false for any other. */
static bool
is_mark(block *b, mr_scan *line)
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
	MR_RESERVE(&b->ctx, b->mark, b->marks, 1, &b->mark_room);
	b->mark[b->marks++] = (mark){ b->faces, b->corners, words[i].what, *line };
	return true;
}

/* ---- lines of a block ---- */

/* Other statements are skipped, if they begin with a word as statements do. */
static mr_status
other_statement(block *b, mr_scan *line)
{
	char shown[MR_SHOWN];
	const char *w;
	size_t n;

	mr_scan_word(line, &w, &n);
	if ((*w | 32) < 'a' || (*w | 32) > 'z')
		return mr_scan_fail(line, w, "'%s' begins no statement of OBJ", mr_word_shown(w, n, shown));
	b->lost[STATEMENTS]++;
	return MR_OK;
}

static kind
kind_of(const mr_scan *line)
{
	size_t left = (size_t)(line->end - line->p);
	char c = left ? *line->p : '#', d = left > 1 ? line->p[1] : ' ';

	if (c == '#')
		return NOTHING;
	if ((c == 'v' || c == 'f') && mr_is_blank(d))
		return c == 'v' ? V : FACE;
	if (c == 'v' && (d == 't' || d == 'n') && (left == 2 || mr_is_blank(line->p[2])))
		return d == 't' ? VT : VN;
	return OTHER;
}

/* Reads one line here; *pass where tinyobj is to see it. */
static mr_status
one_line(block *b, mr_scan *line, kind k, bool *pass)
{
	switch (k) {
	case V:
		return line->p++, position(b, line);
	case VT:
		return line->p += 2, texcoord(b, line);
	case VN:
		return line->p += 2, normal(b, line);
	case FACE:
		*pass = !plain_face(b, line);
		return *pass ? check_face(line) : MR_OK;
	case OTHER:
		return is_mark(b, line) ? MR_OK : other_statement(b, line);
	default:
		return MR_OK;
	}
}

/* A line for tinyobj, which knows few blanks, and after a bare slash takes the next corner's index. */
static void
hand_over(block *b, const mr_scan *line, const char **begin, const char **end)
{
	size_t n = (size_t)(line->end - line->p);

	MR_RESERVE(&b->ctx, b->face, 0, n + 2, &b->face_room);
	b->face[n] = ' ';
	b->face[n + 1] = '\n';
	for (size_t i = n; i-- > 0;) {
		char c = line->p[i];
		b->face[i] = mr_is_blank(c) || (c == '/' && b->face[i + 1] == ' ') ? ' ' : c;
	}
	*begin = b->face;
	*end = b->face + n + 2;
}

/* The next line, without leading blanks. */
static bool
next_line(mr_scan *text, mr_scan *line)
{
	if (!mr_scan_line(text, line))
		return false;
	mr_skip_blanks(line);
	return true;
}

/* Nothing unwinds through tinyobj. */
static mr_status
next_for_tinyobj(block *b, const char **begin, const char **end)
{
	mr_scan line;
	bool pass = false;

	MR_ENTER(&b->ctx);
	while (!pass) {
		kind k;
		if (!next_line(&b->text, &line))
			return MR_END;
		k = kind_of(&line);
		MR_TRY(one_line(b, &line, k, &pass));
		b->so_far[k]++;
	}
	b->line = line.p;
	hand_over(b, &line, begin, end);
	return MR_OK;
}

static bool
line_call(void *user, const char **begin, const char **end)
{
	block *b = user;

	if (b->status == MR_OK)
		b->status = next_for_tinyobj(b, begin, end);
	return b->status == MR_OK;
}

/* ---- blocks ---- */

enum { BLOCK = 1 << 16 };

/* Counts the lines of each kind in blocks, so that arrays have their size and an index can be checked at
 * once. */
static void
count_lines(void *arg, size_t begin, size_t end)
{
	obj *o = arg;

	for (size_t i = begin; i < end; i++) {
		mr_scan text = o->text, line;
		text.p = o->boundary[i].begin;
		text.end = o->boundary[i + 1].begin;
		while (next_line(&text, &line))
			o->boundary[i].lines[kind_of(&line)]++;
	}
}

/* Cuts the file into blocks at ends of lines. */
static void
cut(obj *o)
{
	size_t size = (size_t)(o->text.end - o->text.p), most = size / BLOCK + 1;

	o->boundary = MR_NEW_ZERO(o->ctx, most + 1, boundary);
	for (const char *p = o->text.p, *e; p < o->text.end; p = e ? e + 1 : o->text.end) {
		o->boundary[o->blocks++].begin = p;
		e = o->text.end - p > BLOCK ? memchr(p + BLOCK, '\n', (size_t)(o->text.end - p - BLOCK))
		                            : NULL;
	}
	o->boundary[o->blocks].begin = o->text.end;
}

/* Cuts, and counts the lines before each block. */
static void
find_blocks(obj *o)
{
	cut(o);
	mr_parallel(o->ctx, o->blocks, 1, count_lines, o);
	for (size_t i = 0; i <= o->blocks; i++)
		for (kind k = 0; k < KINDS; k++) {
			size_t here = o->boundary[i].lines[k];
			o->boundary[i].lines[k] = o->all[k];
			o->all[k] += here;
		}
}

/* Room for all that the block can have; a corner takes two bytes at least. */
static void
make_room(block *b, const boundary *at)
{
	size_t most = (size_t)(at[1].begin - at[0].begin) / 2 + 1;

	b->row = MR_NEW(&b->ctx, ROW * (at[1].lines[V] - at[0].lines[V]), double);
	b->size = MR_NEW(&b->ctx, at[1].lines[FACE] - at[0].lines[FACE], uint32_t);
	for (int k = 0; k < 3; k++)
		b->corner[k] = MR_NEW(&b->ctx, most, uint32_t);
}

static mr_status
read_block(block *b, const boundary *at)
{
	mr_obj_calls calls = { line_call, face_call, b };

	MR_ENTER(&b->ctx);
	make_room(b, at);
	b->text = b->o->text;
	b->text.ctx = &b->ctx;
	b->text.p = at[0].begin;
	b->text.end = at[1].begin;
	memcpy(b->so_far, at->lines, sizeof b->so_far);
	if (!mr_obj_parse(&calls))
		return mr_fail(&b->ctx, MR_EMEM, "no memory for a line of the file");
	return b->status;
}

static bool
is_any(const uint32_t *place, size_t n)
{
	bool any = false;

	for (size_t i = 0; i < n; i++)
		any |= place[i] != MR_NONE;
	return any;
}

/* Gives the faces from one mark to the next to the builder. */
static void
put_faces(obj *o, const block *b, const mark *from, const mark *to)
{
	size_t corners = to->corner - from->corner;
	const uint32_t *c[3];

	for (int k = 0; k < 3; k++)
		c[k] = b->corner[k] + from->corner;
	mr_build_faces(&o->rows.b, b->size + from->face, to->face - from->face, c[0],
	    is_any(c[1], corners) ? c[1] : NULL, is_any(c[2], corners) ? c[2] : NULL);
}

/* Adds what a block has to what those before it had. */
static mr_status
join(obj *o, const block *b)
{
	mark from = { 0 };
	const mark end = { .face = b->faces, .corner = b->corners };

	MR_TRY(mr_fail_as(o->ctx, &b->ctx, b->status));
	for (size_t i = 0; i < b->rows; i++)
		mr_rows_put(&o->rows, b->row + ROW * i);
	for (size_t i = 0; i < b->marks; from = b->mark[i++]) {
		put_faces(o, b, &from, &b->mark[i]);
		put_mark(o, &b->mark[i]);
	}
	put_faces(o, b, &from, &end);
	o->rows.b.skipped += b->skipped;
	for (int i = 0; i < LOSSES; i++)
		o->lost[i] += b->lost[i];
	return MR_OK;
}

/* Blocks that are read at the same time. */
typedef struct batch {
	obj *o;
	size_t first;
	block block[32];
} batch;

static void
read_blocks(void *arg, size_t begin, size_t end)
{
	batch *t = arg;

	for (size_t i = begin; i < end; i++) {
		block *b = &t->block[i];
		*b = (block){ .o = t->o };
		mr_keep(t->o->ctx, &b->ctx);
		b->status = read_block(b, t->o->boundary + t->first + i);
	}
}

static mr_status
join_blocks(batch *t, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		MR_TRY(join(t->o, &t->block[i]));
		mr_ctx_free(&t->block[i].ctx);
	}
	return MR_OK;
}

static void
free_batch(void *p)
{
	batch *t = p;

	for (size_t i = 0; i < sizeof t->block / sizeof *t->block; i++)
		mr_ctx_free(&t->block[i].ctx);
}

static mr_status
read_all(obj *o)
{
	batch *t = MR_NEW_ZERO(o->ctx, 1, batch);
	const size_t most = sizeof t->block / sizeof *t->block;

	t->o = o;
	mr_own(o->ctx, free_batch, t);
	for (; t->first < o->blocks; t->first += most) {
		size_t left = o->blocks - t->first, n = left < most ? left : most;
		mr_parallel(o->ctx, n, 1, read_blocks, t);
		MR_TRY(join_blocks(t, n));
	}
	return MR_OK;
}

/* ---- the model ---- */

/* As many values as vertices, none named by a corner, are values of the vertices. */
static bool
are_of_vertices(const obj *o, const uint32_t *place, size_t astray, size_t n)
{
	return !place && !astray && n == o->all[V];
}

static void
finish_texcoords(obj *o)
{
	const char *what = "texture coordinates";

	if (are_of_vertices(o, o->rows.b.corner_uv, o->lost[NO_TEXCOORDS], o->all[VT])) {
		if (mr_all_left(o->ctx, o->lost[ODD_TEXCOORDS], o->all[VT], what))
			o->rows.b.m.texcoord = o->uv;
		return;
	}
	if (!mr_left_out(o->ctx, o->lost[ODD_TEXCOORDS], o->all[VT], what))
		o->rows.b.corner_uv = NULL;
	mr_lost(o->ctx, NULL, o->lost[NO_TEXCOORDS], "texture coordinates that are not there");
}

static void
finish_normals(obj *o)
{
	bool of_vertices = are_of_vertices(o, o->rows.b.corner_vn, o->lost[NO_NORMALS], o->all[VN]);

	if (!mr_normals_left(o->ctx, o->vn_values, o->all[VN]))
		o->rows.b.corner_vn = NULL;
	else if (of_vertices)
		o->rows.b.m.normal = o->vn_values;
	mr_lost(o->ctx, NULL, o->lost[NO_NORMALS], "normals that are not there");
}

static mr_status
finish(obj *o, mr_model *m)
{
	o->rows.b.uv = o->uv;
	o->rows.b.vn = o->vn_values;
	mr_rows_end(&o->rows);
	finish_texcoords(o);
	finish_normals(o);
	mr_lost(o->ctx, NULL, o->lost[NUMBERS], "weights, alpha or third texture coordinates");
	mr_lost(o->ctx, NULL, o->lost[STATEMENTS], "other statements");
	return mr_build_finish(&o->rows.b, m);
}

static mr_status
begin_vertices(obj *o)
{
	o->rows.sparse = true;
	mr_rows_add_unnamed(&o->rows, MR_X, 3);
	mr_rows_add_unnamed(&o->rows, MR_RED, 3);
	mr_rows_begin(&o->rows);
	return mr_rows_room(&o->rows, o->all[V]);
}

/* The text, each line that ends in a backslash after a number or a blank and the next as one: names may end
 * so. */
static const unsigned char *
join_lines(mr_ctx *ctx, const unsigned char *data, size_t size)
{
	const unsigned char *end = data + size;
	unsigned char *joined = NULL;

	for (const unsigned char *p = data; p < end && (p = memchr(p, '\\', (size_t)(end - p))); p++) {
		size_t left = (size_t)(end - p), n = left > 2 && p[1] == '\r' && p[2] == '\n' ? 3 : 2;
		if (left < n || p[n - 1] != '\n' || p == data ||
		    !(isdigit(p[-1]) || mr_is_blank((char)p[-1])))
			continue;
		if (!joined)
			joined = memcpy(MR_NEW(ctx, size, unsigned char), data, size);
		memset(joined + (p - data), ' ', n);
	}
	return joined ? joined : data;
}

mr_status
mr_obj_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	obj o = { .ctx = ctx,
		.text = mr_scan_of(ctx, join_lines(ctx, data, size), size),
		.rows.b = { .ctx = ctx, .ungrouped = "default" } };

	find_blocks(&o);
	if (o.all[VN] >= MR_NONE || o.all[VT] >= MR_NONE)
		return mr_fail(ctx, MR_ERANGE, "more normals or texture coordinates than indices can name");
	MR_TRY(begin_vertices(&o));
	MR_TRY(mr_build_reserve(&o.rows.b, o.all[FACE]));
	o.uv = MR_NEW(ctx, 2 * o.all[VT], double);
	o.vn_values = MR_NEW(ctx, o.all[VN], mr_v3);
	MR_TRY(read_all(&o));
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
