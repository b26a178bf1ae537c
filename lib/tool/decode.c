/* mr-decode: the reconstruction operator of both papers, detail onto a base or heights onto a subdivision
 * surface, posed by its response first where handles are there. */
#include "base/options.h"
#include "edit/detail.h"
#include "edit/handles.h"
#include "judge/mend.h"
#include "space/carry.h"
#include "tool/cache.h"

/* Base where it was encoded. */
static const mr_prepared *
prepared_at_rest(mr_ctx *ctx, mr_rest_cache *kept, const mr_frame *f, mr_mesh rest)
{
	uint64_t triangles = mr_frame_find(f, rest.name, "triangles")->serial,
		 encoded = mr_frame_find(f, rest.name, "encoded")->serial;
	mr_ctx *keep = mr_keep(ctx, &kept->keep);

	if (!f->key && kept->triangles == triangles && kept->encoded == encoded)
		return kept->prepared;
	mr_ctx_free(keep);
	kept->triangles = 0;
	kept->prepared = mr_detail_prepare(keep, &rest);
	kept->triangles = triangles;
	kept->encoded = encoded;
	return kept->prepared;
}

/* Marks the constrained vertices; NULL without any. */
static mr_status
find_held(mr_ctx *ctx, mr_frame *f, size_t nv, bool **held)
{
	const uint32_t *region;

	*held = NULL;
	if (!mr_layer_has(f, "mesh", "region"))
		return MR_OK;
	MR_TRY(mr_layer_region(ctx, f, "mesh", nv, &region));
	*held = MR_NEW(ctx, nv, bool);
	for (size_t v = 0; v < nv; v++)
		(*held)[v] = region[v] != MR_REGION_FREE;
	return MR_OK;
}

/* Mends the decoded positions p of mesh after a pose of base. */
static mr_status
mend(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, const mr_detail *d, mr_v3 *p)
{
	mr_v3 *rest;
	mr_mesh mesh;
	bool *held;

	if (!mr_layer_has(f, "mesh", "triangles") || !memcmp(base->p, d->rest, base->nv * sizeof *base->p))
		return MR_OK;
	MR_TRY(mr_layer_mesh_of_any_size(ctx, f, "mesh", &mesh));
	MR_TRY(find_held(ctx, f, mesh.nv, &held));
	rest = MR_NEW(ctx, d->n, mr_v3);
	mr_detail_at_rest(ctx, base, d, rest);
	mesh.p = rest;
	mr_mend(ctx, &mesh, held, p);
	return MR_OK;
}

static mr_status
decode_detail(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, mr_rest_cache *kept)
{
	mr_detail detail;
	mr_mesh base, rest;
	mr_v3 *p;

	MR_TRY(mr_layer_mesh(ctx, f, "base", &base));
	MR_TRY(mr_response_apply(ctx, f, &base));
	MR_TRY(mr_detail_get(ctx, f, &base, &detail));
	rest = base;
	rest.p = detail.rest;
	detail.prepared = prepared_at_rest(ctx, kept, f, rest);
	p = MR_NEW(ctx, detail.n, mr_v3);
	MR_TRY(mr_decode(ctx, &base, &detail, o->gain, p));
	if (o->gain == 1 && (o->mend == MR_MEND_ALL || (o->mend == MR_MEND_KEYS && f->key)))
		MR_TRY(mend(ctx, f, &base, &detail, p));
	MR_TRY(mr_layer_move(ctx, f, "mesh", MR_POSED, p, detail.n));
	return mr_layer_followed(ctx, f, "base");
}

/* The points' columns at the vertices by mr-sample, coarse levels first. */
static mr_status
put_columns(mr_ctx *ctx, mr_frame *f, size_t nv)
{
	size_t n = f->count;

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
	return MR_OK;
}

/* Removes the old ones, so that they are not reported as lost. */
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

/* Puts the surface in the place of the mesh that the control mesh was made of, and what the mesh knows on it;
 * not once the control mesh has moved. */
static mr_status
replace_mesh(mr_ctx *ctx, mr_frame *f, const mr_mesh *out)
{
	mr_carried *carried;
	mr_topology topo;
	mr_mesh m;
	bool in_place;
	size_t n = 0;

	MR_TRY(mr_layer_is_as_encoded(ctx, f, "control", &in_place));
	if (in_place && mr_layer_has(f, "mesh", "triangles") && mr_layer_carries(f, "mesh")) {
		MR_TRY(mr_layer_mesh(ctx, f, "mesh", &m));
		if ((m.nf != out->nf || memcmp(m.t, out->t, m.nf * sizeof *m.t) != 0) &&
		    mr_topology_build(ctx, &m, &topo) == MR_OK)
			MR_TRY(mr_carry_nearest(ctx, f, &m, out, &carried, &n));
	}
	MR_TRY(mr_layer_replace(ctx, f, "mesh", out));
	return n > 0 ? mr_carried_put(ctx, f, "mesh", carried, n) : MR_OK;
}

/* Level J of the surface needs the first heights alone. */
static mr_status
decode_control(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, mr_cache *cache)
{
	const mr_loop *refined;
	const double *height;
	mr_mesh control;
	mr_domain d;
	mr_v3 *p;
	size_t n;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	MR_TRY(mr_displacement_get(ctx, f, &control, &n, &height));
	if (o->level != MR_UNKNOWN && o->level > n)
		return mr_fail(
		    ctx, MR_ERANGE, "level %zu, but displacement ends with level %zu", o->level, n);
	if (o->level != MR_UNKNOWN)
		n = o->level;
	MR_TRY(mr_response_apply(ctx, f, &control));
	MR_TRY(mr_level_cache_get(&cache->level, ctx, f, &control, 180, n, &refined));
	mr_domain_on(ctx, &control, refined, n, &d);
	p = MR_NEW(ctx, d.m.nv, mr_v3);
	mr_domain_displace(ctx, &d, height, o->gain, p);
	d.m.p = p;
	drop_columns(f);
	MR_TRY(replace_mesh(ctx, f, &d.m));
	MR_TRY(mr_layer_followed(ctx, f, "control"));
	MR_TRY(mr_layer_followed(ctx, f, "displacement"));
	return put_columns(ctx, f, d.m.nv);
}

/* Whether handles pose control, or else it, or the heights over it, were worked on last. */
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
		return mr_advise(
		    ctx, MR_ENCODE, mr_fail(ctx, MR_EMISSING, "neither detail of mesh nor displacement"));
	MR_TRY(is_control_latest(ctx, f, &control));
	*from = detail && !control ? MR_FROM_DETAIL : MR_FROM_CONTROL;
	if (*from == MR_FROM_DETAIL && o->level != MR_UNKNOWN)
		return mr_fail(ctx, MR_EUSAGE, "a level has no effect on the detail that is here");
	return MR_OK;
}

static mr_status
decode(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, mr_cache *cache)
{
	int from;

	MR_TRY(mr_check_number(ctx, "gain", o->gain, -1e6, 1e6));
	MR_TRY(mr_check_choice(ctx, "from", o->from, MR_FROM_CONTROL));
	MR_TRY(mr_check_choice(ctx, "mend", o->mend, MR_MEND_NONE));
	MR_TRY(choose(ctx, f, o, &from));
	if (from == MR_FROM_DETAIL)
		MR_TRY(decode_detail(ctx, f, o, &cache->rest));
	else
		MR_TRY(decode_control(ctx, f, o, cache));
	mr_frame_drop(f, "handles", NULL, 0);
	mr_frame_drop(f, "base", "before", 0);
	return MR_OK;
}

mr_status
mr_decode_frame(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *opts, mr_cache *cache)
{
	static const mr_decode_opts defaults = MR_DECODE_DEFAULTS;

	MR_ON_COPY(
	    ctx, f, done, NULL, done, decode(ctx, &done, opts ? opts : &defaults, mr_cache_for(ctx, cache)));
}
