/* Stanford PLY, written: positions, normals and texture coordinates as doubles, so that nothing is rounded,
 * unless floats are asked for. */
#include "formats/format.h"

typedef struct output {
	mr_sink *s;
	const mr_model *m;
	bool text;
	char real;     /* the type of a part of reals: d or f */
	mr_part *part; /* of vertices, then of faces */
	size_t vertex_parts, face_parts;
	mr_polygons faces;
	bool bytes; /* the lengths of lists are, else whole numbers */
} output;

/* ---- the header ---- */

static void
put_property_lines(const output *w, const mr_part *part, size_t parts)
{
	for (const mr_part *p = part; p < part + parts; p++)
		for (const char *name = p->names; p->data && *name;
		     name += strcspn(name, " "), name += *name == ' ')
			mr_print(w->s, "property %s %.*s\n",
			    p->type == 'd'   ? "double"
			    : p->type == 'f' ? "float"
			    : p->type == 'u' ? "uint"
					     : "uchar",
			    (int)strcspn(name, " "), name);
}

static void
put_header(const output *w)
{
	const char *counted = w->bytes ? "uchar" : "uint";

	mr_print(w->s, "ply\nformat %s 1.0\n", w->text ? "ascii" : "binary_little_endian");
	mr_print(w->s, "element vertex %zu\n", w->m->nv);
	put_property_lines(w, w->part, w->vertex_parts);
	if (w->m->nf) {
		mr_print(
		    w->s, "element face %zu\nproperty list %s int vertex_indices\n", w->faces.count, counted);
		if (w->m->corner_texcoord)
			mr_print(w->s, "property list %s %s texcoord\n", counted,
			    w->real == 'f' ? "float" : "double");
		put_property_lines(w, w->part + w->vertex_parts, w->face_parts);
	}
	mr_print(w->s, "end_header\n");
}

/* ---- rows ---- */

static void
put_length(mr_sink *s, const output *w, size_t n)
{
	const uint32_t whole = (uint32_t)n;
	const unsigned char byte = (unsigned char)n;
	const mr_part length = { w->bytes ? (const void *)&byte : &whole, w->bytes ? 'b' : 'u', 1, 1, "" };

	mr_put_parts(s, &length, 1, 0, w->text);
}

static void
put_face(mr_sink *s, const void *arg, size_t face)
{
	const output *w = arg;
	size_t first = mr_polygon_begin(&w->faces, face), end = mr_polygon_begin(&w->faces, face + 1);
	const mr_part corner = { w->m->t, 'u', 1, 1, "" }, uv = { w->m->corner_texcoord, w->real, 2, 2, "" };

	put_length(s, w, end - first);
	for (size_t i = first; i < end; i++)
		mr_put_parts(s, &corner, 1, mr_polygon_corner(&w->faces, i), w->text);
	if (uv.data)
		put_length(s, w, 2 * (end - first));
	for (size_t i = first; i < end; i++)
		mr_put_parts(s, &uv, 1, mr_polygon_corner(&w->faces, i), w->text);
	mr_put_parts(
	    s, w->part + w->vertex_parts, w->face_parts, mr_polygon_corner(&w->faces, first) / 3, w->text);
	if (w->text)
		mr_end_row(s);
}

static void
put(mr_sink *s, const mr_model *m, bool text, char real)
{
	output w = { .s = s, .m = m, .text = text, .real = real };

	mr_note_lost(s, m, "normal scanner color alpha texcoord corner_texcoord property faces");
	w.part = MR_NEW(s->ctx, MR_PARTS + m->properties, mr_part);
	mr_vertex_parts(m, w.part);
	for (size_t i = 0; i < m->properties; i++) { /* properties of vertices come first */
		w.part[MR_PARTS + i] = mr_property_part(&m->property[i]);
		w.face_parts += m->property[i].shape.element == 'f';
	}
	for (size_t i = 0; i < MR_PARTS + m->properties; i++)
		if (w.part[i].type == 'd')
			w.part[i].type = real;
	w.vertex_parts = MR_PARTS + m->properties - w.face_parts;
	mr_faces_of(s, m, &w.faces);
	w.bytes = w.faces.most * 2 <= UINT8_MAX;
	put_header(&w);
	mr_put_rows(s, w.part, w.vertex_parts, m->nv, text);
	mr_put_each(s, w.faces.count, put_face, &w);
}

mr_status
mr_ply_write(mr_sink *s, const mr_model *m)
{
	put(s, m, false, 'd');
	return MR_OK;
}

mr_status
mr_ply_write_float(mr_sink *s, const mr_model *m)
{
	MR_TRY(mr_note_rounded(s, m));
	put(s, m, false, 'f');
	return MR_OK;
}

mr_status
mr_ply_write_ascii(mr_sink *s, const mr_model *m)
{
	put(s, m, true, 'd');
	return MR_OK;
}
