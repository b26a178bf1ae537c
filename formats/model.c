/* Models in and out of layers. */
#include "formats/model.h"
#include "formats/build.h"
#include "formats/format.h"
#include "formats/materials.h"
#include "mesh/normals.h"
#include "mesh/subset.h"
#include "mesh/validate.h"
#include "stream/record.h"
#include "tool/tool.h"

#include <float.h>

/* The columns of a model's vertices or faces, besides positions and triangles. */
static const struct {
	const char *name, *what;
	size_t at; /* of the pointer in the model */
	bool of_faces;
} columns[] = {
	{ "normal", "normals", offsetof(mr_model, normal), false },
	{ "scanner", "places of the scanner", offsetof(mr_model, scanner), false },
	{ "color", "colors", offsetof(mr_model, color), false },
	{ "texcoord", "texture coordinates", offsetof(mr_model, texcoord), false },
	{ "corner_texcoord", "texture coordinates of corners", offsetof(mr_model, corner_texcoord), true },
	{ "corner_normal", "normals of corners", offsetof(mr_model, corner_normal), true },
	{ "group", "groups", offsetof(mr_model, group), true },
	{ "object", "objects", offsetof(mr_model, object), true },
	{ "material", "materials", offsetof(mr_model, material), true },
	{ "smoothing", "smoothing groups", offsetof(mr_model, smoothing), true },
	{ "polygon", NULL, offsetof(mr_model, polygon),
	    true }, /* that a format has triangles alone is no news */
};

/* Names, and the column without which they say nothing. */
static const struct {
	const char *name, *of;
	size_t at;
} names[] = {
	{ "groups", "group", offsetof(mr_model, groups) },
	{ "objects", "object", offsetof(mr_model, objects) },
	{ "materials", "material", offsetof(mr_model, materials) },
	{ "mtllib", "mtllib", offsetof(mr_model, mtllib) },
};

static const mr_shape BYTES = { '-', 'b', 1 };

enum { COLUMNS = sizeof columns / sizeof *columns, NAMES = sizeof names / sizeof *names };

static const void *
column_of(const mr_model *m, size_t i)
{
	const void *data;

	memcpy(&data, (const char *)m + columns[i].at, sizeof data);
	return data;
}

static void
set_column(mr_model *m, size_t i, const void *data)
{
	memcpy((char *)m + columns[i].at, &data, sizeof data);
}

static mr_lines *
lines_of(mr_model *m, size_t i)
{
	return (mr_lines *)(void *)((char *)m + names[i].at);
}

const double *
mr_corner_texcoord(const mr_model *m, size_t c)
{
	return m->corner_texcoord ? m->corner_texcoord + 2 * c
	       : m->texcoord      ? m->texcoord + 2 * (size_t)m->t[c / 3].v[c % 3]
	                          : NULL;
}

/* ---- what formats have no place for ---- */

/* Whether the word is in a list with blanks between. */
static bool
is_in(const char *list, const char *word)
{
	size_t n = strlen(word);

	for (; *list; list += strspn(list, " ")) {
		size_t k = strcspn(list, " ");
		if (k == n && !memcmp(list, word, n))
			return true;
		list += k;
	}
	return false;
}

void
mr_note_lost(mr_sink *s, const mr_model *m, const char *keeps)
{
	size_t clear = 0;

	for (size_t i = 0; i < COLUMNS; i++)
		if (columns[i].what && column_of(m, i) && !is_in(keeps, columns[i].name)) {
			size_t each = strncmp(columns[i].name, "corner_", 7) ? 1 : 3;
			mr_lost(s->ctx, NULL, columns[i].of_faces ? each * m->nf : m->nv, columns[i].what);
		}
	if (!is_in(keeps, "property"))
		mr_lost(s->ctx, NULL, m->properties, "properties");
	if (!is_in(keeps, "faces"))
		mr_lost(s->ctx, NULL, m->nf, "faces");
	for (size_t i = 0; m->color && i < m->nv; i++)
		clear += m->color[4 * i + 3] < 255;
	if (is_in(keeps, "color") && !is_in(keeps, "alpha"))
		mr_lost(s->ctx, NULL, clear, "alpha");
}

/* ---- attributes follow their vertices and faces ---- */

static void
drop_faces(mr_model *m)
{
	size_t kept = 0;

	m->t = NULL;
	m->nf = 0;
	for (size_t i = 0; i < COLUMNS; i++)
		if (columns[i].of_faces)
			set_column(m, i, NULL);
	for (size_t i = 0; i < NAMES; i++)
		*lines_of(m, i) = (mr_lines){ 0 };
	while (kept < m->properties && m->property[kept].shape.element == 'v')
		kept++;
	m->files = 0;
	m->properties = kept; /* columns of vertices come first */
}

/* ---- layers ---- */

/* A name that a column can have: printable, cut where it is too long. */
static void
column_name(char to[MR_COLUMN_MAX + 1], const char *prefix, const char *name)
{
	snprintf(to, MR_COLUMN_MAX + 1, "%s%.*s", prefix, (int)(MR_COLUMN_MAX - strlen(prefix)), name);
	for (char *c = to; *c; c++)
		if (*c <= ' ' || *c > '~')
			*c = '_';
}

/* Whether the name is free: no column or part of one has it, in this layer or by convention in a
 * surface's. */
static bool
is_free(const mr_frame *f, const char *layer, const char *name, char element)
{
	return *name && mr_name_valid(name, MR_COLUMN_MAX) && !mr_column_known(layer, name) &&
	       !mr_column_of_surfaces(name) && !mr_layer_has(f, layer, name) &&
	       (element == 'f' || !mr_role_of(name, strlen(name)));
}

/* The properties as columns, under their own names or similar ones. */
static mr_status
put_properties(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_model *m)
{
	for (size_t k = 0; k < m->properties; k++) {
		const mr_property *p = &m->property[k];
		char element = p->shape.element, name[MR_COLUMN_MAX + 1];
		column_name(name, "", p->name);
		if (!is_free(f, layer, name, element))
			column_name(name, "ply_", p->name);
		if (is_free(f, layer, name, element))
			MR_TRY(mr_frame_put(
			    ctx, f, layer, name, p->shape, p->data, element == 'f' ? m->nf : m->nv));
		else
			mr_tell(ctx, MR_LOST, 1, "property %s", p->name);
	}
	return MR_OK;
}

mr_status
mr_model_put(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_model *m)
{
	mr_mesh mesh = { .p = m->p, .t = m->t, .nv = m->nv, .nf = m->nf };
	mr_model all = *m;

	if (!layer)
		layer = m->nf ? "mesh" : "points";
	mesh.name = layer;
	if (m->nf)
		MR_TRY(mr_layer_put_mesh(ctx, f, layer, &mesh));
	else
		MR_TRY(mr_layer_put(ctx, f, layer, "position", m->p, m->nv));
	for (size_t i = 0; i < COLUMNS; i++)
		if (column_of(m, i))
			MR_TRY(mr_layer_put(ctx, f, layer, columns[i].name, column_of(m, i),
			    columns[i].of_faces ? m->nf : m->nv));
	for (size_t i = 0; i < NAMES; i++)
		if (lines_of(&all, i)->text)
			MR_TRY(mr_layer_put(
			    ctx, f, layer, names[i].name, lines_of(&all, i)->text, lines_of(&all, i)->bytes));
	for (size_t i = 0; i < m->files; i++)
		MR_TRY(mr_frame_put(ctx, f, "", m->file[i].name, BYTES, m->file[i].data, m->file[i].size));
	return put_properties(ctx, f, layer, m);
}

/* The files that came with the models of the frame. */
static mr_status
get_files(mr_ctx *ctx, mr_frame *f, mr_model *m)
{
	mr_file *file = MR_NEW(ctx, f->count, mr_file);
	const void *data;

	for (size_t i = 0; i < f->count; i++) {
		const mr_column *c = &f->columns[i];
		if (!mr_column_is_file(c))
			continue;
		file[m->files].name = c->name;
		MR_TRY(mr_frame_get(ctx, f, "", c->name, BYTES, &data, &file[m->files].size));
		file[m->files++].data = data;
	}
	m->file = file;
	return MR_OK;
}

/* The name of a column in files: as it was before put_properties gave it a similar name. */
static const char *
name_of(const char *column)
{
	const char *name = column + (strncmp(column, "ply_", 4) ? 0 : 4);
	mr_role role = mr_role_of(name, strlen(name));

	return role == MR_X || role == MR_Y || role == MR_Z ? column : name;
}

static bool
is_property(const mr_column *c, const char *layer, char element)
{
	return !strcmp(c->layer, layer) && c->shape.element == element && c->shape.components == 1 &&
	       c->shape.type != 't' && !mr_column_known(layer, c->name);
}

/* The columns of one component that are none by convention; vertices' first. */
static mr_status
get_properties(mr_ctx *ctx, mr_frame *f, const char *layer, mr_model *m)
{
	mr_property *property = MR_NEW(ctx, f->count, mr_property);
	const void *data;
	size_t n = 0, rows;

	for (int faces = 0; faces < 2; faces++)
		for (size_t i = 0; i < f->count; i++) {
			const mr_column *c = &f->columns[i];
			if (!is_property(c, layer, faces ? 'f' : 'v'))
				continue;
			MR_TRY(mr_frame_get(ctx, f, layer, c->name, c->shape, &data, &rows));
			if (rows != (faces ? m->nf : m->nv))
				return mr_fail(ctx, MR_ERANGE, "%s: column %s has %zu rows, not %zu", layer,
				    c->name, rows, faces ? m->nf : m->nv);
			property[n++] = (mr_property){ name_of(c->name), c->shape, data };
		}
	m->property = property;
	m->properties = n;
	return MR_OK;
}

mr_status
mr_model_get(mr_ctx *ctx, mr_frame *f, const char *layer, mr_model *m)
{
	mr_model got = { 0 };
	const void *data;
	mr_mesh mesh;

	if (mr_layer_has(f, layer, "triangles"))
		MR_TRY(mr_layer_mesh_of_any_size(ctx, f, layer, &mesh));
	else
		MR_TRY(mr_layer_points_of_any_size(ctx, f, layer, &mesh));
	got.p = mesh.p, got.nv = mesh.nv;
	got.t = mesh.t, got.nf = mesh.nf;
	for (size_t i = 0; i < COLUMNS; i++) {
		if (!mr_layer_has(f, layer, columns[i].name) || (columns[i].of_faces && !mesh.nf))
			continue;
		MR_TRY(mr_layer_get_rows(
		    ctx, f, layer, columns[i].name, columns[i].of_faces ? mesh.nf : mesh.nv, &data));
		MR_TRY(mr_check_finite(ctx, mr_frame_find(f, layer, columns[i].name)));
		set_column(&got, i, data);
	}
	for (size_t i = 0; i < NAMES; i++) {
		mr_lines *l = lines_of(&got, i);
		*l = (mr_lines){ "", 0 };
		if (!mr_layer_has(f, layer, names[i].of) || !mr_layer_has(f, layer, names[i].name))
			continue;
		MR_TRY(mr_layer_get(ctx, f, layer, names[i].name, &data, &l->bytes));
		l->text = data;
	}
	MR_TRY(get_properties(ctx, f, layer, &got));
	MR_TRY(get_files(ctx, f, &got));
	*m = got;
	return MR_OK;
}

/* Frames */

/* Whether all positions are floats, and not all of them multiples of 16 times their grain there, as whole
 * numbers may be. */
static bool
are_rounded_floats(const mr_v3 *p, size_t n, double grain)
{
	const double step = 16 * grain;
	bool coarse = true;

	for (size_t i = 0; i < n; i++) {
		const double x[3] = { p[i].x, p[i].y, p[i].z };
		for (int k = 0; k < 3; k++) {
			if (mr_as_float(x[k]) != x[k])
				return false;
			coarse &= x[k] == step * rint(x[k] / step);
		}
	}
	return !coarse;
}

/* Far from the origin doubles are too coarse for a model that is small there, whatever the file said, and
 * long before them the floats that most files have. */
static void
judge_grain(mr_ctx *ctx, const mr_model *m, mr_box box)
{
	const double fine = 1e-7;  /* of the diagonal, as numbers in float32 have */
	const double rough = 1e-4; /* of which an edge may have a hundred: a tenth of one is some faces */
	double grain = mr_box_grain(box), diagonal = mr_box_diagonal(box);
	double of_floats = ldexp(grain, DBL_MANT_DIG - FLT_MANT_DIG);
	bool floats = diagonal > 0 && of_floats > rough * diagonal &&
	              are_rounded_floats(m->p, m->nv, of_floats);

	if (floats || (mr_box_largest(box) > diagonal && grain > fine * diagonal && diagonal > 0))
		mr_coarse(ctx, m->nv, m->nv, (floats ? of_floats : grain) / diagonal);
}

/* Leaves out the vertices without a place, and their faces. */
static mr_status
keep_placed(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_model *m)
{
	const mr_mesh all = { .name = layer, .p = m->p, .t = m->t, .nv = m->nv, .nf = m->nf };
	mr_subset kept;
	size_t gone = 0;

	if (!m->placed)
		return MR_OK;
	for (size_t i = 0; i < m->nv; i++)
		gone += !m->placed[i];
	mr_lost(ctx, NULL, gone, "points without a place");
	MR_TRY(mr_subset_find(ctx, f, &all, m->placed, &kept));
	mr_lost(ctx, NULL, m->nf - kept.nf, "faces at them");
	if (m->nf && kept.nf == 0)
		return mr_fail(ctx, MR_EMESH, "none of %zu faces has a place", m->nf);
	return mr_layer_keep(ctx, f, layer, &kept);
}

static mr_status
import(mr_ctx *ctx, const char *path, const mr_import_opts *o, mr_frame **frame, mr_import_result *result)
{
	const char *name = mr_format_stem(ctx, path), *layer;
	double unit;
	mr_frame *f;
	mr_model m;
	mr_box box;

	MR_TRY(mr_model_read(ctx, path, o->format, &m));
	if (o->points) {
		mr_lost(ctx, NULL, m.corner_normal ? 3 * m.nf : 0, "normals of corners");
		mr_lost(ctx, NULL, m.corner_texcoord ? 3 * m.nf : 0, "texture coordinates of corners");
		drop_faces(&m);
	}
	box = mr_mesh_box(&(mr_mesh){ .p = m.p, .nv = m.nv, .t = m.t, .nf = m.nf });
	judge_grain(ctx, &m, box);
	unit = o->weld_relative ? mr_box_diagonal(box) : 1;
	layer = o->layer ? o->layer : m.nf ? "mesh" : "points";
	MR_TRY(mr_frame_new(ctx, name, &f));
	MR_TRY(mr_prefix(ctx, mr_model_put(ctx, f, layer, &m), "%s", path));
	MR_TRY(mr_prefix(ctx, keep_placed(ctx, f, layer, &m), "%s", path));
	MR_TRY(mr_prefix(ctx, mr_layer_mend(ctx, f, layer, o, unit), "%s", path));
	*frame = f;
	if (m.files == 0)
		mr_libraries_missing(ctx, path, m.mtllib);
	m.counts.vertices = mr_frame_find(f, layer, "position")->rows;
	m.counts.triangles = m.nf ? mr_frame_find(f, layer, "triangles")->rows : 0;
	if (result)
		*result = m.counts;
	return MR_OK;
}

mr_status
mr_import(
    mr_ctx *ctx, const char *path, const mr_import_opts *opts, mr_frame **frame, mr_import_result *result)
{

	MR_ENTER(ctx);
	return import(ctx, path, opts ? opts : &(mr_import_opts)MR_IMPORT_DEFAULTS, frame, result);
}

/* Whether a column of mesh is one that models have, other than places and triangles. */
static bool
is_of_model(const mr_column *c)
{
	bool is = is_property(c, "mesh", c->shape.element);

	for (size_t i = 0; i < COLUMNS && !strcmp(c->layer, "mesh"); i++)
		is |= !strcmp(c->name, columns[i].name);
	for (size_t i = 0; i < NAMES && !strcmp(c->layer, "mesh"); i++)
		is |= !strcmp(c->name, names[i].name);
	return is;
}

/* Columns that mesh has and this layer of the same triangles lacks; normals turn with the surface. */
static mr_status
borrow(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_mesh *before, const mr_mesh *now)
{
	bool normals = mr_layer_has(f, layer, "normal") || mr_layer_has(f, layer, "corner_normal");
	mr_v3 *own[2] = { NULL, NULL };

	for (size_t i = 0, n = f->count; i < n; i++) {
		mr_column c = f->columns[i];
		bool normal = !strcmp(c.name, "normal"), turns = normal || !strcmp(c.name, "corner_normal");
		if (!is_of_model(&c) || mr_layer_has(f, layer, c.name) || (turns && normals))
			continue;
		MR_TRY(mr_column_decode(ctx, &c));
		if (turns) {
			size_t bytes = (size_t)c.rows * c.shape.components * sizeof(double);
			c.data = own[!normal] = memcpy(mr_alloc(ctx, bytes, 1), c.data, bytes);
		}
		MR_TRY(mr_frame_put(ctx, f, layer, c.name, c.shape, c.data, (size_t)c.rows));
	}
	if (own[0] || own[1])
		mr_turn_normals(ctx, before, now->p, own[0], own[1]);
	return MR_OK;
}

/* Columns that mesh has and the layer, of other triangles, lacks, except polygons. */
static void
lose_rest(mr_ctx *ctx, const mr_frame *f, const char *layer)
{
	for (const mr_column *c = f->columns; c < f->columns + f->count; c++)
		if (is_of_model(c) && c->shape.type != 't' && strcmp(c->name, "polygon") &&
		    !mr_layer_has(f, layer, c->name))
			mr_lost(ctx, "mesh", (size_t)c->rows, c->name);
}

mr_status
mr_model_complete(mr_ctx *ctx, mr_frame *f, const char *layer, mr_model *m)
{
	mr_mesh mesh, now;
	mr_frame own;

	MR_TRY(mr_model_get(ctx, f, layer, m));
	if (!strcmp(layer, "mesh") || m->nf == 0 || !mr_layer_has(f, "mesh", "triangles"))
		return MR_OK;
	MR_TRY(mr_layer_mesh_of_any_size(ctx, f, "mesh", &mesh));
	MR_TRY(mr_layer_mesh_of_any_size(ctx, f, layer, &now));
	if (mr_same_triangles(&mesh, &now)) {
		mr_frame_copy(ctx, f, &own);
		MR_TRY(borrow(ctx, &own, layer, &mesh, &now));
		return mr_model_get(ctx, &own, layer, m);
	}
	if (f->key)
		lose_rest(ctx, f, layer);
	return MR_OK;
}

mr_status
mr_export_held(
    mr_ctx *ctx, mr_frame *f, const char *layer, const char *path, const char *format, mr_outfile *held)
{
	mr_model m;

	MR_TRY(mr_layer_result(ctx, f, layer, &layer));
	MR_TRY(mr_model_complete(ctx, f, layer, &m));
	return mr_model_write(ctx, path, format, &m, held);
}

mr_status
mr_export(mr_ctx *ctx, mr_frame *f, const char *layer, const char *path, const char *format)
{
	bool binary;

	MR_ENTER(ctx);
	MR_TRY(mr_format_check(ctx, path, format, true, &binary));
	return mr_export_held(ctx, f, layer, path, format, NULL);
}
