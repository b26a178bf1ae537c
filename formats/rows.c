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
		{ "green", MR_GREEN }, { "blue", MR_BLUE }, { "alpha", MR_ALPHA }, { "diffuse_red", MR_RED },
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
	MR_RESERVE(r->b->ctx, r->column, r->columns, 1, &r->column_room);
	if (r->at[role])
		role = MR_NO_ROLE;
	r->column[r->columns++] = (mr_rows_column){ role, mr_clean_copy(r->b->ctx, name, bytes), type, 0 };
	r->at[role] = role == MR_NO_ROLE ? 0 : r->columns;
}

static void
demote(mr_rows *r, mr_role first, size_t n)
{
	bool whole = true;

	for (size_t i = first; i < first + n; i++)
		whole &= r->at[i] > 0;
	for (size_t i = first; i < first + n && !whole; i++)
		if (r->at[i]) {
			r->column[r->at[i] - 1].role = MR_NO_ROLE;
			r->at[i] = 0;
		}
}

void
mr_rows_begin(mr_rows *r)
{
	demote(r, MR_NX, 3);
	demote(r, MR_RED, 3);
	if (!r->at[MR_RED])
		demote(r, MR_RED, 4);
	demote(r, MR_U, 2);
	demote(r, MR_FROM_X, 3);
	for (size_t i = 0; i < r->columns; i++) {
		mr_rows_column *c = &r->column[i];
		if (c->role == MR_NO_ROLE && c->type)
			mr_build_property(r->b, c->name, c->type, 'v', &c->property);
	}
}

mr_status
mr_rows_room(mr_rows *r, uint64_t more)
{
	mr_builder *b = r->b;
	size_t n = (size_t)more;

	if (more >= MR_NONE - r->n)
		return mr_fail(b->ctx, MR_ERANGE, "%llu vertices are more than indices can name",
		    (unsigned long long)more + r->n);
	MR_RESERVE(b->ctx, b->p, r->n, n, &r->room[0]);
	if (r->at[MR_NX])
		MR_RESERVE(b->ctx, b->normal, r->n, n, &r->room[1]);
	if (r->at[MR_FROM_X])
		MR_RESERVE(b->ctx, b->scanner, r->n, n, &r->room[2]);
	if (r->at[MR_U])
		MR_RESERVE(b->ctx, b->texcoord, 2 * r->n, 2 * n, &r->room[3]);
	return MR_OK;
}

static mr_v3
three(const mr_rows *r, const double *x, mr_role first)
{
	return mr_vec(x[r->at[first] - 1], x[r->at[first + 1] - 1], x[r->at[first + 2] - 1]);
}

mr_v3
mr_rows_position(const mr_rows *r, const double *x)
{
	return three(r, x, MR_X);
}

/* Where their types do not say what is full, alpha says it of colours, too. */
static void
put_color(mr_rows *r, const double *x)
{
	bool together = r->shades[0].full == 0 && r->shades[1].full == 0;
	double c[4];
	float *to;

	for (size_t k = 0; k < 4; k++)
		c[k] = r->at[MR_RED + k] ? x[r->at[MR_RED + k] - 1] : (double)NAN;
	if (!isfinite(c[0] + c[1] + c[2])) {
		r->odd_colors += !r->sparse;
		c[0] = c[3] = (double)NAN;
		if (!r->rgba)
			return;
	}
	if (!r->rgba) {
		MR_RESERVE(r->b->ctx, r->rgba, 0, 4 * r->n + 4, &r->room[4]);
		for (size_t i = 0; i < 4 * r->n; i++)
			r->rgba[i] = NAN;
	}
	MR_RESERVE(r->b->ctx, r->rgba, 4 * r->n, 4, &r->room[4]);
	to = r->rgba + 4 * r->n;
	for (size_t k = 0; k < 4; k++) {
		to[k] = (float)c[k];
		if (isnan(c[0]) || isnan(c[k]))
			continue;
		mr_shade_see(&r->shades[k == 3], c[k]);
		if (k == 3 && together)
			mr_shade_see(&r->shades[0], c[k]);
	}
}

void
mr_rows_put(mr_rows *r, const double *x)
{
	mr_builder *b = r->b;
	size_t i = r->n;

	b->p[i] = three(r, x, MR_X);
	if (r->at[MR_NX])
		b->normal[i] = three(r, x, MR_NX);
	if (r->at[MR_FROM_X]) {
		b->scanner[i] = three(r, x, MR_FROM_X);
		r->odd_scanner += !mr_finite(b->scanner[i]);
	}
	if (r->at[MR_U]) {
		const double *u = x + r->at[MR_U] - 1, *v = x + r->at[MR_V] - 1;
		b->texcoord[2 * i] = *u;
		b->texcoord[2 * i + 1] = *v;
		r->odd_uv += !isfinite(*u) || !isfinite(*v);
	}
	if (r->at[MR_RED])
		put_color(r, x);
	for (size_t k = 0; k < r->columns; k++)
		if (r->column[k].property)
			mr_build_value(b, r->column[k].property, i, x[k]);
	r->n++;
}

/* Colours are bytes; those that are none are white. */
static void
finish_colors(mr_rows *r)
{
	mr_ctx *ctx = r->b->ctx;

	mr_lost(ctx, NULL, r->odd_colors, "colors");
	if (!r->rgba)
		return;
	r->b->color = MR_NEW(ctx, 4 * r->n, unsigned char);
	for (int k = 0; k < 2; k++)
		if (r->shades[k].full == 0)
			r->shades[k].full = mr_shade_full(&r->shades[k]);
	for (size_t i = 0; i < 4 * r->n; i++) {
		bool none = isnan(r->rgba[i]) || isnan(r->rgba[i / 4 * 4]);
		r->b->color[i] = none ? 255 : mr_shade_byte(&r->shades[i % 4 == 3], (double)r->rgba[i]);
	}
	for (int k = 0; k < 2; k++)
		mr_shades_said(ctx, &r->shades[k]);
}

void
mr_rows_end(mr_rows *r)
{
	mr_builder *b = r->b;

	b->nv = r->n;
	if (b->normal && !mr_normals_left(b->ctx, b->normal, r->n))
		b->normal = NULL;
	if (!mr_all_left(b->ctx, r->odd_uv, r->n, "texture coordinates"))
		b->texcoord = NULL;
	if (!mr_all_left(b->ctx, r->odd_scanner, r->n, "places of the scanner"))
		b->scanner = NULL;
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

void
mr_put_rows(mr_sink *s, const mr_part *part, size_t parts, size_t n, bool text)
{
	for (size_t i = 0; i < n; i++) {
		mr_put_parts(s, part, parts, i, text);
		if (text)
			mr_end_row(s);
	}
}
