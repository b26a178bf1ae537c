/*
 * Stanford PLY, written: positions, normals and texture coordinates as doubles, so that nothing is rounded.
 * What PLY has no usual property for stands in some of our own: normals of corners as a list, names of
 * groups, objects, materials and their files as comments.
 */
#include "formats/format.h"

/* Types of properties, and the numbers that they hold; whole ones but the last two. */
typedef enum type { CHAR, UCHAR, SHORT, USHORT, INT, UINT, FLOAT, DOUBLE, TYPES } type;

static const struct {
	const char *name;
	double least, most;
} types[TYPES] = { { "char", -128, 127 }, { "uchar", 0, 255 }, { "short", -32768, 32767 },
	{ "ushort", 0, 65535 }, { "int", INT32_MIN, INT32_MAX }, { "uint", 0, UINT32_MAX },
	{ "float", -INFINITY, INFINITY }, { "double", -INFINITY, INFINITY } };

typedef struct output {
	mr_sink *s;
	const mr_model *m;
	bool text;
	type *type; /* of each property of the model */
	mr_polygons faces;
	type count; /* of the lengths of lists: bytes where they can be */
} output;

/* ---- numbers ---- */

static char *
number(char *to, double x, type t, bool text)
{
	if (text) {
		to = mr_real_write(to, x);
		*to++ = ' ';
		return to;
	}
	if (t == FLOAT)
		return mr_store_float(to, (float)x);
	if (t == DOUBLE)
		return mr_store_double(to, x);
	if (t == INT || t == UINT)
		return mr_store32(to, x < 0 ? (uint32_t)(int32_t)x : (uint32_t)x);
	if (t == SHORT || t == USHORT) {
		unsigned v = x < 0 ? (unsigned)(int)x : (unsigned)x;
		to[0] = (char)(v & 255);
		to[1] = (char)(v >> 8 & 255);
		return to + 2;
	}
	*to = (char)(x < 0 ? (unsigned)(int)x : (unsigned)x);
	return to + 1;
}

static char *
count(char *to, uint32_t n, bool text)
{
	if (!text)
		return mr_store32(to, n);
	to = mr_count_write(to, n);
	*to++ = ' ';
	return to;
}

static void
put_numbers(const output *w, const double *x, size_t n)
{
	char *to = mr_sink_room(w->s);

	for (size_t i = 0; i < n; i++)
		to = number(to, x[i], DOUBLE, w->text);
	mr_sink_fill(w->s, to);
}

/* In text, the last blank of a row becomes its newline. */
static void
end_row(const output *w)
{
	if (w->text)
		w->s->buffer[w->s->used - 1] = '\n';
}

/* ---- properties ---- */

/* Whether x is what a float is written as, in the 6 to 9 digits that programs give it: 0.1 is. */
static bool
is_text_of_float(double x)
{
	char text[32];
	double y;

	for (int digits = 6; digits <= 9; digits++) {
		int n = snprintf(text, sizeof text, "%.*g", digits, mr_as_float(x));
		if (mr_real_read(text, text + n, &y) && y == x)
			return true;
	}
	return false;
}

static bool
holds(type t, double x, bool text)
{
	if (t == FLOAT)
		return isnan(x) || mr_as_float(x) == x || (text && x != floor(x) && is_text_of_float(x));
	return t == DOUBLE || (x >= types[t].least && x <= types[t].most && x == floor(x));
}

/* The type that the property came with, or doubles where that does not hold its values. */
static type
choose_type(const mr_property *p, size_t n, bool text)
{
	type t = CHAR;

	while (t < DOUBLE && strcmp(types[t].name, p->type))
		t++;
	for (size_t i = 0; i < n; i++)
		if (!holds(t, mr_property_value(p, i), text))
			return DOUBLE;
	return t;
}

static void
choose_types(output *w)
{
	const mr_model *m = w->m;

	w->type = MR_NEW(w->s->ctx, m->properties, type);
	for (size_t i = 0; i < m->properties; i++) {
		const mr_property *p = &m->property[i];
		w->type[i] = choose_type(p, p->shape.element == 'f' ? m->nf : m->nv, w->text);
	}
}

static void
put_properties(const output *w, char element, size_t i)
{
	for (size_t k = 0; k < w->m->properties; k++) {
		const mr_property *p = &w->m->property[k];
		if (p->shape.element == element)
			mr_sink_fill(
			    w->s, number(mr_sink_room(w->s), mr_property_value(p, i), w->type[k], w->text));
	}
}

/* ---- the header ---- */

static void
put_names(const output *w, const char *what, mr_lines names)
{
	const char *p = names.text, *end = p + names.bytes;

	while (p <= end) {
		const char *e = p < end ? memchr(p, '\n', (size_t)(end - p)) : NULL;
		mr_print(w->s, "comment %s ", what);
		mr_put(w->s, p, (size_t)((e ? e : end) - p));
		mr_put(w->s, "\n", 1);
		p = e ? e + 1 : end + 1;
	}
}

/* A column of a table may be called as a coordinate, too. */
static bool
is_coordinate(const mr_property *p)
{
	return p->shape.element == 'v' && strchr("xyz", *p->name) && !p->name[1];
}

static void
put_property_lines(const output *w, char element)
{
	for (size_t i = 0; i < w->m->properties; i++) {
		const mr_property *p = &w->m->property[i];
		if (p->shape.element == element)
			mr_print(w->s, "property %s %s%s\n", types[w->type[i]].name,
			    is_coordinate(p) ? "other_" : "", p->name);
	}
}

static void
put_vertex_lines(const output *w)
{
	const mr_model *m = w->m;
	mr_sink *s = w->s;

	mr_print(s, "element vertex %zu\nproperty double x\nproperty double y\nproperty double z\n", m->nv);
	if (m->normal)
		mr_print(s, "property double nx\nproperty double ny\nproperty double nz\n");
	if (m->color)
		mr_print(s,
		    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n");
	if (m->texcoord)
		mr_print(s, "property double s\nproperty double t\n");
	if (m->scanner)
		mr_print(
		    s, "property double scanner_x\nproperty double scanner_y\nproperty double scanner_z\n");
	put_property_lines(w, 'v');
}

static void
put_face_lines(const output *w)
{
	const char *counted = types[w->count].name;
	const mr_model *m = w->m;
	mr_sink *s = w->s;

	mr_print(s, "element face %zu\nproperty list %s int vertex_indices\n", w->faces.count, counted);
	if (m->corner_texcoord)
		mr_print(s, "property list %s double texcoord\n", counted);
	if (m->corner_normal)
		mr_print(s, "property list %s double corner_normal\n", counted);
	if (m->group)
		mr_print(s, "property uint group\n");
	if (m->object)
		mr_print(s, "property uint object\n");
	if (m->material)
		mr_print(s, "property uint material\n");
	if (m->smoothing)
		mr_print(s, "property uint smoothing\n");
	put_property_lines(w, 'f');
}

static void
put_header(const output *w)
{
	const mr_model *m = w->m;

	mr_print(w->s, "ply\nformat %s 1.0\n", w->text ? "ascii" : "binary_little_endian");
	if (m->mtllib.bytes)
		put_names(w, "mtllib", m->mtllib);
	if (m->group)
		put_names(w, "group", m->groups);
	if (m->object)
		put_names(w, "object", m->objects);
	if (m->material)
		put_names(w, "material", m->materials);
	put_vertex_lines(w);
	if (m->nf)
		put_face_lines(w);
	mr_print(w->s, "end_header\n");
}

/* ---- rows ---- */

static void
put_vertex(const output *w, size_t i)
{
	const mr_model *m = w->m;

	put_numbers(w, &m->p[i].x, 3);
	if (m->normal)
		put_numbers(w, &m->normal[i].x, 3);
	for (size_t k = 0; m->color && k < 4; k++)
		mr_sink_fill(w->s, number(mr_sink_room(w->s), m->color[4 * i + k], UCHAR, w->text));
	if (m->texcoord)
		put_numbers(w, m->texcoord + 2 * i, 2);
	if (m->scanner)
		put_numbers(w, &m->scanner[i].x, 3);
	put_properties(w, 'v', i);
	end_row(w);
}

/* A list of `width` numbers for each corner. */
static void
put_corners(const output *w, size_t face, const double *value, size_t width)
{
	size_t first = mr_polygon_begin(&w->faces, face), end = mr_polygon_begin(&w->faces, face + 1);

	mr_sink_fill(w->s, number(mr_sink_room(w->s), (double)(width * (end - first)), w->count, w->text));
	for (size_t i = first; i < end; i++)
		put_numbers(w, value + width * mr_polygon_corner(&w->faces, i), width);
}

static void
put_face(const output *w, size_t face)
{
	size_t first = mr_polygon_begin(&w->faces, face), end = mr_polygon_begin(&w->faces, face + 1),
	       f = mr_polygon_corner(&w->faces, first) / 3;
	const uint32_t *const marks[] = { w->m->group, w->m->object, w->m->material, w->m->smoothing };
	const mr_model *m = w->m;
	mr_sink *s = w->s;

	mr_sink_fill(s, number(mr_sink_room(s), (double)(end - first), w->count, w->text));
	for (size_t i = first; i < end; i++) {
		uint32_t h = mr_polygon_corner(&w->faces, i);
		mr_sink_fill(s, count(mr_sink_room(s), m->t[h / 3].v[h % 3], w->text));
	}
	if (m->corner_texcoord)
		put_corners(w, face, m->corner_texcoord, 2);
	if (m->corner_normal)
		put_corners(w, face, (const double *)m->corner_normal, 3);
	for (size_t k = 0; k < 4; k++)
		if (marks[k])
			mr_sink_fill(s, count(mr_sink_room(s), marks[k][f], w->text));
	put_properties(w, 'f', f);
	end_row(w);
}

static void
put(mr_sink *s, const mr_model *m, bool text)
{
	enum { MOST = 255 };
	output w = { .s = s, .m = m, .text = text, .count = UCHAR };

	choose_types(&w);
	mr_faces_of(s, m, &w.faces);
	if (w.faces.most * (m->corner_normal ? 3 : m->corner_texcoord ? 2 : 1) > MOST)
		w.count = UINT;
	put_header(&w);
	for (size_t i = 0; i < m->nv; i++)
		put_vertex(&w, i);
	for (size_t i = 0; i < w.faces.count; i++)
		put_face(&w, i);
}

mr_status
mr_ply_write(mr_sink *s, const mr_model *m)
{
	put(s, m, false);
	return MR_OK;
}

mr_status
mr_ply_write_ascii(mr_sink *s, const mr_model *m)
{
	put(s, m, true);
	return MR_OK;
}
