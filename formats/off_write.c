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
	mr_polygons faces;

	mr_note_lost(s, m,
	    MR_KEEPS_NORMAL | MR_KEEPS_COLOR | MR_KEEPS_ALPHA | MR_KEEPS_TEXCOORD | MR_KEEPS_POLYGON |
		MR_KEEPS_FACES);
	mr_faces_of(s, m, &faces);
	mr_print(s, "%s%s%sOFF\n", m->texcoord ? "ST" : "", m->color ? "C" : "", m->normal ? "N" : "");
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
