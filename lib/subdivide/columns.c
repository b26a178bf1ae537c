/* Each kind of column has its own way to a finer mesh. */
#include "subdivide/columns.h"

#include "base/text.h"

/* Where the corners of a fine triangle are in the triangle that it is a part of. */
typedef struct corners {
	uint32_t face;
	mr_v3 at[3];
} corners;

static corners
corners_of(const mr_refined *r, size_t f)
{
	corners c = { r->face ? r->face[f] : (uint32_t)(f >> 2 * r->n), { { 0, 0, 0 } } };

	if (r->face)
		memcpy(c.at, r->bary + 3 * f, sizeof c.at);
	else
		mr_loop_corners(r->n, f, c.at);
	return c;
}

/* A value of `width` numbers between those of three corners; those of no weight do not count. */
static void
blend(const double *const value[3], mr_v3 bary, size_t width, double *to)
{
	const double w[3] = { bary.x, bary.y, bary.z };

	for (size_t k = 0; k < width; k++) {
		to[k] = 0;
		for (int i = 0; i < 3; i++)
			if (w[i] == 1)
				to[k] = value[i][k];
			else if (w[i] != 0)
				to[k] += w[i] * value[i][k];
	}
}

/* The same of normals: as long as theirs are on the mean. */
static void
blend_normals(const double *const value[3], mr_v3 bary, double *to)
{
	double length[3], mean;
	const double *const lengths[] = { &length[0], &length[1], &length[2] };
	mr_v3 n;

	for (int i = 0; i < 3; i++)
		length[i] = mr_norm(mr_vec(value[i][0], value[i][1], value[i][2]));
	blend(value, bary, 3, to);
	blend(lengths, bary, 1, &mean);
	n = mr_vec(to[0], to[1], to[2]);
	if (bary.x == 1 || bary.y == 1 || bary.z == 1 || !(mr_norm2(n) > 0))
		return;
	n = mr_mul(mean / mr_norm(n), n);
	to[0] = n.x, to[1] = n.y, to[2] = n.z;
}

/* ---- columns of vertices ---- */

/* Each fine vertex as a place on the mesh; vertices of no triangle have the face MR_NONE. */
static mr_status
find_places(mr_ctx *ctx, const mr_refined *r, mr_place **places)
{
	mr_place *at = MR_NEW(ctx, r->fine.nv, mr_place);

	if (!at)
		return MR_EMEM;
	for (size_t i = 0; i < r->fine.nv; i++)
		at[i].face = MR_NONE;
	for (size_t f = 0; f < r->fine.nf; f++) {
		corners c = corners_of(r, f);
		for (int k = 0; k < 3; k++) {
			mr_place *place = &at[r->fine.t[f].v[k]];
			if (place->face == MR_NONE)
				*place = (mr_place){ c.face, c.at[k] };
		}
	}
	*places = at;
	return MR_OK;
}

/* Rows of `width` numbers of vertices, linear on the triangles. */
static mr_status
linear(mr_ctx *ctx, const mr_refined *r, const mr_place *at, size_t width, bool normals, const double *x,
    const void **out)
{
	double *y = MR_NEW(ctx, width * r->fine.nv, double);

	if (!y)
		return MR_EMEM;
	memcpy(y, x, width * r->m.nv * sizeof *y);
	for (size_t i = r->m.nv; i < r->fine.nv; i++) {
		const uint32_t *v = r->m.t[at[i].face].v;
		const double *const value[] = { x + width * v[0], x + width * v[1], x + width * v[2] };
		if (normals)
			blend_normals(value, at[i].bary, y + 3 * i);
		else
			blend(value, at[i].bary, width, y + width * i);
	}
	*out = y;
	return MR_OK;
}

static mr_status
numbers(mr_ctx *ctx, const mr_refined *r, const mr_place *at, size_t width, const double *x, const void **out)
{
	double *y;

	if (!r->level)
		return linear(ctx, r, at, width, false, x, out);
	y = MR_NEW(ctx, width * r->fine.nv, double);
	if (!y)
		return MR_EMEM;
	*out = y;
	return mr_loop_values(ctx, r->level, r->n, width, x, y);
}

static mr_status
colors(mr_ctx *ctx, const mr_refined *r, const mr_place *at, const unsigned char *bytes, const void **out)
{
	size_t count = 4 * r->fine.nv;
	unsigned char *color = MR_NEW(ctx, count, unsigned char);
	mr_mark mark = mr_mark_take(ctx);
	double *coarse = MR_NEW(ctx, 4 * r->m.nv, double);
	const void *fine;

	if (!color || !coarse)
		return MR_EMEM;
	for (size_t i = 0; i < 4 * r->m.nv; i++)
		coarse[i] = bytes[i];
	MR_TRY(numbers(ctx, r, at, 4, coarse, &fine));
	for (size_t i = 0; i < count; i++) /* averages, so from 0 to 255 */
		color[i] = (unsigned char)(((const double *)fine)[i] + 0.5);
	mr_mark_release(ctx, mark);
	*out = color;
	return MR_OK;
}

/* The least of the regions around, so that what is fixed or free stays so up to its border. */
static mr_status
regions(mr_ctx *ctx, const mr_refined *r, const mr_place *at, const uint32_t *region, const void **out)
{
	uint32_t *fine = MR_NEW(ctx, r->fine.nv, uint32_t);

	if (!fine)
		return MR_EMEM;
	memcpy(fine, region, r->m.nv * sizeof *fine);
	for (size_t i = r->m.nv; i < r->fine.nv; i++) {
		/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference) a new vertex has its place */
		const double w[] = { at[i].bary.x, at[i].bary.y, at[i].bary.z };
		fine[i] = UINT32_MAX;
		for (int k = 0; k < 3; k++) {
			uint32_t of = region[r->m.t[at[i].face].v[k]];
			fine[i] = w[k] > 0 && of < fine[i] ? of : fine[i];
		}
	}
	*out = fine;
	return MR_OK;
}

/* Rows of the nearest vertex by weight, of equal ones that of the lowest number. */
static mr_status
nearest(mr_ctx *ctx, const mr_refined *r, const mr_place *at, size_t bytes, const char *x, const void **out)
{
	char *y = mr_alloc(ctx, r->fine.nv, bytes);

	if (!y)
		return MR_EMEM;
	memcpy(y, x, bytes * r->m.nv);
	for (size_t i = r->m.nv; i < r->fine.nv; i++) {
		/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference) a new vertex has its place */
		const double w[] = { at[i].bary.x, at[i].bary.y, at[i].bary.z };
		const uint32_t *v = r->m.t[at[i].face].v;
		int best = 0;
		for (int k = 1; k < 3; k++)
			if (w[k] > w[best] || (w[k] == w[best] && v[k] < v[best]))
				best = k;
		memcpy(y + bytes * i, x + bytes * v[best], bytes);
	}
	*out = y;
	return MR_OK;
}

static mr_status
vertex_column(mr_ctx *ctx, const mr_refined *r, const mr_place *at, const mr_carried *c, const void **out)
{
	size_t width = c->shape.components;

	if (!strcmp(c->name, "region"))
		return regions(ctx, r, at, c->data, out);
	if (!strcmp(c->name, "color"))
		return colors(ctx, r, at, c->data, out);
	if (!strcmp(c->name, "normal"))
		return linear(ctx, r, at, 3, true, c->data, out);
	if (!mr_are_labels(c->shape, c->data, (size_t)c->rows))
		return numbers(ctx, r, at, width, c->data, out);
	return nearest(ctx, r, at, width * mr_type_size(c->shape.type), c->data, out);
}

/* ---- columns of faces ---- */

static mr_status
parents(mr_ctx *ctx, const mr_refined *r, size_t bytes, const char *x, const void **out)
{
	char *y = mr_alloc(ctx, r->fine.nf, bytes);

	for (size_t f = 0; y && f < r->fine.nf; f++)
		memcpy(y + bytes * f, x + bytes * (r->face ? r->face[f] : f >> 2 * r->n), bytes);
	*out = y;
	return y ? MR_OK : MR_EMEM;
}

static mr_status
of_corners(mr_ctx *ctx, const mr_refined *r, size_t width, const double *x, const void **out)
{
	double *y = MR_NEW(ctx, 3 * width * r->fine.nf, double);

	if (!y)
		return MR_EMEM;
	for (size_t f = 0; f < r->fine.nf; f++) {
		corners c = corners_of(r, f);
		const double *first = x + 3 * width * c.face;
		const double *const value[] = { first, first + width, first + 2 * width };
		for (size_t k = 0; k < 3; k++)
			if (width == 3)
				blend_normals(value, c.at[k], y + 3 * (3 * f + k));
			else
				blend(value, c.at[k], width, y + width * (3 * f + k));
	}
	*out = y;
	return MR_OK;
}

static mr_status
face_column(mr_ctx *ctx, const mr_refined *r, const mr_carried *c, const void **out)
{
	if (!strcmp(c->name, "corner_texcoord"))
		return of_corners(ctx, r, 2, c->data, out);
	if (!strcmp(c->name, "corner_normal"))
		return of_corners(ctx, r, 3, c->data, out);
	return parents(ctx, r, c->shape.components * mr_type_size(c->shape.type), c->data, out);
}

/* ---- all of them ---- */

/* Those by convention that go along, and all that are none by convention. */
static bool
goes_along(const mr_column *c, const char *layer, const mr_refined *r)
{
	static const char *const vertex[] = { "region", "color", "texcoord", "normal", NULL };
	static const char *const face[] = { "corner_texcoord", "corner_normal", "group", "object", "material",
		"smoothing", NULL };
	static const char *const names[] = { "groups", "objects", "materials", "mtllib", "properties", NULL };
	char element = c->shape.element;

	if (strcmp(c->layer, layer))
		return false;
	if (!strcmp(c->name, "polygon"))
		return !r->level || r->n == 0;
	if (!mr_column_known(layer, c->name))
		return element != '-';
	return mr_is_one_of(c->name, element == 'v' ? vertex : element == 'f' ? face : names);
}

/* The column on the fine mesh, in place. */
static mr_status
carry(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_refined *r, const mr_place *at, mr_carried *c)
{
	char element = c->shape.element;
	size_t expected = element == 'v' ? r->m.nv : r->m.nf;
	const void *fine;

	if (mr_column_known(layer, c->name))
		MR_TRY(mr_layer_get(ctx, f, layer, c->name, &c->data, &c->rows));
	else
		MR_TRY(mr_frame_get(ctx, f, layer, c->name, c->shape, &c->data, &c->rows));
	if (element == '-')
		return MR_OK;
	if (c->rows != expected)
		return mr_fail(
		    ctx, MR_ERANGE, "%s: column %s has %zu rows, not %zu", layer, c->name, c->rows, expected);
	MR_TRY(element == 'v' ? vertex_column(ctx, r, at, c, &fine) : face_column(ctx, r, c, &fine));
	c->data = fine;
	c->rows = element == 'v' ? r->fine.nv : r->fine.nf;
	return MR_OK;
}

mr_status
mr_refine_columns(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_refined *r, mr_carried **out, size_t *count)
{
	mr_carried *list = MR_NEW(ctx, f->count, mr_carried);
	mr_place *at = NULL;
	size_t n = 0;

	if (!list)
		return MR_EMEM;
	for (size_t i = 0; i < f->count; i++) {
		const mr_column *c = &f->columns[i];
		if (!goes_along(c, layer, r))
			continue;
		list[n] = (mr_carried){ .shape = c->shape };
		memcpy(list[n].name, c->name, sizeof list[n].name);
		if (c->shape.element == 'v' && !at)
			MR_TRY(find_places(ctx, r, &at));
		MR_TRY(carry(ctx, f, layer, r, at, &list[n++]));
	}
	*out = list;
	*count = n;
	return MR_OK;
}

mr_status
mr_refined_flat(mr_ctx *ctx, const mr_refined *r, mr_v3 *p)
{
	mr_mark mark = mr_mark_take(ctx);
	const void *flat;
	mr_place *at;

	MR_TRY(find_places(ctx, r, &at));
	MR_TRY(linear(ctx, r, at, 3, false, (const double *)r->m.p, &flat));
	memcpy(p, flat, r->fine.nv * sizeof *p);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
