/* mr-sample: heights over the limit surface of the control mesh. */
#include "tool/tool.h"

#include "base/options.h"
#include "sample/sample.h"

static const char *const reads[] = { "points", "mesh", NULL };

bool
mr_sample_meets_faces(const mr_frame *f, const char *layer)
{
	const char *from = layer ? layer : mr_frame_has_layer(f, reads[0]) ? reads[0] : reads[1];
	const mr_column *faces = mr_frame_find(f, from, "triangles");

	return strcmp(from, "points") && faces && faces->rows;
}

mr_status
mr_sample_report_move(mr_ctx *ctx, mr_frame *f, const char *from)
{
	bool still, pending;

	MR_TRY(mr_layer_is_as_encoded(ctx, f, "control", &still));
	MR_TRY(mr_layer_is_pending(ctx, f, "control", &pending));
	if (!strcmp(from, "mesh") && mr_frame_has_layer(f, "displacement") && !pending)
		still = true; /* mr-decode has made it anew */
	if (!still && f->key)
		mr_found(ctx, &(mr_finding){ .kind = MR_STALE, .layer = "control", .what = "its motion" });
	return MR_OK;
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

/* The columns of the points that go along, and says which cannot.  carried: f->count, the caller's. */
static mr_status
get_columns(mr_ctx *ctx, mr_frame *f, const mr_mesh *points, size_t nv, mr_carried *carried, size_t *count)
{
	for (size_t i = 0; i < f->count; i++) {
		const mr_column *c = &f->columns[i];
		if (mr_column_carried(c, points->name))
			MR_TRY(mr_carried_begin(ctx, f, i, points->nv, nv, &carried[(*count)++]));
		else if (!strcmp(c->layer, points->name) && c->shape.element == 'v' &&
			 !mr_column_known(points->name, c->name))
			mr_lost(ctx, points->name, c->rows, c->name);
	}
	return MR_OK;
}

/* Puts what the points, or the mesh, have beside their places, at the vertices. */
static mr_status
put_columns(mr_ctx *ctx, mr_frame *f, const mr_domain *d, const mr_mesh *points, const mr_sampling *s,
    const double *height)
{
	mr_carried *carried = MR_NEW(ctx, f->count, mr_carried);
	size_t count = 0;

	MR_TRY(get_columns(ctx, f, points, d->m.nv, carried, &count));
	if (count == 0)
		return MR_OK;
	if (points->nf)
		mr_sample_mesh_columns(ctx, d, height, points, carried, count);
	else
		MR_TRY(mr_sample_columns(ctx, d, height, points->p, s, carried, count));
	return mr_carried_put(ctx, f, "displacement", carried, count);
}

static mr_status
sample(mr_ctx *ctx, mr_frame *f, const mr_sample_opts *o, mr_sample_result *result)
{
	mr_mesh control, target;
	size_t n = o->level;
	double *height;
	mr_sampling sampling;
	mr_domain d;

	MR_TRY(mr_check_choice(ctx, "method", o->method, MR_SAMPLE_ROBUST));
	MR_TRY(mr_check_number(ctx, "neighbours", (double)o->neighbours, 3, MR_SAMPLE_MOST));
	if (o->level != MR_UNKNOWN)
		MR_TRY(mr_check_number(ctx, "level", (double)o->level, 0, MR_LEVEL_MAX));
	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	MR_TRY(get_target(ctx, f, o->layer, &target));
	if (n == MR_UNKNOWN) {
		MR_TRY(mr_domain_level(ctx, &control, target.nv, &n));
		n = n ? n : 1; /* the triangles of level 0 are far from the surface that was fitted */
	}
	MR_TRY(mr_sample_report_move(ctx, f, target.name));
	MR_TRY(mr_domain_of(ctx, f, &control, n, &d));
	height = MR_NEW(ctx, d.m.nv, double);
	if (target.nf) {
		MR_TRY(mr_sample_mesh(ctx, &d, &target, o, height, result));
	} else {
		MR_TRY(mr_sampling_of(ctx, f, &target, &sampling));
		MR_TRY(mr_sample_points(ctx, &d, target.p, target.nv, &sampling, o, height, result));
	}
	result->level = n;
	result->vertices = d.m.nv;
	mr_frame_drop(f, "displacement", NULL, 0);
	MR_TRY(mr_displacement_put(ctx, f, &d, height));
	return put_columns(ctx, f, &d, &target, &sampling, height);
}

mr_status
mr_sample_frame(mr_ctx *ctx, mr_frame *f, const mr_sample_opts *opts, mr_sample_result *result)
{
	static const mr_sample_opts defaults = MR_SAMPLE_DEFAULTS;
	mr_sample_result r;

	MR_ON_COPY(ctx, f, done, result, r, sample(ctx, &done, opts ? opts : &defaults, &r));
}
