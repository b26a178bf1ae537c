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
align(mr_ctx *ctx, mr_frame *f, mr_frame *reference, const mr_align_opts *o, mr_align_result *r)
{
	const mr_shape shape = { '-', 'd', 12 };
	const char *a, *b, *result;
	mr_align_side from, to;
	mr_mesh ma, mb;
	double *map;

	MR_TRY(mr_layer_result(ctx, f, o->from ? o->from : o->layer, &a));
	MR_TRY(mr_layer_result(ctx, reference, o->from, &result));
	b = mr_frame_has_layer(reference, a) ? a : result;
	MR_TRY(read_side(ctx, f, a, &ma, &from));
	MR_TRY(read_side(ctx, reference, b, &mb, &to));
	MR_TRY(mr_align(ctx, from, to, o->scale, r));
	if (!r->found) {
		const mr_affine none = mr_identity();
		memcpy(r->map, none.m, sizeof r->map);
		mr_found(ctx, &(mr_finding){ .kind = MR_UNALIGNED,
				  .layer = a,
				  .what = "no motion was found that fits it to the reference" });
		return MR_OK;
	}
	MR_TRY(mr_transform_frame(ctx, f, o->layer, r->map));
	map = MR_NEW(ctx, 12, double);
	memcpy(map, r->map, sizeof r->map);
	return mr_frame_put(ctx, f, "", "transform", shape, map, 1);
}

mr_status
mr_align_frame(
    mr_ctx *ctx, mr_frame *f, mr_frame *reference, const mr_align_opts *opts, mr_align_result *result)
{
	static const mr_align_opts defaults = MR_ALIGN_DEFAULTS;
	mr_align_result r = { 0 };

	MR_ON_COPY(ctx, f, done, result, r, align(ctx, &done, reference, opts ? opts : &defaults, &r));
}
