/*
 * Object File Format (Geomview), read: the keyword [ST][C][N]OFF, of MeshLab [C][N][ST]OFF, which says what a
 * vertex has besides its position, then text or "BINARY".  Binary files are big-endian with a number of
 * colour components behind each face, as Geomview has them, or little-endian without, as others write them:
 * the one that fits the size to the byte is meant.
 */
#include "formats/format.h"

typedef struct off {
	mr_ctx *ctx;
	mr_scan text;
	bool normals, colors, texcoords, binary;
	mr_builder b;
	mr_rows rows;
	uint64_t nv, nf;
	size_t face_colors; /* faces that have one */
	size_t ignored;     /* numbers behind a vertex that the keyword does not announce */
	uint32_t *corner;
	size_t corner_room;
} off;

/* ---- the keyword ---- */

static bool
take(mr_scan *t, const char *s)
{
	size_t n = strlen(s);

	if ((size_t)(t->end - t->p) < n || memcmp(t->p, s, n))
		return false;
	t->p += n;
	return true;
}

/* Reads the keyword; false where there is none.  `dimensions`: of those it announces, four or n. */
static bool
keyword(off *f, bool *dimensions)
{
	mr_scan t = f->text;

	mr_skip_comments(&t);
	f->texcoords = take(&t, "ST");
	f->colors = take(&t, "C");
	f->normals = take(&t, "N");
	f->texcoords |= take(&t, "ST");
	*dimensions = take(&t, "4") || take(&t, "n");
	if (!take(&t, "OFF"))
		return false;
	if (t.p < t.end && !mr_is_blank(*t.p) && *t.p != '\n' && *t.p != '#' && !mr_is_digit(*t.p))
		return false;
	f->text.p = t.p;
	mr_skip_blanks(&t);
	if (take(&t, "BINARY")) {
		mr_scan rest = t, line;
		f->binary = true;
		mr_scan_line(&rest, &line);
		f->text.p = rest.p;
	}
	return true;
}

bool
mr_off_sniff(const unsigned char *data, size_t size)
{
	off f = { .text = mr_scan_of(NULL, data, size) };
	bool dimensions;

	return keyword(&f, &dimensions);
}

/* ---- vertices ---- */

/* The numbers of a vertex: three, then of the normal, the colour, and the texture coordinates. */
enum { MOST = 3 + 3 + 4 + 2 };

static mr_status
begin_vertices(off *f)
{
	static const mr_role roles[MOST] = { MR_X, MR_Y, MR_Z, MR_NX, MR_NY, MR_NZ, MR_RED, MR_GREEN, MR_BLUE,
		MR_ALPHA, MR_U, MR_V };

	for (size_t i = 0; i < MOST; i++)
		if (i < 3 || (i < 6 && f->normals) || (i >= 6 && i < 10 && f->colors) ||
		    (i >= 10 && f->texcoords))
			mr_rows_add(&f->rows, roles[i], "", 0, NULL);
	mr_rows_begin(&f->rows);
	return mr_rows_room(&f->rows, f->nv);
}

/* The numbers left on the line. */
static mr_status
line_rest(off *f, double *x, size_t most, size_t *count)
{
	size_t n = 0;

	for (mr_skip_blanks(&f->text); f->text.p < f->text.end && *f->text.p != '\n' && *f->text.p != '#';
	     mr_skip_blanks(&f->text)) {
		if (n == most)
			return mr_scan_fail(
			    &f->text, f->text.p, "more numbers on a line than a vertex can have");
		MR_TRY(mr_scan_real(&f->text, "a number of a vertex", &x[n++]));
	}
	*count = n;
	return MR_OK;
}

/* x y z [nx ny nz] [r g b [a]] [s t], on one line from the third number on. */
static mr_status
text_vertex(off *f)
{
	size_t n = 3, rest = 0, colors, wanted = f->texcoords ? 2 : 0;
	double x[MOST] = { 0 }, more[8] = { 0 };
	const char *where;
	mr_v3 p;

	mr_skip_comments(&f->text);
	where = f->text.p;
	MR_TRY(mr_scan_position(&f->text, &p));
	x[0] = p.x, x[1] = p.y, x[2] = p.z;
	for (int k = 0; f->normals && k < 3; k++)
		MR_TRY(mr_scan_real(&f->text, "a normal", &x[n++]));
	MR_TRY(line_rest(f, more, 8, &rest));
	if (rest < wanted)
		return mr_scan_fail(&f->text, where, "a vertex lacks its texture coordinates");
	colors = rest - wanted;
	if (f->colors && colors != 3 && colors != 4)
		return mr_scan_fail(
		    &f->text, where, "a vertex with %zu colour components, not 3 or 4", colors);
	for (size_t k = 0; f->colors && k < 4; k++)
		x[n++] = k < colors ? more[k] : (double)NAN;
	f->ignored += f->colors ? 0 : colors;
	memcpy(x + n, more + colors, wanted * sizeof *x);
	mr_rows_put(&f->rows, x);
	return MR_OK;
}

static mr_status
finish(off *f, mr_model *m)
{
	mr_lost(f->ctx, NULL, f->face_colors, "colors of faces");
	mr_lost(f->ctx, NULL, f->ignored, "numbers behind vertices");
	return mr_build_finish(&f->b, m);
}

/* ---- text ---- */

static mr_status
text_face(off *f)
{
	const char *where, *e;
	uint64_t n, v;

	mr_skip_comments(&f->text);
	where = f->text.p;
	MR_TRY(mr_scan_count(&f->text, "the number of corners of a face", UINT32_MAX, &n));
	if (n > (size_t)(f->text.end - f->text.p) / 2 + 1)
		return mr_scan_fail(&f->text, where, "a face of %llu corners, beyond the end of the file",
		    (unsigned long long)n);
	MR_RESERVE(f->ctx, f->corner, 0, (size_t)n, &f->corner_room);
	for (size_t i = 0; i < n; i++) {
		MR_TRY(mr_scan_count(&f->text, "a corner of a face", UINT32_MAX, &v));
		if (v >= f->nv)
			return mr_scan_fail(&f->text, where, "vertex %llu of %llu", (unsigned long long)v,
			    (unsigned long long)f->nv);
		f->corner[i] = (uint32_t)v;
	}
	mr_skip_blanks(&f->text);
	if (f->text.p < f->text.end && *f->text.p != '\n') {
		f->face_colors += *f->text.p != '#';
		e = memchr(f->text.p, '\n', (size_t)(f->text.end - f->text.p));
		f->text.p = e ? e : f->text.end;
	}
	if (n == 3 && mr_build_triangle(&f->b, f->corner[0], f->corner[1], f->corner[2]))
		return MR_OK;
	mr_build_face(&f->b, f->corner, NULL, NULL, (size_t)n);
	return MR_OK;
}

/* Vertices, faces and, which nobody needs, edges: on one line. */
static mr_status
text_counts(off *f)
{
	uint64_t edges;
	size_t left;
	const char *where;

	mr_skip_comments(&f->text);
	where = f->text.p;
	MR_TRY(mr_scan_count(&f->text, "the number of vertices", UINT64_MAX / 16, &f->nv));
	MR_TRY(mr_scan_count(&f->text, "the number of faces", UINT64_MAX / 16, &f->nf));
	mr_skip_blanks(&f->text);
	if (f->text.p < f->text.end && *f->text.p != '\n' && *f->text.p != '#')
		MR_TRY(mr_scan_count(&f->text, "the number of edges", UINT64_MAX / 16, &edges));
	left = (size_t)(f->text.end - f->text.p) + 1;
	if (f->nv > left / 6 || f->nf > left / 2)
		return mr_scan_fail(&f->text, where,
		    "%llu vertices and %llu faces cannot be in the %zu bytes that follow",
		    (unsigned long long)f->nv, (unsigned long long)f->nf, left - 1);
	return MR_OK;
}

static mr_status
read_text(off *f, mr_model *m)
{
	MR_TRY(text_counts(f));
	MR_TRY(begin_vertices(f));
	MR_TRY(mr_build_reserve(&f->b, f->nf < MR_NONE / 3 ? (size_t)f->nf : 0));
	for (uint64_t i = 0; i < f->nv; i++)
		MR_TRY(text_vertex(f));
	mr_rows_end(&f->rows);
	for (uint64_t i = 0; i < f->nf; i++)
		MR_TRY(text_face(f));
	mr_skip_comments(&f->text);
	mr_scan_rest(&f->text);
	return finish(f, m);
}

/* ---- binary ---- */

typedef struct layout {
	bool big, face_colors;
} layout;

/* Walks over the faces; true where they end with the file. */
static bool
fits(const off *f, const unsigned char *p, const unsigned char *end, layout l)
{
	uint64_t left = (uint64_t)(end - p), nv, nf, vertices;

	if (left < 12)
		return false;
	nv = mr_load32(p, l.big);
	nf = mr_load32(p + 4, l.big);
	vertices = nv * 4 * f->rows.columns;
	if (vertices > left - 12)
		return false;
	for (p += 12 + vertices; nf > 0 && (size_t)(end - p) >= 4; nf--) {
		uint64_t n = mr_load32(p, l.big);
		p += 4;
		if (4 * (n + l.face_colors) > (uint64_t)(end - p))
			return false;
		p += 4 * n;
		if (l.face_colors) {
			uint64_t colors = mr_load32(p, l.big);
			p += 4;
			if (4 * colors > (uint64_t)(end - p))
				return false;
			p += 4 * colors;
		}
	}
	return nf == 0 && p == end;
}

static mr_status
binary_vertices(off *f, const unsigned char *p, layout l)
{
	double x[MOST];

	MR_TRY(mr_rows_room(&f->rows, f->nv));
	for (uint64_t i = 0; i < f->nv; i++) {
		for (size_t k = 0; k < f->rows.columns; k++, p += 4)
			x[k] = (double)mr_load_float(p, l.big);
		if (!mr_finite(mr_rows_position(&f->rows, x)))
			return mr_fail(f->ctx, MR_EFORMAT, "byte %zu: a coordinate is not finite",
			    (size_t)((const char *)p - f->text.start) - 4 * f->rows.columns);
		mr_rows_put(&f->rows, x);
	}
	mr_rows_end(&f->rows);
	return MR_OK;
}

static mr_status
binary_faces(off *f, const unsigned char *p, layout l)
{
	for (uint64_t i = 0; i < f->nf; i++) {
		size_t n = mr_load32(p, l.big);
		MR_RESERVE(f->ctx, f->corner, 0, n, &f->corner_room);
		p += 4;
		for (size_t k = 0; k < n; k++, p += 4) {
			f->corner[k] = mr_load32(p, l.big);
			if (f->corner[k] >= f->nv)
				return mr_fail(f->ctx, MR_EFORMAT, "byte %zu: vertex %u of %zu",
				    (size_t)((const char *)p - f->text.start), f->corner[k], f->b.nv);
		}
		if (l.face_colors) {
			f->face_colors += mr_load32(p, l.big) > 0;
			p += 4 + 4 * (size_t)mr_load32(p, l.big);
		}
		mr_build_face(&f->b, f->corner, NULL, NULL, n);
	}
	return MR_OK;
}

static mr_status
read_binary(off *f, mr_model *m)
{
	static const layout layouts[] = { { true, true }, { false, false }, { false, true },
		{ true, false } };
	const unsigned char *p = (const unsigned char *)f->text.p, *end = (const unsigned char *)f->text.end;
	size_t i = 0;

	MR_TRY(begin_vertices(f));
	while (i < 4 && !fits(f, p, end, layouts[i]))
		i++;
	if (i == 4)
		return mr_fail(f->ctx, MR_EFORMAT,
		    "byte %zu: the numbers of vertices and faces, in neither byte order, fit the %zu bytes",
		    (size_t)(f->text.p - f->text.start), (size_t)(end - p));
	f->nv = mr_load32(p, layouts[i].big);
	f->nf = mr_load32(p + 4, layouts[i].big);
	MR_TRY(binary_vertices(f, p + 12, layouts[i]));
	MR_TRY(binary_faces(f, p + 12 + 4 * f->nv * f->rows.columns, layouts[i]));
	return finish(f, m);
}

/* Of a text that begins with no keyword. */
static mr_status
check_variant(const off *f)
{
	char shown[MR_SHOWN];
	mr_scan t = f->text;
	const char *w;
	size_t n;

	mr_skip_comments(&t);
	if (!mr_scan_word(&t, &w, &n) || n < 3 || memcmp(w + n - 3, "OFF", 3) != 0)
		return MR_OK;
	return mr_scan_fail(&f->text, w,
	    "'%s' is not read: OFF is with ST, C and N before it, or C, N and ST",
	    mr_word_shown(w, n, shown));
}

mr_status
mr_off_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	off f = { .ctx = ctx, .text = mr_scan_of(ctx, data, size), .b = { .ctx = ctx } };
	bool dimensions;

	f.rows.b = &f.b;
	if (!keyword(&f, &dimensions))
		MR_TRY(check_variant(&f));
	else if (dimensions)
		return mr_scan_fail(&f.text, f.text.p,
		    "4OFF and nOFF are not read, which may have other than three dimensions");
	return f.binary ? read_binary(&f, m) : read_text(&f, m);
}
