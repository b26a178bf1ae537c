/* mr-shrinkwrap: points to a control mesh around them. */
#include "wrap/shrinkwrap.h"

#include "mesh/layers.h"

/* The triangles stay, and with them all that the layer has but what followed from the positions. */
static mr_status
wrap_control(mr_ctx *ctx, mr_frame *f, const mr_mesh *points, const mr_sampling *sampling,
    const mr_wrap_opts *o, mr_wrap_result *result)
{
	mr_mesh control;
	mr_v3 *p;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	p = MR_NEW(ctx, control.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_prefix(ctx, mr_wrap_template(ctx, points->p, points->nv, sampling, &control, o, p, result),
	    "%s", points->name));
	return mr_layer_move(ctx, f, "control", MR_RESHAPED, p, control.nv);
}

mr_status
mr_shrinkwrap_frame(mr_ctx *ctx, mr_frame *f, const mr_wrap_opts *opts, mr_wrap_result *result)
{
	static const mr_wrap_opts defaults = MR_WRAP_DEFAULTS;
	static const char *const reads[] = { "points", NULL };
	const mr_wrap_opts *o = opts ? opts : &defaults;
	const char *layer;
	mr_mesh points, out;
	mr_sampling sampling;

	MR_TRY(mr_layer_choose(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_points(ctx, f, layer, &points));
	MR_TRY(mr_prefix(ctx, mr_sampling_of(ctx, f, &points, &sampling), "%s", layer));
	if (o->template_mesh)
		return wrap_control(ctx, f, &points, &sampling, o, result);
	MR_TRY(
	    mr_prefix(ctx, mr_shrinkwrap(ctx, points.p, points.nv, &sampling, o, &out, result), "%s", layer));
	return mr_layer_put_mesh(ctx, f, "control", &out);
}
