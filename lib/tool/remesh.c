/* mr-remesh: a base, or a mesh, to an isotropic base; its places on the mesh are composed with those there
 * are.
 */
#include "remesh/remesh.h"

#include "base/options.h"

static mr_status
check_options(mr_ctx *ctx, const mr_remesh_opts *o)
{
	MR_TRY(mr_check_number(ctx, "length", o->length, 0, 1e300));
	MR_TRY(mr_check_number(ctx, "ratio", o->ratio, 1e-6, 1e6));
	MR_TRY(mr_check_number(ctx, "gravity", o->gravity, 0, 4));
	MR_TRY(mr_check_number(ctx, "feature", o->feature, 0, 180));
	return mr_check_number(ctx, "adaptive", o->adaptive, 0, 1e300);
}

static mr_status
remesh(mr_ctx *ctx, mr_frame *f, const mr_remesh_opts *o, mr_remesh_result *r)
{
	static const char *const reads[] = { "base", "mesh", NULL };
	mr_places over, map;
	const char *layer;
	mr_mesh m, out;
	bool mapped;

	MR_TRY(check_options(ctx, o));
	MR_TRY(mr_layer_choose_warned(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	MR_TRY(mr_remesh(ctx, &m, o, &out, &over, r));
	MR_TRY(mr_source_map_follow(ctx, f, &m, &over, out.nv, &map, &mapped));
	MR_TRY(mr_layer_put_mesh(ctx, f, "base", &out));
	return mapped ? mr_source_map_put(ctx, f, &map, out.nv) : MR_OK;
}

mr_status
mr_remesh_frame(mr_ctx *ctx, mr_frame *f, const mr_remesh_opts *opts, mr_remesh_result *result)
{
	static const mr_remesh_opts defaults = MR_REMESH_DEFAULTS;
	mr_remesh_result r;

	MR_ON_COPY(ctx, f, done, result, r, remesh(ctx, &done, opts ? opts : &defaults, &r));
}
