/* mr-decode: the reconstruction operator of both papers, detail onto a base or heights onto a subdivision
 * surface, posed by its response first where handles are there. */
#include "edit/detail.h"
#include "edit/pose_basis.h"
#include "tool/cache.h"

/* The faces around the vertices of base, which a delta mostly keeps. */
static mr_status
base_incidence(mr_ctx *ctx, mr_cache *cache, const mr_frame *f, const mr_mesh *base, mr_incidence *inc)
{
	uint64_t serial = mr_frame_find(f, base->name, "triangles")->serial;
	mr_incidence_cache *kept = cache ? &cache->incidence : NULL;
	mr_ctx *keep;

	if (!cache)
		return mr_incidence_build(ctx, base, inc);
	if (f->key || !serial || serial != kept->serial) {
		keep = mr_cache_arena(ctx, &cache->incidence_keep);
		mr_ctx_free(keep);
		kept->serial = 0;
		MR_TRY(mr_cache_say(ctx, keep, mr_incidence_build(keep, base, &kept->inc)));
		kept->serial = serial;
	}
	*inc = kept->inc;
	return MR_OK;
}

static mr_status
decode_detail(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, mr_cache *cache)
{
	mr_incidence inc;
	mr_detail detail;
	mr_mesh base;
	mr_v3 *p;

	MR_TRY(mr_layer_mesh(ctx, f, "base", &base));
	MR_TRY(base_incidence(ctx, cache, f, &base, &inc));
	MR_TRY(mr_response_apply(ctx, f, &base));
	MR_TRY(mr_detail_get(ctx, f, &base, &detail));
	p = MR_NEW(ctx, detail.n, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_decode(ctx, &base, &inc, &detail, o->gain, p));
	return mr_layer_move(ctx, f, "mesh", MR_POSED, p, detail.n);
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
		    ctx, MR_ERANGE, "--level %zu, but displacement ends with level %zu", o->level, n);
	if (o->level != MR_UNKNOWN)
		n = o->level;
	MR_TRY(mr_response_apply(ctx, f, &control));
	MR_TRY(mr_cache_levels(ctx, cache, f, &control, 180, n, &refined));
	MR_TRY(mr_domain_on(ctx, &control, refined, n, &d));
	p = MR_NEW(ctx, d.m.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	mr_domain_displace(ctx, &d, height, o->gain, p);
	d.m.p = p;
	return mr_layer_put_mesh(ctx, f, "mesh", &d.m);
}

static mr_status
choose(mr_ctx *ctx, const mr_frame *f, const mr_decode_opts *o, int *from)
{
	bool detail = mr_layer_has(f, "mesh", "detail_face");

	*from = o->from;
	if (o->from != MR_FROM_ANY)
		return MR_OK;
	if (!detail && !mr_frame_has_layer(f, "displacement"))
		return mr_fail(ctx, MR_EMISSING,
		    "neither detail of mesh, which mr-encode makes, nor displacement, which mr-sample makes");
	*from = detail ? MR_FROM_DETAIL : MR_FROM_CONTROL;
	if (detail && o->level != MR_UNKNOWN)
		return mr_fail(
		    ctx, MR_EUSAGE, "--level has no effect on the detail that is here: --from control");
	return MR_OK;
}

mr_status
mr_decode_frame(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *opts, mr_cache *cache)
{
	static const mr_decode_opts defaults = MR_DECODE_DEFAULTS;
	const mr_decode_opts *o = opts ? opts : &defaults;
	int from;

	MR_TRY(choose(ctx, f, o, &from));
	return from == MR_FROM_DETAIL ? decode_detail(ctx, f, o, cache) : decode_control(ctx, f, o, cache);
}
