/* mr-encode: the mesh as detail over its base. */
#include "edit/detail.h"

/* A pose that mesh has not followed is lost to it. */
static mr_status
look_for_pose(mr_ctx *ctx, mr_frame *f)
{
	bool posed;

	MR_TRY(mr_layer_is_posed(ctx, f, "base", &posed));
	posed |= mr_layer_has(f, "base", "before");
	if (posed && f->key)
		mr_found(ctx, &(mr_finding){ .kind = MR_STALE,
				  .layer = "base",
				  .what = "its pose, which mesh has not followed," });
	return MR_OK;
}

static mr_status
encode(mr_ctx *ctx, mr_frame *f, mr_encode_result *result)
{
	bool mapped = mr_layer_has(f, "base", "source_face");
	mr_mesh mesh, base;
	mr_places map;
	mr_detail detail;

	MR_TRY(look_for_pose(ctx, f));
	MR_TRY(mr_layer_points(ctx, f, "mesh", &mesh));
	if (mr_layer_has(f, "mesh", "triangles"))
		MR_TRY(mr_layer_mesh(ctx, f, "mesh", &mesh));
	MR_TRY(mr_layer_mesh(ctx, f, "base", &base));
	if (mapped)
		MR_TRY(mr_source_map_get(ctx, f, &mesh, base.nv, &map));
	MR_TRY(mr_encode(ctx, &mesh, &base, mapped ? &map : NULL, &detail, result));
	return mr_detail_put(ctx, f, &base, &detail);
}

mr_status
mr_encode_frame(mr_ctx *ctx, mr_frame *f, mr_encode_result *result)
{
	mr_encode_result r;

	MR_ON_COPY(ctx, f, done, result, r, encode(ctx, &done, &r));
}
