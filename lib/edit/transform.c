/* Frames under affine maps p -> L p + t: positions are mapped, normals by L^-T, lengths scaled; a map that
 * mirrors turns the faces over, by their first two corners. */
#include "edit/transform.h"

#include "base/rotation.h"
#include "base/text_file.h"
#include "edit/handles.h"
#include "subdivide/displaced.h"

#include <ctype.h>
#include <unistd.h>

/* ---- steps ---- */

typedef enum step_kind { MAP, CENTER, UNIT } step_kind;

typedef struct mr_transform_step {
	step_kind kind;
	mr_affine map;
} step;

static void
add_step(mr_ctx *ctx, mr_transform *t, step_kind kind, const mr_affine *map)
{
	MR_RESERVE(ctx, t->step, t->n, 1, &t->room);
	t->step[t->n++] = (step){ kind, *map };
}

/* "-y": the axis, and its sign; false where it is none. */
static bool
read_axis(const char **text, int *axis, int *sign)
{
	*sign = **text == '-' ? -1 : 1;
	*text += **text == '-' || **text == '+';
	if (**text < 'x' || **text > 'z')
		return false;
	*axis = *(*text)++ - 'x';
	return true;
}

/* The rotation, of whole numbers, that turns one axis to another by a quarter or half a turn. */
static mr_status
parse_up(mr_ctx *ctx, const char *text, mr_affine *map)
{
	int from, to, sign_from, sign_to, sign;
	const char *at = text;
	mr_affine r = mr_identity();

	if (!read_axis(&at, &from, &sign_from) || *at++ != ':' || !read_axis(&at, &to, &sign_to) || *at)
		return mr_fail(ctx, MR_EUSAGE, "'%s' is not two axes, of x, y, z, -x, -y, -z, as y:z", text);
	sign = sign_from * sign_to;
	if (from == to) {
		r.m[5 * from] = sign;
		r.m[5 * ((from + 1) % 3)] = sign;
	} else {
		r.m[5 * from] = r.m[5 * to] = 0;
		r.m[4 * to + from] = sign;
		r.m[4 * from + to] = -sign;
	}
	*map = r;
	return MR_OK;
}

/* All numbers of a text, with commas or blanks between them; false where there is something else. */
static bool
read_numbers(const char *at, double *x, size_t most, size_t *n)
{
	for (;;) {
		while (isspace((unsigned char)*at) || *at == ',')
			at++;
		if (!*at)
			return true;
		if (*n == most || !mr_numbers(&at, 1, &x[(*n)++]))
			return false;
	}
}

/* Infinite entries are reported with the positions. */
static mr_status
check_inverse(mr_ctx *ctx, const mr_affine *map)
{
	mr_mat3 l = mr_affine_linear(map);
	double det = mr_mat3_determinant(&l);

	if (det == 0 || isinf(1 / det))
		return mr_fail(ctx, MR_EUSAGE, "the matrix has no inverse: its determinant is %g", det);
	return MR_OK;
}

static mr_status
parse_matrix(mr_ctx *ctx, const char *text, mr_affine *map)
{
	double x[16];
	size_t n = 0, lines;
	char **line;

	if (!read_numbers(text, x, 16, &n)) {
		if (strchr(text, ',') && access(text, F_OK))
			return mr_fail(
			    ctx, MR_EUSAGE, "'%.100s' is neither 12 or 16 numbers nor a file", text);
		MR_TRY(mr_lines_read(ctx, text, &line, &lines));
		n = 0;
		for (size_t i = 0; i < lines; i++)
			if (!read_numbers(line[i], x, 16, &n))
				return mr_fail(ctx, MR_EFORMAT,
				    "%s:%zu: '%.40s' is not numbers, of which a matrix has 16", text, i + 1,
				    line[i]);
	}
	if (n != 12 && n != 16)
		return mr_fail(ctx, MR_EUSAGE, "'%s' has %zu numbers, where a matrix has 12 or 16", text, n);
	if (n == 16 && (x[12] != 0 || x[13] != 0 || x[14] != 0 || x[15] != 1))
		return mr_fail(ctx, MR_EUSAGE, "the last row is %g %g %g %g, where an affine map has 0 0 0 1",
		    x[12], x[13], x[14], x[15]);
	memcpy(map->m, x, sizeof map->m);
	return check_inverse(ctx, map);
}

mr_status
mr_transform_add(mr_ctx *ctx, mr_transform *t, const char *what, const char *text)
{
	mr_pose pose = MR_POSE_REST;
	mr_affine map = mr_identity();

	if (!strcmp(what, "center")) {
		add_step(ctx, t, CENTER, &map);
		return MR_OK;
	}
	if (!strcmp(what, "unit")) {
		add_step(ctx, t, UNIT, &map);
		return MR_OK;
	}
	if (!strcmp(what, "up")) {
		MR_TRY(parse_up(ctx, text, &map));
	} else if (!strcmp(what, "matrix")) {
		MR_TRY(parse_matrix(ctx, text, &map));
	} else {
		MR_TRY(mr_pose_set(ctx, &pose, what, text));
		if (pose.scale.x == 0 || pose.scale.y == 0 || pose.scale.z == 0)
			return mr_fail(ctx, MR_EUSAGE, "a scale of 0 leaves nothing: %s", text);
		map = mr_pose_map(&pose, mr_vec(0, 0, 0), 1);
	}
	add_step(ctx, t, MAP, &map);
	return MR_OK;
}

/* ---- boxes ---- */

static bool
is_position(const mr_column *c, const char *layer)
{
	return *c->layer && !strcmp(c->name, "position") && (!layer || !strcmp(layer, c->layer));
}

static mr_status
find_box(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_affine *map, mr_box *box)
{
	mr_mesh m;

	*box = mr_box_empty();
	for (size_t i = 0; i < f->count; i++)
		if (is_position(&f->columns[i], layer)) {
			MR_TRY(mr_layer_surface_or_points_of_any_size(ctx, f, f->columns[i].layer, &m));
			for (size_t k = 0; k < mr_mesh_places(&m); k++)
				mr_box_add(box, mr_apply(map, mr_mesh_place(&m, k)));
		}
	if (box->min.x > box->max.x)
		return mr_fail(ctx, MR_EMISSING, "no layer has positions that a box could be around");
	return MR_OK;
}

static mr_status
box_map(mr_ctx *ctx, mr_frame *f, const char *layer, step_kind kind, const mr_affine *so_far, mr_affine *map)
{
	mr_v3 middle, size;
	double longest, s = 1;
	mr_box box;

	MR_TRY(find_box(ctx, f, layer, so_far, &box));
	size = mr_sub(box.max, box.min);
	middle = mr_lerp(0.5, box.min, box.max);
	longest = fmax(size.x, fmax(size.y, size.z));
	if (kind == UNIT && longest > 0)
		s = 1 / longest;
	*map = (mr_affine){ { s, 0, 0, -s * middle.x, 0, s, 0, -s * middle.y, 0, 0, s, -s * middle.z } };
	return MR_OK;
}

mr_status
mr_transform_map(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_transform *t, mr_affine *map)
{
	mr_affine all = mr_identity();

	for (size_t i = 0; i < t->n; i++) {
		mr_affine one = t->step[i].map;
		if (t->step[i].kind != MAP)
			MR_TRY(box_map(ctx, f, layer, t->step[i].kind, &all, &one));
		all = mr_compose(&one, &all);
	}
	*map = all;
	return MR_OK;
}

/* cbrt's last bit is not always right, and powers of two are to round nothing: a step of Newton's. */
static double
cube_root(double x)
{
	double s = cbrt(x);

	return s > 0 ? s - (s * s * s - x) / (3 * s * s) : s;
}

/* ---- columns ---- */

typedef struct change {
	mr_affine map;
	mr_mat3 linear, normal; /* L, L^-T */
	double scale;           /* of lengths; 0: it depends on the direction */
	bool mirrors;
} change;

static change
change_of(const mr_affine *map)
{
	change c = { .map = *map, .linear = mr_affine_linear(map) };
	mr_mat3 square = mr_mat3_multiply_transposed(&c.linear, &c.linear);
	double det = mr_mat3_determinant(&c.linear), s = cube_root(fabs(det)), off = 0;

	c.mirrors = det < 0;
	c.normal = mr_mat3_inverse_transposed(&c.linear);
	for (int i = 0; i < 9; i++)
		off = fmax(off, fabs(square.m[i] - (i % 4 == 0 ? s * s : 0)));
	c.scale = off <= 1e-9 * s * s ? s : 0;
	return c;
}

/* A copy of the rows of a column, to be changed. */
static mr_status
copy_rows(mr_ctx *ctx, mr_column *column, void *copy)
{
	size_t width = mr_type_size(column->shape.type) * column->shape.components;
	void *x = mr_alloc(ctx, (size_t)column->rows, width);

	MR_TRY(mr_column_decode(ctx, column));
	memcpy(x, column->data, (size_t)column->rows * width);
	*(void **)copy = x;
	return MR_OK;
}

static mr_v3
turn_normal(const change *c, mr_v3 n)
{
	double length = mr_norm(n);
	mr_v3 turned = mr_mat3_apply(&c->normal, n);

	return length > 0 ? mr_mul(length / mr_norm(turned), turned) : n;
}

/* The kind of a column that changes. */
typedef enum column_sort {
	OTHER,
	POSITIONS,
	NORMALS,
	LENGTHS,
	SAMPLES, /* the first number of a row is a length; of one number it is that */
	OFFSETS, /* in the frames of faces, whose first axis a mirror turns round */
	CORNERS, /* three parts of a row, for the corners of a face */
	EDGES    /* for its edges, the first from the first corner to the second */
} column_sort;

/* Columns of one layer alone, by the width of their rows. */
static column_sort
sort_of_own(const mr_column *c)
{
	if (c->shape.type != 'd')
		return !strcmp(c->name, "triangles") ? CORNERS : !strcmp(c->name, "crease") ? EDGES : OTHER;
	if (c->shape.components < 3)
		return LENGTHS;
	return !strcmp(c->name, "detail_offset") ? OFFSETS : POSITIONS;
}

static column_sort
sort_of(const mr_column *c)
{
	const mr_column_info *is = *c->layer ? mr_column_of(c->layer, c->name) : NULL;

	if (!is || is->shape.element != c->shape.element || is->shape.type != c->shape.type ||
	    (is->shape.components && is->shape.components != c->shape.components))
		return OTHER;
	switch (is->kind) {
	case MR_OWN:
		return sort_of_own(c);
	case MR_SAMPLED:
		return c->shape.type == 'd' ? SAMPLES : OTHER;
	case MR_DIRECTION:
		return NORMALS;
	case MR_PLACE:
		return CORNERS;
	default:
		return !strcmp(c->name, "corner_texcoord") ? CORNERS : OTHER;
	}
}

static void
swap(void *a, void *b, size_t size)
{
	char kept[3 * sizeof(double)];

	memcpy(kept, a, size);
	memcpy(a, b, size);
	memcpy(b, kept, size);
}

/* n values of a column of doubles in rows of `components`. */
static void
map_values(const change *c, column_sort sort, double *x, size_t rows, size_t components)
{
	size_t n = rows * components;
	mr_v3 *p = (mr_v3 *)x;

	for (size_t i = 0; sort == POSITIONS && i < n / 3; i++)
		p[i] = mr_apply(&c->map, p[i]);
	for (size_t i = 0; sort == NORMALS && i < n / 3; i++)
		p[i] = turn_normal(c, p[i]);
	for (size_t i = 0; sort == OFFSETS && i < n / 3; i++)
		p[i] = mr_mul(c->scale, mr_vec(c->mirrors ? -p[i].x : p[i].x, p[i].y, p[i].z));
	for (size_t i = 0; (sort == LENGTHS || sort == SAMPLES) && i < n;
	     i += sort == LENGTHS ? 1 : components)
		x[i] *= c->scale;
}

static mr_status
map_column(mr_ctx *ctx, mr_frame *f, mr_column *column, const change *c, column_sort sort)
{
	size_t rows = (size_t)column->rows, components = column->shape.components;
	size_t part = mr_type_size(column->shape.type) * components / 3;
	bool corners = sort == CORNERS || (sort == NORMALS && column->shape.element == 'f');
	void *x;

	if (sort == OTHER || ((sort == CORNERS || sort == EDGES) && !c->mirrors))
		return MR_OK;
	MR_TRY(copy_rows(ctx, column, &x));
	/* the first two of the three parts of each row change places, where faces are turned over */
	for (size_t i = 0; corners && c->mirrors && i < rows; i++)
		swap((char *)x + 3 * i * part, (char *)x + (3 * i + 1) * part, part);
	for (size_t i = 0; sort == EDGES && i < rows; i++)
		swap((char *)x + 3 * i + 1, (char *)x + 3 * i + 2, 1);
	if (column->shape.type == 'd')
		map_values(c, sort, x, rows, components);
	for (size_t i = 0; sort == POSITIONS && i < rows; i++)
		if (!mr_finite(((const mr_v3 *)x)[i]))
			return mr_fail(ctx, MR_ERANGE, "%s: %s %zu is %s", column->layer, column->name, i,
			    mr_finite(((const mr_v3 *)column->data)[i]) ? "mapped to infinity"
									: "not finite");
	return mr_frame_put(ctx, f, column->layer, column->name, column->shape, x, rows);
}

/* ---- frames ---- */

/* MR_EMESH where a column cannot follow the map. */
static mr_status
check(mr_ctx *ctx, const mr_frame *f, const char *layer, const change *c)
{
	for (const mr_column *column = f->columns; column < f->columns + f->count; column++) {
		column_sort sort = sort_of(
		    column); /* lengths follow only what scales alike in every direction */
		if ((layer && strcmp(layer, column->layer)) || (sort != LENGTHS && sort != OFFSETS))
			continue;
		if (c->scale == 0)
			return mr_fail(ctx, MR_EMESH,
			    "%s: %s cannot be stretched in one direction more than in another: the mesh "
			    "alone can",
			    column->layer, column->name);
		if (c->mirrors && !strcmp(column->layer, "displacement"))
			return mr_fail(ctx, MR_EMESH,
			    "displacement: %s follows the faces of control, which a mirror turns over: the "
			    "mesh alone can be mirrored",
			    column->name);
	}
	return MR_OK;
}

/* A layer that goes alone is no more where the others have it. */
static void
cut_loose(mr_ctx *ctx, mr_frame *f, const char *layer)
{
	size_t before = f->count;

	mr_layer_renumbered(f, layer);
	for (const mr_column_info *c = mr_columns; c->name; c++)
		if ((c->refers || !strcmp(c->name, "encoded")) && (!c->layer || !strcmp(c->layer, layer)))
			mr_frame_drop(f, layer, c->name, 0);
	if (f->count < before)
		mr_found(ctx, &(mr_finding){
				  .kind = MR_STALE, .layer = layer, .what = "what tied it to other layers" });
}

static mr_status
transform(mr_ctx *ctx, mr_frame *f, const char *layer, const double map[12])
{
	mr_affine t;
	change c;

	memcpy(t.m, map, sizeof t.m);
	MR_TRY(check_inverse(ctx, &t));
	c = change_of(&t);
	if (layer && !mr_frame_has_layer(f, layer))
		return mr_layer_missing(ctx, f, layer, layer);
	if (mr_layer_has(f, "handles", "transform")) /* whose maps are of where they are */
		return mr_advise(ctx, MR_SOLVE_FIRST, mr_fail(ctx, MR_EMESH, "handles are posed"));
	if (layer)
		cut_loose(ctx, f, layer);
	for (size_t i = 0; i < 2; i++)
		mr_frame_drop(f, i ? "base" : "control", "response", 0);
	MR_TRY(check(ctx, f, layer, &c));
	for (size_t i = f->count; i-- > 0;) {
		mr_column *column = &f->columns[i];
		column_sort sort = sort_of(column);
		if (layer && strcmp(layer, column->layer))
			continue;
		if (!(c.scale > 0) && sort == SAMPLES) {
			char of[MR_LAYER_MAX + 1];
			memcpy(of, column->layer, sizeof of);
			mr_frame_drop(f, of, column->name, 0);
		} else {
			MR_TRY(map_column(ctx, f, column, &c, sort));
		}
	}
	return MR_OK;
}

mr_status
mr_transform_frame(mr_ctx *ctx, mr_frame *f, const char *layer, const double map[12])
{
	MR_ON_COPY(ctx, f, done, NULL, done, transform(ctx, &done, layer, map));
}
