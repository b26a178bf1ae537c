/* The tables of columns and of what goes stale, and meshes in and out of frames by them. */
#include "mesh/layers.h"

#include "base/text.h"
#include "mesh/normals.h"

/* Columns that go stale when a layer changes, beside references to its triangles: its own columns (layer
 * "="), another's, or all of a layer (name NULL).  `changed` NULL: any layer. */
static const struct {
	mr_change change;
	const char *changed, *layer, *name;
} dependents[] = {
	{ MR_POSED, NULL, "=", "normal" },
	{ MR_POSED, NULL, "=", "corner_normal" },
	{ MR_POSED, NULL, "=", "response" },
	{ MR_RESHAPED, NULL, "=", "rest" },
	{ MR_RESHAPED, "base", "base", "before" },
	{ MR_RESHAPED, "control", "displacement", NULL },
	{ MR_RESHAPED, "control", "control", "encoded" },
	{ MR_RECONNECTED, NULL, "=", "groups" },
	{ MR_RECONNECTED, NULL, "=", "objects" },
	{ MR_RECONNECTED, NULL, "=", "materials" },
	{ MR_RECONNECTED, NULL, "=", "mtllib" },
	{ MR_RESELECTED, NULL, "=", "response" },
	{ MR_RESELECTED, "mesh", "base", "region" },
	{ MR_RESELECTED, "mesh", "base", "response" },
};

bool
mr_layer_has(const mr_frame *f, const char *layer, const char *name)
{
	return mr_frame_find(f, layer, name) != NULL;
}

bool
mr_layer_no_surface(const char *layer)
{
	return !strcmp(layer, "points") || !strcmp(layer, "handles") || !strcmp(layer, "displacement");
}

static mr_status
unknown(mr_ctx *ctx, const char *layer, const char *name)
{
	return mr_fail(ctx, MR_EMISSING, "%s: no column by convention is called %s", layer, name);
}

mr_status
mr_layer_get(mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, const void **data, size_t *rows)
{
	const mr_column_info *c = mr_column_of(layer, name);
	const mr_column *column = mr_frame_find(f, layer, name);
	mr_shape shape;

	if (!c)
		return unknown(ctx, layer, name);
	shape = c->shape;
	if (shape.components == 0 && column)
		shape.components = column->shape.components;
	return mr_frame_get(ctx, f, layer, name, shape, data, rows);
}

mr_status
mr_layer_get_rows(
    mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, size_t rows, const void **data)
{
	const void *values;
	size_t n;

	MR_TRY(mr_layer_get(ctx, f, layer, name, &values, &n));
	if (n != rows)
		return mr_fail(ctx, MR_ERANGE, "%s: column %s has %zu rows, not %zu", layer, name, n, rows);
	*data = values;
	return MR_OK;
}

mr_status
mr_layer_put(mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, const void *data, size_t rows)
{
	const mr_column_info *c = mr_column_of(layer, name);

	return c ? mr_frame_put(ctx, f, layer, name, c->shape, data, rows) : unknown(ctx, layer, name);
}

static mr_status
check_finite(mr_ctx *ctx, const mr_mesh *m)
{
	size_t i = mr_first_infinite((const double *)m->p, 3 * m->nv) / 3;

	return i == m->nv ? MR_OK
	                  : mr_fail(ctx, MR_ERANGE, "%s: position %zu (%g %g %g) is not finite", m->name, i,
				m->p[i].x, m->p[i].y, m->p[i].z);
}

static mr_status
check_indices(mr_ctx *ctx, const mr_mesh *m)
{
	const uint32_t *v = m->t->v;
	uint32_t end = (uint32_t)m->nv, bad = 0;
	size_t i = 0;

	for (size_t k = 0; k < 3 * m->nf; k++)
		bad |= v[k] < end ? 0 : 1;
	if (!bad)
		return MR_OK;
	while (v[i] < end)
		i++;
	return mr_fail(ctx, MR_ERANGE, "%s: face %zu has vertex %u of %zu", m->name, i / 3, v[i], m->nv);
}

/* In the order of what makes them: MR_MAKE_MESH and on. */
static const char *const made[] = { "mesh", "points", "base", "control", "displacement", "handles" };

void
mr_layer_names(mr_ctx *ctx, const mr_frame *f, const char *except, const char **names)
{
	mr_text list = { .ctx = ctx };
	size_t n = 0;

	for (size_t i = 0; i < f->count; i++) {
		const char *layer = f->columns[i].layer;
		if (mr_frame_begins_layer(f, i) && !(except && !strcmp(layer, except)))
			mr_text_name(&list, &n, layer);
	}
	*names = n ? list.s : "";
}

/* In brackets: for make lint there is a macro of this name. */
mr_status(mr_layer_missing)(mr_ctx *ctx, const mr_frame *f, const char *names, const char *layer)
{
	const char *there;
	mr_remedy how = MR_NO_REMEDY;

	for (size_t i = 0; i < sizeof made / sizeof *made; i++)
		if (!strcmp(made[i], layer))
			how = (mr_remedy)(MR_MAKE_MESH + i);
	mr_layer_names(ctx, f, NULL, &there);
	return mr_advise(ctx, how,
	    mr_fail(ctx, MR_EMISSING, "no layer %s; the frame has %s", names, *there ? there : "none"));
}

/* Up to here, and down to its inverse, every tool gives the same bits at every power of two; at 1e57 wraps
 * and heights are others. */
static const double LARGEST = 1e30;

/* Beyond, results would be wrong in silence: products of lengths overflow or vanish. */
static mr_status
check_size(mr_ctx *ctx, const mr_mesh *m)
{
	const double *x = (const double *)m->p;
	size_t n = 3 * m->nv, i = 0;
	double lane[4] = { 0 }, most = 0; /* side by side, as the machine has them */

	for (; i + 4 <= n; i += 4)
		for (size_t k = 0; k < 4; k++)
			lane[k] = fabs(x[i + k]) > lane[k] ? fabs(x[i + k]) : lane[k];
	for (size_t k = 0; k < 4; k++)
		most = fmax(most, fmax(lane[k], i + k < n ? fabs(x[i + k]) : 0));
	if (most == 0 || (most >= 1 / LARGEST && most <= LARGEST))
		return MR_OK;
	return mr_advise(ctx, MR_RESCALE,
	    mr_fail(ctx, MR_ERANGE,
		"%s: the largest coordinate is %.3g, and only %g to %g can be computed with", m->name, most,
		1 / LARGEST, LARGEST));
}

mr_status
mr_layer_points(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m)
{
	MR_ENTER(ctx);
	MR_TRY(mr_layer_points_of_any_size(ctx, f, layer, m));
	return check_size(ctx, m);
}

mr_status
mr_layer_mesh(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m)
{
	MR_ENTER(ctx);
	MR_TRY(mr_layer_mesh_of_any_size(ctx, f, layer, m));
	return check_size(ctx, m);
}

mr_status
mr_layer_points_of_any_size(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m)
{
	mr_mesh r = { .name = layer };
	const void *p;

	if (!mr_frame_has_layer(f, layer))
		return mr_layer_missing(ctx, f, layer, layer);
	MR_TRY(mr_layer_get(ctx, f, layer, "position", &p, &r.nv));
	r.p = p;
	if (r.nv >= MR_NONE)
		return mr_fail(ctx, MR_ERANGE, "%s: %zu vertices are more than %u", layer, r.nv, MR_NONE - 1);
	MR_TRY(check_finite(ctx, &r));
	*m = r;
	return MR_OK;
}

mr_status
mr_layer_mesh_of_any_size(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m)
{
	mr_mesh r;
	const void *t;

	MR_TRY(mr_layer_points_of_any_size(ctx, f, layer, &r));
	MR_TRY(mr_layer_get(ctx, f, layer, "triangles", &t, &r.nf));
	r.t = t;
	if (r.nf == 0)
		return mr_fail(ctx, MR_EMESH, "%s: the mesh has no faces", layer);
	if (r.nf > (MR_NONE - 1) / 3)
		return mr_fail(
		    ctx, MR_ERANGE, "%s: %zu faces are more than %u", layer, r.nf, (MR_NONE - 1) / 3);
	MR_TRY(check_indices(ctx, &r));
	*m = r;
	return MR_OK;
}

mr_status
mr_layer_surface_or_points_of_any_size(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m)
{
	const mr_column *faces = mr_frame_find(f, layer, "triangles");

	return faces && faces->rows ? mr_layer_mesh_of_any_size(ctx, f, layer, m)
	                            : mr_layer_points_of_any_size(ctx, f, layer, m);
}

mr_status
mr_layer_surface_or_points(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m)
{
	MR_TRY(mr_layer_surface_or_points_of_any_size(ctx, f, layer, m));
	return check_size(ctx, m);
}

/* A column stale after a change of shape or connectivity is stale after a greater one. */
static bool
concerns(mr_change change, const char *layer, size_t i)
{
	mr_change least = dependents[i].change;

	return (least == change || (least < change && change != MR_RESELECTED)) &&
	       (!dependents[i].changed || !strcmp(dependents[i].changed, layer));
}

void
mr_layer_drop_kind(mr_frame *f, const char *layer, mr_attribute kind)
{
	for (const mr_column_info *c = mr_columns; c->name; c++)
		if (c->kind == kind)
			mr_frame_drop(f, layer, c->name, 0);
}

/* own: whether columns of the layer itself go too, but for a file's own of such a name. */
static void
drop_dependents(mr_frame *f, const char *layer, mr_change change, bool own)
{
	for (const mr_column_info *c = mr_columns; change == MR_RECONNECTED && c->name; c++)
		if (c->refers && !strcmp(c->refers, layer))
			mr_frame_drop(f, c->layer, c->name, 0);
	if (own && change != MR_RESELECTED)
		mr_layer_drop_kind(f, layer, MR_SAMPLED);
	for (size_t i = 0; i < sizeof dependents / sizeof *dependents; i++) {
		const char *of = dependents[i].layer;
		if (!concerns(change, layer, i))
			continue;
		if (*of == '=' && !(own && mr_column_known(layer, dependents[i].name)))
			continue;
		mr_frame_drop(f, *of == '=' ? layer : of, dependents[i].name, 0);
	}
}

mr_status
mr_layer_is_posed(mr_ctx *ctx, mr_frame *f, const char *layer, bool *is)
{
	bool rest, pending;

	MR_TRY(mr_layer_is_as_encoded(ctx, f, layer, &rest));
	MR_TRY(mr_layer_is_pending(ctx, f, layer, &pending));
	*is = !rest && pending;
	return MR_OK;
}

mr_status
mr_layer_has_standing_detail(mr_ctx *ctx, mr_frame *f, bool *has)
{
	bool rest, posed;

	*has = false;
	if (!mr_layer_has(f, "mesh", "detail_height"))
		return MR_OK;
	MR_TRY(mr_layer_is_as_encoded(ctx, f, "base", &rest));
	MR_TRY(mr_layer_is_posed(ctx, f, "base", &posed));
	*has = rest || posed;
	return MR_OK;
}

void
mr_layer_changed(mr_frame *f, const char *layer, mr_change change)
{
	if (change == MR_RECONNECTED) {
		mr_frame_drop(f, layer, NULL, 'v');
		mr_frame_drop(f, layer, NULL, 'f');
	}
	drop_dependents(f, layer, change, true);
}

void
mr_layer_renumbered(mr_frame *f, const char *layer)
{
	drop_dependents(f, layer, MR_RECONNECTED, false);
}

/* True where the layer's triangles are the given ones. */
static bool
same_triangles(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_mesh *m)
{
	const mr_column *column = mr_frame_find(f, layer, "triangles");
	const void *t;
	size_t nf;

	if (!column || mr_layer_get(ctx, f, layer, "triangles", &t, &nf) != MR_OK)
		return false;
	return nf == m->nf && (t == m->t || !memcmp(t, m->t, nf * sizeof *m->t));
}

/* True where the layer's positions are the given ones, bit for bit. */
static bool
same_positions(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_mesh *m)
{
	const void *p;
	size_t nv;

	return mr_layer_get(ctx, f, layer, "position", &p, &nv) == MR_OK && nv == m->nv &&
	       !memcmp(p, m->p, nv * sizeof *m->p);
}

mr_status
mr_layer_is_as_encoded(mr_ctx *ctx, mr_frame *f, const char *layer, bool *is)
{
	const void *p = NULL, *encoded = NULL;
	size_t n;

	*is = true;
	if (!mr_column_known(layer, "encoded") || !mr_layer_has(f, layer, "encoded"))
		return MR_OK;
	MR_TRY(mr_layer_get(ctx, f, layer, "position", &p, &n));
	MR_TRY(mr_layer_get_rows(ctx, f, layer, "encoded", n, &encoded));
	*is = !memcmp(p, encoded, n * sizeof(mr_v3));
	return MR_OK;
}

/* A copy of a column of normals, or NULL where the layer has none. */
static mr_status
copy_normals(
    mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, size_t rows, size_t each, mr_v3 **copy)
{
	const void *data = NULL;

	*copy = NULL;
	if (!mr_layer_has(f, layer, name))
		return MR_OK;
	MR_TRY(mr_layer_get_rows(ctx, f, layer, name, rows, &data));
	*copy = MR_NEW(ctx, rows * each, mr_v3);
	memcpy(*copy, data, rows * each * sizeof **copy);
	return MR_OK;
}

/* The same vertices and triangles at other places: normals turn with the surface, stale columns go. */
static mr_status
move(mr_ctx *ctx, mr_frame *f, const char *layer, mr_change change, const mr_v3 *p, size_t nv)
{
	bool has = mr_layer_has(f, layer, "normal") || mr_layer_has(f, layer, "corner_normal");
	mr_v3 *normal = NULL, *corner = NULL;
	mr_mesh before;

	if (has && mr_layer_has(f, layer, "triangles")) {
		MR_TRY(mr_layer_mesh_of_any_size(ctx, f, layer, &before));
		if (before.nv != nv)
			return mr_fail(
			    ctx, MR_ERANGE, "%s: %zu positions for %zu vertices", layer, nv, before.nv);
		MR_TRY(copy_normals(ctx, f, layer, "normal", nv, 1, &normal));
		MR_TRY(copy_normals(ctx, f, layer, "corner_normal", before.nf, 3, &corner));
		mr_turn_normals(ctx, &before, p, normal, corner);
	}
	mr_layer_changed(f, layer, change);
	MR_TRY(mr_layer_put(ctx, f, layer, "position", p, nv));
	if (normal)
		MR_TRY(mr_layer_put(ctx, f, layer, "normal", normal, nv));
	if (corner)
		MR_TRY(mr_layer_put(ctx, f, layer, "corner_normal", corner, before.nf));
	return mr_layer_worked(ctx, f, layer);
}

mr_status
mr_layer_put_mesh(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_mesh *m)
{
	const mr_column *p = mr_frame_find(f, layer, "position");

	MR_ENTER(ctx);
	MR_TRY(check_finite(ctx, m));
	if (!p || p->rows != m->nv || !same_triangles(ctx, f, layer, m)) {
		mr_layer_changed(f, layer, MR_RECONNECTED);
	} else if (!same_positions(ctx, f, layer, m))
		return move(ctx, f, layer, MR_RESHAPED, m->p, m->nv);
	MR_TRY(mr_layer_put(ctx, f, layer, "position", m->p, m->nv));
	MR_TRY(mr_layer_put(ctx, f, layer, "triangles", m->t, m->nf));
	return mr_layer_worked(ctx, f, layer);
}

mr_status
mr_layer_move(mr_ctx *ctx, mr_frame *f, const char *layer, mr_change change, const mr_v3 *p, size_t nv)
{
	MR_ENTER(ctx);
	MR_TRY(check_finite(ctx, &(mr_mesh){ .name = layer, .p = p, .nv = nv }));
	return move(ctx, f, layer, change, p, nv);
}

mr_status
mr_layer_replace(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_mesh *m)
{
	bool normals = mr_layer_has(f, layer, "normal") || mr_layer_has(f, layer, "corner_normal");
	mr_v3 *normal;

	MR_TRY(mr_layer_put_mesh(ctx, f, layer, m));
	if (!normals)
		return MR_OK;
	normal = MR_NEW(ctx, m->nv, mr_v3);
	mr_vertex_normals(m, normal);
	return mr_layer_put(ctx, f, layer, "normal", normal, m->nv);
}

mr_status
mr_layer_put_region(mr_ctx *ctx, mr_frame *f, const char *layer, const uint32_t *region, size_t nv)
{
	MR_ENTER(ctx);
	mr_layer_changed(f, layer, MR_RESELECTED);
	return mr_layer_put(ctx, f, layer, "region", region, nv);
}

mr_status
mr_layer_region(mr_ctx *ctx, mr_frame *f, const char *layer, size_t nv, const uint32_t **region)
{
	enum { MOST = 65536 };
	const void *data = NULL;
	const uint32_t *r;

	MR_TRY(mr_layer_get_rows(ctx, f, layer, "region", nv, &data));
	r = data;
	for (size_t i = 0; i < nv; i++)
		if (r[i] >= MR_REGION_HANDLE + MOST)
			return mr_fail(ctx, MR_ERANGE, "%s: vertex %zu has region %u of %d", layer, i, r[i],
			    MR_REGION_HANDLE + MOST);
	*region = r;
	return MR_OK;
}

mr_regions
mr_regions_of(mr_ctx *ctx, const uint32_t *region, size_t nv)
{
	mr_regions r = { .n = MR_REGION_HANDLE };

	for (size_t v = 0; v < nv; v++)
		r.n = region[v] < r.n ? r.n : (size_t)region[v] + 1;
	r.count = MR_NEW_ZERO(ctx, r.n, size_t);
	for (size_t v = 0; v < nv; v++)
		r.count[region[v]]++;
	return r;
}

mr_status
mr_layer_crease(mr_ctx *ctx, mr_frame *f, const char *layer, size_t nf, const uint8_t **mark)
{
	const void *data = NULL;

	if (!strcmp(layer, "control") && mr_layer_has(f, layer, "crease"))
		MR_TRY(mr_layer_get_rows(ctx, f, layer, "crease", nf, &data));
	*mark = data;
	return MR_OK;
}

mr_status
mr_layer_choose(mr_ctx *ctx, mr_frame *f, const char *only, const char *const *layers, const char **layer)
{
	char names[128];
	size_t n = 0, i = 0;

	if (only) {
		if (!mr_frame_has_layer(f, only))
			return mr_layer_missing(ctx, f, only, only);
		*layer = only;
		return MR_OK;
	}
	for (; layers[i]; i++) {
		if (mr_frame_has_layer(f, layers[i])) {
			*layer = layers[i];
			return MR_OK;
		}
		n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", i ? " nor " : "", layers[i]);
	}
	do /* most pipes begin with mesh; else the first in search order */
		i--;
	while (i && strcmp(layers[i], "mesh") != 0);
	return mr_layer_missing(ctx, f, names, layers[i]);
}
