/* Rows by the roles of their columns; colours become bytes once all have been seen. */
#include "formats/rows.h"

#include "formats/format.h"

mr_role
mr_role_of(const char *name, size_t bytes)
{
	static const struct {
		const char *name;
		mr_role role;
	} roles[] = { { "x", MR_X }, { "y", MR_Y }, { "z", MR_Z }, { "nx", MR_NX }, { "ny", MR_NY },
		{ "nz", MR_NZ }, { "normalx", MR_NX }, { "normaly", MR_NY }, { "normalz", MR_NZ },
		{ "normal_x", MR_NX }, { "normal_y", MR_NY }, { "normal_z", MR_NZ }, { "r", MR_RED },
		{ "g", MR_GREEN }, { "b", MR_BLUE }, { "a", MR_ALPHA }, { "red", MR_RED },
		{ "green", MR_GREEN }, { "blue", MR_BLUE }, { "rf", MR_RED }, { "gf", MR_GREEN },
		{ "bf", MR_BLUE }, { "alpha", MR_ALPHA }, { "diffuse_red", MR_RED },
		{ "diffuse_green", MR_GREEN }, { "diffuse_blue", MR_BLUE }, { "s", MR_U }, { "t", MR_V },
		{ "u", MR_U }, { "v", MR_V }, { "texture_u", MR_U }, { "texture_v", MR_V },
		{ "texture_s", MR_U }, { "texture_t", MR_V }, { "scanner_x", MR_FROM_X },
		{ "scanner_y", MR_FROM_Y }, { "scanner_z", MR_FROM_Z } };

	for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
		if (mr_word_is(name, bytes, roles[i].name))
			return roles[i].role;
	return MR_NO_ROLE;
}

void
mr_rows_add(mr_rows *r, mr_role role, const char *name, size_t bytes, const char *type)
{
	MR_RESERVE(r->b.ctx, r->column, r->columns, 1, &r->column_room);
	if (r->at[role])
		role = MR_NO_ROLE;
	r->column[r->columns++] = (mr_rows_column){ role, mr_clean_copy(r->b.ctx, name, bytes), type, 0 };
	r->at[role] = role == MR_NO_ROLE ? 0 : r->columns;
}

void
mr_rows_add_unnamed(mr_rows *r, mr_role first, size_t n)
{
	for (size_t i = 0; i < n; i++)
		mr_rows_add(r, (mr_role)(first + i), "", 0, NULL);
}

/* A group of columns: successive roles from the first on; `needed` of them must exist. */
static const struct {
	mr_role first;
	size_t width, needed;
	const char *what;
} kinds[MR_PARTS] = { { MR_X, 3, 3, "positions" }, { MR_NX, 3, 3, "normals" }, { MR_RED, 4, 3, "colors" },
	{ MR_U, 2, 2, "texture coordinates" }, { MR_FROM_X, 3, 3, "places of the scanner" } };

enum { POSITION, NORMAL, COLOR, TEXCOORD, SCANNER };

/* Makes properties of the columns of a part that is not whole. */
static void
demote(mr_rows *r, size_t part)
{
	size_t *at = r->at + kinds[part].first, there = 0;

	for (size_t i = 0; i < kinds[part].needed; i++)
		there += at[i] > 0;
	for (size_t i = 0; i < kinds[part].width && there < kinds[part].needed; i++)
		if (at[i]) {
			r->column[at[i] - 1].role = MR_NO_ROLE;
			at[i] = 0;
		}
}

void
mr_rows_begin(mr_rows *r)
{
	for (size_t k = NORMAL; k < MR_PARTS; k++)
		demote(r, k);
	for (size_t i = 0; i < r->columns; i++) {
		mr_rows_column *c = &r->column[i];
		if (c->role == MR_NO_ROLE && c->type)
			c->property = mr_build_property(&r->b, c->name, c->type, 'v');
	}
}

static bool
has_part(const mr_rows *r, size_t part)
{
	return r->at[kinds[part].first] > 0;
}

mr_status
mr_rows_room(mr_rows *r, uint64_t more)
{
	mr_ctx *ctx = r->b.ctx;

	if (more >= MR_NONE - r->n)
		return mr_fail(ctx, MR_ERANGE, "%llu vertices are more than indices can name",
		    (unsigned long long)more + r->n);
	for (size_t k = 0; k < MR_PARTS; k++)
		if (has_part(r, k) && !(r->sparse && k == COLOR))
			MR_RESERVE(ctx, r->part[k], kinds[k].width * r->n, kinds[k].width * (size_t)more,
			    &r->room[k]);
	return MR_OK;
}

/* Room for the colour of a row, which those before it have none of; false where it has none either. */
static bool
begin_color(mr_rows *r, double red)
{
	size_t before = r->part[COLOR] ? 4 * r->n : 0;

	if (!r->part[COLOR] && isnan(red))
		return false;
	MR_RESERVE(r->b.ctx, r->part[COLOR], before, 4 * r->n + 4 - before, &r->room[COLOR]);
	for (size_t i = before; i < 4 * r->n; i++)
		r->part[COLOR][i] = NAN;
	return true;
}

void
mr_rows_put(mr_rows *r, const double *x)
{
	bool placed = mr_finite(mr_vec(x[r->at[MR_X] - 1], x[r->at[MR_Y] - 1], x[r->at[MR_Z] - 1]));

	for (size_t k = 0; k < MR_PARTS; k++) {
		const size_t *at = r->at + kinds[k].first, width = kinds[k].width;
		if (!has_part(r, k) || (r->sparse && k == COLOR && !begin_color(r, x[*at - 1])))
			continue;
		for (size_t i = 0; i < width; i++)
			r->part[k][width * r->n + i] = !placed && k > 0 ? 0
			                               : at[i]          ? x[at[i] - 1]
			                                                : (double)NAN;
	}
	for (size_t k = 0; k < r->columns; k++)
		if (r->column[k].property)
			mr_build_value(&r->b, r->column[k].property, r->n, placed ? x[k] : 0);
	r->n++;
}

static bool
has_color(const double *c)
{
	return isfinite(c[0] + c[1] + c[2]);
}

/* Looks at a colour.  If the type defines no full intensity, alpha decides it for colours, too. */
static void
see_color(mr_rows *r, const double *c, bool together)
{
	for (size_t k = 0; k < 4; k++) {
		if (isnan(c[k]))
			continue;
		mr_shade_see(&r->shades[k == 3], c[k]);
		if (k == 3 && together)
			mr_shade_see(&r->shades[0], c[k]);
	}
}

/* Colours become bytes; those that are none are white. */
static void
finish_colors(mr_rows *r)
{
	const double *c = r->part[COLOR];
	bool together = r->shades[0].full == 0 && r->shades[1].full == 0;
	size_t odd = 0, there = 0;
	unsigned char *color;

	for (size_t i = 0; c && i < 4 * r->n; i += 4)
		if (has_color(c + i)) {
			see_color(r, c + i, together);
			there++;
		} else
			odd += !r->sparse || !isnan(c[i]) || !isnan(c[i + 1]) || !isnan(c[i + 2]);
	mr_lost(r->b.ctx, NULL, odd, kinds[COLOR].what);
	if (there == 0)
		return;
	for (int k = 0; k < 2; k++)
		if (r->shades[k].full == 0)
			r->shades[k].full = mr_shade_full(&r->shades[k]);
	r->b.m.color = color = MR_NEW(r->b.ctx, 4 * r->n, unsigned char);
	for (size_t i = 0; i < r->n; i++, c += 4)
		for (size_t k = 0, none = !has_color(c); k < 4; k++)
			*color++ = none || isnan(c[k]) ? 255 : mr_shade_byte(&r->shades[k == 3], c[k]);
	for (int k = 0; k < 2; k++)
		mr_shades_said(r->b.ctx, &r->shades[k]);
}

/* The values of a part that has no value for none; NULL where it is not there, or one is not finite. */
static const double *
finish_part(mr_rows *r, size_t part)
{
	const size_t width = kinds[part].width;
	size_t odd = 0;

	for (size_t i = 0; r->part[part] && i < r->n; i++) {
		const double *x = r->part[part] + width * i;
		odd += !isfinite(x[0] + x[1] + x[width - 1]) ? 1 : 0;
	}
	return mr_all_left(r->b.ctx, odd, r->n, kinds[part].what) ? r->part[part] : NULL;
}

void
mr_rows_end(mr_rows *r)
{
	mr_model *m = &r->b.m;
	mr_v3 *normal = (mr_v3 *)r->part[NORMAL];

	m->nv = r->n;
	m->p = (const mr_v3 *)r->part[POSITION];
	m->normal = normal && mr_normals_left(r->b.ctx, normal, r->n) ? normal : NULL;
	m->texcoord = finish_part(r, TEXCOORD);
	m->scanner = (const mr_v3 *)finish_part(r, SCANNER);
	finish_colors(r);
}

/* ---- written ---- */

void
mr_vertex_parts(const mr_model *m, mr_part part[MR_PARTS])
{
	part[0] = (mr_part){ m->p, 'd', 3, 3, "x y z" };
	part[1] = (mr_part){ m->normal, 'd', 3, 3, "nx ny nz" };
	part[2] = (mr_part){ m->color, 'b', 4, 4, "red green blue alpha" };
	part[3] = (mr_part){ m->texcoord, 'd', 2, 2, "s t" };
	part[4] = (mr_part){ m->scanner, 'd', 3, 3, "scanner_x scanner_y scanner_z" };
}

mr_part
mr_property_part(const mr_property *p)
{
	return (mr_part){ p->data, p->shape.type, 1, 1, p->name };
}

static char *
put_number(char *to, const mr_part *p, size_t at, bool text)
{
	if (p->type == 'f')
		return mr_store_float(to, (float)((const double *)p->data)[at]);
	if (p->type == 'd' && text)
		to = mr_real_write(to, ((const double *)p->data)[at]);
	else if (p->type == 'd')
		return mr_store_double(to, ((const double *)p->data)[at]);
	else if (p->type == 'u' && text)
		to = mr_count_write(to, ((const uint32_t *)p->data)[at]);
	else if (p->type == 'u')
		return mr_store32(to, ((const uint32_t *)p->data)[at]);
	else if (text)
		to = mr_count_write(to, ((const unsigned char *)p->data)[at]);
	else
		*to++ = ((const char *)p->data)[at];
	if (text)
		*to++ = ' ';
	return to;
}

void
mr_put_parts(mr_sink *s, const mr_part *part, size_t parts, size_t i, bool text)
{
	for (const mr_part *p = part; p < part + parts; p++) {
		char *to;
		if (!p->data)
			continue;
		to = mr_sink_room(s);
		for (size_t k = 0; k < p->width; k++)
			to = put_number(to, p, p->stride * i + k, text);
		mr_sink_fill(s, to);
	}
}

void
mr_end_row(mr_sink *s)
{
	s->buffer[s->used - 1] = '\n';
}

typedef struct table {
	const mr_part *part;
	size_t parts;
	bool text;
} table;

static void
put_row(mr_sink *s, const void *arg, size_t i)
{
	const table *t = arg;

	mr_put_parts(s, t->part, t->parts, i, t->text);
	if (t->text)
		mr_end_row(s);
}

void
mr_put_rows(mr_sink *s, const mr_part *part, size_t parts, size_t n, bool text)
{
	mr_put_each(s, n, put_row, &(table){ part, parts, text });
}
