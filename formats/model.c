/* Welding and repair with all attributes, and models in and out of layers. */
#include "formats/model.h"
#include "mesh/repair.h"

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

static mr_status
gather_vertices(mr_ctx *ctx, mr_model *m, const uint32_t *of, size_t n)
{
	const void *normal = m->normal, *color = m->color, *texcoord = m->texcoord;

	MR_TRY(gather(ctx, &normal, sizeof *m->normal, of, n));
	MR_TRY(gather(ctx, &color, 4, of, n));
	MR_TRY(gather(ctx, &texcoord, 2 * sizeof(double), of, n));
	m->normal = normal;
	m->color = color;
	m->texcoord = texcoord;
	return MR_OK;
}

static mr_status
gather_groups(mr_ctx *ctx, mr_model *m, const uint32_t *of, size_t n)
{
	const void *group = m->group;

	MR_TRY(gather(ctx, &group, sizeof *m->group, of, n));
	m->group = group;
	return MR_OK;
}

void
mr_model_to_points(mr_model *m)
{
	m->t = NULL;
	m->nf = 0;
	m->group = NULL;
	m->groups = NULL;
	m->groups_bytes = 0;
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
	MR_TRY(gather_groups(ctx, m, of, kept));
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
	MR_TRY(gather_vertices(ctx, &w, of, n));
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
	MR_TRY(gather_vertices(ctx, &done, vertex_of, out.nv));
	MR_TRY(gather_groups(ctx, &done, face_of, out.nf));
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

mr_status
mr_model_put(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_model *m)
{
	mr_mesh mesh = { .p = m->p, .t = m->t, .nv = m->nv, .nf = m->nf };

	if (!layer)
		layer = m->nf ? "mesh" : "points";
	mesh.name = layer;
	if (m->nf)
		MR_TRY(mr_layer_put_mesh(ctx, f, layer, &mesh));
	else
		MR_TRY(mr_layer_put(ctx, f, layer, "position", m->p, m->nv));
	if (m->normal)
		MR_TRY(mr_layer_put(ctx, f, layer, "normal", m->normal, m->nv));
	if (m->color)
		MR_TRY(mr_layer_put(ctx, f, layer, "color", m->color, m->nv));
	if (m->texcoord)
		MR_TRY(mr_layer_put(ctx, f, layer, "texcoord", m->texcoord, m->nv));
	if (m->group) {
		MR_TRY(mr_layer_put(ctx, f, layer, "group", m->group, m->nf));
		MR_TRY(mr_layer_put(ctx, f, layer, "groups", m->groups, m->groups_bytes));
	}
	return MR_OK;
}

static mr_status
get(mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, size_t rows, const void **data)
{
	*data = NULL;
	return mr_layer_has(f, layer, name) ? mr_layer_get_rows(ctx, f, layer, name, rows, data) : MR_OK;
}

mr_status
mr_model_get(mr_ctx *ctx, mr_frame *f, const char *layer, mr_model *m)
{
	const void *normal, *color, *texcoord, *group, *groups = "";
	size_t bytes = 0;
	mr_mesh mesh;

	if (mr_layer_has(f, layer, "triangles"))
		MR_TRY(mr_layer_mesh(ctx, f, layer, &mesh));
	else
		MR_TRY(mr_layer_points(ctx, f, layer, &mesh));
	MR_TRY(get(ctx, f, layer, "normal", mesh.nv, &normal));
	MR_TRY(get(ctx, f, layer, "color", mesh.nv, &color));
	MR_TRY(get(ctx, f, layer, "texcoord", mesh.nv, &texcoord));
	MR_TRY(get(ctx, f, layer, "group", mesh.nf, &group));
	if (group && mr_layer_has(f, layer, "groups"))
		MR_TRY(mr_layer_get(ctx, f, layer, "groups", &groups, &bytes));
	*m = (mr_model){ .p = mesh.p,
		.nv = mesh.nv,
		.t = mesh.t,
		.nf = mesh.nf,
		.normal = normal,
		.color = color,
		.texcoord = texcoord,
		.group = group,
		.groups = groups,
		.groups_bytes = bytes };
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
