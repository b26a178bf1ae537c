/* mr-decode: the reconstruction operator of both papers, detail onto a base or heights onto a subdivision
 * surface, posed by its response first where handles are there. */
#include "base/options.h"
#include "edit/handles.h"
#include "edit/pose_basis.h"
#include "measure/gaps.h"
#include "tool/moved.h"

/* Whether what was kept of a column is still true of the frame; where it is not, the arena is emptied. */
static bool
still_there(
    const mr_ctx *ctx, const mr_frame *f, const char *layer, const char *name, uint64_t *kept, mr_ctx *keep)
{
	uint64_t serial = mr_frame_find(f, layer, name)->serial;

	if (!f->key && serial && serial == *kept)
		return true;
	mr_ctx_free(mr_cache_arena(ctx, keep));
	*kept = 0;
	return false;
}

/* The faces around the vertices of base, which are to be those over which mesh was encoded. */
static mr_status
base_incidence(mr_ctx *ctx, mr_cache *cache, mr_frame *f, const mr_mesh *base, mr_incidence *inc)
{
	mr_connectivity_cache *kept;

	if (!cache) {
		MR_TRY(mr_detail_check_faces(ctx, f, base));
		return mr_incidence_build(ctx, base, inc);
	}
	kept = &cache->connectivity;
	if (!still_there(ctx, f, base->name, "triangles", &kept->base_serial, &cache->base_keep)) {
		MR_TRY(mr_detail_check_faces(ctx, f, base));
		MR_TRY(mr_fail_as(
		    ctx, &cache->base_keep, mr_incidence_build(&cache->base_keep, base, &kept->base)));
		kept->base_serial = mr_frame_find(f, base->name, "triangles")->serial;
		kept->rest_serial = 0;
		kept->rest_normal = kept->at_rest.p = kept->before.p = NULL;
	}
	*inc = kept->base;
	return MR_OK;
}

/* The normals of base where it was encoded, if that is known. */
static mr_status
rest_normals(mr_ctx *ctx, mr_cache *cache, const mr_frame *f, const mr_mesh *base, const mr_incidence *inc,
    mr_detail *d)
{
	mr_connectivity_cache *kept = cache ? &cache->connectivity : NULL;
	mr_ctx *keep = cache ? &cache->base_keep : ctx;
	mr_v3 *normal = cache ? kept->rest_normal : NULL;
	mr_mesh rest = *base;
	uint64_t serial;

	if (!d->rest)
		return MR_OK;
	rest.p = d->rest;
	d->rest_normal = normal;
	serial = mr_frame_find(f, base->name, "encoded")->serial;
	if (normal && !f->key && serial && serial == kept->rest_serial)
		return MR_OK;
	if (!normal)
		normal = MR_NEW(keep, base->nv, mr_v3);
	if (!normal)
		return mr_fail_as(ctx, keep, MR_EMEM);
	MR_TRY(mr_vertex_normals(ctx, &rest, inc, normal));
	d->rest_normal = normal;
	if (cache) {
		kept->rest_normal = normal;
		kept->rest_serial = serial;
	}
	return MR_OK;
}

/*
 * Poses the layer by its response, and warns of what that cannot do, once from key to key.  Half-way to a
 * handle that is twisted by 60 degrees a limb is 0.87 times as wide, and models that are bent or twisted by
 * so much lose 3 to 15 % of their volume; by 90 degrees up to 27 %.
 */
static mr_status
respond(mr_ctx *ctx, mr_frame *f, mr_cache *cache, mr_mesh *m)
{
	static const double most = 60;
	const uint32_t *region;
	double degrees;

	if (mr_layer_has(f, "handles", "transform") && mr_layer_has(f, m->name, "region")) {
		MR_TRY(mr_layer_region(ctx, f, m->name, m->nv, &region));
		MR_TRY(mr_handles_warn_of_few(ctx, f, m, region, cache ? &cache->told_few : NULL));
	}
	MR_TRY(mr_response_apply(ctx, f, m, &degrees));
	if (cache && f->key)
		cache->turned_far = false;
	if (degrees <= most * (1 + 1e-9) || (cache && cache->turned_far))
		return MR_OK;
	if (cache)
		cache->turned_far = true;
	mr_warn(ctx,
	    "%s: a handle turns by %.0f degrees against what is fixed or another, and a response is linear: "
	    "beyond %.0f it thins what is between; mr-solve does not",
	    m->name, degrees, most);
	return MR_OK;
}

static mr_status
find_neighbours(mr_ctx *ctx, const mr_mesh *mesh, mr_edges *edges, mr_contacts *contacts)
{
	/* Of the diagonal.  Of 78 models of several parts, bent, 23 have some that come apart by a third of
	 * this, 28 by this, among them a house whose windows its straight walls leave, as many by 0.005. */
	const double touch = 0.003;

	MR_TRY(mr_contacts_find(ctx, mesh, touch * mr_mesh_diagonal(mesh), contacts));
	return mr_edges_build(ctx, mesh, edges);
}

/* The edges of mesh, and where its parts touch. */
static mr_status
mesh_neighbours(mr_ctx *ctx, mr_cache *cache, const mr_frame *f, const mr_mesh *mesh, mr_edges *edges,
    mr_contacts *contacts)
{
	mr_connectivity_cache *kept;

	if (!cache)
		return find_neighbours(ctx, mesh, edges, contacts);
	kept = &cache->connectivity;
	if (kept->place_serial != mr_frame_find(f, mesh->name, "position")->serial)
		kept->mesh_serial = 0; /* parts may touch elsewhere */
	if (!still_there(ctx, f, mesh->name, "triangles", &kept->mesh_serial, &cache->mesh_keep)) {
		MR_TRY(mr_fail_as(ctx, &cache->mesh_keep,
		    find_neighbours(&cache->mesh_keep, mesh, &kept->mesh, &kept->contacts)));
		kept->mesh_serial = mr_frame_find(f, mesh->name, "triangles")->serial;
		kept->place_serial = mr_frame_find(f, mesh->name, "position")->serial;
	}
	*edges = kept->mesh;
	*contacts = kept->contacts;
	return MR_OK;
}

/* Where the vertices of mesh stood when base was where its column `name` has it. */
static mr_status
places_on(
    mr_ctx *ctx, const mr_moved *m, const mr_mesh *on, const char *name, mr_stood *kept, const mr_v3 **p)
{
	const mr_frame *f = m->f;
	const mr_detail *d = m->detail;
	mr_ctx *keep = m->cache ? &m->cache->base_keep : ctx;
	uint64_t serial[2] = { mr_frame_find(f, on->name, name)->serial,
		mr_frame_find(f, "mesh", "detail_height")->serial };

	if (!kept->p || kept->rows < d->n)
		kept->p = MR_NEW(keep, d->n, mr_v3);
	else if (!f->key && serial[0] && serial[1] && kept->gain == m->gain &&
		 !memcmp(serial, kept->serial, sizeof serial)) {
		*p = kept->p;
		return MR_OK;
	}
	if (!kept->p)
		return mr_fail_as(ctx, keep, MR_EMEM);
	if (on->p == d->rest)
		mr_decode_at_rest(ctx, on, d, m->gain, kept->p);
	else
		MR_TRY(mr_decode(ctx, on, m->inc, d, m->gain, kept->p));
	kept->rows = d->n;
	kept->gain = m->gain;
	memcpy(kept->serial, serial, sizeof serial);
	*p = kept->p;
	return MR_OK;
}

/* Judges by where the pose began: an earlier one may have bent what is fixed now, or a handle.  m: of the
 * mesh as it was encoded. */
static mr_status
look_at_pose(mr_ctx *ctx, const mr_moved *m)
{
	mr_stood none = { 0 }, *kept = m->cache ? &m->cache->connectivity.before : &none;
	mr_mesh mesh = *m->mesh, before = *m->base;
	mr_held_pose pose = {
		.mesh = &mesh, .base = &before, .p = m->p, .on_base = m->base->p, .at = m->detail->at
	};

	if (!mr_layer_has(m->f, "mesh", "region") || !mr_layer_has(m->f, before.name, "region"))
		return MR_OK;
	MR_TRY(mr_layer_region(ctx, m->f, before.name, before.nv, &pose.base_region));
	MR_TRY(mr_layer_region(ctx, m->f, "mesh", mesh.nv, &pose.region));
	MR_TRY(mr_detail_before(ctx, m->f, m->base, m->detail, &before.p));
	if (before.p != m->detail->rest)
		MR_TRY(places_on(ctx, m, &before, "before", kept, &mesh.p));
	return mr_moved_pose(ctx, m, &pose);
}

/* What the motion of the frame's mesh has done to it, and how it stands to base.  m: without mesh and edges.
 */
static mr_status
look_at_detail(mr_ctx *ctx, mr_moved m)
{
	mr_contacts contacts;
	mr_edges edges;
	mr_mesh mesh, encoded = *m.base;
	mr_stood none = { 0 }, *kept = m.cache ? &m.cache->connectivity.at_rest : &none;

	MR_TRY(mr_layer_mesh(ctx, m.f, "mesh", &mesh));
	MR_TRY(mesh_neighbours(ctx, m.cache, m.f, &mesh, &edges, &contacts));
	m.mesh = &mesh;
	m.edges = &edges;
	MR_TRY(mr_moved_harm(ctx, &m));
	mr_moved_gaps(ctx, &m, &contacts);
	if (!m.detail->rest)
		return MR_OK;
	encoded.p = m.detail->rest;
	MR_TRY(places_on(ctx, &m, &encoded, "encoded", kept, &mesh.p));
	mr_moved_strayed(ctx, &m);
	MR_TRY(mr_moved_chords(ctx, &m));
	return look_at_pose(ctx, &m);
}

static mr_status
decode_detail(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, mr_cache *cache, mr_decode_result *result)
{
	mr_incidence inc;
	mr_detail detail;
	mr_mesh base;
	mr_v3 *p;

	MR_TRY(mr_layer_mesh(ctx, f, "base", &base));
	MR_TRY(base_incidence(ctx, cache, f, &base, &inc));
	MR_TRY(respond(ctx, f, cache, &base));
	MR_TRY(mr_detail_get(ctx, f, &base, &detail));
	MR_TRY(rest_normals(ctx, cache, f, &base, &inc, &detail));
	p = MR_NEW(ctx, detail.n, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_decode(ctx, &base, &inc, &detail, o->gain, p));
	if (!o->blind && mr_layer_has(f, "mesh", "triangles"))
		MR_TRY(look_at_detail(
		    ctx, (mr_moved){ f, cache, NULL, NULL, p, &base, &inc, &detail, o->gain, result }));
	MR_TRY(mr_layer_move(ctx, f, "mesh", MR_POSED, p, detail.n));
	return mr_layer_followed(ctx, f, "base");
}

/* The displaced surface over d at a gain of 1, but on the control mesh as it was encoded, its edges, and what
 * it stands on. */
static mr_status
build_encoded(mr_ctx *ctx, const mr_domain *d, const mr_mesh *encoded, const double *height, mr_mesh *surface,
    mr_edges *edges, const mr_v3 **foot)
{
	mr_domain before;
	mr_v3 *p;

	MR_TRY(mr_domain_on(ctx, encoded, d->level, d->n, &before));
	p = MR_NEW(ctx, before.m.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	mr_domain_displace(ctx, &before, height, 1, p);
	*surface = before.m;
	*foot = before.m.p;
	surface->p = p;
	return mr_edges_build(ctx, surface, edges);
}

/* The same of the frame, kept as long as it is. */
static mr_status
find_encoded(mr_ctx *ctx, mr_cache *cache, mr_frame *f, const mr_domain *d, const double *height,
    mr_mesh *surface, mr_edges *edges, const mr_v3 **foot)
{
	mr_connectivity_cache *kept = cache ? &cache->connectivity : NULL;
	mr_ctx *keep = cache ? &cache->displaced_keep : ctx;
	uint64_t heights = mr_frame_find(f, "displacement", "height")->serial;
	mr_mesh encoded;
	const void *p;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &encoded));
	MR_TRY(mr_layer_get_rows(ctx, f, "control", "encoded", encoded.nv, &p));
	encoded.p = p;
	if (!kept)
		return build_encoded(ctx, d, &encoded, height, surface, edges, foot);
	if (kept->height_serial != heights)
		kept->displaced_serial = 0;
	if (!still_there(ctx, f, "control", "encoded", &kept->displaced_serial, keep)) {
		MR_TRY(mr_fail_as(ctx, keep,
		    build_encoded(keep, d, &encoded, height, &kept->displaced, &kept->displaced_edges,
			&kept->displaced_foot)));
		kept->displaced_serial = mr_frame_find(f, "control", "encoded")->serial;
		kept->height_serial = heights;
	}
	*surface = kept->displaced;
	*edges = kept->displaced_edges;
	*foot = kept->displaced_foot;
	return MR_OK;
}

/* Of each vertex over d the region of the control vertices that it lies between, free where these have
 * several. */
static mr_status
regions_of_levels(mr_ctx *ctx, const mr_domain *d, const uint32_t *control, const uint32_t **region)
{
	uint32_t *r = MR_NEW(ctx, d->m.nv, uint32_t);

	if (!r)
		return MR_EMEM;
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
	return MR_OK;
}

/* What posing it has done to the surface over d.  m: its mesh at a gain of 1; foot: what
 * that stood on. */
static mr_status
look_at_control(mr_ctx *ctx, const mr_moved *m, const mr_domain *d, const mr_mesh *control, const mr_v3 *foot)
{
	mr_mesh surface = *m->mesh, encoded = *control;
	mr_held_pose pose = {
		.mesh = &surface, .base = &encoded, .p = m->p, .on_base = control->p, .foot = foot
	};
	mr_v3 *at = MR_NEW(ctx, surface.nv, mr_v3);
	const void *p;

	if (!mr_layer_has(m->f, "control", "region"))
		return MR_OK;
	if (!at)
		return MR_EMEM;
	for (size_t v = 0; v < surface.nv; v++)
		at[v] = mr_lerp(m->gain, foot[v], surface.p[v]);
	surface.p = at;
	MR_TRY(mr_layer_get_rows(ctx, m->f, "control", "encoded", encoded.nv, &p));
	encoded.p = p;
	MR_TRY(mr_layer_region(ctx, m->f, "control", control->nv, &pose.base_region));
	MR_TRY(regions_of_levels(ctx, d, pose.base_region, &pose.region));
	return mr_moved_pose(ctx, m, &pose);
}

/* What posing the control mesh, or the gain, has done to the surface, now at p. */
static mr_status
look_at_displaced(mr_ctx *ctx, mr_frame *f, mr_cache *cache, const mr_domain *d, const mr_mesh *control,
    const double *height, double gain, const mr_v3 *p, mr_decode_result *result)
{
	bool posed = mr_layer_has(f, "control", "encoded");
	mr_mesh before;
	mr_edges edges;
	mr_moved m = { f, cache, &before, &edges, p, NULL, NULL, NULL, gain, result };
	const mr_v3 *foot;

	if (posed)
		MR_TRY(find_encoded(ctx, cache, f, d, height, &before, &edges, &foot));
	else if (gain != 1)
		MR_TRY(build_encoded(ctx, d, control, height, &before, &edges, &foot));
	else
		return MR_OK;
	MR_TRY(mr_moved_harm(ctx, &m));
	return posed ? look_at_control(ctx, &m, d, control, foot) : MR_OK;
}

/* What mr-sample found of the points' columns at the vertices, those of coarse levels first. */
static mr_status
put_columns(mr_ctx *ctx, mr_frame *f, size_t nv)
{
	size_t n = f->count, bytes;
	const void *types;

	for (size_t i = 0; i < n; i++) {
		mr_column *c = &f->columns[i];
		if (!mr_column_carried(c, "displacement"))
			continue;
		MR_TRY(mr_column_decode(ctx, c));
		if (c->rows < nv)
			return mr_fail(ctx, MR_ERANGE, "displacement: %s has %llu rows for %zu vertices",
			    c->name, (unsigned long long)c->rows, nv);
		MR_TRY(mr_frame_put(ctx, f, "mesh", c->name, c->shape, c->data, nv));
	}
	if (!mr_layer_has(f, "displacement", "properties"))
		return MR_OK;
	MR_TRY(mr_layer_get(ctx, f, "displacement", "properties", &types, &bytes));
	return mr_layer_put(ctx, f, "mesh", "properties", types, bytes);
}

/* Takes those of before away, so that nothing is said to be lost that is not. */
static void
drop_columns(mr_frame *f)
{
	for (size_t i = f->count; i-- > 0;) {
		char name[MR_COLUMN_MAX + 1];
		snprintf(name, sizeof name, "%s", f->columns[i].name);
		if (mr_column_carried(&f->columns[i], "mesh") && mr_layer_has(f, "displacement", name))
			mr_frame_drop(f, "mesh", name, 0);
	}
}

/* Level J of the surface needs the first heights alone. */
static mr_status
decode_control(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, mr_cache *cache, mr_decode_result *result)
{
	const mr_loop *refined;
	const double *height;
	bool posed = mr_layer_has(f, "handles", "transform") || mr_layer_has(f, "control", "encoded");
	mr_mesh control;
	mr_domain d;
	mr_v3 *p;
	size_t n;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	MR_TRY(mr_displacement_get(ctx, f, &control, &n, &height));
	if (o->level != MR_UNKNOWN && o->level > n)
		return mr_fail(
		    ctx, MR_ERANGE, "--level %zu, but displacement ends with level %zu", o->level, n);
	if (o->level != MR_UNKNOWN)
		n = o->level;
	MR_TRY(respond(ctx, f, cache, &control));
	MR_TRY(mr_cache_levels(ctx, cache, f, &control, 180, n, &refined));
	MR_TRY(mr_domain_on(ctx, &control, refined, n, &d));
	p = MR_NEW(ctx, d.m.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	mr_domain_displace(ctx, &d, height, o->gain, p);
	if (!o->blind)
		MR_TRY(look_at_displaced(ctx, f, cache, &d, &control, height, o->gain, p, result));
	if (f->key && mr_layer_has(f, "mesh", "detail_face"))
		mr_warn(ctx,
		    "mesh, which has detail over base, is made anew from control, without what base has "
		    "done to it");
	else
		MR_TRY(mr_displaced_warn_of_change(ctx, f, &control, &d, o->gain == 1 && !posed ? p : NULL));
	d.m.p = p;
	drop_columns(f);
	MR_TRY(mr_layer_replace(ctx, f, "mesh", &d.m));
	MR_TRY(mr_layer_followed(ctx, f, "control"));
	MR_TRY(mr_layer_followed(ctx, f, "displacement"));
	MR_TRY(put_columns(ctx, f, d.m.nv));
	return mr_layer_warn_of_rest(ctx, f, "mesh", "control");
}

/* How far mesh is from the points, where it is known how these lie. */
static mr_status
look_at_gaps(mr_ctx *ctx, mr_frame *f, mr_gaps *gaps)
{
	mr_sampling sampling;
	mr_mesh points, mesh;
	bool known;

	if (!mr_layer_has(f, "points", "sampling"))
		return MR_OK;
	MR_TRY(mr_layer_points(ctx, f, "points", &points));
	MR_TRY(mr_sampling_stored(ctx, f, "points", points.nv, &sampling, &known));
	MR_TRY(mr_layer_mesh(ctx, f, "mesh", &mesh));
	return known ? mr_gaps_measure(ctx, &mesh, points.p, &sampling, gaps) : MR_OK;
}

/* Whether it is the control mesh that handles pose, or else that, or the heights over it, that were worked on
 * last. */
static mr_status
is_control_latest(mr_ctx *ctx, mr_frame *f, bool *is)
{
	bool base = mr_layer_has(f, "base", "response"), control = mr_layer_has(f, "control", "response");
	const char *latest;

	MR_TRY(mr_layer_latest(ctx, f, &latest));
	*is = latest && (!strcmp(latest, "displacement") || !strcmp(latest, "control"));
	if (mr_layer_has(f, "handles", "transform") && base != control)
		*is = control;
	*is = *is && mr_frame_has_layer(f, "displacement");
	return MR_OK;
}

static mr_status
choose(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, int *from)
{
	bool detail = mr_layer_has(f, "mesh", "detail_face"), control;

	*from = o->from;
	if (o->from != MR_FROM_ANY)
		return MR_OK;
	if (!detail && !mr_frame_has_layer(f, "displacement"))
		return mr_fail(ctx, MR_EMISSING,
		    "neither detail of mesh, which mr-encode makes, nor displacement, which mr-sample makes");
	MR_TRY(is_control_latest(ctx, f, &control));
	*from = detail && !control ? MR_FROM_DETAIL : MR_FROM_CONTROL;
	if (*from == MR_FROM_DETAIL && o->level != MR_UNKNOWN)
		return mr_fail(ctx, MR_EUSAGE, "--level has no effect on the detail that is here%s",
		    mr_frame_has_layer(f, "displacement") ? ": --from control" : "");
	return MR_OK;
}

/* gaps: whether those are looked at. */
static mr_status
decode(
    mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, mr_cache *cache, bool gaps, mr_decode_result *result)
{
	int from;

	mr_unmeasured(result, sizeof *result);
	MR_TRY(mr_check_number(ctx, "gain", o->gain, -1e6, 1e6));
	MR_TRY(mr_check_choice(ctx, "from", o->from, MR_FROM_CONTROL));
	MR_TRY(choose(ctx, f, o, &from));
	if (mr_layer_has(f, from == MR_FROM_DETAIL ? "base" : "control", "target"))
		return mr_fail(ctx, MR_EMISSING,
		    "%s has targets and has not gone there: mr-solve comes before",
		    from == MR_FROM_DETAIL ? "base" : "control");
	if (from == MR_FROM_DETAIL)
		MR_TRY(decode_detail(ctx, f, o, cache, result));
	else
		MR_TRY(decode_control(ctx, f, o, cache, result));
	mr_frame_drop(f, "handles", NULL, 0);
	mr_frame_drop(f, "base", "before", 0);
	return gaps && from == MR_FROM_CONTROL ? look_at_gaps(ctx, f, &result->gaps) : MR_OK;
}

mr_status
mr_decode_frame(
    mr_ctx *ctx, mr_frame *f, const mr_decode_opts *opts, mr_cache *cache, mr_decode_result *result)
{
	static const mr_decode_opts defaults = MR_DECODE_DEFAULTS;
	mr_decode_result r;
	mr_frame done;

	MR_TRY(mr_frame_copy(ctx, f, &done));
	MR_TRY(decode(ctx, &done, opts ? opts : &defaults, cache, result, &r));
	return mr_frame_finish(f, &done, result, &r, sizeof r);
}
