/* Jeong, Kim 2001, section 3, and beyond it: the box and the volume, and which of them is better. */
#include "wrap/shrinkwrap.h"

#include "base/disjoint_sets.h"
#include "remesh/unfold.h"
#include "wrap/parts.h"

/* Iterations by default: the cube comes to rest in as many. */
enum { CUBE_ITERATIONS = 20, TEMPLATE_ITERATIONS = 20, TEMPLATE_SETTLES = 4 };

/* What a box may leave out and have too much in edges of its first level, which are long. */
static const mr_wrap_cover FIRST = {
	.points_max = 1, .points_high = 0.55, .wrap_max = 0.6, .wrap_high = 0.45
};

/* Points and faces at most that this is measured by. */
enum { FIRST_SAMPLES = 1 << 11 };

/* Of mr_wrap_result.method, beside the methods. */
enum { TEMPLATE = MR_WRAP_VOLUME + 1 };

/* So few points tell nothing of handles and limbs: the box, of genus 0, goes around them. */
enum { FEW = 64 };

static size_t
flaws(const mr_wrap *c)
{
	return c->folds + c->cover.crossings;
}

static bool
covers(const mr_wrap_cover *c, const mr_wrap_cover *most, double unit)
{
	return c->points_max <= most->points_max * unit && c->points_high <= most->points_high * unit &&
	       c->wrap_max <= most->wrap_max * unit && c->wrap_high <= most->wrap_high * unit;
}

/* What it leaves out and has too much, where up to a tenth of the points are outliers. */
static double
badness(const mr_wrap_cover *c)
{
	return c->points_most + c->wrap_high;
}

/* The iterations of the paper. */
static mr_status
pull(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	size_t iterations = o->iterations ? o->iterations : CUBE_ITERATIONS;
	double start = mr_seconds();

	for (size_t i = 0; i < iterations; i++) {
		MR_TRY(mr_wrap_project(ctx, cloud, o->alpha, &c->d));
		MR_TRY(mr_wrap_smooth(ctx, o->lambda, false, &c->d));
		mr_progress(ctx, "wrapping", (double)(i + 1) / (double)iterations);
	}
	c->found.iterations = iterations;
	c->found.seconds_pull = mr_seconds() - start;
	return MR_OK;
}

/* The cube around the box. */
static mr_box
cube_around(mr_box b)
{
	mr_v3 size = mr_sub(b.max, b.min), middle = mr_lerp(0.5, b.min, b.max);
	double half = fmax(size.x, fmax(size.y, size.z)) / 2;
	mr_v3 corner = mr_vec(half, half, half);

	return (mr_box){ mr_sub(middle, corner), mr_add(middle, corner) };
}

/* So many edges a side that the cube has half as many vertices again as there are points: 6 r^2 = 1.5 n. */
static size_t
resolution_for(const mr_wrap_cloud *cloud)
{
	size_t r = (size_t)ceil(sqrt((double)cloud->n / 4));

	return r < 4 ? 4 : r;
}

/* To the letter of section 3.1.1. */
static mr_status
wrap_cube(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	size_t r = o->resolution ? o->resolution : resolution_for(cloud);
	mr_mesh cube;

	c->found.method = MR_WRAP_CUBE;
	c->found.resolution = r;
	MR_TRY(mr_wrap_box(ctx, cube_around(cloud->box), (size_t[]){ r, r, r }, &cube));
	MR_TRY(mr_wrap_dyn(ctx, &cube, &c->d));
	MR_TRY(pull(ctx, cloud, o, c));
	mr_unfold(&c->d, true);
	return mr_wrap_assess(ctx, cloud, MR_WRAP_SAMPLES, "cube", c);
}

/* From edges of `length` on. */
static mr_status
finish_box(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, double length, mr_wrap *c)
{
	double start = mr_seconds();

	MR_TRY(mr_wrap_refine(ctx, cloud, o, length, &c->d));
	c->found.seconds_levels = mr_seconds() - start;
	return mr_wrap_finish(ctx, cloud, o, "box", c);
}

/* The volume also closes what the points leave open, which counts against it: the box must be this much
 * better; not so where the volume has handles, which may be there alone.  A first level may become as much
 * better. */
static const double BETTER = 0.7;

static bool
beats(const mr_wrap *box, bool finished, const mr_wrap *volume, bool handles)
{
	double bar = !handles ? BETTER : finished ? 1 : 1 / BETTER;

	return badness(&box->cover) < bar * badness(&volume->cover);
}

/* Closed surfaces of c components with h handles in all have V - F / 2 = 2 c - 2 h. */
mr_status
mr_wrap_has_handles(mr_ctx *ctx, const mr_dyn *d, bool *handles)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *set = mr_sets_new(ctx, d->nv);
	size_t components = 0;

	if (!set)
		return MR_EMEM;
	for (uint32_t h = 0; h < 3 * d->nf; h++)
		mr_sets_join(set, d->v[h], mr_dyn_to(d, h));
	for (uint32_t v = 0; v < d->nv; v++)
		components += set[v] == v;
	*handles = d->nv < 2 * components + d->nf / 2;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The volume, but where it is not good either the box if that is better.  Which fits closer counts less than
 * which passes less through itself: drawn to an open sheet from both sides, the box does. */
static mr_status
choose(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, double length, bool finished, mr_wrap *c)
{
	double start = mr_seconds();
	mr_wrap volume = *c;
	mr_status status = mr_wrap_volume(ctx, cloud, o, &volume);
	bool handles = false;

	if (status != MR_OK && status != MR_EMESH)
		return status;
	if (status == MR_OK)
		MR_TRY(mr_wrap_has_handles(ctx, &volume.d, &handles));
	if (status == MR_OK && (covers(&volume.cover, &MR_WRAP_ENOUGH, cloud->spacing) ||
				   !beats(c, finished, &volume, handles))) {
		*c = volume;
		return MR_OK;
	}
	mr_wrap_tried(c, mr_seconds() - start);
	if (status == MR_EMESH)
		mr_note(ctx, "no volume: %s", ctx->error);
	if (!finished)
		MR_TRY(finish_box(ctx, cloud, o, length, c));
	if (status == MR_OK && (!beats(c, true, &volume, handles) || flaws(c) > flaws(&volume)))
		*c = volume;
	return MR_OK;
}

/*
 * The box, where its first level, a few hundred vertices, covers the points: that is cheap to know, and on
 * what is round the finer ones cost less than the volume.
 */
static mr_status
wrap_auto(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	double start = mr_seconds(), length;
	bool round;

	c->found.method = MR_WRAP_AUTO; /* the box */
	MR_TRY(mr_wrap_begin(ctx, cloud, o, &length, &c->d));
	MR_TRY(mr_wrap_assess(ctx, cloud, FIRST_SAMPLES, "first level", c));
	c->found.seconds_box = mr_seconds() - start;
	round = cloud->n <= FEW || covers(&c->cover, &FIRST, length);
	if (round) {
		MR_TRY(finish_box(ctx, cloud, o, length, c));
		if (flaws(c) == 0 && covers(&c->cover, &MR_WRAP_ENOUGH, cloud->spacing))
			return MR_OK;
	}
	return choose(ctx, cloud, o, length, round, c);
}

static mr_status
wrap_by_method(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	switch (o->method) {
	case MR_WRAP_CUBE:
		return wrap_cube(ctx, cloud, o, c);
	case MR_WRAP_VOLUME:
		return mr_wrap_volume(ctx, cloud, o, c);
	default:
		return wrap_auto(ctx, cloud, o, c);
	}
}

/* Where a wrap is poor by the same measure. */
static void
warn(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap *c)
{
	double points = c->cover.points_high / cloud->spacing, wrap = c->cover.wrap_high / cloud->spacing;

	if (flaws(c) > 0)
		mr_warn(ctx, "the wrap has %zu folded edges and %zu pairs of faces that intersect", c->folds,
		    c->cover.crossings);
	if (c->cover.lost > 0)
		mr_warn(ctx,
		    "%zu of %zu places %s more than %g sampling distances from the wrap: outliers, left out",
		    c->cover.lost, cloud->sampling.places, c->cover.lost == 1 ? "is" : "are", MR_WRAP_LACKS);
	if (points > MR_WRAP_ENOUGH.points_high)
		mr_warn(ctx,
		    "1 %% of the points are more than %.3g sampling distances from the wrap: outliers, or it "
		    "does not reach them",
		    points);
	else if (c->cover.points_max > MR_WRAP_LACKS * cloud->spacing)
		mr_warn(ctx,
		    "a point is %.3g sampling distances from the wrap: an outlier, or of a part that is left "
		    "out",
		    c->cover.points_max / cloud->spacing);
	if (wrap > MR_WRAP_ENOUGH.wrap_max)
		mr_warn(ctx,
		    "1 %% of the wrap is more than %.3g sampling distances from the points: it closes what "
		    "they leave open",
		    wrap);
}

static void
report(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap *c, mr_wrap_result *result)
{
	static const char *const names[] = { "box", "cube", "volume", "template" };
	mr_wrap_result r = c->found;

	mr_note(ctx, "by the %s", names[r.method]);
	warn(ctx, cloud, c);
	r.places = cloud->sampling.places;
	r.outliers = cloud->sampling.outliers;
	r.sampling = cloud->spacing;
	r.points_to_wrap_max = c->cover.points_max;
	r.points_to_wrap_99 = c->cover.points_high;
	r.points_to_wrap_90 = c->cover.points_most;
	r.wrap_to_points_max = c->cover.wrap_max;
	r.wrap_to_points_99 = c->cover.wrap_high;
	r.lost = c->cover.lost;
	r.faces = c->d.nf;
	r.folded_edges = c->folds;
	r.intersecting_pairs = c->cover.crossings;
	if (result)
		*result = r;
}

static mr_status
wrap(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_mesh *out, mr_wrap_result *result)
{
	mr_wrap c;

	mr_unmeasured(&c.found, sizeof c.found);
	MR_TRY(wrap_by_method(ctx, cloud, o, &c));
	for (size_t h = 0; h < 3 * c.d.nf; h++)
		if (c.d.twin[h] == MR_NONE)
			return mr_fail(ctx, MR_EMESH, "the wrap of %zu faces is open at one", c.d.nf);
	report(ctx, cloud, &c, result);
	*out = mr_dyn_view(&c.d, "control");
	return MR_OK;
}

mr_status
mr_shrinkwrap(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling,
    const mr_wrap_opts *opts, mr_mesh *out, mr_wrap_result *result)
{
	mr_wrap_cloud cloud;
	mr_status status = mr_wrap_cloud_open(ctx, point, n, sampling, &cloud);

	if (status == MR_OK)
		status = wrap(ctx, &cloud, opts, out, result);
	mr_near_free(cloud.near);
	return status;
}

/* By the steps of the box, which turn no face, and at the end those of all that is near the points. */
static mr_status
wrap_template(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_mesh *start, const mr_wrap_opts *o, mr_v3 *p,
    mr_wrap_result *result)
{
	size_t iterations = o->iterations ? o->iterations : TEMPLATE_ITERATIONS;
	double edge = mr_mesh_edge_scale(ctx, start);
	mr_wrap c;

	mr_unmeasured(&c.found, sizeof c.found);
	c.found.method = TEMPLATE;
	c.found.iterations = iterations;
	if (!(edge > 0))
		return mr_fail(ctx, MR_EMESH, "the template's %zu vertices are at one place", start->nv);
	MR_TRY(mr_wrap_dyn(ctx, start, &c.d));
	for (size_t i = 0; i < iterations; i++) {
		MR_TRY(mr_wrap_draw(ctx, cloud, o->alpha, edge, edge, &c.d));
		MR_TRY(mr_wrap_smooth(ctx, o->lambda, true, &c.d));
		mr_progress(ctx, "wrapping", (double)(i + 1) / (double)iterations);
	}
	MR_TRY(mr_wrap_settle(ctx, cloud, o, TEMPLATE_SETTLES, &c.d));
	mr_unfold(&c.d, true);
	MR_TRY(mr_wrap_assess(ctx, cloud, MR_WRAP_SAMPLES, "template", &c));
	report(ctx, cloud, &c, result);
	memcpy(p, c.d.p, start->nv * sizeof *p);
	return MR_OK;
}

mr_status
mr_wrap_template(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling, const mr_mesh *start,
    const mr_wrap_opts *opts, mr_v3 *p, mr_wrap_result *result)
{
	mr_wrap_cloud cloud;
	mr_status status = mr_wrap_cloud_open(ctx, point, n, sampling, &cloud);

	if (status == MR_OK)
		status = wrap_template(ctx, &cloud, start, opts, p, result);
	mr_near_free(cloud.near);
	return status;
}
