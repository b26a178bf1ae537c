/* mr-sample: heights over the limit surface of the control mesh. */
#include "tool/sample.h"

#include "sample/sample.h"

static const char *const reads[] = { "points", "mesh", NULL };

bool
mr_sample_meets_faces(const mr_frame *f, const char *layer)
{
	const char *from = layer ? layer : mr_frame_has_layer(f, reads[0]) ? reads[0] : reads[1];
	const mr_column *faces = mr_frame_find(f, from, "triangles");

	return strcmp(from, "points") && faces && faces->rows;
}

/* The layer to sample: points, or else the mesh, as its points alone where it has no faces. */
static mr_status
get_target(mr_ctx *ctx, mr_frame *f, const char *only, mr_mesh *target)
{
	const char *layer;

	MR_TRY(mr_layer_choose(ctx, f, only, reads, &layer));
	if (mr_sample_meets_faces(f, layer))
		return mr_layer_mesh(ctx, f, layer, target);
	return mr_layer_points(ctx, f, layer, target);
}

/* The triangles of level 0 are far from the surface that was fitted. */
static mr_status
choose_level(mr_ctx *ctx, const mr_mesh *control, size_t vertices, size_t *n)
{
	MR_TRY(mr_domain_level(ctx, control, vertices, n));
	if (*n == 0)
		*n = 1;
	return MR_OK;
}

mr_status
mr_sample_frame(mr_ctx *ctx, mr_frame *f, const mr_sample_opts *opts, mr_sample_result *result)
{
	static const mr_sample_opts defaults = MR_SAMPLE_DEFAULTS;
	const mr_sample_opts *o = opts ? opts : &defaults;
	mr_mesh control, target;
	size_t n = o->level;
	double *height;
	mr_sampling sampling;
	mr_domain d;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	MR_TRY(get_target(ctx, f, o->layer, &target));
	if (n == MR_UNKNOWN)
		MR_TRY(choose_level(ctx, &control, target.nv, &n));
	MR_TRY(mr_domain_build(ctx, &control, n, &d));
	height = MR_NEW(ctx, d.m.nv, double);
	if (!height)
		return MR_EMEM;
	if (target.nf) {
		MR_TRY(mr_sample_mesh(ctx, &d, &target, o, height, result));
	} else {
		MR_TRY(mr_sampling_of(ctx, f, &target, &sampling));
		MR_TRY(mr_sample_points(ctx, &d, target.p, target.nv, &sampling, o, height, result));
	}
	if (result) {
		result->level = n;
		result->vertices = d.m.nv;
	}
	return mr_displacement_put(ctx, f, &d, height);
}
