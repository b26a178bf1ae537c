/* mr-encode -- store a mesh as detail over its base surface.  See man/mr-encode.1. */
#include "edit/detail.h"
#include "cmd.h"
#include "mesh/layers.h"

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
	return mr_detail_put(&c->ctx, f, &detail);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "store a mesh as detail over its base surface",
		.frame = encode_frame,
		.fixed_layers = true });
}
