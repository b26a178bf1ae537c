/* Jeong, Kim 2001, section 3: the cube to the letter, and a template; beyond it the volume, of any topology,
 * and height fields. */
#include "wrap/shrinkwrap.h"

#include "base/text.h"
#include "measure/gaps.h"
#include "remesh/unfold.h"
#include "shape/shape.h"
#include "volume/volume.h"
#include "wrap/parts.h"

/* By default: both come to rest in as many. */
enum { ITERATIONS = 20, TEMPLATE_SETTLES = 4 };

/* Values of mr_wrap_result.method, beside the methods. */
enum { TEMPLATE = MR_WRAP_VOLUME + 1, SHEET };

/* So few points show no handles and limbs: a cube goes around them. */
enum { FEW = 64 };

/* So few places, or places so far apart in diagonals, show no handles. */
enum { SURE_LEAST = 100 };
static const double SURE_MOST = 0.07;

/* The iterations of the paper. */
static mr_status
pull(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, bool guarded, mr_wrap *c)
{
	size_t iterations = o->iterations ? o->iterations : ITERATIONS;

	for (size_t i = 0; i < iterations; i++) {
		MR_TRY(mr_wrap_project(ctx, cloud, o->alpha, guarded, &c->d));
		MR_TRY(mr_wrap_smooth(ctx, o->lambda, guarded, &c->d));
		mr_progress(ctx, "wrapping", (double)(i + 1) / (double)iterations);
	}
	c->found.iterations = iterations;
	return MR_OK;
}

/* The cube around the box, of squares of two triangles, r of them along a side. */
static mr_status
make_cube(mr_ctx *ctx, mr_box box, size_t r, mr_mesh *cube)
{
	mr_make_opts o = MR_MAKE_DEFAULTS;
	mr_v3 size = mr_sub(box.max, box.min), middle = mr_lerp(0.5, box.min, box.max), *p;

	o.solid = MR_CUBE;
	o.vertices = 6 * r * r + 2;
	MR_TRY(mr_solid_make(ctx, &o, cube));
	p = MR_NEW(ctx, cube->nv, mr_v3);
	for (size_t v = 0; v < cube->nv; v++)
		p[v] = mr_axpy(fmax(size.x, fmax(size.y, size.z)) / 2, cube->p[v], middle);
	cube->p = p;
	return MR_OK;
}

/* Section 3.1.1, to the letter, or so that no face turns.  The cube has half as many vertices again as there
 * are points: 6 r^2 = 1.5 n. */
static mr_status
wrap_cube(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, bool guarded, mr_wrap *c)
{
	size_t r = o->resolution ? o->resolution : (size_t)fmax(4, ceil(sqrt((double)cloud->n / 4)));
	mr_mesh cube;

	c->found.method = MR_WRAP_CUBE;
	c->found.resolution = r;
	MR_TRY(make_cube(ctx, cloud->box, r, &cube));
	MR_TRY(mr_wrap_dyn(ctx, &cube, &c->d));
	MR_TRY(pull(ctx, cloud, o, guarded, c));
	mr_unfold(&c->d);
	return mr_wrap_assess(ctx, cloud, c);
}

static mr_status
wrap_volume(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	mr_volume_opts volume = { o->grid, &cloud->sampling, cloud->sides };
	mr_mesh m;

	c->found.method = MR_WRAP_VOLUME;
	MR_TRY(mr_volume_wrap(ctx, cloud->given, cloud->sampling.n, &volume, &m, &c->found.volume));
	MR_TRY(mr_wrap_remesh(ctx, cloud, o, &m, &c->d));
	MR_TRY(mr_wrap_finish(ctx, cloud, o, c));
	if (o->lids != MR_LIDS_ALL)
		MR_TRY(mr_wrap_open(ctx, cloud, o, o->lids == MR_LIDS_AUTO, &c->lids, &c->d));
	return c->lids.openings > 0 ? mr_wrap_assess(ctx, cloud, c) : MR_OK;
}

/* Height fields as such, unless they are to be closed. */
static mr_status
wrap_by_method(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	mr_wrap_field *field;
	size_t fields = 0;

	if (o->method == MR_WRAP_AUTO && o->lids != MR_LIDS_ALL)
		MR_TRY(mr_wrap_find_fields(ctx, cloud, &field, &fields));
	if (fields > 0) {
		c->found.method = SHEET;
		return mr_wrap_fields(ctx, cloud, o, field, fields, c);
	}
	if (cloud->flat)
		return mr_fail(ctx, MR_EMESH, "%zu points lie in a plane: no surface closes around them%s",
		    cloud->sampling.n,
		    cloud->sampling.n < MR_WRAP_FIELD_LEAST
			? mr_format(ctx, ", and an open one needs %d", MR_WRAP_FIELD_LEAST)
			: "");
	if (o->method == MR_WRAP_CUBE || (o->method == MR_WRAP_AUTO && cloud->n <= FEW))
		return wrap_cube(ctx, cloud, o, o->method == MR_WRAP_AUTO, c);
	return wrap_volume(ctx, cloud, o, c);
}

/* ---- findings, at most one of a kind ---- */

static void
report_uncertain(mr_ctx *ctx, const char *what, const mr_v3 *at)
{
	mr_finding f = { .kind = MR_UNCERTAIN, .layer = "control", .what = what, .vertex = MR_NO_VERTEX };

	f.placed = at != NULL;
	if (at)
		f.at = *at;
	mr_found(ctx, &f);
}

/* Reports a topology that depends on the level, on so few points, or on how wide openings may be. */
static void
report_topology(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap *c)
{
	const mr_volume_result *v = &c->found.volume;
	const mr_wrap_lids *l = &c->lids;

	if (cloud->n < SURE_LEAST || cloud->spacing > SURE_MOST * cloud->diagonal)
		report_uncertain(ctx, ": so few points hide handles", NULL);
	else if (c->found.method == MR_WRAP_VOLUME && v->levels_alike < MR_VOLUME_LEVELS)
		report_uncertain(ctx,
		    mr_format(ctx, ": Euler number %g is that of %zu of %d levels", v->euler, v->levels_alike,
			MR_VOLUME_LEVELS),
		    NULL);
	else if (l->doubtful > 0)
		report_uncertain(ctx,
		    mr_format(ctx, ": an opening %.3g sampling distances wide is %s, and may not be meant so",
			l->width, l->flickers || l->width <= MR_WRAP_OPENING ? "closed" : "left open"),
		    &l->at);
}

/* Reports a poor wrap. */
static void
report_cover(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap *c)
{
	mr_finding f = { .kind = MR_FOLDED, .layer = "control", .count = c->folds };

	if (c->folds > 0)
		mr_found(ctx, &f);
	f = (mr_finding){ .kind = MR_CROSSING, .layer = "control", .count = c->cover.crossings };
	if (c->cover.crossings > 0)
		mr_found(ctx, &f);
	f = (mr_finding){ .kind = MR_UNREACHED, .count = c->cover.unreached, .of = cloud->sampling.places };
	f.placed = true;
	f.vertex = MR_NO_VERTEX;
	f.at = c->cover.at;
	if (c->cover.unreached > 0)
		mr_found(ctx, &f);
	mr_gaps_report(ctx, "control", &c->cover.gaps);
}

/* An open surface has two outer sides, and faces the points' own; a closed one faces outward. */
static void
take_side(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap *c, mr_mesh *m)
{
	mr_tri *t;

	if (c->lids.openings == 0) {
		mr_found(
		    ctx, &(mr_finding){ .kind = MR_GUESSED,
			     .layer = "points",
			     .what = cloud->sides->normals
		                         ? "the normals of the points point inward, and are turned over"
		                         : "the points were seen from within: their surface faces away" });
		return;
	}
	t = MR_NEW(ctx, m->nf, mr_tri);
	for (size_t f = 0; f < m->nf; f++)
		t[f] = (mr_tri){ { m->t[f].v[0], m->t[f].v[2], m->t[f].v[1] } };
	m->t = t;
}

static void
put_result(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap *c, mr_wrap_result *result)
{
	mr_wrap_result r = c->found;

	report_cover(ctx, cloud, c);
	r.places = cloud->sampling.places;
	r.outliers = cloud->sampling.outliers;
	r.sampling = cloud->spacing;
	r.gaps = c->cover.gaps;
	r.unreached = c->cover.unreached;
	r.openings = c->lids.openings;
	r.holes = c->lids.holes;
	r.faces = c->d.nf;
	r.folded_edges = c->folds;
	r.intersecting_pairs = c->cover.crossings;
	if (result)
		*result = r;
}

/* ---- the whole ---- */

static mr_status
begin(
    mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling, mr_wrap_cloud *cloud, mr_wrap *c)
{
	mr_unmeasured(&c->found, sizeof c->found);
	c->lids = (mr_wrap_lids){ 0 };
	return mr_wrap_cloud_open(ctx, point, n, sampling, cloud);
}

mr_status
mr_shrinkwrap(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling,
    const mr_outer_sides *sides, const mr_wrap_opts *opts, mr_mesh *out, mr_wrap_result *result)
{
	mr_wrap_cloud cloud;
	mr_wrap c;

	MR_TRY(begin(ctx, point, n, sampling, &cloud, &c));
	cloud.sides = sides;
	MR_TRY(wrap_by_method(ctx, &cloud, opts, &c));
	put_result(ctx, &cloud, &c, result);
	report_topology(ctx, &cloud, &c);
	*out = mr_dyn_view(&c.d, "control");
	if (c.found.method == MR_WRAP_VOLUME && c.found.volume.turned)
		take_side(ctx, &cloud, &c, out);
	return MR_OK;
}

/* By the steps of the paper, which turn no face, and at the end the faces near the points. */
mr_status
mr_wrap_template(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling, const mr_mesh *start,
    const mr_wrap_opts *opts, mr_v3 *p, mr_wrap_result *result)
{
	mr_wrap_cloud cloud;
	mr_wrap c;

	MR_TRY(begin(ctx, point, n, sampling, &cloud, &c));
	c.found.method = TEMPLATE;
	if (!(mr_mesh_edge_scale(ctx, start) > 0))
		return mr_fail(ctx, MR_EMESH, "the template's %zu vertices are at one place", start->nv);
	MR_TRY(mr_wrap_dyn(ctx, start, &c.d));
	MR_TRY(pull(ctx, &cloud, opts, true, &c));
	MR_TRY(mr_wrap_settle(ctx, &cloud, opts, TEMPLATE_SETTLES, &c.d));
	mr_unfold(&c.d);
	MR_TRY(mr_wrap_assess(ctx, &cloud, &c));
	put_result(ctx, &cloud, &c, result);
	memcpy(p, c.d.p, start->nv * sizeof *p);
	return MR_OK;
}
