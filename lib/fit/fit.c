/*
 * Jeong, Kim 2001, section 4, after Suzuki, Takeuchi, Kanai 1999: Subdivision surface fitting to a range of
 * points; and by least squares: Marinov, Kobbelt 2005: Optimization methods for scattered data approximation
 * with subdivision surfaces; Huber 1964: Robust estimation of a location parameter, for the weights.
 */
#include "fit/fit.h"

#include "base/sort.h"
#include "fit/guard.h"
#include "fit/normal_equations.h"
#include "mesh/fold.h"
#include "mesh/zorder.h"
#include "space/local_planes.h"
#include "space/near.h"
#include "space/outlier.h"

enum { LOCAL_PASSES = 20, LEAST_SQUARES_PASSES = 5 };

/* Points no further than this share of a control edge are no outliers, however near the others are. */
static const double NEAR = 0.1;

/* Control edges from the surface, beyond which points are not followed. */
static const double FAR = 0.15;

/* f_i = q_i - v_i, v_i the limit points, q_i the nearest points; none of vertices without a face. */
static mr_status
forces(mr_ctx *ctx, const mr_near *near, const mr_v3 *point, const mr_loop *l, const mr_v3 *limit,
    uint32_t *nearest, mr_v3 *f)
{
	MR_TRY(mr_near_query(ctx, near, limit, l->nv, 1, nearest, NULL));
	for (size_t v = 0; v < l->nv; v++)
		f[v] = l->topo.out[v] == MR_NONE ? mr_vec(0, 0, 0) : mr_sub(point[nearest[v]], limit[v]);
	return MR_OK;
}

static mr_status
local_passes(mr_ctx *ctx, const mr_near *near, const mr_loop *l, const mr_v3 *point, double step,
    size_t passes, mr_v3 *x)
{
	mr_v3 *limit = MR_NEW(ctx, l->nv, mr_v3), *f = MR_NEW(ctx, l->nv, mr_v3);
	uint32_t *nearest = MR_NEW(ctx, l->nv, uint32_t);
	mr_sparse s;

	MR_TRY(mr_loop_limit_matrix(ctx, l, 0, &s));
	for (size_t i = 0; i < passes; i++) {
		mr_progress(ctx, "fitting", (double)i / (double)passes);
		mr_sparse_apply(ctx, &s, NULL, l->nv, 3, &x->x, &limit->x);
		MR_TRY(forces(ctx, near, point, l, limit, nearest, f));
		/* F_i = (1 - n chi) f_i + chi sum_j f_j: the mask of the limit points */
		mr_sparse_apply(ctx, &s, NULL, l->nv, 3, &f->x, &limit->x);
		for (size_t v = 0; v < l->nv; v++)
			x[v] = mr_axpy(step, limit[v], x[v]);
	}
	return MR_OK;
}

static mr_status
local(mr_ctx *ctx, mr_fit_surface *s, const mr_v3 *point, size_t n, const mr_fit_opts *opts, size_t passes,
    mr_v3 *x)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_near *near;

	MR_TRY(mr_near_build(ctx, point, n, &near));
	MR_TRY(local_passes(ctx, near, &s->level[0], point, opts->step, passes, x));
	mr_fit_surface_move(ctx, s, x, NULL);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/*
 * Huber's weights: as least squares up to `limit` standard deviations, estimated from the median; beyond, a
 * point pulls as one at the limit does.  If outliers were found, others lie too near to be found by distance:
 * beyond the limit a point then pulls less, by the cube of the ratio.
 */
static void
weigh(mr_ctx *ctx, const mr_fit_foot *foot, const double *share, size_t n, double near, bool outliers,
    double *w)
{
	static const double limit = 2.5, deviation = 1.4826;
	mr_mark mark = mr_mark_take(ctx);
	double *d = MR_NEW(ctx, n, double), most;

	for (size_t i = 0; i < n; i++)
		d[i] = foot[i].dist;
	most = fmax(limit * deviation * mr_kth(d, n, n / 2), near);
	for (size_t i = 0; i < n; i++) {
		double ratio = foot[i].dist > most ? most / foot[i].dist : 1;
		w[i] = share[i] * (outliers ? pow(ratio, 4) : ratio);
	}
	mr_mark_release(ctx, mark);
}

/*
 * How much of the surface each point stands for, the mean over those on its control face; 1 on the mean of
 * all.  Were each to count the same, the fairness would win where they are sparse.  By the points' own areas,
 * which vary by chance, clouds with noise are 2 % farther from the truth.
 */
static void
share_area(mr_ctx *ctx, const mr_fit_foot *foot, const double *spacing, size_t n, size_t nf, double *share)
{
	mr_mark mark = mr_mark_take(ctx);
	double *sum = MR_NEW_ZERO(ctx, nf, double), all = 0;
	size_t *count = MR_NEW_ZERO(ctx, nf, size_t);

	for (size_t i = 0; i < n; i++) {
		size_t f = foot[i].patch / MR_FIT_PATCHES;
		sum[f] += spacing[i] * spacing[i];
		count[f]++;
		all += spacing[i] * spacing[i];
	}
	for (size_t i = 0; i < n; i++) {
		size_t f = foot[i].patch / MR_FIT_PATCHES;
		share[i] = all > 0 ? sum[f] / (double)count[f] * (double)n / all : 1;
	}
	mr_mark_release(ctx, mark);
}

/*
 * The share of its form that the control mesh keeps as it comes: junctions and edges that a thin plate would
 * round off or web.  With noise, in spacings, its form is of the noise too.  On clean clouds of 18 models
 * half of it leaves the largest distances 16 % less, of frames, trees and lattices half of them, with 1.1 %
 * bent edges instead of 0.6; all of it leaves no less, with 2.1 %.
 */
static double
form_kept(double noise)
{
	const double most = 0.5;

	return most * fmax(0, 1 - noise / MR_NOISY);
}

/* Moves the control vertices x, and the surface with them: passes of feet, weights, equations, guarded steps.
 * noise: in usual spacings; outliers: the points had some, and may have more. */
static mr_status
least_squares(mr_ctx *ctx, mr_fit_surface *surface, const mr_v3 *point, const double *spacing, size_t n,
    double noise, const mr_fit_opts *opts, size_t passes, bool outliers, mr_fit_foot *foot, mr_v3 *x,
    mr_fit_result *result)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *z = MR_NEW(ctx, surface->level[0].nv, mr_v3);
	double *w = MR_NEW(ctx, n, double), *share = MR_NEW(ctx, n, double);
	mr_fit_system system;
	double edge = (1 << MR_FIT_LEVEL) * mr_mesh_edge_scale(ctx, &surface->m);
	mr_fit_guard *guard;

	MR_TRY(mr_fit_system_build(ctx, surface, x, form_kept(noise), &system));
	MR_TRY(mr_fit_guard_new(ctx, surface, x, &guard));
	for (size_t i = 0; i < passes; i++) {
		mr_progress(ctx, "fitting", (double)i / (double)passes);
		share_area(ctx, foot, spacing, n, surface->level[0].nf, share);
		weigh(ctx, foot, share, n, NEAR * edge, outliers, w);
		mr_fit_system_fill(ctx, &system, x, point, foot, w, n, opts->fairness);
		MR_TRY(mr_fit_solve(ctx, &system, z));
		MR_TRY(mr_fit_step(ctx, guard, x, z));
		mr_fit_attach(ctx, surface, point, n, false, foot);
	}
	result->crossing_faces = mr_fit_crossing(guard);
	if (result->crossing_faces > 0)
		mr_found(ctx, &(mr_finding){
				  .kind = MR_CROSSING, .layer = "control", .count = result->crossing_faces });
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Nodes of level 2. */
static size_t
count_folds(const mr_ctx *ctx, const mr_fit_surface *s)
{
	return mr_count_folds(ctx, &s->m, s->level[MR_FIT_LEVEL].topo.twin);
}

static void
put_distances(const mr_fit_gap *before, const mr_fit_gap *after, mr_fit_result *r)
{
	r->distance_mean_before = before->mean;
	r->distance_rms_before = before->rms;
	r->distance_max_before = before->max;
	r->distance_mean_after = after->mean;
	r->distance_rms_after = after->rms;
	r->distance_max_after = after->max;
}

/* Reports a poor result: it folds, or the points, less their noise, are as far as the control mesh is
 * coarse. */
static void
report(mr_ctx *ctx, const mr_fit_surface *s, double far, const mr_fit_result *r)
{
	mr_finding f = { .kind = MR_FOLDED, .layer = "control", .count = r->folded_edges_after };

	if (f.count > 0)
		mr_found(ctx, &f);
	f = (mr_finding){
		.kind = MR_DISTANT, .layer = "control", .what = "a finer control mesh comes nearer"
	};
	f.value = r->distance_mean_after / mr_mesh_diagonal(&s->m);
	if (r->distance_mean_after > far)
		mr_found(ctx, &f);
}

/* Takes the outliers of *n points out, and their feet; s: their sampling. */
static void
drop_outliers(mr_ctx *ctx, const mr_sampling *s, double least, mr_v3 *point, double *spacing,
    mr_fit_foot *foot, size_t *n, size_t *outliers)
{
	mr_mark mark = mr_mark_take(ctx);
	double *off = MR_NEW(ctx, *n, double);
	bool *outlier = MR_NEW(ctx, *n, bool);
	size_t kept = 0;

	for (size_t i = 0; i < *n; i++)
		off[i] = foot[i].dist;
	mr_find_outliers(ctx, s, off, least, outlier, outliers);
	for (size_t i = 0; i < *n; i++) {
		if (outlier[i])
			continue;
		point[kept] = point[i];
		spacing[kept] = s->spacing[i];
		foot[kept++] = foot[i];
	}
	*n = kept;
	mr_mark_release(ctx, mark);
}

/* Points for each control face, at most: more move it no further. */
enum { ENOUGH = 24 };

/* Some of the points, at equal strides along the Z curve, where what close ones look up is in the cache, and
 * their sampling. */
static mr_status
take_points(mr_ctx *ctx, const mr_v3 *point, size_t *n, size_t faces, const mr_sampling *known, mr_v3 *p,
    mr_sampling *s)
{
	size_t some = *n < ENOUGH * faces ? *n : ENOUGH * faces;
	uint8_t *outlier = MR_NEW(ctx, some, uint8_t), *repeat = MR_NEW(ctx, some, uint8_t);
	double *spacing = MR_NEW(ctx, some, double);

	MR_TRY(mr_sampling_find(ctx, point, *n, known, s));
	mr_sampling_sort(ctx, point, s, p, s);
	for (size_t i = 0; i < some; i++) {
		size_t from = i * *n / some;
		p[i] = p[from];
		spacing[i] = s->spacing[from];
		outlier[i] = s->outlier[from];
		repeat[i] = s->repeat[from];
	}
	s->spacing = spacing;
	s->outlier = outlier;
	s->repeat = repeat;
	s->n = *n = some;
	return MR_OK;
}

static mr_status
check(mr_ctx *ctx, const mr_mesh *control, const mr_v3 *point, size_t n)
{
	if (n == 0)
		return mr_fail(ctx, MR_EMESH, "%s: there are no points to fit it to", control->name);
	if (!(mr_mesh_diagonal(control) > 0))
		return mr_fail(ctx, MR_EMESH,
		    "%s: its %zu vertices lie at one place: there is no surface to fit", control->name,
		    control->nv);
	if (!(mr_box_diagonal(mr_box_of(point, n)) > 0))
		return mr_fail(
		    ctx, MR_EMESH, "%s: the %zu points to fit it to lie at one place", control->name, n);
	return MR_OK;
}

mr_status
mr_fit(mr_ctx *ctx, const mr_mesh *control, const uint8_t *crease, const mr_v3 *point, size_t n, bool of_mesh,
    const mr_sampling *known, const mr_fit_opts *opts, mr_v3 *out, mr_fit_result *result)
{
	mr_mark mark = mr_mark_take(ctx);
	bool is_local = opts->method == MR_FIT_LOCAL;
	size_t passes = opts->iterations ? opts->iterations : is_local ? LOCAL_PASSES : LEAST_SQUARES_PASSES;
	mr_v3 *x = MR_NEW(ctx, control->nv, mr_v3);
	mr_fit_foot *foot = mr_alloc(ctx, n, sizeof *foot);
	mr_v3 *sorted = MR_NEW(ctx, n, mr_v3);
	double *spacing = MR_NEW(ctx, n, double);
	size_t given;
	double edge = mr_mesh_edge_scale(ctx, control);
	double noise;
	mr_sampling sampling;
	mr_fit_gap before, after;
	mr_fit_result r;
	mr_fit_surface s;

	mr_unmeasured(&r, sizeof r);
	MR_TRY(check(ctx, control, point, n));
	if (is_local)
		mr_zorder_points(ctx, point, n, sorted);
	else
		MR_TRY(take_points(ctx, point, &n, control->nf, known, sorted, &sampling));
	given = n;
	memcpy(x, control->p, control->nv * sizeof *x);
	MR_TRY(mr_fit_surface_build(ctx, control, crease, &s));
	mr_fit_attach(ctx, &s, sorted, n, true, foot);
	if (!is_local)
		drop_outliers(ctx, &sampling, NEAR * edge, sorted, spacing, foot, &n, &r.outliers);
	noise = is_local || sampling.usual == 0 ? 0 : sampling.noise / sampling.usual;
	before = mr_fit_measure(ctx, foot, n);
	/* a control mesh made of that mesh lies on it: passes would bend flats beside creases */
	if (of_mesh && crease && !is_local && opts->iterations == 0 && before.mean < NEAR * edge)
		passes = 0;
	r.folded_edges_before = count_folds(ctx, &s);
	MR_TRY(is_local
		   ? local(ctx, &s, sorted, n, opts, passes, x)
		   : least_squares(ctx, &s, sorted, spacing, n, noise, opts, passes, n < given, foot, x, &r));
	r.iterations = passes;
	if (is_local)
		mr_fit_attach(ctx, &s, sorted, n, true, foot);
	after = mr_fit_measure(ctx, foot, n);
	r.folded_edges_after = count_folds(ctx, &s);
	put_distances(&before, &after, &r);
	report(ctx, &s, FAR * edge + (is_local ? 0 : sampling.noise), &r);
	if (result)
		*result = r;
	memcpy(out, x, control->nv * sizeof *out);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
