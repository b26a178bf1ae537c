/* mr-fit: a control mesh to where its limit surface is near the points. */
#include "fit/fit.h"

#include "base/options.h"
#include "mesh/layers.h"
#include "tool/tool.h"

/* How the points lie, of which a mesh's own are all on it, however far from others. */
static mr_status
find_sampling(mr_ctx *ctx, mr_frame *f, const mr_mesh *points, mr_sampling *s)
{
	uint8_t *none;

	MR_TRY(mr_sampling_of(ctx, f, points, s));
	if (!mr_sample_meets_faces(f, points->name))
		return MR_OK;
	none = MR_NEW_ZERO(ctx, s->n, uint8_t);
	s->outlier = none;
	s->outliers = 0;
	return MR_OK;
}

/* The points to be fitted to: of a mesh the vertices that a face has. */
static mr_status
get_points(mr_ctx *ctx, mr_frame *f, const char *from, mr_mesh *points)
{
	size_t count, n = 0;
	bool *used;
	mr_v3 *p;

	MR_TRY(mr_layer_surface_or_points(ctx, f, from, points));
	if (points->nf == 0)
		return MR_OK;
	mr_vertices_used(ctx, points->t, points->nf, points->nv, &used, &count);
	p = MR_NEW(ctx, count, mr_v3);
	for (size_t v = 0; v < points->nv; v++)
		if (used[v])
			p[n++] = points->p[v];
	*points = (mr_mesh){ .name = from, .p = p, .nv = count };
	return MR_OK;
}

static mr_status
fit(mr_ctx *ctx, mr_frame *f, const mr_fit_opts *o, mr_fit_result *r)
{
	static const char *const reads[] = { "points", "mesh", NULL };
	const char *layer = o->layer ? o->layer : "control", *from;
	mr_mesh control, points;
	mr_sampling sampling, *known = NULL;
	const uint8_t *crease;
	mr_v3 *p;

	MR_TRY(mr_check_choice(ctx, "method", o->method, MR_FIT_LEAST_SQUARES));
	MR_TRY(mr_check_number(ctx, "step", o->step, 0, 1));
	MR_TRY(mr_check_number(ctx, "fairness", o->fairness, 0, 1e6));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &control));
	MR_TRY(mr_layer_crease(ctx, f, layer, control.nf, &crease));
	MR_TRY(mr_layer_choose(ctx, f, NULL, reads, &from));
	MR_TRY(get_points(ctx, f, from, &points));
	if (o->method != MR_FIT_LOCAL) {
		MR_TRY(find_sampling(ctx, f, &points, &sampling));
		known = &sampling;
	}
	if (!strcmp(layer, "control"))
		MR_TRY(mr_sample_report_move(ctx, f, from));
	p = MR_NEW(ctx, control.nv, mr_v3);
	MR_TRY(mr_fit(
	    ctx, &control, crease, points.p, points.nv, mr_sample_meets_faces(f, from), known, o, p, r));
	return mr_layer_move(ctx, f, layer, MR_RESHAPED, p, control.nv);
}

mr_status
mr_fit_frame(mr_ctx *ctx, mr_frame *f, const mr_fit_opts *opts, mr_fit_result *result)
{
	static const mr_fit_opts defaults = MR_FIT_DEFAULTS;
	mr_fit_result r;

	MR_ON_COPY(ctx, f, done, result, r, fit(ctx, &done, opts ? opts : &defaults, &r));
}
