/* mr-remesh: a base, or a mesh, to an isotropic base; its places on the mesh are composed with those there
 * are.
 */
#include "remesh/remesh.h"

mr_status
mr_remesh_frame(mr_ctx *ctx, mr_frame *f, const mr_remesh_opts *opts, mr_remesh_result *result)
{
	static const mr_remesh_opts defaults = MR_REMESH_DEFAULTS;
	static const char *const reads[] = { "base", "mesh", NULL };
	const mr_remesh_opts *o = opts ? opts : &defaults;
	mr_places over, map;
	const char *layer;
	mr_mesh m, out;
	bool mapped;

	MR_TRY(mr_layer_choose_warned(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	MR_TRY(mr_remesh(ctx, &m, o, &out, &over, result));
	MR_TRY(mr_source_map_follow(ctx, f, &m, &over, out.nv, &map, &mapped));
	MR_TRY(mr_layer_put_mesh(ctx, f, "base", &out));
	return mapped ? mr_source_map_put(ctx, f, &map, out.nv) : MR_OK;
}
