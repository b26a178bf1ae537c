/* mr-align: a frame onto another. */
#include "align/align.h"

#include "mesh/layers.h"

/* A layer to match, and of a cloud its normals. */
static mr_status
read_side(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m, mr_align_side *s)
{
	const void *normal = NULL;

	MR_TRY(mr_layer_surface_or_points(ctx, f, layer, m));
	if (!m->nf && mr_layer_has(f, layer, "normal"))
		MR_TRY(mr_layer_get_rows(ctx, f, layer, "normal", m->nv, &normal));
	*s = (mr_align_side){ m, normal };
	return MR_OK;
}

static mr_status
put(mr_ctx *ctx, mr_frame *f, const mr_align_opts *o, const mr_align_result *r)
{
	const mr_shape shape = { '-', 'd', 12 };
	const char *layer;
	double *map;

	if (!r->found || !r->sure) {
		MR_TRY(mr_layer_result(ctx, f, o->from ? o->from : o->layer, &layer));
		mr_found(ctx, &(mr_finding){ .kind = MR_UNALIGNED,
				  .layer = layer,
				  .what = r->found ? "another place fits nearly as well"
		                                   : "no motion was found that fits it" });
	}
	if (!r->found)
		return MR_OK;
	MR_TRY(mr_transform_frame(ctx, f, o->layer, r->map));
	map = MR_NEW(ctx, 12, double);
	memcpy(map, r->map, sizeof r->map);
	return mr_frame_put(ctx, f, "", "transform", shape, map, 1);
}

/* Without a motion the map is the identity. */
static void
stay(mr_align_result *r)
{
	const mr_affine none = mr_identity();

	if (!r->found)
		memcpy(r->map, none.m, sizeof r->map);
}

static mr_status
align(mr_ctx *ctx, mr_frame *f, mr_frame *reference, const mr_align_opts *o, mr_align_result *r)
{
	const char *a, *b, *result;
	mr_align_side from, to;
	mr_mesh ma, mb;

	MR_TRY(mr_layer_result(ctx, f, o->from ? o->from : o->layer, &a));
	MR_TRY(mr_layer_result(ctx, reference, o->from, &result));
	b = mr_frame_has_layer(reference, a) ? a : result;
	MR_TRY(read_side(ctx, f, a, &ma, &from));
	MR_TRY(read_side(ctx, reference, b, &mb, &to));
	MR_TRY(mr_align(ctx, from, to, o->scale, r));
	stay(r);
	return put(ctx, f, o, r);
}

mr_status
mr_align_frame(
    mr_ctx *ctx, mr_frame *f, mr_frame *reference, const mr_align_opts *opts, mr_align_result *result)
{
	static const mr_align_opts defaults = MR_ALIGN_DEFAULTS;
	mr_align_result r = { 0 };

	MR_ON_COPY(ctx, f, done, result, r, align(ctx, &done, reference, opts ? opts : &defaults, &r));
}

mr_status
mr_align_frames(mr_ctx *ctx, mr_frame *const *f, size_t n, const mr_align_opts *o, mr_align_result *r)
{
	MR_ENTER(ctx);
	MR_SCOPE(ctx);
	mr_align_side *side = MR_NEW(ctx, n, mr_align_side);
	mr_mesh *m = MR_NEW(ctx, n, mr_mesh);
	const char *layer;

	for (size_t i = 0; i < n; i++) {
		MR_TRY(mr_layer_result(ctx, f[i], o->from ? o->from : o->layer, &layer));
		MR_TRY(mr_prefix(ctx, read_side(ctx, f[i], layer, &m[i], &side[i]), "%s", f[i]->name));
	}
	MR_TRY(mr_align_all(ctx, side, n, r));
	for (size_t i = 0; i < n; i++)
		stay(&r[i]);
	return MR_OK;
}

mr_status
mr_align_put(mr_ctx *ctx, mr_frame *f, const mr_align_opts *o, const mr_align_result *r)
{
	MR_ON_COPY(ctx, f, done, NULL, done, put(ctx, &done, o, r));
}
