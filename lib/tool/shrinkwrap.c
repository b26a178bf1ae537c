/* mr-shrinkwrap: points to a control mesh around them. */
#include "wrap/shrinkwrap.h"

#include "base/options.h"
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
	MR_TRY(mr_prefix(ctx, mr_wrap_template(ctx, points->p, points->nv, sampling, &control, o, p, result),
	    "%s", points->name));
	return mr_layer_move(ctx, f, "control", MR_RESHAPED, p, control.nv);
}

/* The outer sides of the points: their normals, or from where they were seen; toward NULL: neither. */
static mr_status
get_sides(mr_ctx *ctx, mr_frame *f, const mr_mesh *points, mr_outer_sides *sides)
{
	const void *data;

	*sides = (mr_outer_sides){ NULL, mr_layer_has(f, points->name, "normal") };
	if (sides->normals) {
		MR_TRY(mr_layer_get_rows(ctx, f, points->name, "normal", points->nv, &data));
		sides->toward = data;
	} else if (mr_layer_has(f, points->name, "scanner")) {
		mr_v3 *toward = MR_NEW(ctx, points->nv, mr_v3);
		MR_TRY(mr_layer_get_rows(ctx, f, points->name, "scanner", points->nv, &data));
		for (size_t i = 0; i < points->nv; i++)
			toward[i] = mr_sub(((const mr_v3 *)data)[i], points->p[i]);
		sides->toward = toward;
	}
	return MR_OK;
}

static mr_status
check_options(mr_ctx *ctx, const mr_wrap_opts *o)
{
	MR_TRY(mr_check_choice(ctx, "method", o->method, MR_WRAP_VOLUME));
	MR_TRY(mr_check_choice(ctx, "lids", o->lids, MR_LIDS_NONE));
	MR_TRY(mr_check_number(ctx, "resolution", (double)o->resolution, 0, 10000));
	MR_TRY(mr_check_number(ctx, "grid", (double)o->grid, 0, 4096));
	MR_TRY(mr_check_number(ctx, "alpha", o->alpha, 0, 1));
	return mr_check_number(ctx, "lambda", o->lambda, 0, 1);
}

static mr_status
shrinkwrap(mr_ctx *ctx, mr_frame *f, const mr_wrap_opts *o, mr_wrap_result *result)
{
	static const char *const reads[] = { "points", NULL };
	const char *layer;
	mr_outer_sides sides = { NULL, false };
	mr_mesh points, out;
	mr_sampling sampling;

	MR_TRY(check_options(ctx, o));
	MR_TRY(mr_layer_choose(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_points(ctx, f, layer, &points));
	MR_TRY(mr_sampling_of(ctx, f, &points, &sampling));
	if (o->template_mesh)
		return wrap_control(ctx, f, &points, &sampling, o, result);
	if (!o->ignore_normals)
		MR_TRY(get_sides(ctx, f, &points, &sides));
	MR_TRY(mr_prefix(ctx,
	    mr_shrinkwrap(ctx, points.p, points.nv, &sampling, sides.toward ? &sides : NULL, o, &out, result),
	    "%s", layer));
	return mr_layer_replace(ctx, f, "control", &out);
}

mr_status
mr_shrinkwrap_frame(mr_ctx *ctx, mr_frame *f, const mr_wrap_opts *opts, mr_wrap_result *result)
{
	static const mr_wrap_opts defaults = MR_WRAP_DEFAULTS;
	mr_wrap_result r;

	MR_ON_COPY(ctx, f, done, result, r, shrinkwrap(ctx, &done, opts ? opts : &defaults, &r));
}
