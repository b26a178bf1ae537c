/* mr-remesh: a base, or a mesh, to an isotropic base; its places on the mesh are composed with those there
 * are.
 */
#include "remesh/remesh.h"

/*
 * Warns of area that is lost: edges cut across what is thinner than they are long.  Of 98 models as they were
 * imported 15 lose this share, five of these over half: bodies of a few long faces.
 */
static void
look_at_area(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out)
{
	const double much = 0.1;
	double before = mr_mesh_area(ctx, m), lost = 1 - mr_mesh_area(ctx, out) / before;

	if (before > 0 && lost > much)
		mr_warn(ctx,
		    "%s: %.2g %% of its area is lost: edges of about %.3g cut across what is thinner or more "
		    "tightly bent; shorter ones, by -L, keep more",
		    m->name, 100 * lost, mr_mesh_edge_scale(ctx, out));
}

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
	look_at_area(ctx, &m, &out);
	MR_TRY(mr_source_map_follow(ctx, f, &m, &over, out.nv, &map, &mapped));
	MR_TRY(mr_layer_put_mesh(ctx, f, "base", &out));
	return mapped ? mr_source_map_put(ctx, f, &map, out.nv) : MR_OK;
}
