/* OBJ: polygons, corners with what the model has, and what the faces are marked with wherever it changes. */
#include "formats/filename.h"
#include "formats/format.h"
#include "formats/image.h"
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

/* Writes the mark of face i if it differs from the last face's; none before the first name. */
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

/* ---- files of materials ---- */

/* The MTL file and pictures written beside the OBJ. */
typedef struct files {
	mr_ctx *ctx;
	const char *path, *stem;
	bool own;          /* STEM.mtl is there, by an earlier mr-export: so are the pictures */
	const char **name; /* in the stream, of the pictures so far */
	size_t count, room;
} files;

/* Writes a picture of the stream once; its name becomes the one there. */
static mr_status
put_picture(files *w, mr_file *file)
{
	size_t i = 0;
	const char *end;

	if (!file->name)
		return MR_OK;
	while (i < w->count && strcmp(w->name[i], file->name) != 0)
		i++;
	end = mr_format(w->ctx, "-%zu.%s", i + 1, mr_is_png(file->data, file->size) ? "png" : "jpg");
	if (i == w->count) {
		if (!w->own &&
		    !mr_may_replace(mr_format(w->ctx, "%s%s", w->stem, end), file->data, file->size))
			return mr_fail(w->ctx, MR_EUSAGE, "%s%s would be lost: give another name",
			    mr_file_name(w->stem), end);
		MR_RESERVE(w->ctx, w->name, w->count, 1, &w->room);
		w->name[w->count++] = file->name;
		return mr_put_beside(w->ctx, w->path, end, file->data, file->size, &file->name);
	}
	file->name = mr_format(w->ctx, "%s%s", mr_file_name(w->stem), end);
	return MR_OK;
}

/* The materials that the stream has files of, and their pictures. */
static mr_status
put_files(mr_sink *s, const mr_model *m)
{
	files w = { .ctx = s->ctx, .path = s->path, .stem = mr_path_stem(s->ctx, s->path) };
	mr_text text = { .ctx = s->ctx };
	mr_material *look;
	const char **name;
	size_t count, names;

	mr_text_add(&text, "%s", ""); /* not NULL */
	MR_TRY(mr_library_check(s->ctx, w.stem, &w.own));
	MR_TRY(mr_materials_find(s->ctx, m, NULL, &look, &count));
	mr_line_starts(s->ctx, m->materials.text, m->materials.bytes, &name, &names);
	for (size_t i = 0; i < count; i++) {
		int bytes = (int)(name[i + 1] - name[i]) - 1;
		MR_TRY(put_picture(&w, &look[i].file));
		MR_TRY(put_picture(&w, &look[i].normals));
		mr_material_put(&text, mr_format(s->ctx, "%.*s", bytes, name[i]), &look[i]);
	}
	mr_print(s, "mtllib %s.mtl\n", mr_file_name(w.stem));
	return mr_library_write(s->ctx, w.stem, text.s);
}

/* The files of materials that the model names, and those that are in the stream. */
static mr_status
put_libraries(mr_sink *s, const mr_model *m)
{
	mr_scan text = mr_scan_of(s->ctx, (const unsigned char *)m->mtllib.text, m->mtllib.bytes), line;
	mr_text named = { .ctx = s->ctx };
	size_t attached = 0;

	while (mr_scan_line(&text, &line)) {
		size_t bytes = (size_t)(line.end - line.p);
		if (mr_file_attached(m, line.p, bytes).name) {
			attached++;
			continue;
		}
		mr_put(s, "mtllib ", 7);
		mr_put(s, line.p, bytes);
		mr_put(s, "\n", 1);
		mr_text_add(&named, "%.*s\n", (int)bytes, line.p);
	}
	mr_libraries_missing(s->ctx, s->file.target ? s->path : "-", (mr_lines){ named.s, named.n });
	if (attached && s->file.target)
		return put_files(s, m);
	mr_lost(s->ctx, NULL, attached, "files of materials");
	return MR_OK;
}

mr_status
mr_obj_write(mr_sink *s, const mr_model *m)
{
	values x[2] = { { 't', 2, m->texcoord, m->corner_texcoord, NULL, NULL },
		{ 'n', 3, (const double *)m->normal, (const double *)m->corner_normal, NULL, NULL } };

	mr_note_lost(s, m,
	    "normal corner_normal color texcoord corner_texcoord group object material smoothing faces");
	MR_TRY(put_libraries(s, m));
	mr_put_each(s, m->nv, put_vertex, m);
	put_values(s, m, &x[0]);
	put_values(s, m, &x[1]);
	put_faces(s, m, x);
	return MR_OK;
}
