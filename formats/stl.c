/* Stereolithography: triangles without connectivity, whose corners are joined where equal.  A binary file may
 * begin with "solid", as a text does: its size decides: 84 bytes and 50 for each triangle. */
#include "formats/format.h"
#include "mesh/name_lists.h"
#include "mesh/repair.h"

enum { HEADER = 84, RECORD = 50 };

/* ---- what both have in common ---- */

/* Joins equal corners; corner[] then holds the numbers of the vertices that are left in p. */
static void
join_corners(mr_ctx *ctx, mr_v3 *p, size_t n, uint32_t *corner, size_t *nv)
{
	size_t next = 0;

	mr_weld(ctx, p, n, 0, corner, nv);
	for (size_t i = 0; i < n; i++)
		if (corner[i] == next)
			p[next++] = p[i]; /* the first of its number; next <= i */
}

/* ---- binary ---- */

bool
mr_stl_is_binary(const unsigned char *data, size_t size)
{
	return size >= HEADER && (size - HEADER) % RECORD == 0 &&
	       (size - HEADER) / RECORD == mr_load32(data + 80, false);
}

static mr_status
read_binary(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	size_t n = mr_load32(data + 80, false), used = 0;
	uint32_t *corner;
	mr_v3 *p;

	if (n > (size - HEADER) / RECORD)
		return mr_fail(ctx, MR_EFORMAT,
		    "byte 80: %zu triangles cannot be in the %zu bytes that follow", n, size - HEADER);
	if (n > (MR_NONE - 1) / 3)
		return mr_fail(ctx, MR_ERANGE, "%zu triangles are more than indices can name", n);
	corner = MR_NEW(ctx, 3 * n, uint32_t);
	p = MR_NEW(ctx, 3 * n, mr_v3);
	for (size_t i = 0; i < 3 * n; i++) {
		size_t at = HEADER + i / 3 * RECORD + 12 + i % 3 * 12;
		p[i] = mr_vec(mr_load_float(data + at, false), mr_load_float(data + at + 4, false),
		    mr_load_float(data + at + 8, false));
	}
	for (size_t i = 0; i < n; i++) /* which some programs use for colours */
		used += mr_load16(data + HEADER + (i + 1) * RECORD - 2, false) != 0;
	mr_lost(ctx, NULL, used, "attributes of triangles");
	mr_lost(ctx, NULL, size - HEADER - n * RECORD, "bytes behind the last triangle");
	join_corners(ctx, p, 3 * n, corner, &m->nv);
	m->p = p;
	m->t = (const mr_tri *)corner;
	m->nf = n;
	return MR_OK;
}

/* ---- text ---- */

typedef struct ascii {
	mr_scan text;
	mr_builder b;
	mr_v3 *p; /* of the corners of all facets */
	size_t corners, room;
	size_t first;  /* corner of the facet at hand */
	size_t solids; /* so far */
	bool inside;   /* of a solid */
} ascii;

/* Corners are vertices of their own until all are there; a facet is a face of them. */
static mr_status
end_facet(ascii *a, const char *where)
{
	size_t n = a->corners - a->first;
	uint32_t small[16], *c = n > 16 ? MR_NEW(a->text.ctx, n, uint32_t) : small;

	if (n < 3)
		return mr_scan_fail(&a->text, where, "a facet of %zu vertices", n);
	for (size_t i = 0; i < n; i++)
		c[i] = (uint32_t)(a->first + i);
	mr_build_face(&a->b, c, NULL, NULL, n);
	return MR_OK;
}

/* The rest of the line names a solid, which begins a group, except a first one without a name. */
static void
name_solid(ascii *a, bool begins)
{
	mr_scan line = { 0 };

	mr_skip_blanks(&a->text);
	mr_scan_line(&a->text, &line);
	if (begins && (a->solids++ > 0 || line.p < line.end))
		mr_build_mark(&a->b, MR_GROUP, line.p, (size_t)(line.end - line.p), true);
}

/* The values after a word; irrelevant words, such as a normal's, are skipped. */
static mr_status
read_word(ascii *a, const char *w, size_t n)
{
	bool begins = mr_word_is(w, n, "solid");

	if (begins || mr_word_is(w, n, "endsolid")) {
		if (begins == a->inside)
			return mr_scan_fail(&a->text, w, "'%.*s' stands where it may not", (int)n, w);
		a->inside = begins;
		name_solid(a, begins);
	} else if (mr_word_is(w, n, "outer"))
		a->first = a->corners;
	else if (mr_word_is(w, n, "endloop"))
		return end_facet(a, w);
	else if (mr_word_is(w, n, "vertex")) {
		MR_RESERVE(a->text.ctx, a->p, a->corners, 1, &a->room);
		return mr_scan_position(&a->text, &a->p[a->corners++]);
	}
	return MR_OK;
}

static mr_status
read_ascii(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	ascii a = { .text = mr_scan_of(ctx, data, size), .b = { .ctx = ctx } };
	const char *w;
	uint32_t *map;
	size_t n;

	while (mr_scan_word(&a.text, &w, &n))
		MR_TRY(read_word(&a, w, n));
	if (a.corners >= MR_NONE)
		return mr_fail(ctx, MR_ERANGE, "%zu corners are more than indices can name", a.corners);
	if (a.inside)
		return mr_scan_fail(&a.text, a.text.end, "the file ends inside a solid");
	map = MR_NEW(ctx, a.corners, uint32_t);
	join_corners(ctx, a.p, a.corners, map, &a.b.m.nv);
	a.b.m.p = a.p;
	for (size_t i = 0; i < a.b.corners; i++)
		a.b.corner[i] = map[a.b.corner[i]];
	return mr_build_finish(&a.b, m);
}

/* ---- the table's ---- */

/* A text: "solid", and in the first lines a facet or the end. */
static bool
is_text(const unsigned char *data, size_t size)
{
	mr_scan text = mr_scan_of(NULL, data, size), line;

	if (memchr(data, 0, size < 256 ? size : 256) || !mr_scan_accept(&text, "solid"))
		return false;
	mr_scan_line(&text, &line);
	return mr_scan_accept(&text, "facet") || mr_scan_accept(&text, "endsolid") ||
	       mr_scan_accept(&text, "solid");
}

bool
mr_stl_sniff(const unsigned char *data, size_t size)
{
	return mr_stl_is_binary(data, size) || is_text(data, size);
}

mr_status
mr_stl_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	mr_scan text = mr_scan_of(ctx, data, size);

	if (!mr_stl_is_binary(data, size) &&
	    (is_text(data, size) || (mr_scan_accept(&text, "solid") && !memchr(data, 0, size))))
		return read_ascii(ctx, data, size, m);
	if (size < HEADER)
		return mr_fail(
		    ctx, MR_EFORMAT, "byte %zu: the file ends in its header of %d bytes", size, (int)HEADER);
	return read_binary(ctx, data, size, m);
}

static mr_v3
unit_normal(const mr_model *m, size_t f)
{
	const uint32_t *v = m->t[f].v;
	mr_v3 a = m->p[v[0]], n = mr_unit(mr_cross(mr_sub(m->p[v[1]], a), mr_sub(m->p[v[2]], a)));

	return mr_finite(n) ? n : mr_vec(0, 0, 0);
}

static mr_status
need_faces(mr_sink *s, const mr_model *m, const char *keeps)
{
	size_t count;
	bool *used;

	if (m->nf == 0)
		return mr_fail(s->ctx, MR_EMESH, "points cannot be written as stl, which has triangles only");
	mr_note_lost(s, m, keeps);
	mr_vertices_used(s->ctx, m->t, m->nf, m->nv, &used, &count);
	mr_lost(s->ctx, NULL, m->nv - count, "isolated vertices");
	return MR_OK;
}

mr_status
mr_stl_write(mr_sink *s, const mr_model *m)
{
	char header[80] = "binary STL";

	MR_TRY(need_faces(s, m, "faces"));
	MR_TRY(mr_note_rounded(s, m));
	mr_put(s, header, sizeof header);
	mr_sink_fill(s, mr_store32(mr_sink_room(s), (uint32_t)m->nf));
	for (size_t f = 0; f < m->nf; f++) {
		char *to = mr_store_floats(mr_sink_room(s), unit_normal(m, f));
		for (int k = 0; k < 3; k++)
			to = mr_store_floats(to, m->p[m->t[f].v[k]]);
		*to++ = 0;
		*to++ = 0;
		mr_sink_fill(s, to);
	}
	return MR_OK;
}

/* A model as solids: faces that follow each other in a group are one of its name, of those that there are. */
typedef struct solids {
	const mr_model *m;
	const char **start;
	size_t names;
} solids;

static void
put_facet(mr_sink *s, const mr_model *m, size_t f)
{
	mr_v3 n = unit_normal(m, f);

	mr_print(s, "facet normal ");
	mr_put_reals(s, (double[]){ mr_as_float(n.x), mr_as_float(n.y), mr_as_float(n.z) }, 3, '\n');
	mr_print(s, "outer loop\n");
	for (int k = 0; k < 3; k++) {
		mr_put(s, "vertex ", 7);
		mr_put_reals(s, &m->p[m->t[f].v[k]].x, 3, '\n');
	}
	mr_print(s, "endloop\nendfacet\n");
}

/* "solid" or "endsolid" with the name of the face's group. */
static void
put_solid(mr_sink *s, const char *what, const solids *w, size_t f)
{
	uint32_t group = w->m->group ? w->m->group[f] : 0;

	mr_put(s, what, strlen(what));
	if (w->m->group && group < w->names) {
		mr_put(s, " ", 1);
		mr_put(s, w->start[group], (size_t)(w->start[group + 1] - w->start[group] - 1));
	} else if (w->m->group)
		mr_print(s, " group%u", (unsigned)group);
	mr_put(s, "\n", 1);
}

static void
put_face(mr_sink *s, const void *arg, size_t f)
{
	const solids *w = arg;
	const uint32_t *group = w->m->group;

	if (f == 0 || (group && group[f] != group[f - 1]))
		put_solid(s, "solid", w, f);
	put_facet(s, w->m, f);
	if (f + 1 == w->m->nf || (group && group[f] != group[f + 1]))
		put_solid(s, "endsolid", w, f);
}

mr_status
mr_stl_write_ascii(mr_sink *s, const mr_model *m)
{
	solids w = { .m = m };

	MR_TRY(need_faces(s, m, "faces group"));
	if (m->group)
		mr_line_starts(s->ctx, m->groups.text, m->groups.bytes, &w.start, &w.names);
	mr_put_each(s, m->nf, put_face, &w);
	return MR_OK;
}
