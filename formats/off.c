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
	uint64_t nv, nf;
	float *rgba;               /* four per vertex as given, NAN where there are none */
	mr_shades shades[2];       /* of all components, of alpha */
	size_t odd_colors, odd_uv; /* values that are not finite */
	size_t face_colors;        /* faces that have one */
	size_t ignored;            /* numbers behind a vertex that the keyword does not announce */
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

static mr_status
arrays(off *f)
{
	MR_TRY(mr_build_vertices(&f->b, f->nv));
	if (f->normals && !(f->b.normal = MR_NEW(f->ctx, f->b.nv, mr_v3)))
		return MR_EMEM;
	if (f->texcoords && !(f->b.texcoord = MR_NEW(f->ctx, 2 * f->b.nv, double)))
		return MR_EMEM;
	return MR_OK;
}

static mr_status
set_color(off *f, size_t vertex, const double *c, size_t n)
{
	bool odd = false;

	if (!f->rgba) {
		f->rgba = MR_NEW(f->ctx, 4 * f->b.nv, float);
		if (!f->rgba)
			return MR_EMEM;
		for (size_t i = 0; i < 4 * f->b.nv; i++)
			f->rgba[i] = NAN;
	}
	for (size_t i = 0; i < n; i++) {
		f->rgba[4 * vertex + i] = (float)c[i];
		mr_shade_see(&f->shades[0], c[i]);
		if (i == 3)
			mr_shade_see(&f->shades[1], c[i]);
		odd |= !isfinite(c[i]);
	}
	f->odd_colors += odd;
	return MR_OK;
}

static void
set_normal(off *f, size_t vertex, const double *n)
{
	f->b.normal[vertex] = mr_vec(n[0], n[1], n[2]);
}

static void
set_texcoord(off *f, size_t vertex, const double *uv)
{
	f->b.texcoord[2 * vertex] = uv[0];
	f->b.texcoord[2 * vertex + 1] = uv[1];
	f->odd_uv += !isfinite(uv[0]) || !isfinite(uv[1]);
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
text_vertex(off *f, size_t i)
{
	double x[9] = { 0 }, normal[3];
	const char *where;
	size_t n = 0, colors;

	mr_skip_comments(&f->text);
	where = f->text.p;
	MR_TRY(mr_scan_position(&f->text, &f->b.p[i]));
	for (int k = 0; f->normals && k < 3; k++)
		MR_TRY(mr_scan_real(&f->text, "a normal", &normal[k]));
	if (f->normals)
		set_normal(f, i, normal);
	MR_TRY(line_rest(f, x, 8, &n));
	if (f->texcoords && n < 2)
		return mr_scan_fail(&f->text, where, "a vertex lacks its texture coordinates");
	colors = n - (f->texcoords ? 2 : 0);
	if (f->texcoords)
		set_texcoord(f, i, x + colors);
	if (!f->colors) {
		f->ignored += colors;
		return MR_OK;
	}
	if (colors != 3 && colors != 4)
		return mr_scan_fail(
		    &f->text, where, "a vertex with %zu colour components, not 3 or 4", colors);
	return set_color(f, i, x, colors);
}

static mr_status
finish_colors(off *f)
{
	if (!f->rgba)
		return MR_OK;
	if (!mr_all_left(f->ctx, f->odd_colors, f->b.nv, "colors"))
		return MR_OK;
	if (!(f->b.color = mr_alloc(f->ctx, f->b.nv, 4)))
		return MR_EMEM;
	for (size_t k = 0; k < 2; k++)
		f->shades[k].full = mr_shade_full(&f->shades[k]);
	for (size_t i = 0; i < 4 * f->b.nv; i++)
		f->b.color[i] = isnan(f->rgba[i]) ? 255
		                                  : mr_shade_byte(&f->shades[i % 4 == 3], (double)f->rgba[i]);
	for (size_t k = 0; k < 2; k++)
		mr_shades_said(f->ctx, &f->shades[k]);
	return MR_OK;
}

static mr_status
finish(off *f, mr_model *m)
{
	MR_TRY(finish_colors(f));
	if (f->b.normal && !mr_normals_left(f->ctx, f->b.normal, f->b.nv))
		f->b.normal = NULL;
	if (!mr_all_left(f->ctx, f->odd_uv, f->b.nv, "texture coordinates"))
		f->b.texcoord = NULL;
	mr_lost(f->ctx, NULL, f->face_colors, "colors of faces");
	mr_lost(f->ctx, NULL, f->ignored, "numbers behind vertices");
	return mr_build_finish(&f->b, m);
}

/* ---- text ---- */

static mr_status
corner_room(off *f, size_t n)
{
	if (n <= f->corner_room)
		return MR_OK;
	f->corner_room = n + n / 2;
	f->corner = MR_NEW(f->ctx, f->corner_room, uint32_t);
	return f->corner ? MR_OK : MR_EMEM;
}

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
	MR_TRY(corner_room(f, (size_t)n));
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
	return mr_build_face(&f->b, f->corner, NULL, NULL, (size_t)n);
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
	MR_TRY(arrays(f));
	MR_TRY(mr_build_reserve(&f->b, f->nf < MR_NONE / 3 ? (size_t)f->nf : 0));
	for (size_t i = 0; i < f->b.nv; i++)
		MR_TRY(text_vertex(f, i));
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

static size_t
floats_per_vertex(const off *f)
{
	return (size_t)(3 + 3 * f->normals + 4 * f->colors + 2 * f->texcoords);
}

/* Walks over the faces; true where they end with the file. */
static bool
fits(const off *f, const unsigned char *p, const unsigned char *end, layout l)
{
	uint64_t left = (uint64_t)(end - p), nv, nf, vertices;

	if (left < 12)
		return false;
	nv = mr_load32(p, l.big);
	nf = mr_load32(p + 4, l.big);
	vertices = nv * 4 * floats_per_vertex(f);
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
	size_t floats = floats_per_vertex(f);
	double x[12] = { 0 };

	for (size_t i = 0; i < f->b.nv; i++) {
		const double *at = x;
		for (size_t k = 0; k < floats; k++)
			x[k] = (double)mr_load_float(p + 4 * (i * floats + k), l.big);
		f->b.p[i] = mr_vec(x[0], x[1], x[2]);
		if (!mr_finite(f->b.p[i]))
			return mr_fail(f->ctx, MR_EFORMAT, "byte %zu: a coordinate is not finite",
			    (size_t)((const char *)p - f->text.start) + 4 * i * floats);
		at += 3;
		if (f->normals) {
			set_normal(f, i, at);
			at += 3;
		}
		if (f->colors) {
			MR_TRY(set_color(f, i, at, 4));
			at += 4;
		}
		if (f->texcoords)
			set_texcoord(f, i, at);
	}
	return MR_OK;
}

static mr_status
binary_faces(off *f, const unsigned char *p, layout l)
{
	for (uint64_t i = 0; i < f->nf; i++) {
		size_t n = mr_load32(p, l.big);
		MR_TRY(corner_room(f, n));
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
		MR_TRY(mr_build_face(&f->b, f->corner, NULL, NULL, n));
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

	while (i < 4 && !fits(f, p, end, layouts[i]))
		i++;
	if (i == 4)
		return mr_fail(f->ctx, MR_EFORMAT,
		    "byte %zu: the numbers of vertices and faces, in neither byte order, fit the %zu bytes",
		    (size_t)(f->text.p - f->text.start), (size_t)(end - p));
	f->nv = mr_load32(p, layouts[i].big);
	f->nf = mr_load32(p + 4, layouts[i].big);
	MR_TRY(arrays(f));
	MR_TRY(binary_vertices(f, p + 12, layouts[i]));
	MR_TRY(binary_faces(f, p + 12 + 4 * f->nv * floats_per_vertex(f), layouts[i]));
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

	if (!keyword(&f, &dimensions))
		MR_TRY(check_variant(&f));
	else if (dimensions)
		return mr_scan_fail(&f.text, f.text.p,
		    "4OFF and nOFF are not read, which may have other than three dimensions");
	return f.binary ? read_binary(&f, m) : read_text(&f, m);
}
