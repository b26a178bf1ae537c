/* The table of what the columns are, and new rows of them by their kinds. */
#include "mesh/attributes.h"

#include "base/parallel.h"
#include "base/vec.h"

/* The one table of what the columns are.  Extend it with each new column; man/mr.7 shows it. */
const mr_column_info mr_columns[] = {
	{ NULL, "position", { 'v', 'd', 3 }, MR_OWN, MR_NEEDED, NULL, "where the vertex is" },
	{ NULL, "triangles", { 'f', 'u', 3 }, MR_OWN, MR_NEEDED, NULL,
	    "corners, counter-clockwise seen from outside" },
	{ NULL, "normal", { 'v', 'd', 3 }, MR_DIRECTION, MR_NEEDED, NULL, "unit normal" },
	{ NULL, "color", { 'v', 'b', 4 }, MR_MEAN, MR_WHITE, NULL, "red, green, blue, alpha" },
	{ NULL, "texcoord", { 'v', 'd', 2 }, MR_MEAN, MR_ZERO, NULL, "texture coordinates" },
	{ NULL, "corner_texcoord", { 'f', 'd', 6 }, MR_MEAN, MR_NAN, NULL,
	    "those of the corners, NaN of one without" },
	{ NULL, "corner_normal", { 'f', 'd', 9 }, MR_DIRECTION, MR_ZERO, NULL,
	    "normals of the corners, 0 of one without" },
	{ NULL, "polygon", { 'f', 'u', 1 }, MR_LABEL, MR_COUNTED, NULL,
	    "the polygon that the triangle is a part of" },
	{ NULL, "group", { 'f', 'u', 1 }, MR_LABEL, MR_ZERO, NULL, "index into groups" },
	{ NULL, "groups", { '-', 't', 1 }, MR_LABEL, MR_NEEDED, NULL, "names of the groups, one a line" },
	{ NULL, "object", { 'f', 'u', 1 }, MR_LABEL, MR_ZERO, NULL, "index into objects" },
	{ NULL, "objects", { '-', 't', 1 }, MR_LABEL, MR_NEEDED, NULL, "names of the objects, one a line" },
	{ NULL, "material", { 'f', 'u', 1 }, MR_LABEL, MR_ZERO, NULL, "index into materials" },
	{ NULL, "materials", { '-', 't', 1 }, MR_LABEL, MR_NEEDED, NULL,
	    "names of the materials, one a line" },
	{ NULL, "mtllib", { '-', 't', 1 }, MR_LABEL, MR_NEEDED, NULL, "files of the materials, one a line" },
	{ NULL, "smoothing", { 'f', 'u', 1 }, MR_LABEL, MR_ZERO, NULL, "smoothing group, 0 none" },
	{ NULL, "region", { 'v', 'u', 1 }, MR_LEAST, MR_NEEDED, NULL, "0 fixed, 1 free, 2 + N handle N" },
	{ NULL, "scanner", { 'v', 'd', 3 }, MR_OWN, MR_NEEDED, NULL, "from where the point was seen" },
	{ NULL, "spacing", { 'v', 'd', 1 }, MR_SAMPLED, MR_NEEDED, NULL,
	    "side of the square of surface that the point has to itself" },
	{ NULL, "outlier", { 'v', 'b', 1 }, MR_SAMPLED, MR_NEEDED, NULL,
	    "1 where the point is on no surface, else 0" },
	{ NULL, "repeat", { 'v', 'b', 1 }, MR_SAMPLED, MR_NEEDED, NULL,
	    "1 where an earlier point is at the same place, else 0" },
	{ NULL, "sampling", { '-', 'd', 2 }, MR_SAMPLED, MR_NEEDED, NULL,
	    "noise, and how many nearest points show the surface" },
	{ "mesh", "detail_face", { 'v', 'u', 1 }, MR_NUMBER, MR_NEEDED, "base",
	    "base triangle below the vertex" },
	{ "mesh", "detail_bary", { 'v', 'd', 3 }, MR_PLACE, MR_NEEDED, "base",
	    "barycentric coordinates in it" },
	{ "mesh", "detail_height", { 'v', 'd', 1 }, MR_OWN, MR_NEEDED, "base",
	    "height along the base's Phong normal" },
	{ "mesh", "detail_offset", { 'v', 'd', 3 }, MR_OWN, MR_ZERO, "base",
	    "offset in the base's frame, where there is no height" },
	{ "base", "source_face", { 'v', 'u', 1 }, MR_NUMBER, MR_NEEDED, "mesh",
	    "triangle of mesh that the vertex lies on" },
	{ "base", "source_bary", { 'v', 'd', 3 }, MR_PLACE, MR_NEEDED, "mesh",
	    "barycentric coordinates in it" },
	{ "base", "encoded", { 'v', 'd', 3 }, MR_OWN, MR_NEEDED, "mesh",
	    "positions on which mesh was encoded" },
	{ "base", "before", { 'v', 'd', 3 }, MR_OWN, MR_NEEDED, NULL,
	    "positions from which its last pose began" },
	{ "base", "rest", { 'v', 'd', 3 }, MR_OWN, MR_NEEDED, NULL,
	    "positions on which the system is assembled" },
	{ "base", "response", { 'v', 'd', 0 }, MR_OWN, MR_NEEDED, NULL,
	    "what each handle's affine map does, 4 a handle" },
	{ "control", "encoded", { 'v', 'd', 3 }, MR_OWN, MR_NEEDED, NULL, "positions before it was moved" },
	{ "control", "crease", { 'f', 'b', 3 }, MR_OWN, MR_ZERO, NULL,
	    "1 where the edge from that corner on is sharp, else 0" },
	{ "control", "rest", { 'v', 'd', 3 }, MR_OWN, MR_NEEDED, NULL,
	    "positions on which the system is assembled" },
	{ "control", "response", { 'v', 'd', 0 }, MR_OWN, MR_NEEDED, NULL,
	    "what each handle's affine map does, 4 a handle" },
	{ "handles", "transform", { 'v', 'd', 12 }, MR_OWN, MR_NEEDED, NULL,
	    "3x4 affine map, row-major, on the rest position" },
	{ "handles", "turn", { 'v', 'd', 3 }, MR_OWN, MR_NEEDED, NULL,
	    "how it turned there: axis times radians, however many" },
	{ "handles", "frames", { '-', 'u', 1 }, MR_OWN, MR_NEEDED, NULL,
	    "how many deltas of a sequence follow the key" },
	{ "displacement", "height", { 'v', 'd', 1 }, MR_OWN, MR_NEEDED, NULL,
	    "height along the limit normal" },
	{ "displacement", "level", { '-', 'u', 1 }, MR_OWN, MR_NEEDED, NULL, "subdivision level" },
	{ "displacement", "range", { '-', 'd', 2 }, MR_OWN, MR_NEEDED, NULL,
	    "heights of black and of white in their picture" },
	{ NULL, NULL, { 0, 0, 0 }, MR_OWN, MR_NEEDED, NULL, NULL },
};

const mr_column_info *
mr_column_of(const char *layer, const char *name)
{
	for (const mr_column_info *c = mr_columns; c->name; c++)
		if ((!c->layer || !strcmp(c->layer, layer)) && !strcmp(c->name, name))
			return c;
	return NULL;
}

bool
mr_column_known(const char *layer, const char *name)
{
	return mr_column_of(layer, name) != NULL;
}

bool
mr_column_of_surfaces(const char *name)
{
	return mr_column_of("mesh", name) || mr_column_of("base", name) || mr_column_of("control", name);
}

bool
mr_column_carried(const mr_column *c, const char *layer)
{
	if (strcmp(c->layer, layer) || c->shape.element != 'v' || c->shape.type == 't')
		return false;
	return !strcmp(c->name, "color") ||
	       !(mr_column_of(layer, c->name) || mr_column_of("displacement", c->name) ||
		   mr_column_of("mesh", c->name));
}

mr_missing
mr_column_missing(const mr_column *c)
{
	const mr_column_info *info = mr_column_of(c->layer, c->name);

	return info ? info->missing : c->shape.type == 'd' ? MR_NAN : MR_NEEDED;
}

/* Of a column that is none by convention: labels, where it has other than doubles, or doubles, one a row, all
 * of which are whole or missing (not finite), as a file's int is and, of some programs, its float. */
static mr_attribute
kind_of(const mr_column *c)
{
	const mr_column_info *info = mr_column_of(c->layer, c->name);
	const double *x = c->data;
	size_t known = 0;

	if (info)
		return info->kind;
	if (c->shape.type == 'd' && c->shape.components > 1)
		return MR_MEAN;
	for (size_t i = 0; c->shape.type == 'd' && i < c->rows; i++) {
		if (isfinite(x[i]) && x[i] != floor(x[i]))
			return MR_MEAN;
		known += isfinite(x[i]) ? 1 : 0;
	}
	return known || c->shape.type != 'd' ? MR_LABEL : MR_MEAN;
}

/* ---- rows ---- */

typedef struct job {
	const mr_carried *c;
	size_t parts, first;
	mr_rows_from r;
} job;

static double
value_at(const mr_carried *c, size_t at)
{
	return c->shape.type == 'd' ? ((const double *)c->from)[at] : ((const uint8_t *)c->from)[at];
}

/* The mean of equal values is exact.  A corner without a value makes the mean missing. */
static double
mean_of(const mr_carried *c, size_t wide, size_t k, const uint32_t *parent, const double *weight, size_t n)
{
	double first = NAN, sum = 0, all = 0;
	bool differ = false;

	for (size_t i = 0; i < n; i++) {
		double x = value_at(c, parent[i] * wide + k), w = weight ? weight[i] : 1;
		if (w == 0 || (!isfinite(x) && wide == c->shape.components))
			continue;
		first = all > 0 ? first : x;
		differ |= x != first;
		sum += w * x;
		all += w;
	}
	return differ ? sum / all : first;
}

static void
put_mean(const mr_carried *c, size_t wide, size_t row, const uint32_t *parent, const double *weight, size_t n)
{
	for (size_t k = 0; k < wide; k++) {
		double mean = mean_of(c, wide, k, parent, weight, n);
		if (c->shape.type == 'd')
			((double *)c->to)[row * wide + k] = mean;
		else
			((uint8_t *)c->to)[row * wide + k] = (uint8_t)(mean + 0.5);
	}
}

static void
put_direction(const mr_carried *c, size_t row, const uint32_t *parent, const double *weight, size_t n)
{
	const mr_v3 *from = c->from;
	mr_v3 *to = (mr_v3 *)c->to + row, sum = { 0, 0, 0 };
	double length = 0, all = 0;
	size_t parents = 0, last = 0;

	for (size_t i = 0; i < n; i++) {
		double w = weight ? weight[i] : 1;
		if (w == 0)
			continue;
		sum = mr_axpy(w, from[parent[i]], sum);
		length += w * mr_norm(from[parent[i]]);
		all += w;
		parents++;
		last = i;
	}
	if (parents == 1)
		*to = from[parent[last]];
	else
		*to = mr_norm2(sum) > 0 ? mr_mul(length / all / mr_norm(sum), sum) : sum;
}

/* The parent whose row stands for all. */
static uint32_t
heaviest(const uint32_t *parent, const double *weight, size_t n)
{
	size_t best = 0;

	for (size_t i = 1; weight && i < n; i++)
		if (weight[i] > weight[best] || (weight[i] == weight[best] && parent[i] < parent[best]))
			best = i;
	return parent[best];
}

static uint32_t
least(const mr_carried *c, const uint32_t *parent, const double *weight, size_t n)
{
	uint32_t most = UINT32_MAX;

	for (size_t i = 0; i < n; i++) {
		uint32_t x = ((const uint32_t *)c->from)[parent[i]];
		most = (!weight || weight[i] > 0) && x < most ? x : most;
	}
	return most;
}

static void
make_rows(void *arg, size_t begin, size_t end)
{
	const job *j = arg;
	const mr_carried *c = j->c;
	size_t wide = c->shape.components / j->parts, bytes = wide * mr_type_size(c->shape.type);

	for (size_t i = begin; i < end; i++) {
		const uint32_t *parent = j->r.parent + i * j->r.width;
		const double *weight = j->r.weight ? j->r.weight + i * j->r.width : NULL;
		size_t row = j->first + i;
		if (c->kind == MR_MEAN)
			put_mean(c, wide, row, parent, weight, j->r.width);
		else if (c->kind == MR_DIRECTION)
			put_direction(c, row, parent, weight, j->r.width);
		else if (c->kind == MR_LEAST)
			((uint32_t *)c->to)[row] = least(c, parent, weight, j->r.width);
		else
			memcpy((char *)c->to + row * bytes,
			    (const char *)c->from + heaviest(parent, weight, j->r.width) * bytes, bytes);
	}
}

mr_status
mr_carried_begin(mr_ctx *ctx, mr_frame *f, size_t i, size_t before, size_t rows, mr_carried *c)
{
	mr_column *column = &f->columns[i];

	MR_TRY(mr_column_decode(ctx, column));
	if (column->shape.element != '-' && column->rows != before)
		return mr_fail(ctx, MR_ERANGE, "%s: column %s has %llu rows, not %zu", column->layer,
		    column->name, (unsigned long long)column->rows, before);
	*c = (mr_carried){ .shape = column->shape, .kind = kind_of(column), .from = column->data };
	memcpy(c->name, column->name, sizeof c->name);
	c->rows = column->shape.element == '-' ? (size_t)column->rows : rows;
	c->to = mr_alloc(ctx, c->rows * c->shape.components, mr_type_size(c->shape.type));
	if (column->shape.element == '-')
		memcpy(c->to, c->from, c->rows * c->shape.components * mr_type_size(c->shape.type));
	return MR_OK;
}

void
mr_carried_make(const mr_ctx *ctx, const mr_carried *c, size_t parts, size_t first, mr_rows_from r)
{
	enum { GRAIN = 4096 };

	mr_parallel(ctx, r.n, GRAIN, make_rows, &(job){ c, parts, first, r });
}

mr_status
mr_carried_put(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_carried *list, size_t count)
{
	for (const mr_carried *c = list; c < list + count; c++)
		MR_TRY(mr_frame_put(ctx, f, layer, c->name, c->shape, c->to, c->rows));
	return MR_OK;
}

/* ---- all of a layer ---- */

static bool
goes_along(const mr_column *c, const char *layer, const char *const *but)
{
	const mr_column_info *info = mr_column_of(layer, c->name);

	for (; but && *but; but++)
		if (!strcmp(c->name, *but))
			return false;
	return !strcmp(c->layer, layer) && (info ? info->kind >= MR_MEAN : c->shape.element != '-');
}

bool
mr_columns_go_along(const mr_frame *f, const char *layer, const char *const *but)
{
	for (size_t i = 0; i < f->count; i++)
		if (goes_along(&f->columns[i], layer, but))
			return true;
	return false;
}

mr_status
mr_columns_descend(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_descent *d, mr_carried **list, size_t *count)
{
	mr_carried *c = *list = MR_NEW(ctx, f->count, mr_carried);

	for (size_t i = 0; i < f->count; i++) {
		char element = f->columns[i].shape.element;
		bool of_vertices = element == 'v';
		if (!goes_along(&f->columns[i], layer, d->but))
			continue;
		MR_TRY(mr_carried_begin(
		    ctx, f, i, of_vertices ? d->nv : d->nf, of_vertices ? d->to_nv : d->to_nf, c));
		if (element != '-')
			MR_TRY(d->make(d->arg, ctx, c));
		c++;
	}
	*count = (size_t)(c - *list);
	return MR_OK;
}
