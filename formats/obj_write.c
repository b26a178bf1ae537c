/* OBJ: polygons, corners with what the model has, and what the faces are marked with wherever it changes. */
#include "formats/format.h"
#include "formats/materials.h"
#include "mesh/name_lists.h"

/* The vt or vn lines: one for each vertex, or for each value that corners have. */
typedef struct values {
	char letter; /* t or n */
	size_t width;
	const double *vertex, *corner;
	uint32_t *place, *first; /* of the corners' values: line from 0, MR_NONE of one without; of each line
	                            its corner; NULL where they are of vertices */
} values;

static void
put_vertex(mr_sink *s, const void *arg, size_t i)
{
	const mr_model *m = arg;
	double x[6] = { m->p[i].x, m->p[i].y, m->p[i].z };

	mr_put(s, "v ", 2);
	if (m->color)
		for (size_t k = 0; k < 3; k++)
			x[3 + k] = round(m->color[4 * i + k] * (1e6 / 255)) / 1e6;
	mr_put_reals(s, x, m->color ? 6 : 3, '\n');
}

static void
put_value(mr_sink *s, const void *arg, size_t i)
{
	const values *x = arg;
	const double *value = x->vertex ? x->vertex + x->width * i : x->corner + x->width * x->first[i];
	char word[3] = { 'v', x->letter, ' ' };

	mr_put(s, word, sizeof word);
	mr_put_reals(s, value, x->width, '\n');
}

/* The values of vertices, or each of corners once, in order of first use. */
static void
put_values(mr_sink *s, const mr_model *m, values *x)
{
	size_t corners = 3 * m->nf, lines = x->vertex ? m->nv : 0;

	if (!x->vertex && x->corner) {
		x->first = MR_NEW(s->ctx, corners, uint32_t);
		x->place = MR_NEW(s->ctx, corners, uint32_t);
		mr_number_rows(s->ctx, x->corner, x->width, corners, x->place, x->first, &lines);
	}
	mr_put_each(s, lines, put_value, x);
}

/* The line of a corner's value; 0 where it has none. */
static uint64_t
line_of(const values *x, uint32_t corner, uint32_t vertex)
{
	if (x->vertex)
		return (uint64_t)vertex + 1;
	return x->place && x->place[corner] != MR_NONE ? (uint64_t)x->place[corner] + 1 : 0;
}

static void
put_corner(mr_sink *s, const mr_model *m, const values x[2], uint32_t corner)
{
	uint32_t v = m->t[corner / 3].v[corner % 3];
	uint64_t uv = line_of(&x[0], corner, v), vn = line_of(&x[1], corner, v);
	char *to = mr_sink_room(s);

	*to++ = ' ';
	to = mr_count_write(to, (uint64_t)v + 1);
	if (uv || vn)
		*to++ = '/';
	if (uv)
		to = mr_count_write(to, uv);
	if (vn) {
		*to++ = '/';
		to = mr_count_write(to, vn);
	}
	mr_sink_fill(s, to);
}

/* ---- what faces are marked with ---- */

typedef struct marks {
	const char *word, *what; /* of the statement; of a number without a name */
	const uint32_t *of;
	const char **start;
	size_t names;
	size_t first; /* polygon that has a name */
} marks;

typedef struct faces {
	const mr_model *m;
	const values *x;
	mr_polygons polygon;
	marks mark[4];
} faces;

/* The face that a polygon begins with. */
static size_t
face_of(const faces *w, size_t i)
{
	return mr_polygon_corner(&w->polygon, mr_polygon_begin(&w->polygon, i)) / 3;
}

static size_t
name_bytes(const marks *k, uint32_t mark)
{
	return mark < k->names ? (size_t)(k->start[mark + 1] - k->start[mark]) - 1 : 0;
}

/* Writes the mark of face i if it differs from that of the face before; none before the first name. */
static void
put_mark(mr_sink *s, const faces *w, const marks *k, size_t i)
{
	uint32_t mark = k->of[face_of(w, i)];
	size_t n;

	if (i < k->first || (i > k->first && mark == k->of[face_of(w, i - 1)]))
		return;
	n = name_bytes(k, mark);
	if (mark >= k->names)
		mr_print(s, "%s %s%u\n", k->word, k->what, (unsigned)mark);
	else {
		mr_print(s, n ? "%s " : "%s", k->word);
		mr_put(s, k->start[mark], n);
		mr_put(s, "\n", 1);
	}
}

static void
put_face(mr_sink *s, const void *arg, size_t i)
{
	const faces *w = arg;

	for (const marks *k = w->mark; k < w->mark + 4; k++)
		if (k->of)
			put_mark(s, w, k, i);
	mr_put(s, "f", 1);
	for (size_t c = mr_polygon_begin(&w->polygon, i); c < mr_polygon_begin(&w->polygon, i + 1); c++)
		put_corner(s, w->m, w->x, mr_polygon_corner(&w->polygon, c));
	mr_put(s, "\n", 1);
}

static void
find_names(mr_ctx *ctx, const faces *w, marks *k, mr_lines names)
{
	uint32_t mark;

	if (!k->of)
		return;
	mr_line_starts(ctx, names.text, names.bytes, &k->start, &k->names);
	while (k->first < w->polygon.count && (mark = k->of[face_of(w, k->first)]) < k->names &&
	       name_bytes(k, mark) == 0)
		k->first++;
}

static void
put_faces(mr_sink *s, const mr_model *m, const values x[2])
{
	faces w = { .m = m,
		.x = x,
		.mark = { { .word = "o", .what = "object", .of = m->object },
		    { .word = "g", .what = "group", .of = m->group },
		    { .word = "usemtl", .what = "material", .of = m->material },
		    { .word = "s", .what = "", .of = m->smoothing } } };
	const mr_lines names[] = { m->objects, m->groups, m->materials, { "off", 3 } };

	mr_faces_of(s, m, &w.polygon);
	for (size_t k = 0; k < 4; k++)
		find_names(s->ctx, &w, &w.mark[k], names[k]);
	mr_put_each(s, w.polygon.count, put_face, &w);
}

static void
put_libraries(mr_sink *s, mr_lines files)
{
	mr_scan text = mr_scan_of(s->ctx, (const unsigned char *)files.text, files.bytes), line;

	while (mr_scan_line(&text, &line)) {
		mr_put(s, "mtllib ", 7);
		mr_put(s, line.p, (size_t)(line.end - line.p));
		mr_put(s, "\n", 1);
	}
}

mr_status
mr_obj_write(mr_sink *s, const mr_model *m)
{
	values x[2] = { { 't', 2, m->texcoord, m->corner_texcoord, NULL, NULL },
		{ 'n', 3, (const double *)m->normal, (const double *)m->corner_normal, NULL, NULL } };

	mr_note_lost(s, m,
	    "normal corner_normal color texcoord corner_texcoord group object material smoothing faces");
	put_libraries(s, m->mtllib);
	mr_put_each(s, m->nv, put_vertex, m);
	put_values(s, m, &x[0]);
	put_values(s, m, &x[1]);
	mr_libraries_missing(s->ctx, s->file.target ? s->path : "-", m->mtllib);
	put_faces(s, m, x);
	return MR_OK;
}
