/* Object File Format (Geomview): the keyword [ST][C][N]OFF, of MeshLab [C][N][ST]OFF, says what a vertex has;
 * -f off reads a file without it, too.  Binary files are little-endian, as of PMP. */
#include "formats/format.h"

typedef struct off {
	mr_ctx *ctx;
	mr_scan text;
	bool normals, colors, texcoords;
	mr_rows rows;
	uint64_t nv, nf;
	size_t face_colors; /* faces that have one */
	size_t ignored;     /* numbers after a vertex that the keyword does not announce */
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

/* Reads the keyword; false where there is none. */
static bool
keyword(off *f)
{
	mr_scan t = f->text;

	mr_skip_comments(&t);
	f->texcoords = take(&t, "ST");
	f->colors = take(&t, "C");
	f->normals = take(&t, "N");
	f->texcoords |= take(&t, "ST");
	if (!take(&t, "OFF"))
		return false;
	if (t.p < t.end && !mr_is_blank(*t.p) && *t.p != '\n' && *t.p != '#' && !mr_is_digit(*t.p))
		return false;
	f->text.p = t.p;
	mr_skip_blanks(&t);
	f->text.binary = take(&t, "BINARY\n");
	if (f->text.binary)
		f->text.p = t.p;
	return true;
}

bool
mr_off_sniff(const unsigned char *data, size_t size)
{
	return keyword(&(off){ .text = mr_scan_of(NULL, data, size) });
}

/* ---- vertices ---- */

/* The numbers of a vertex: three, then of the normal, the colour, and the texture coordinates. */
enum { MOST = 3 + 3 + 4 + 2 };

static mr_status
begin_vertices(off *f)
{
	mr_rows_add_unnamed(&f->rows, MR_X, 3);
	mr_rows_add_unnamed(&f->rows, MR_NX, f->normals ? 3 : 0);
	mr_rows_add_unnamed(&f->rows, MR_RED, f->colors ? 4 : 0);
	mr_rows_add_unnamed(&f->rows, MR_U, f->texcoords ? 2 : 0);
	mr_rows_begin(&f->rows);
	return mr_rows_room(&f->rows, f->nv);
}

/* x y z [nx ny nz] [r g b [a]] [s t], on one line from the third number on. */
static mr_status
read_vertex(off *f)
{
	size_t n = 3, rest = 0, colors, wanted = f->texcoords ? 2 : 0;
	double x[MOST] = { 0 }, more[8] = { 0 };
	const char *where;
	mr_scan line;
	mr_v3 p = { 0, 0, 0 };

	mr_skip_comments(&f->text);
	where = f->text.p;
	MR_TRY(mr_scan_position(&f->text, &p));
	x[0] = p.x, x[1] = p.y, x[2] = p.z;
	for (int k = 0; f->normals && k < 3; k++)
		MR_TRY(mr_scan_real(&f->text, "a normal", &x[n++]));
	if (mr_scan_line(&f->text, &line))
		MR_TRY(mr_scan_reals(&line, "a vertex", 0, 8, more, &rest));
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

/* ---- faces ---- */

static mr_status
read_face(off *f)
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
	if (n == 3 && mr_build_triangle(&f->rows.b, f->corner[0], f->corner[1], f->corner[2]))
		return MR_OK;
	mr_build_face(&f->rows.b, f->corner, NULL, NULL, (size_t)n);
	return MR_OK;
}

/* Vertices, faces and, which nobody needs, edges: on one line. */
static mr_status
read_counts(off *f)
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

/* The next `words` of a binary file, passed over; MR_EFORMAT where it ends before them. */
static mr_status
words(off *f, uint64_t words, const unsigned char **p)
{
	size_t left = (size_t)(f->text.end - f->text.p);

	if (words > left / 4)
		return mr_scan_fail(&f->text, f->text.p, "%llu numbers cannot be in %zu bytes",
		    (unsigned long long)words, left);
	*p = (const unsigned char *)f->text.p;
	f->text.p += 4 * words;
	return MR_OK;
}

static mr_status
binary_face(off *f)
{
	const unsigned char *p = NULL;
	size_t n;

	MR_TRY(words(f, 1, &p));
	n = mr_load32(p, false);
	MR_TRY(words(f, n, &p));
	MR_RESERVE(f->ctx, f->corner, 0, n, &f->corner_room);
	for (size_t k = 0; k < n; k++) {
		f->corner[k] = mr_load32(p + 4 * k, false);
		if (f->corner[k] >= f->nv)
			return mr_scan_fail(&f->text, p, "vertex %u of %zu", f->corner[k], f->rows.b.m.nv);
	}
	mr_build_face(&f->rows.b, f->corner, NULL, NULL, n);
	return MR_OK;
}

static mr_status
read_binary(off *f)
{
	const size_t width = (f->normals ? 6u : 3u) + (f->colors ? 4u : 0u) + (f->texcoords ? 2u : 0u);
	const unsigned char *p = NULL;
	double x[MOST];

	MR_TRY(words(f, 3, &p));
	f->nv = mr_load32(p, false);
	f->nf = mr_load32(p + 4, false);
	MR_TRY(words(f, width * f->nv, &p));
	MR_TRY(begin_vertices(f));
	for (uint64_t i = 0; i < f->nv; i++, p += 4 * width) {
		for (size_t k = 0; k < width; k++)
			x[k] = mr_load_float(p + 4 * k, false);
		mr_rows_put(&f->rows, x);
	}
	mr_rows_end(&f->rows);
	for (uint64_t i = 0; i < f->nf; i++)
		MR_TRY(binary_face(f));
	return MR_OK;
}

static mr_status
read_text(off *f)
{
	MR_TRY(read_counts(f));
	MR_TRY(begin_vertices(f));
	MR_TRY(mr_build_reserve(&f->rows.b, f->nf < MR_NONE / 3 ? (size_t)f->nf : 0));
	for (uint64_t i = 0; i < f->nv; i++)
		MR_TRY(read_vertex(f));
	mr_rows_end(&f->rows);
	for (uint64_t i = 0; i < f->nf; i++)
		MR_TRY(read_face(f));
	mr_skip_comments(&f->text);
	return MR_OK;
}

mr_status
mr_off_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	off f = { .ctx = ctx, .text = mr_scan_of(ctx, data, size), .rows.b.ctx = ctx };

	keyword(&f);
	MR_TRY(f.text.binary ? read_binary(&f) : read_text(&f));
	mr_scan_rest(&f.text);
	mr_lost(ctx, NULL, f.face_colors, "colors of faces");
	mr_lost(ctx, NULL, f.ignored, "numbers behind vertices");
	return mr_build_finish(&f.rows.b, m);
}

/* ---- written ---- */

typedef struct written {
	const mr_tri *t;
	mr_polygons faces;
} written;

static void
put_face(mr_sink *s, const void *arg, size_t f)
{
	const written *w = arg;
	size_t first = mr_polygon_begin(&w->faces, f), end = mr_polygon_begin(&w->faces, f + 1);

	mr_sink_fill(s, mr_count_write(mr_sink_room(s), end - first));
	for (size_t i = first; i < end; i++) {
		uint32_t corner = mr_polygon_corner(&w->faces, i);
		mr_put(s, " ", 1);
		mr_sink_fill(s, mr_count_write(mr_sink_room(s), w->t[corner / 3].v[corner % 3]));
	}
	mr_put(s, "\n", 1);
}

mr_status
mr_off_write(mr_sink *s, const mr_model *m)
{
	written w = { .t = m->t };
	mr_part part[MR_PARTS];

	mr_note_lost(s, m, "normal color alpha texcoord faces");
	mr_faces_of(s, m, &w.faces);
	mr_print(s, "%s%s%sOFF\n", m->texcoord ? "ST" : "", m->color ? "C" : "", m->normal ? "N" : "");
	mr_print(s, "%zu %zu 0\n", m->nv, w.faces.count);
	mr_vertex_parts(m, part);
	mr_put_rows(s, part, 4, m->nv, true);
	mr_put_each(s, w.faces.count, put_face, &w);
	return MR_OK;
}
