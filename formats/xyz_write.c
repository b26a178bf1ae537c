/* Points in columns, written: XYZ (position, normal, colour), PTS (a count, position, intensity, colour), PWN
 * (position, normal). */
#include "formats/format.h"

static void
put_rows(mr_sink *s, const mr_part *part, size_t parts, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		mr_put_parts(s, part, parts, i, true);
		mr_end_row(s);
	}
}

/* A line of names where there are colours, which could be normals. */
mr_status
mr_xyz_write(mr_sink *s, const mr_model *m)
{
	mr_part part[MR_PARTS];

	mr_note_lost(s, m, "normal color");
	if (m->color)
		mr_print(s, "# x y z%s red green blue\n", m->normal ? " nx ny nz" : "");
	mr_vertex_parts(m, part);
	part[2].width = 3;
	put_rows(s, part, 3, m->nv);
	return MR_OK;
}

/* A position, an intensity, which only points without a colour may lack, and a colour. */
mr_status
mr_pts_write(mr_sink *s, const mr_model *m)
{
	static const double none = 0;
	mr_part part[MR_PARTS];
	size_t i = 0;

	while (i < m->properties &&
	       (strcmp(m->property[i].name, "intensity") || m->property[i].shape.element != 'v'))
		i++;
	mr_note_lost(s, m, i < m->properties && m->properties == 1 ? "color property" : "color");
	mr_vertex_parts(m, part);
	part[1] = i < m->properties ? mr_property_part(&m->property[i])
	                            : (mr_part){ m->color ? &none : NULL, 'd', 1, 0, "" };
	part[2].width = 3;
	mr_print(s, "%zu\n", m->nv);
	put_rows(s, part, 3, m->nv);
	return MR_OK;
}

mr_status
mr_pwn_write(mr_sink *s, const mr_model *m)
{
	mr_model own = { .p = m->p, .nv = m->nv, .normal = m->normal };

	if (!m->normal)
		return mr_fail(s->ctx, MR_EMISSING, "pwn is points with normals, and there are no normals");
	mr_note_lost(s, m, "normal");
	return mr_xyz_write(s, &own);
}
