/* mr-encode -- store a mesh as detail over its base surface.  See man/mr-encode.1. */
#include "alg/detail.h"
#include "cmd.h"
#include "mesh/layers.h"

/* The source map, where the base has one; else *map is NULL. */
static mr_status
read_source(
    mr_ctx *ctx, mr_frame *f, const mr_mesh *mesh, const mr_mesh *base, mr_source *s, const mr_source **map)
{
	const void *face, *bary;

	*map = NULL;
	if (!mr_layer_has(f, "base", "source_face"))
		return MR_OK;
	MR_TRY(mr_layer_get_rows(ctx, f, "base", "source_face", base->nv, &face));
	MR_TRY(mr_layer_get_rows(ctx, f, "base", "source_bary", base->nv, &bary));
	*s = (mr_source){ face, bary };
	*map = s;
	return mr_source_check(ctx, mesh, base, s);
}

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
	const mr_source *map;
	mr_mesh mesh, base;
	mr_source source;
	mr_detail detail;

	MR_TRY(mr_layer_points(&c->ctx, f, "mesh", &mesh));
	if (mr_layer_has(f, "mesh", "triangles"))
		MR_TRY(mr_layer_mesh(&c->ctx, f, "mesh", &mesh));
	MR_TRY(mr_layer_mesh(&c->ctx, f, "base", &base));
	MR_TRY(read_source(&c->ctx, f, &mesh, &base, &source, &map));
	MR_TRY(mr_encode(&c->ctx, &mesh, &base, map, &detail));
	return put_detail(&c->ctx, f, &detail);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "store a mesh as detail over its base surface", .frame = encode_frame });
}
