/* OBJ, groups of faces together, corners with what the model has. */
#include "formats/format.h"

static void
put_vertex(mr_sink *s, const mr_model *m, size_t i)
{
	double x[6] = { m->p[i].x, m->p[i].y, m->p[i].z };

	mr_put(s, "v ", 2);
	if (m->color)
		for (size_t k = 0; k < 3; k++)
			x[3 + k] = round(m->color[4 * i + k] * (1e6 / 255)) / 1e6;
	mr_put_reals(s, x, m->color ? 6 : 3, '\n');
}

static void
put_face(mr_sink *s, const mr_model *m, const mr_tri *t)
{
	char *to = mr_sink_room(s);

	*to++ = 'f';
	for (int k = 0; k < 3; k++) {
		uint64_t i = (uint64_t)t->v[k] + 1;
		*to++ = ' ';
		to = mr_count_write(to, i);
		if (m->texcoord || m->normal)
			*to++ = '/';
		if (m->texcoord)
			to = mr_count_write(to, i);
		if (m->normal) {
			*to++ = '/';
			to = mr_count_write(to, i);
		}
	}
	*to++ = '\n';
	mr_sink_fill(s, to);
}

static mr_status
put_faces(mr_sink *s, const mr_model *m)
{
	const char **start = NULL;
	size_t names = 0;

	if (m->group)
		MR_TRY(mr_lines_starts(s->ctx, m->groups, &start, &names));
	for (size_t f = 0; f < m->nf; f++) {
		if (m->group && (f == 0 || m->group[f] != m->group[f - 1])) {
			uint32_t g = m->group[f];
			if (g < names) {
				mr_put(s, "g ", 2);
				mr_put(s, start[g], (size_t)(start[g + 1] - start[g]) - 1);
				mr_put(s, "\n", 1);
			} else
				mr_print(s, "g group%u\n", (unsigned)g);
		}
		put_face(s, m, &m->t[f]);
	}
	return MR_OK;
}

mr_status
mr_obj_write(mr_sink *s, const mr_model *m)
{
	size_t opaque = 0;

	mr_note_lost(
	    s, m, MR_KEEPS_NORMAL | MR_KEEPS_COLOR | MR_KEEPS_TEXCOORD | MR_KEEPS_GROUP | MR_KEEPS_FACES);
	for (size_t i = 0; i < m->nv; i++)
		put_vertex(s, m, i);
	for (size_t i = 0; m->color && i < m->nv; i++)
		opaque += m->color[4 * i + 3] == 255;
	if (m->color && opaque < m->nv)
		mr_dropped(s->ctx, &s->lost.dropped_alpha, "alpha", "colours of OBJ have none");
	for (size_t i = 0; m->texcoord && i < m->nv; i++) {
		mr_put(s, "vt ", 3);
		mr_put_reals(s, m->texcoord + 2 * i, 2, '\n');
	}
	for (size_t i = 0; m->normal && i < m->nv; i++) {
		mr_put(s, "vn ", 3);
		mr_put_reals(s, &m->normal[i].x, 3, '\n');
	}
	return put_faces(s, m);
}
