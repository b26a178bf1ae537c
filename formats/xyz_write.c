/* Points in columns, written: XYZ (position, normal, colour), PTS (a count, position, intensity, colour), PWN
 * (position, normal). */
#include "formats/format.h"

static void
put_color(mr_sink *s, const unsigned char *c)
{
	mr_print(s, "%d %d %d\n", c[0], c[1], c[2]);
}

/* Every byte is 0 or 1, and one is 1, which a reader takes for white. */
static bool
are_dark(const mr_model *m)
{
	unsigned char most = 0;

	for (size_t i = 0; i < 4 * m->nv; i++)
		if (i % 4 < 3 && m->color[i] > most)
			most = m->color[i];
	return most == 1;
}

/* No value is negative, and some normal is not unit. */
static bool
could_be_colors(const mr_v3 *normal, size_t n)
{
	bool odd = false;

	for (size_t i = 0; i < n; i++) {
		if (normal[i].x < 0 || normal[i].y < 0 || normal[i].z < 0)
			return false;
		odd |= mr_norm2(normal[i]) > 0 && !mr_has_unit_length(normal[i]);
	}
	return odd;
}

/* A line of names, where columns without it may be something else. */
static void
put_names(mr_sink *s, const mr_v3 *normal, const unsigned char *color, size_t n)
{
	if (color || (normal && could_be_colors(normal, n)))
		mr_print(s, "# x y z%s%s\n", normal ? " nx ny nz" : "", color ? " red green blue" : "");
}

mr_status
mr_xyz_write(mr_sink *s, const mr_model *m)
{
	mr_note_lost(s, m, MR_KEEPS_NORMAL | MR_KEEPS_COLOR);
	put_names(s, m->normal, m->color, m->nv);
	if (m->color && are_dark(m))
		mr_print(s, "# %s\n", MR_XYZ_BYTES);
	for (size_t i = 0; i < m->nv; i++) {
		mr_put_reals(s, &m->p[i].x, 3, m->normal || m->color ? ' ' : '\n');
		if (m->normal)
			mr_put_reals(s, &m->normal[i].x, 3, m->color ? ' ' : '\n');
		if (m->color)
			put_color(s, m->color + 4 * i);
	}
	return MR_OK;
}

/* What the points have of this name, from a PTS, PTX or LAS; NULL: nothing. */
static const mr_property *
intensity_of(const mr_model *m)
{
	for (size_t i = 0; i < m->properties; i++)
		if (!strcmp(m->property[i].name, "intensity") && m->property[i].shape.element == 'v')
			return &m->property[i];
	return NULL;
}

/* A position, an intensity, which only points without a colour may lack, and a colour. */
mr_status
mr_pts_write(mr_sink *s, const mr_model *m)
{
	const mr_property *intensity = intensity_of(m);

	mr_note_lost(s, m, MR_KEEPS_COLOR | (intensity && m->properties == 1 ? MR_KEEPS_PROPERTY : 0));
	mr_print(s, "%zu\n", m->nv);
	for (size_t i = 0; i < m->nv; i++) {
		bool more = intensity || m->color;
		double x = intensity ? mr_property_value(intensity, i) : 0;
		mr_put_reals(s, &m->p[i].x, 3, more ? ' ' : '\n');
		if (more)
			mr_put_reals(s, &x, 1, m->color ? ' ' : '\n');
		if (m->color)
			put_color(s, m->color + 4 * i);
	}
	return MR_OK;
}

mr_status
mr_pwn_write(mr_sink *s, const mr_model *m)
{
	if (!m->normal)
		return mr_fail(s->ctx, MR_EMISSING, "pwn is points with normals, and there are no normals");
	mr_note_lost(s, m, MR_KEEPS_NORMAL);
	put_names(s, m->normal, NULL, m->nv);
	for (size_t i = 0; i < m->nv; i++) {
		mr_put_reals(s, &m->p[i].x, 3, ' ');
		mr_put_reals(s, &m->normal[i].x, 3, '\n');
	}
	return MR_OK;
}
