/* Object File Format, written: [ST][C][N]OFF as text in doubles, or binary in big-endian floats as Geomview
 * has it. */
#include "formats/format.h"

static void
put_keyword(mr_sink *s, const mr_model *m, const char *binary)
{
	mr_print(
	    s, "%s%s%sOFF%s\n", m->texcoord ? "ST" : "", m->color ? "C" : "", m->normal ? "N" : "", binary);
}

static uint32_t
vertex_of(const mr_model *m, uint32_t corner)
{
	return m->t[corner / 3].v[corner % 3];
}

mr_status
mr_off_write(mr_sink *s, const mr_model *m)
{
	mr_polygons faces;

	mr_note_lost(
	    s, m, MR_KEEPS_NORMAL | MR_KEEPS_COLOR | MR_KEEPS_TEXCOORD | MR_KEEPS_POLYGON | MR_KEEPS_FACES);
	put_keyword(s, m, "");
	MR_TRY(mr_faces_of(s, m, &faces));
	mr_print(s, "%zu %zu 0\n", m->nv, faces.count);
	for (size_t i = 0; i < m->nv; i++) {
		bool more = m->normal || m->color || m->texcoord;
		mr_put_reals(s, &m->p[i].x, 3, more ? ' ' : '\n');
		if (m->normal)
			mr_put_reals(s, &m->normal[i].x, 3, m->color || m->texcoord ? ' ' : '\n');
		if (m->color) {
			const unsigned char *c = m->color + 4 * i;
			mr_print(s, "%d %d %d %d%s", c[0], c[1], c[2], c[3], m->texcoord ? " " : "\n");
		}
		if (m->texcoord)
			mr_put_reals(s, m->texcoord + 2 * i, 2, '\n');
	}
	for (size_t f = 0; f < faces.count; f++) {
		mr_sink_fill(s, mr_count_write(mr_sink_room(s),
				    mr_polygon_begin(&faces, f + 1) - mr_polygon_begin(&faces, f)));
		for (size_t i = mr_polygon_begin(&faces, f); i < mr_polygon_begin(&faces, f + 1); i++) {
			char *to = mr_sink_room(s);
			*to++ = ' ';
			mr_sink_fill(s, mr_count_write(to, vertex_of(m, mr_polygon_corner(&faces, i))));
		}
		mr_put(s, "\n", 1);
	}
	return MR_OK;
}

static char *
put_floats(char *to, const double *x, size_t n)
{
	for (size_t i = 0; i < n; i++)
		to = mr_store_float(to, (float)x[i], true);
	return to;
}

mr_status
mr_off_write_binary(mr_sink *s, const mr_model *m)
{
	mr_polygons faces;
	char *to;

	mr_note_lost(
	    s, m, MR_KEEPS_NORMAL | MR_KEEPS_COLOR | MR_KEEPS_TEXCOORD | MR_KEEPS_POLYGON | MR_KEEPS_FACES);
	MR_TRY(mr_note_rounded(s, m));
	MR_TRY(mr_check_floats(s, m));
	MR_TRY(mr_faces_of(s, m, &faces));
	put_keyword(s, m, " BINARY");
	to = mr_store32(mr_sink_room(s), (uint32_t)m->nv, true);
	mr_sink_fill(s, mr_store32(mr_store32(to, (uint32_t)faces.count, true), 0, true));
	for (size_t i = 0; i < m->nv; i++) {
		to = put_floats(mr_sink_room(s), &m->p[i].x, 3);
		if (m->normal)
			to = put_floats(to, &m->normal[i].x, 3);
		for (size_t k = 0; m->color && k < 4; k++)
			to = mr_store_float(to, (float)(m->color[4 * i + k] / 255.0), true);
		if (m->texcoord)
			to = put_floats(to, m->texcoord + 2 * i, 2);
		mr_sink_fill(s, to);
	}
	for (size_t f = 0; f < faces.count; f++) {
		size_t first = mr_polygon_begin(&faces, f), end = mr_polygon_begin(&faces, f + 1);
		mr_sink_fill(s, mr_store32(mr_sink_room(s), (uint32_t)(end - first), true));
		for (size_t i = first; i < end; i++)
			mr_sink_fill(
			    s, mr_store32(mr_sink_room(s), vertex_of(m, mr_polygon_corner(&faces, i)), true));
		mr_sink_fill(s, mr_store32(mr_sink_room(s), 0, true)); /* no colour of the face */
	}
	return MR_OK;
}
