/* mr-encode -- store a mesh as detail over its base surface.  See man/mr-encode.1. */
#include "alg/detail.h"
#include "cmd.h"
#include "mesh/layers.h"

static mr_status
put_detail(mr_ctx *ctx, mr_frame *f, const mr_detail *d)
{
	MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_face", d->face, d->n));
	MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_bary", d->bary, d->n));
	MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_height", d->height, d->n));
	if (d->offset)
		return mr_layer_put(ctx, f, "mesh", "detail_offset", d->offset, d->n);
	mr_frame_drop(f, "mesh", "detail_offset", 0);
	return MR_OK;
}

static mr_status
encode_frame(cmd *c, mr_frame *f)
{
	bool mapped = mr_layer_has(f, "base", "source_face");
	mr_mesh mesh, base;
	mr_source_map map;
	mr_detail detail;

	MR_TRY(mr_layer_points(&c->ctx, f, "mesh", &mesh));
	if (mr_layer_has(f, "mesh", "triangles"))
		MR_TRY(mr_layer_mesh(&c->ctx, f, "mesh", &mesh));
	MR_TRY(mr_layer_mesh(&c->ctx, f, "base", &base));
	if (mapped)
		MR_TRY(mr_source_map_get(&c->ctx, f, &mesh, base.nv, &map));
	MR_TRY(mr_encode(&c->ctx, &mesh, &base, mapped ? &map : NULL, &detail));
	return put_detail(&c->ctx, f, &detail);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "store a mesh as detail over its base surface", .frame = encode_frame });
}
