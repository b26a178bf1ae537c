/* Welding and repair with all attributes, and models in and out of layers. */
#include "formats/model.h"
#include "mesh/repair.h"

/* What a model has of each vertex, or of each face, besides positions and triangles. */
static const struct {
	const char *name;
	size_t at, bytes; /* of the pointer in the model; of a row */
	bool of_faces;
} columns[] = {
	{ "normal", offsetof(mr_model, normal), sizeof(mr_v3), false },
	{ "color", offsetof(mr_model, color), 4, false },
	{ "texcoord", offsetof(mr_model, texcoord), 2 * sizeof(double), false },
	{ "corner_texcoord", offsetof(mr_model, corner_texcoord), 6 * sizeof(double), true },
	{ "corner_normal", offsetof(mr_model, corner_normal), 3 * sizeof(mr_v3), true },
	{ "group", offsetof(mr_model, group), sizeof(uint32_t), true },
	{ "object", offsetof(mr_model, object), sizeof(uint32_t), true },
	{ "material", offsetof(mr_model, material), sizeof(uint32_t), true },
	{ "smoothing", offsetof(mr_model, smoothing), sizeof(uint32_t), true },
	{ "polygon", offsetof(mr_model, polygon), sizeof(uint32_t), true },
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

/* ---- attributes follow their vertices and faces ---- */

/* new[i] = old[of[i]], for rows of `size` bytes; NULL stays NULL. */
static mr_status
gather(mr_ctx *ctx, const void **column, size_t size, const uint32_t *of, size_t n)
{
	const char *old = *column;
	char *new;

	if (!old)
		return MR_OK;
	new = mr_alloc(ctx, n, size);
	if (!new)
		return MR_EMEM;
	for (size_t i = 0; i < n; i++)
		memcpy(new + i *size, old + of[i] * size, size);
	*column = new;
	return MR_OK;
}

/* All that the model has of vertices, or of faces, for those that are left: row i is that of of[i]. */
static mr_status
gather_rows(mr_ctx *ctx, mr_model *m, bool of_faces, const uint32_t *of, size_t n)
{
	mr_property *property = MR_NEW(ctx, m->properties, mr_property);

	if (!property)
		return MR_EMEM;
	for (size_t i = 0; i < COLUMNS; i++) {
		const void *data = column_of(m, i);
		if (columns[i].of_faces != of_faces)
			continue;
		MR_TRY(gather(ctx, &data, columns[i].bytes, of, n));
		set_column(m, i, data);
	}
	for (size_t i = 0; i < m->properties; i++) {
		property[i] = m->property[i];
		if ((property[i].shape.element == 'f') == of_faces)
			MR_TRY(gather(ctx, &property[i].data, mr_type_size(property[i].shape.type), of, n));
	}
	m->property = property;
	return MR_OK;
}

void
mr_model_to_points(mr_model *m)
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
	m->properties = kept; /* those of vertices come first */
}

/* ---- weld ---- */

static bool
proper(mr_tri t)
{
	return t.v[0] != t.v[1] && t.v[1] != t.v[2] && t.v[2] != t.v[0];
}

/* Faces by their new vertices, without those that had three corners and have not now. */
static mr_status
rename_faces(mr_ctx *ctx, const uint32_t *map, mr_model *m)
{
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);
	uint32_t *of = MR_NEW(ctx, m->nf, uint32_t);
	size_t kept = 0;

	if (!t || !of)
		return MR_EMEM;
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		mr_tri now = { { map[v[0]], map[v[1]], map[v[2]] } };
		if (!proper(now) && proper(m->t[f]))
			continue;
		t[kept] = now;
		of[kept++] = (uint32_t)f;
	}
	m->counts.weld_collapsed = m->nf - kept;
	if (kept < m->nf)
		mr_note(ctx, "weld: %zu faces collapsed", m->nf - kept);
	MR_TRY(gather_rows(ctx, m, true, of, kept));
	m->t = t;
	m->nf = kept;
	return MR_OK;
}

mr_status
mr_model_weld(mr_ctx *ctx, double eps, mr_model *m)
{
	mr_model w = *m;
	uint32_t *map = MR_NEW(ctx, m->nv, uint32_t), *of = MR_NEW(ctx, m->nv, uint32_t);
	const void *p = m->p;
	size_t n = 0, next = 0;

	if (!map || !of)
		return MR_EMEM;
	MR_TRY(mr_weld(ctx, m->p, m->nv, eps, map, &n));
	for (size_t i = 0; i < m->nv; i++)
		if (map[i] == next)
			of[next++] = (uint32_t)i;
	w.counts.weld_joined = m->nv - n;
	mr_note(ctx, "weld: %zu vertices joined to others", m->nv - n);
	MR_TRY(gather(ctx, &p, sizeof *m->p, of, n));
	MR_TRY(gather_rows(ctx, &w, false, of, n));
	w.p = p;
	w.nv = n;
	if (m->nf)
		MR_TRY(rename_faces(ctx, map, &w));
	if (m->nf && w.nf == 0)
		return mr_fail(ctx, MR_EMESH, "welding within %g leaves no face of %zu", eps, m->nf);
	*m = w;
	return MR_OK;
}

/* ---- repair ---- */

static void
report(mr_ctx *ctx, const mr_repair_report *r, mr_import_result *counts)
{
	const struct {
		size_t *to, count;
		const char *what;
	} lines[] = { { &counts->repair_degenerate, r->degenerate, "degenerate faces dropped" },
		{ &counts->repair_duplicate, r->duplicate, "duplicate faces dropped" },
		{ &counts->repair_isolated, r->isolated, "isolated vertices dropped" },
		{ &counts->repair_split_edges, r->split_edges, "edges of more than two faces split" },
		{ &counts->repair_split_vertices, r->split_vertices,
		    "vertices added where fans were parted" },
		{ &counts->repair_flipped, r->flipped, "faces turned over" },
		{ &counts->repair_cut_edges, r->cut_edges, "edges cut" } };

	for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
		*lines[i].to = lines[i].count;
		if (lines[i].count)
			mr_note(ctx, "repair: %zu %s", lines[i].count, lines[i].what);
	}
}

mr_status
mr_model_repair(mr_ctx *ctx, mr_model *m)
{
	mr_mesh in = { .name = "mesh", .p = m->p, .t = m->t, .nv = m->nv, .nf = m->nf }, out;
	const uint32_t *vertex_of, *face_of;
	mr_repair_report r;
	mr_model done = *m;

	if (m->nf == 0)
		return MR_OK;
	MR_TRY(mr_repair(ctx, &in, &out, &vertex_of, &face_of, &r));
	MR_TRY(gather_rows(ctx, &done, false, vertex_of, out.nv));
	MR_TRY(gather_rows(ctx, &done, true, face_of, out.nf));
	if (r.flipped && done.normal) {
		mr_note(ctx, "repair: normals dropped, since faces were turned over");
		done.normal = NULL;
	}
	done.p = out.p;
	done.nv = out.nv;
	done.t = out.t;
	done.nf = out.nf;
	report(ctx, &r, &done.counts);
	*m = done;
	return MR_OK;
}

/* ---- layers ---- */

/* The properties as columns, and their types. */
static mr_status
put_properties(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_model *m)
{
	const char *text = "";

	if (m->properties == 0)
		return MR_OK;
	for (size_t i = 0; i < m->properties; i++) {
		const mr_property *p = &m->property[i];
		MR_TRY(mr_frame_put(
		    ctx, f, layer, p->name, p->shape, p->data, p->shape.element == 'f' ? m->nf : m->nv));
		text = mr_format(ctx, "%s%s%s %s", text, i ? "\n" : "", p->name, p->type);
		if (!text)
			return MR_EMEM;
	}
	return mr_layer_put(ctx, f, layer, "properties", text, strlen(text));
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
	for (size_t i = 0; i < NAMES; i++) {
		const mr_lines *l = lines_of(&all, i);
		if (l->text)
			MR_TRY(mr_layer_put(ctx, f, layer, names[i].name, l->text, l->bytes));
	}
	return put_properties(ctx, f, layer, m);
}

/* The type of PLY that `properties` has for the column, else the one of its shape. */
static const char *
type_of(mr_lines types, const mr_column *c)
{
	static const char *const known[] = { "char", "uchar", "short", "ushort", "int", "uint", "float",
		"double", NULL };
	size_t length = strlen(c->name);
	const char *p = types.text, *end = p + types.bytes;

	while (p < end) {
		const char *e = memchr(p, '\n', (size_t)(end - p));
		size_t n = (size_t)((e ? e : end) - p);
		for (size_t i = 0; known[i] && n > length && !memcmp(p, c->name, length); i++)
			if (p[length] == ' ' && n == length + 1 + strlen(known[i]) &&
			    !memcmp(p + length + 1, known[i], strlen(known[i])))
				return known[i];
		p += n + 1;
	}
	return c->shape.type == 'b' ? "uchar" : c->shape.type == 'u' ? "uint" : "double";
}

static bool
is_property(const mr_column *c, const char *layer, char element)
{
	return !strcmp(c->layer, layer) && c->shape.element == element && c->shape.components == 1 &&
	       !mr_column_known(layer, c->name);
}

/* The columns of one component that are none by convention; those of vertices first. */
static mr_status
get_properties(mr_ctx *ctx, mr_frame *f, const char *layer, mr_model *m)
{
	mr_property *property = MR_NEW(ctx, f->count, mr_property);
	mr_lines types = { "", 0 };
	const void *data;
	size_t n = 0, rows;

	if (!property)
		return MR_EMEM;
	if (mr_layer_has(f, layer, "properties")) {
		MR_TRY(mr_layer_get(ctx, f, layer, "properties", &data, &types.bytes));
		types.text = data;
	}
	for (int faces = 0; faces < 2; faces++)
		for (size_t i = 0; i < f->count; i++) {
			const mr_column *c = &f->columns[i];
			if (!is_property(c, layer, faces ? 'f' : 'v'))
				continue;
			MR_TRY(mr_frame_get(ctx, f, layer, c->name, c->shape, &data, &rows));
			if (rows != (faces ? m->nf : m->nv))
				return mr_fail(ctx, MR_ERANGE, "%s: column %s has %zu rows, not %zu", layer,
				    c->name, rows, faces ? m->nf : m->nv);
			property[n++] = (mr_property){ c->name, type_of(types, c), c->shape, data };
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
		MR_TRY(mr_layer_mesh(ctx, f, layer, &mesh));
	else
		MR_TRY(mr_layer_points(ctx, f, layer, &mesh));
	got.p = mesh.p, got.nv = mesh.nv;
	got.t = mesh.t, got.nf = mesh.nf;
	for (size_t i = 0; i < COLUMNS; i++) {
		if (!mr_layer_has(f, layer, columns[i].name) || (columns[i].of_faces && !mesh.nf))
			continue;
		MR_TRY(mr_layer_get_rows(
		    ctx, f, layer, columns[i].name, columns[i].of_faces ? mesh.nf : mesh.nv, &data));
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
	*m = got;
	return MR_OK;
}

/* Frames */

mr_status
mr_import(
    mr_ctx *ctx, const char *path, const mr_import_opts *opts, mr_frame **frame, mr_import_result *result)
{
	static const mr_import_opts defaults = MR_IMPORT_DEFAULTS;
	const mr_import_opts *o = opts ? opts : &defaults;
	const char *name = mr_format_stem(ctx, path);
	double unit;
	mr_frame *f;
	mr_model m;

	if (!name)
		return MR_EMEM;
	MR_TRY(mr_model_read(ctx, path, o->format, &m));
	if (o->points)
		mr_model_to_points(&m);
	unit = o->weld_relative ? mr_box_diagonal(mr_box_of(m.p, m.nv)) : 1;
	if (o->weld)
		MR_TRY(mr_model_weld(ctx, o->weld_distance * unit, &m));
	if (o->repair)
		MR_TRY(mr_prefix(ctx, mr_model_repair(ctx, &m), "%s", path));
	MR_TRY(mr_frame_new(ctx, name, &f));
	MR_TRY(mr_model_put(ctx, f, o->layer, &m));
	*frame = f;
	m.counts.vertices = m.nv;
	m.counts.triangles = m.nf;
	if (result)
		*result = m.counts;
	return MR_OK;
}

mr_status
mr_export_held(mr_ctx *ctx, mr_frame *f, const char *layer, const char *path, const char *format,
    mr_held *held, mr_export_result *result)
{
	static const char *const layers[] = { "mesh", "control", "points", NULL };
	mr_model m;

	MR_TRY(mr_layer_choose(ctx, f, layer, layers, &layer));
	MR_TRY(mr_model_get(ctx, f, layer, &m));
	return mr_model_write(ctx, path, format, &m, held, result);
}

mr_status
mr_export(mr_ctx *ctx, mr_frame *f, const char *layer, const char *path, const char *format,
    mr_export_result *result)
{
	bool binary;

	MR_TRY(mr_format_check(ctx, path, format, true, &binary));
	return mr_export_held(ctx, f, layer, path, format, NULL, result);
}
