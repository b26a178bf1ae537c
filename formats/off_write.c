/* Object File Format, written: [ST][C][N]OFF as text in doubles. */
#include "formats/format.h"

static uint32_t
vertex_of(const mr_model *m, uint32_t corner)
{
	return m->t[corner / 3].v[corner % 3];
}

mr_status
mr_off_write(mr_sink *s, const mr_model *m)
{
	mr_part part[MR_PARTS];
	mr_polygons faces;

	mr_note_lost(s, m, "normal color alpha texcoord polygon faces");
	mr_faces_of(s, m, &faces);
	mr_print(s, "%s%s%sOFF\n", m->texcoord ? "ST" : "", m->color ? "C" : "", m->normal ? "N" : "");
	mr_print(s, "%zu %zu 0\n", m->nv, faces.count);
	mr_vertex_parts(m, part);
	for (size_t i = 0; i < m->nv; i++) {
		mr_put_parts(s, part, 4, i, true);
		mr_end_row(s);
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
