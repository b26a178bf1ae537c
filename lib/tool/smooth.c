/* mr-smooth: a mesh, or a base again, to a smooth base that knows where its vertices lie on the mesh. */
#include "edit/smooth.h"

#include "base/options.h"
#include "space/source_map.h"

static const mr_smooth_opts defaults = MR_SMOOTH_DEFAULTS;

static mr_status
smooth(mr_ctx *ctx, mr_frame *f, const mr_smooth_opts *o, mr_smooth_result *r)
{
	static const char *const reads[] = { "base", "mesh", NULL };
	mr_places map;
	const char *layer;
	bool from_mesh;
	mr_mesh m;
	mr_v3 *p;

	MR_TRY(mr_check_choice(ctx, "method", o->method, MR_SMOOTH_TAUBIN));
	MR_TRY(mr_check_number(ctx, "time", o->time, 0, 1e9));
	MR_TRY(mr_layer_choose_warned(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	from_mesh = !strcmp(layer, "mesh");
	p = MR_NEW(ctx, m.nv, mr_v3);
	MR_TRY(mr_smooth(ctx, &m, o, p, r));
	if (from_mesh)
		mr_source_map_identity(ctx, &m, &map);
	m.p = p;
	MR_TRY(mr_layer_put_mesh(ctx, f, "base", &m));
	return from_mesh ? mr_source_map_put(ctx, f, &map, m.nv) : MR_OK;
}

mr_status
mr_smooth_frame(mr_ctx *ctx, mr_frame *f, const mr_smooth_opts *opts, mr_smooth_result *result)
{
	mr_smooth_result r;

	MR_ON_COPY(ctx, f, done, result, r, smooth(ctx, &done, opts ? opts : &defaults, &r));
}
