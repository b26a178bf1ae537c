#include "alg/shrinkwrap.h"

#include "alg/iron.h"
#include "alg/wrap_parts.h"

/* Iterations by default: the cube comes to rest in as many. */
enum { CUBE_ITERATIONS = 20, SETTLE_ITERATIONS = 4 };

/* The iterations of the paper. */
static mr_status
pull(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, size_t iterations, mr_dyn *d)
{
	for (size_t i = 0; i < iterations; i++) {
		MR_TRY(mr_wrap_project(ctx, cloud, o->alpha, d));
		MR_TRY(mr_wrap_smooth(ctx, o->lambda, false, d));
		mr_progress(ctx, "wrapping", (double)(i + 1) / (double)iterations);
	}
	mr_stat_set(ctx, "iterations", (double)iterations);
	return MR_OK;
}

/* The cube around the box. */
static mr_box
cube_around(mr_box b)
{
	mr_v3 size = mr_sub(b.max, b.min), middle = mr_lerp(0.5, b.min, b.max);
	double half = fmax(size.x, fmax(size.y, size.z)) / 2;

	return (mr_box){ mr_sub(middle, mr_vec(half, half, half)), mr_add(middle, mr_vec(half, half, half)) };
}

/* So many edges a side that the cube has half as many vertices again as there are points: 6 r^2 = 1.5 n. */
static size_t
resolution_for(const mr_wrap_cloud *cloud)
{
	size_t r = (size_t)ceil(sqrt((double)cloud->places / 4));

	return r < 4 ? 4 : r;
}

/* To the letter of section 3.1.1. */
static mr_status
wrap_cube(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_dyn *d)
{
	size_t r = o->resolution ? o->resolution : resolution_for(cloud);
	mr_mesh cube;

	MR_TRY(mr_wrap_box(ctx, cube_around(cloud->box), (size_t[]){ r, r, r }, &cube));
	MR_TRY(mr_wrap_dyn(ctx, &cube, d));
	mr_stat_set(ctx, "resolution", (double)r);
	return pull(ctx, cloud, o, o->iterations ? o->iterations : CUBE_ITERATIONS, d);
}

/* Edges at which the wrap has about half as many faces as there are points, or as long as asked for. */
static double
final_length(const mr_wrap_cloud *cloud, const mr_wrap_opts *o)
{
	mr_v3 size = mr_sub(cloud->box.max, cloud->box.min);

	if (o->resolution)
		return fmax(size.x, fmax(size.y, size.z)) / (double)o->resolution;
	return 2.15 * sqrt(cloud->area / (double)cloud->places);
}

static void
report_cover(mr_ctx *ctx, const mr_wrap_cloud *cloud, const char *what, double length, const mr_wrap_cover *c)
{
	mr_note(ctx,
	    "%s: edges %.3g; points to wrap at most %.3g, 99 %% within %.3g; wrap to points at most %.3g, 99 "
	    "%% within %.3g sampling distances",
	    what, length / cloud->spacing, c->points_max / cloud->spacing, c->points_high / cloud->spacing,
	    c->wrap_max / cloud->spacing, c->wrap_high / cloud->spacing);
}

static mr_status
wrap_auto(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_dyn *d)
{
	double last = final_length(cloud, o), l = last;
	size_t edges[3];
	mr_v3 size = mr_sub(cloud->box.max, cloud->box.min);
	mr_mesh box;
	mr_wrap_cover c;

	while (l < cloud->diagonal / 16)
		l *= 2;
	for (int i = 0; i < 3; i++)
		edges[i] = (size_t)ceil(((const double[]){ size.x, size.y, size.z })[i] / l / 2);
	for (int i = 0; i < 3; i++)
		if (!edges[i])
			edges[i] = 1;
	MR_TRY(mr_wrap_box(ctx, cloud->box, edges, &box));
	MR_TRY(mr_wrap_dyn(ctx, &box, d));
	for (;;) {
		for (int i = 0; i < (l > cloud->diagonal / 32 ? 8 : 2); i++)
			MR_TRY(mr_wrap_level(ctx, cloud, o, l, d));
		mr_mesh m = mr_dyn_view(d, "control");
		MR_TRY(mr_wrap_measure(ctx, cloud, &m, 1 << 14, &c));
		report_cover(ctx, cloud, "level", l, &c);
		if (l <= last * 1.01)
			break;
		l /= 2;
	}
	MR_TRY(mr_wrap_remesh(ctx, last, d));
	MR_TRY(mr_wrap_settle(ctx, cloud, o, o->iterations ? o->iterations : SETTLE_ITERATIONS, d));
	mr_mesh m = mr_dyn_view(d, "control");
	MR_TRY(mr_wrap_measure(ctx, cloud, &m, 1 << 14, &c));
	report_cover(ctx, cloud, "end", l, &c);
	return MR_OK;
}

static mr_status
wrap(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_mesh *out)
{
	mr_dyn d;

	mr_stat_set(ctx, "places", (double)cloud->places);
	mr_stat_set(ctx, "sampling", cloud->spacing);
	if (o->method == MR_WRAP_CUBE)
		MR_TRY(wrap_cube(ctx, cloud, o, &d));
	else if (o->method == MR_WRAP_VOLUME)
		return mr_fail(ctx, MR_EMESH, "the volume cannot be had yet");
	else
		MR_TRY(wrap_auto(ctx, cloud, o, &d));
	mr_stat_set(ctx, "folded_edges", (double)mr_iron(&d, true));
	MR_TRY(mr_dyn_compact(ctx, &d));
	*out = mr_dyn_view(&d, "control");
	return MR_OK;
}

mr_status
mr_shrinkwrap(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_wrap_opts *opts, mr_mesh *out)
{
	mr_wrap_cloud cloud;
	mr_status status = mr_wrap_cloud_open(ctx, point, n, &cloud);

	if (status == MR_OK)
		status = wrap(ctx, &cloud, opts, out);
	mr_near_free(cloud.near);
	return status;
}

static mr_status
wrap_template(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_mesh *start, const mr_wrap_opts *o, mr_v3 *p)
{
	mr_dyn d;

	MR_TRY(mr_wrap_dyn(ctx, start, &d));
	MR_TRY(pull(ctx, cloud, o, o->iterations ? o->iterations : CUBE_ITERATIONS, &d));
	memcpy(p, d.p, start->nv * sizeof *p);
	return MR_OK;
}

mr_status
mr_wrap_template(
    mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_mesh *start, const mr_wrap_opts *opts, mr_v3 *p)
{
	mr_wrap_cloud cloud;
	mr_status status = mr_wrap_cloud_open(ctx, point, n, &cloud);

	if (status == MR_OK)
		status = wrap_template(ctx, &cloud, start, opts, p);
	mr_near_free(cloud.near);
	return status;
}
