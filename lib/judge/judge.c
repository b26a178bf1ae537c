/* Which surface to compare with which: the layer worked on last with its former state or its source. */
#include "judge/judge.h"

#include "edit/detail.h"
#include "space/contact.h"
#include "subdivide/displaced.h"

/* The layer's surface where it has one; t NULL: none. */
static mr_status
surface_of(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m)
{
	*m = (mr_mesh){ .name = layer };
	if (!layer || !mr_layer_has(f, layer, "position") || !mr_layer_has(f, layer, "triangles"))
		return MR_OK;
	return mr_layer_mesh_of_any_size(ctx, f, layer, m);
}

/* The largest distance that a vertex went. */
static double
farthest(const mr_v3 *then, const mr_v3 *now, size_t n)
{
	double most = 0;

	for (size_t v = 0; v < n; v++) {
		double far = mr_norm2(mr_sub(now[v], then[v]));
		most = far > most ? far : most;
	}
	return sqrt(most);
}

static mr_status
read_regions(mr_ctx *ctx, mr_frame *f, const char *layer, size_t nv, const uint32_t **region)
{
	*region = NULL;
	return mr_layer_has(f, layer, "region") ? mr_layer_region(ctx, f, layer, nv, region) : MR_OK;
}

/* Base's positions at the time of mesh's: before its last pose, else as encoded; then->p NULL: not known. */
static mr_status
base_then(mr_ctx *ctx, mr_frame *before, mr_frame *after, mr_mesh *then)
{
	const void *p = NULL;
	mr_frame *f = mr_layer_has(before, "base", "before") ? before : after;
	const char *column = f == before ? "before" : "encoded";

	if (mr_layer_has(f, "base", column))
		MR_TRY(mr_layer_get_rows(ctx, f, "base", column, then->nv, &p));
	then->p = p;
	return MR_OK;
}

/* mesh, which has followed base by its detail. */
static mr_status
judge_on_base(mr_ctx *ctx, mr_frame *before, mr_frame *after, const mr_motion *m)
{
	mr_ground g = { .then.name = "base" };
	const void *face;
	mr_mesh base;
	bool closed;

	mr_judge_contacts(ctx, m, &closed);
	MR_TRY(surface_of(ctx, after, "base", &base));
	if (!base.t || !mr_layer_has(after, "mesh", "detail_face"))
		return MR_OK;
	MR_TRY(mr_layer_get_rows(ctx, after, "mesh", "detail_face", m->then->nv, &face));
	g.then = base;
	g.now = base.p;
	g.face = face;
	for (size_t v = 0; v < m->then->nv; v++)
		if (g.face[v] >= base.nf)
			return mr_fail(ctx, MR_ERANGE, "mesh: detail_face %zu is %u, but base has %zu faces",
			    v, g.face[v], base.nf);
	MR_TRY(base_then(ctx, before, after, &g.then));
	if (!g.then.p)
		return MR_OK;
	MR_TRY(read_regions(ctx, after, "base", base.nv, &g.region));
	MR_TRY(read_regions(ctx, after, "mesh", m->then->nv, &g.surface_region));
	mr_judge_detail(ctx, m, &g);
	if (g.region && g.surface_region)
		mr_judge_pose(ctx, m, &g, closed);
	return MR_OK;
}

/* The region of the control vertices around each vertex over d; free where these differ. */
static void
regions_of_levels(mr_ctx *ctx, const mr_domain *d, const uint32_t *control, const uint32_t **region)
{
	uint32_t *r = MR_NEW(ctx, d->m.nv, uint32_t);

	memcpy(r, control, d->level[0].nv * sizeof *r);
	for (size_t n = 1; n <= d->n; n++) {
		const mr_loop *level = &d->level[n], *below = level - 1;
		for (size_t v = level->coarse_nv; v < level->nv; v++) {
			uint32_t h = level->edge[v - level->coarse_nv];
			uint32_t a = r[below->t[h / 3].v[h % 3]], b = r[below->t[h / 3].v[(h + 1) % 3]];
			r[v] = a == b ? a : MR_REGION_FREE;
		}
	}
	*region = r;
}

/* The displaced surface of a frame on its control mesh where that was encoded, over d: foot and surface. */
static mr_status
displaced_then(mr_ctx *ctx, mr_frame *f, size_t n, mr_mesh *control, mr_domain *d, mr_v3 **surface)
{
	const double *height;
	const void *p;
	size_t all;

	MR_TRY(surface_of(ctx, f, "control", control));
	MR_TRY(mr_displacement_get(ctx, f, control, &all, &height));
	if (mr_layer_has(f, "control", "encoded")) {
		MR_TRY(mr_layer_get_rows(ctx, f, "control", "encoded", control->nv, &p));
		control->p = p;
	}
	MR_TRY(mr_domain_of(ctx, f, control, n < all ? n : all, d));
	*surface = MR_NEW(ctx, d->m.nv, mr_v3);
	mr_domain_displace(ctx, d, height, 1, *surface);
	return MR_OK;
}

static void
judge_motion(mr_ctx *ctx, const mr_mesh *then, const mr_v3 *now, mr_motion *m)
{
	*m = mr_motion_of(ctx, then, now);
	mr_judge_harm(ctx, m);
}

/* mesh, made of control and its heights: unposed and at a gain of 1 nothing has moved. */
static mr_status
judge_on_control(mr_ctx *ctx, mr_frame *before, mr_frame *after, const mr_mesh *mesh)
{
	mr_mesh control, surface;
	mr_ground g = { .then.name = "control" };
	mr_motion m;
	mr_domain d;
	bool *boundary, open;
	mr_v3 *then;
	size_t n;

	MR_TRY(displaced_then(ctx, before, 0, &control, &d, &then));
	if (mesh->nv >= control.nv &&
	    farthest(then, mesh->p, control.nv) <= mr_mesh_tolerance(&control, 1e-9))
		return MR_OK;
	MR_TRY(mr_domain_level(ctx, &control, mesh->nv, &n));
	MR_TRY(displaced_then(ctx, before, n, &control, &d, &then));
	if (d.m.nv != mesh->nv || !mr_same_triangles(&d.m, mesh))
		return MR_OK;
	surface = d.m;
	surface.name = mesh->name;
	surface.p = then;
	judge_motion(ctx, &surface, mesh->p, &m);
	if (!mr_layer_has(after, "control", "region") || !mr_layer_has(after, "control", "encoded"))
		return MR_OK;
	g.then = control;
	MR_TRY(surface_of(ctx, after, "control", &control));
	g.now = control.p;
	MR_TRY(mr_layer_region(ctx, after, "control", control.nv, &g.region));
	regions_of_levels(ctx, &d, g.region, &g.surface_region);
	mr_boundary_label(ctx, mesh, &boundary, &open);
	mr_judge_pose(ctx, &m, &g, !open);
	return MR_OK;
}

/* The former state or source of `layer`: the surface worked on last before; t NULL: none. */
static mr_status
surface_then(mr_ctx *ctx, mr_frame *before, const char *layer, mr_mesh *then)
{
	const char *latest;

	MR_TRY(surface_of(ctx, before, layer, then));
	if (then->t)
		return MR_OK;
	MR_TRY(mr_layer_latest(ctx, before, &latest));
	return surface_of(ctx, before, latest ? latest : "mesh", then);
}

static mr_status
judge_surface(mr_ctx *ctx, mr_frame *before, mr_frame *after, const char *layer, double *least)
{
	mr_mesh then, now;
	mr_motion m;

	MR_TRY(surface_of(ctx, after, layer, &now));
	MR_TRY(surface_then(ctx, before, layer, &then));
	if (!now.t)
		return MR_OK;
	if (!strcmp(layer, "mesh") && !mr_layer_has(after, "mesh", "detail_face") &&
	    mr_layer_has(before, "displacement", "height"))
		return judge_on_control(ctx, before, after, &now);
	if (!then.t || (then.p == now.p && then.t == now.t))
		return MR_OK;
	if (!mr_same_triangles(&then, &now)) {
		mr_judge_remade(ctx, &then, &now);
		return MR_OK;
	}
	if (then.p == now.p || !memcmp(then.p, now.p, now.nv * sizeof *now.p))
		return MR_OK;
	if (least) {
		double most = farthest(then.p, now.p, now.nv);
		if (most < *least)
			return MR_OK;
		*least = 2 * most;
	}
	judge_motion(ctx, &then, now.p, &m);
	return judge_on_base(ctx, before, after, &m);
}

mr_status
mr_judge(mr_ctx *ctx, mr_frame *before, mr_frame *after, double *least)
{
	MR_SCOPE(ctx);
	const char *layer;

	MR_ENTER(ctx);
	if (!mr_listens(ctx))
		return MR_OK;
	MR_TRY(mr_layer_latest(ctx, after, &layer));
	return judge_surface(ctx, before, after, layer ? layer : "mesh", least);
}

/* ---- columns that were there and are not any more ---- */

/* Columns of a surface from a file or from a user's selection. */
static bool
is_given(const mr_column *c)
{
	const mr_column_info *info = mr_column_of(c->layer, c->name);

	if (!*c->layer || c->shape.element == '-' || !strcmp(c->name, "polygon"))
		return false;
	return !info || info->kind == MR_MEAN || info->kind == MR_LABEL || !strcmp(c->name, "region");
}

/* mesh and base have one selection; texture coordinates of merged vertices become corners'; colors may have
 * gone into a picture. */
static bool
is_there(const mr_frame *before, const mr_frame *f, const mr_column *c)
{
	if (mr_layer_has(f, c->layer, c->name))
		return true;
	if (!strcmp(c->name, "color"))
		return mr_layer_has(f, c->layer, "mtllib") && !mr_layer_has(before, c->layer, "mtllib");
	if (!strcmp(c->name, "texcoord"))
		return mr_layer_has(f, c->layer, "corner_texcoord");
	return !strcmp(c->name, "region") &&
	       (mr_layer_has(f, "base", "region") || mr_layer_has(f, "mesh", "region"));
}

static void
report_stale(mr_ctx *ctx, const char *layer, const char *what)
{
	mr_found(ctx, &(mr_finding){ .kind = MR_STALE, .layer = layer, .what = what });
}

mr_status
mr_judge_losses(mr_ctx *ctx, mr_frame *before, mr_frame *after)
{
	bool standing;

	MR_ENTER(ctx);
	for (size_t i = 0; after->key && i < before->count; i++) {
		const mr_column *c = &before->columns[i];
		if (is_given(c) && mr_frame_has_layer(after, c->layer) && !is_there(before, after, c))
			mr_found(ctx,
			    &(mr_finding){ .kind = MR_LOST, .layer = c->layer, .what = c->name, .count = 1 });
	}
	if (!after->key)
		return MR_OK;
	MR_TRY(mr_layer_has_standing_detail(ctx, before, &standing));
	if (standing && mr_frame_has_layer(after, "mesh") && !mr_layer_has(after, "mesh", "detail_height"))
		report_stale(ctx, "mesh", "its detail over base");
	if (mr_layer_has(before, "displacement", "height") && mr_frame_has_layer(after, "control") &&
	    !mr_layer_has(after, "displacement", "height"))
		report_stale(ctx, "control", "its displacement");
	return MR_OK;
}
