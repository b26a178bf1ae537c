/* Jeong, Kim 2001, section 3, and beyond it: the box and the volume, and which of them is better. */
#include "wrap/shrinkwrap.h"

#include "base/disjoint_sets.h"
#include "base/text.h"
#include "measure/gaps.h"
#include "remesh/unfold.h"
#include "space/rows.h"
#include "space/scatter.h"
#include "space/two_layers.h"
#include "volume/volume.h"
#include "wrap/parts.h"

/* Iterations by default: the cube comes to rest in as many. */
enum { CUBE_ITERATIONS = 20, TEMPLATE_ITERATIONS = 20, TEMPLATE_SETTLES = 4 };

/* Of mr_wrap_result.method, beside the methods. */
enum { TEMPLATE = MR_WRAP_VOLUME + 1, SHEET };

/* So few points tell nothing of handles and limbs: the box, of genus 0, goes around them. */
enum { FEW = 64 };

/*
 * Nor do so few, or points so far apart, in shares of their diagonal: the wrong ones of all that level.c
 * counts whose levels are alike have 19 to 90 points, but where much of the surface is left out; of 29 clouds
 * of 100 to 1,500 points the wrong ones that nothing else tells lie 0.09 apart and more, the right ones 0.055
 * and less.
 */
enum { SURE_LEAST = 100 };
static const double SURE_MOST = 0.07;

static size_t
flaws(const mr_wrap *c)
{
	return c->folds + c->cover.crossings;
}

static bool
covers(const mr_gaps *g, const mr_gaps *most, double unit)
{
	return g->points.max <= most->points.max * unit && g->points.high <= most->points.high * unit &&
	       g->surface.max <= most->surface.max * unit && g->surface.high <= most->surface.high * unit;
}

/* What it leaves out and has too much, where up to a tenth of the points are outliers. */
static double
badness(const mr_wrap_cover *c)
{
	return c->points_most + c->gaps.surface.high;
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

static mr_status
wrap_box(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	double start = mr_seconds();

	c->found.method = MR_WRAP_AUTO; /* the box */
	MR_TRY(mr_wrap_box_to_points(ctx, cloud, o, &c->d));
	c->found.seconds_box = mr_seconds() - start;
	return mr_wrap_finish(ctx, cloud, o, "box", c);
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

static bool
is_good(const mr_wrap *c, const mr_wrap_cloud *cloud)
{
	return covers(&c->cover.gaps, &MR_WRAP_ENOUGH, cloud->spacing);
}

/* Whether the closed wrap is good but for its lids, and the open one is without. */
static bool
is_good_open(const mr_wrap *closed, const mr_wrap *open, const mr_wrap_cloud *cloud)
{
	mr_gaps g = open->cover.gaps;

	g.points.max = fmax(g.points.max, closed->cover.gaps.points.max);
	g.points.high = fmax(g.points.high, closed->cover.gaps.points.high);
	return covers(&g, &MR_WRAP_ENOUGH, cloud->spacing);
}

/*
 * The volume also closes what the points leave open, which counts against it: the box must leave out and have
 * too much by this much less; not so where the volume has handles, which may be there alone.  Which fits
 * closer counts less than which passes less through itself: drawn to an open sheet from both sides, the box
 * does.
 */
static mr_status
is_better(mr_ctx *ctx, const mr_wrap *box, const mr_wrap *volume, bool *better)
{
	static const double share = 0.7;
	bool handles;

	MR_TRY(mr_wrap_has_handles(ctx, &volume->d, &handles));
	*better = flaws(box) <= flaws(volume) &&
	          badness(&box->cover) < (handles ? 1 : share) * badness(&volume->cover);
	return MR_OK;
}

/* *enclosed: whether the points enclose a volume. */
static mr_status
try_volume(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c, bool *enclosed)
{
	mr_status status = mr_wrap_volume(ctx, cloud, o, c);

	*enclosed = status == MR_OK;
	if (status == MR_EMESH)
		mr_note(ctx, "no volume: %s", ctx->error);
	return status == MR_EMESH ? MR_OK : status;
}

/* The volume; where that is not good, the box if it is better; of few points the box, if it is good. */
static mr_status
wrap_body(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	double start = mr_seconds(), middle;
	bool few = cloud->n <= FEW, enclosed = false, better = true;
	mr_wrap box = *c, volume = *c;

	if (!few)
		MR_TRY(try_volume(ctx, cloud, o, &volume, &enclosed));
	*c = volume;
	if (enclosed) {
		MR_TRY(mr_wrap_open(ctx, cloud, o, c));
		if (is_good_open(&volume, c, cloud))
			return MR_OK;
	}
	middle = mr_seconds();
	MR_TRY(wrap_box(ctx, cloud, o, &box));
	if (few && !(flaws(&box) == 0 && is_good(&box, cloud)))
		MR_TRY(try_volume(ctx, cloud, o, &volume, &enclosed));
	if (enclosed)
		MR_TRY(is_better(ctx, &box, &volume, &better));
	box.sided = volume.sided; /* which may be why the volume is not good */
	*c = better ? box : volume;
	mr_wrap_tried(c, better ? middle - start : mr_seconds() - middle);
	return mr_wrap_open(ctx, cloud, o, c);
}

/* Turns axis[2] to the side on which most directions of the points are; by right all are. */
static void
face_sides(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_v3 axis[3])
{
	static const double MIXED = 0.05;
	const mr_outer_sides *sides = cloud->sides;
	double side[2] = { 0 }, less;

	if (!sides)
		return;
	for (size_t i = 0; i < cloud->sampling.n; i++) {
		double up = mr_dot(sides->toward[i], axis[2]);
		side[0] += up > 0;
		side[1] += up < 0;
	}
	less = fmin(side[0], side[1]);
	if (less > MIXED * (side[0] + side[1]))
		mr_warn(ctx,
		    "%.3g %% of the %s are on the other side of the height field than most, whose side it "
		    "faces",
		    100 * less / (side[0] + side[1]),
		    sides->normals ? "normals of the points" : "places of the scanner");
	if (side[1] > side[0]) {
		axis[1] = mr_mul(-1, axis[1]);
		axis[2] = mr_mul(-1, axis[2]);
	}
}

/* A height field as one, unless it is to be closed. */
static mr_status
wrap_by_method(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	bool is_sheet = false;
	mr_v3 axis[3];

	if (o->method == MR_WRAP_AUTO && o->lids != MR_LIDS_ALL)
		MR_TRY(mr_wrap_is_sheet(ctx, cloud, axis, &is_sheet));
	if (is_sheet) {
		c->found.method = SHEET;
		if (o->grid || o->iterations)
			mr_warn(ctx,
			    "the points are a height field, on which --grid and --iterations have no effect");
		face_sides(ctx, cloud, axis);
		return mr_wrap_sheet(ctx, cloud, o, axis, c);
	}
	if (cloud->flat)
		return mr_fail(ctx, MR_EMESH, "%zu points lie in a plane: no surface closes around them",
		    cloud->sampling.n);
	switch (o->method) {
	case MR_WRAP_CUBE:
		return wrap_cube(ctx, cloud, o, c);
	case MR_WRAP_VOLUME:
		MR_TRY(mr_wrap_volume(ctx, cloud, o, c));
		return mr_wrap_open(ctx, cloud, o, c);
	default:
		return wrap_body(ctx, cloud, o, c);
	}
}

/* The end of a sentence on what may be wrong: sides that agree among neighbours may still be those of parts.
 */
static const char *
doubt_of_sides(const mr_wrap *c)
{
	return c->sided ? "; sides that are given may be wrong, and --ignore-normals finds others" : "";
}

/* Where its topology hangs on the level, or nothing tells it. */
static void
warn_of_topology(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap *c)
{
	const mr_volume_result *v = &c->found.volume;

	if (cloud->n < SURE_LEAST || cloud->spacing > SURE_MOST * cloud->diagonal)
		mr_warn(ctx,
		    "of %zu places, %.2g %% of their diagonal apart, the topology is uncertain: so few hide "
		    "handles",
		    cloud->n, 100 * cloud->spacing / cloud->diagonal);
	else if (c->found.method == MR_WRAP_VOLUME && v->levels_alike < MR_VOLUME_LEVELS)
		mr_warn(ctx,
		    "the topology is uncertain: %sEuler number %g, or %g where body or gaps are thin, first "
		    "near (%.4g, %.4g, %.4g)%s",
		    c->lids.loops > 0 ? "before the wrap was opened " : "", v->euler, v->euler_beside,
		    v->uncertain.x, v->uncertain.y, v->uncertain.z,
		    c->sided ? doubt_of_sides(c)
			     : "; denser points would tell, or their normals, but of a one-sided surface");
	else if (c->found.method == MR_WRAP_AUTO)
		mr_warn(ctx,
		    "the topology is uncertain: but for openings it is that of the sphere as which the wrap "
		    "began%s",
		    doubt_of_sides(c));
}

/* Where a wrap is poor by the same measure. */
static void
warn(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap *c)
{
	const mr_gaps *g = &c->cover.gaps;
	double points = g->points.high / cloud->spacing, wrap = g->surface.high / cloud->spacing;

	if (flaws(c) > 0)
		mr_warn(ctx, "the wrap has %zu folded edges and %zu pairs of faces that intersect", c->folds,
		    c->cover.crossings);
	if (c->cover.lost > 0)
		mr_warn(ctx,
		    "%zu of %zu places %s more than %g sampling distances from the wrap, and left out: "
		    "outliers, "
		    "or of a part that it does not reach",
		    c->cover.lost, cloud->sampling.places, c->cover.lost == 1 ? "is" : "are", MR_WRAP_LACKS);
	if (points > MR_WRAP_ENOUGH.points.high)
		mr_warn(ctx,
		    "%.3g %% of the points are more than %g sampling distances from the wrap, up to %.3g: "
		    "outliers, or of a part that it does not reach%s",
		    100 * c->cover.missed, MR_WRAP_ENOUGH.points.high, g->points.max / cloud->spacing,
		    doubt_of_sides(c));
	else if (g->points.max > MR_WRAP_LACKS * cloud->spacing)
		mr_warn(ctx,
		    "a point is %.3g sampling distances from the wrap: an outlier, or of a part that is left "
		    "out",
		    g->points.max / cloud->spacing);
	if (wrap > MR_WRAP_ENOUGH.surface.max)
		mr_warn(ctx,
		    "1 %% of the wrap is more than %.3g sampling distances from the points: it closes what "
		    "they leave open",
		    wrap);
	else
		mr_gaps_warn(ctx, "the wrap", g);
}

/* Of two sides that are nearer to each other than a sheet's points the wrap makes one, with a rim. */
static mr_status
warn_of_layers(mr_ctx *ctx, const mr_wrap_cloud *cloud, size_t loops)
{
	const char *end = loops == 0
	                      ? ""
	                      : mr_format(ctx,
				    "; the wrap is open, in %zu loop%s: rims, perhaps, where such sides "
				    "became one sheet",
				    loops, mr_plural(loops));

	if (!end)
		return MR_EMEM;
	return mr_warn_of_layers(ctx, cloud->p, cloud->n, cloud->near, cloud->spacing, end);
}

static const double ROWS = 5;

/* Points in rows say little of what is between these: of a height field whose rows are 6 times as far apart
 * as their points a closed body is made, of rows 5 times as far apart a sheet. */
static mr_status
warn_of_rows(mr_ctx *ctx, const mr_wrap_cloud *cloud)
{
	mr_rows r;

	if (cloud->n < SURE_LEAST)
		return MR_OK;
	MR_TRY(mr_find_rows(ctx, cloud->p, cloud->n, cloud->near, &r));
	if (r.across > ROWS * r.along)
		mr_warn(ctx,
		    "the points stand in rows, %.3g apart and %.3g along: what is between is chance; mr-crop "
		    "--keep spaced:%.2g before makes them as dense across as along",
		    r.across, r.along, r.across / 2);
	return MR_OK;
}

/* Of balls, cubes and bars that 300 points or more fill 0.163 and more, a slab of 4 spacings 0.14; of clouds
 * of surfaces 0.1 at most, with noise of 1 % of the diagonal 0.12 but of what is as thin as that. */
static const double SCATTERED = 0.16;

static mr_status
warn_of_scatter(mr_ctx *ctx, const mr_wrap_cloud *cloud)
{
	double scatter;

	MR_TRY(mr_cloud_scatter(ctx, cloud->p, cloud->n, cloud->near, &scatter));
	if (scatter > SCATTERED)
		mr_warn(ctx, "the points hardly lie along a surface: they fill a volume, scatter about it as "
			     "widely as it bends, or lie along several close by, and what is wrapped may be "
			     "chance");
	return MR_OK;
}

/* What was left open, and where it might as well be closed, or the other way round. */
static void
report_lids(mr_ctx *ctx, const mr_wrap_lids *l)
{
	if (l->openings + l->holes > 0)
		mr_note(ctx, "%zu opening%s left open, %zu loop%s of the boundary; %zu hole%s closed",
		    l->openings, mr_plural(l->openings), l->loops, mr_plural(l->loops), l->holes,
		    mr_plural(l->holes));
	if (l->doubtful > 0 && l->flickers)
		mr_warn(ctx,
		    "%zu opening%s closed, as the points support the wrap too unevenly to tell where they "
		    "end: the widest measures %.3g sampling distances, near (%.4g, %.4g, %.4g); of an open "
		    "sheet "
		    "--lids none cuts them out",
		    l->doubtful, l->doubtful == 1 ? " is" : "s are", l->width, l->at.x, l->at.y, l->at.z);
	else if (l->doubtful > 0)
		mr_warn(ctx,
		    "%zu opening%s of the points may be meant or not: those up to %g sampling distances wide "
		    "are closed, wider ones are not, and the widest measures %.3g, near (%.4g, %.4g, %.4g)",
		    l->doubtful, mr_plural(l->doubtful), MR_WRAP_OPENING, l->width, l->at.x, l->at.y,
		    l->at.z);
}

static void
report(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap *c, mr_wrap_result *result)
{
	static const char *const names[] = { "box", "cube", "volume", "template", "height field" };
	mr_wrap_result r = c->found;

	mr_note(ctx, "by the %s", names[r.method]);
	report_lids(ctx, &c->lids);
	warn(ctx, cloud, c);
	if (r.method == MR_WRAP_VOLUME && r.volume.inward == 1)
		mr_warn(ctx, "%s",
		    cloud->sides->normals
			? "the normals of the points point inward: turned over"
			: "the points were seen from within: the wrap faces away from the scanner");
	if (c->found.method != TEMPLATE)
		warn_of_topology(ctx, cloud, c);
	r.places = cloud->sampling.places;
	r.outliers = cloud->sampling.outliers;
	r.sampling = cloud->spacing;
	r.gaps = c->cover.gaps;
	r.lost = c->cover.lost;
	r.loops = c->lids.loops;
	r.openings = c->lids.openings;
	r.holes = c->lids.holes;
	r.faces = c->d.nf;
	r.folded_edges = c->folds;
	r.intersecting_pairs = c->cover.crossings;
	if (result)
		*result = r;
}

static mr_status
wrap(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_mesh *out, mr_wrap_result *result)
{
	mr_wrap c = { 0 };

	mr_unmeasured(&c.found, sizeof c.found);
	MR_TRY(wrap_by_method(ctx, cloud, o, &c));
	for (size_t h = 0; h < 3 * c.d.nf; h++)
		if (c.d.twin[h] == MR_NONE && c.lids.loops == 0)
			return mr_fail(ctx, MR_EMESH, "the wrap of %zu faces is open at one", c.d.nf);
	MR_TRY(warn_of_layers(ctx, cloud, c.lids.loops));
	MR_TRY(warn_of_scatter(ctx, cloud));
	MR_TRY(warn_of_rows(ctx, cloud));
	report(ctx, cloud, &c, result);
	*out = mr_dyn_view(&c.d, "control");
	return MR_OK;
}

mr_status
mr_shrinkwrap(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling,
    const mr_outer_sides *sides, const mr_wrap_opts *opts, mr_mesh *out, mr_wrap_result *result)
{
	mr_wrap_cloud cloud;
	mr_status status = mr_wrap_cloud_open(ctx, point, n, sampling, &cloud);

	cloud.sides = sides;
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
	mr_wrap c = { 0 };

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
