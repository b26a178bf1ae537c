/* Law by law, each with the sentence that names what breaks it. */
#include "mesh/validate.h"

#include "mesh/name_lists.h"

static const double SUM_TOLERANCE = 1e-9;

static bool
is(const mr_column *c, const char *name)
{
	return !strcmp(c->name, name);
}

static mr_status
check_shape(mr_ctx *ctx, const mr_column *c)
{
	const mr_column_info *info = mr_column_of(c->layer, c->name);
	mr_shape s = info ? info->shape : c->shape;

	if (s.components == 0)
		s.components = c->shape.components;
	if (s.element == c->shape.element && s.type == c->shape.type && s.components == c->shape.components)
		return MR_OK;
	return mr_fail(ctx, MR_ERANGE, "%s: column %s is %c %c%u, not %c %c%u", c->layer, c->name,
	    c->shape.element, c->shape.type, c->shape.components, s.element, s.type, s.components);
}

/* How many vertices or faces a layer has; false where nothing says so. */
static bool
layer_rows(const mr_frame *f, const char *layer, char element, uint64_t *rows)
{
	const mr_column *c = mr_frame_find(f, layer, element == 'v' ? "position" : "triangles");

	if (c)
		*rows = c->rows;
	return c;
}

static mr_status
check_rows(mr_ctx *ctx, const mr_frame *f, const mr_column *c)
{
	uint64_t rows;

	if (c->shape.element == '-' || !layer_rows(f, c->layer, c->shape.element, &rows) || rows == c->rows)
		return MR_OK;
	return mr_fail(ctx, MR_ERANGE, "%s: column %s has %llu rows, not %llu", c->layer, c->name,
	    (unsigned long long)c->rows, (unsigned long long)rows);
}

mr_status
mr_check_finite(mr_ctx *ctx, const mr_column *c)
{
	const double *x = c->data;
	size_t width = c->shape.components;
	bool may_lack = is(c, "corner_texcoord"); /* NaN: a corner without */

	if (c->shape.type != 'd' || !mr_column_known(c->layer, c->name))
		return MR_OK; /* a file's own numbers may be anything */
	for (size_t i = mr_first_infinite(x, c->rows * width); i < c->rows * width; i++)
		if (!isfinite(x[i]) && !(may_lack && isnan(x[i])))
			return mr_fail(ctx, MR_ERANGE, "%s: column %s, row %zu: component %zu is %g",
			    c->layer, c->name, i / width, i % width, isnan(x[i]) ? NAN : x[i]);
	return MR_OK;
}

static mr_status
check_below(mr_ctx *ctx, const mr_column *c, uint64_t end, const char *of)
{
	const uint32_t *x = c->data;
	size_t width = c->shape.components;

	for (size_t i = 0; i < c->rows * width; i++)
		if (x[i] >= end)
			return mr_fail(ctx, MR_ERANGE, "%s: column %s, row %zu is %u of %llu %s", c->layer,
			    c->name, i / width, x[i], (unsigned long long)end, of);
	return MR_OK;
}

static mr_status
check_places(mr_ctx *ctx, const mr_column *c)
{
	const mr_v3 *w = c->data;

	for (size_t i = 0; i < c->rows; i++) {
		if (!(fabs(w[i].x + w[i].y + w[i].z - 1) <= SUM_TOLERANCE))
			return mr_fail(ctx, MR_ERANGE,
			    "%s: column %s, row %zu: the coordinates have the sum %.17g", c->layer, c->name,
			    i, w[i].x + w[i].y + w[i].z);
		if (!mr_bary_within(w[i]))
			return mr_fail(ctx, MR_ERANGE,
			    "%s: column %s, row %zu: (%g %g %g) is no place within a face", c->layer, c->name,
			    i, w[i].x, w[i].y, w[i].z);
	}
	return MR_OK;
}

static mr_status
check_reference(mr_ctx *ctx, const mr_frame *f, const mr_column *c, const char *layer, char element)
{
	const char *elements = element == 'v' ? "vertices" : "faces";
	uint64_t rows;

	if (!layer_rows(f, layer, element, &rows))
		return mr_fail(ctx, MR_EMISSING, "%s: column %s refers to %s of %s, which is not there",
		    c->layer, c->name, elements, layer);
	return check_below(ctx, c, rows, elements);
}

static mr_status
check_law(mr_ctx *ctx, const mr_frame *f, const mr_column *c)
{
	const mr_column_info *info = mr_column_of(c->layer, c->name);

	if (!strcmp(c->name, "triangles"))
		return check_reference(ctx, f, c, c->layer, 'v');
	if (info && info->kind == MR_NUMBER)
		return check_reference(ctx, f, c, info->refers, 'f');
	return info && info->kind == MR_PLACE ? check_places(ctx, c) : MR_OK;
}

/* Numbers of lines of a column of names. */
static mr_status
check_names(mr_ctx *ctx, mr_frame *f, const mr_column *c, const char *list)
{
	const mr_shape text = { '-', 't', 1 };
	const void *names;
	uint64_t lines = 1;
	size_t n;

	MR_TRY(mr_frame_get(ctx, f, c->layer, list, text, &names, &n));
	for (size_t i = 0; i < n; i++)
		lines += ((const char *)names)[i] == '\n';
	return check_below(ctx, c, lines, list);
}

/* Checks one column; the first law it breaks fails. */
static mr_status
check_column(mr_ctx *ctx, mr_frame *f, mr_column *c)
{
	const char *names = mr_names_of(c->name);
	const uint32_t *region;

	MR_TRY(mr_prefix(ctx, mr_column_decode(ctx, c), "%s: column %s", c->layer, c->name));
	if (!*c->layer)
		return MR_OK;
	MR_TRY(check_shape(ctx, c));
	MR_TRY(check_rows(ctx, f, c));
	MR_TRY(mr_check_finite(ctx, c));
	if (is(c, "region"))
		return mr_layer_region(ctx, f, c->layer, c->rows, &region);
	return names ? check_names(ctx, f, c, names) : check_law(ctx, f, c);
}

mr_status
mr_check_made(mr_ctx *ctx, const mr_frame *f)
{
	for (size_t i = 0; i < f->count; i++)
		if (!f->columns[i].stored)
			MR_TRY(mr_check_finite(ctx, &f->columns[i]));
	return MR_OK;
}

void
mr_check_frame(mr_ctx *ctx, mr_frame *f, void (*broken)(void *user, const char *sentence), void *user)
{
	for (size_t i = 0; i < f->count; i++) {
		mr_status status = check_column(ctx, f, &f->columns[i]);
		if (status < 0)
			broken(user, ctx->error);
	}
	*ctx->error = '\0';
}
