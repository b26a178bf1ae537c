/*
 * Marinov, Kobbelt 2005: Optimization methods for scattered data approximation with subdivision surfaces;
 * Huber 1964: Robust estimation of a location parameter, for the weights.
 */
#include "fit/least_squares.h"

#include "base/sort.h"
#include "fit/guard.h"
#include "fit/normal_equations.h"

/*
 * Huber's weights: as least squares up to `limit` standard deviations, estimated from the median; beyond, a
 * point pulls as one at the limit does.  Where outliers were found there are others too near to be told by
 * where they lie: beyond the limit a point then pulls by the cube of the ratio less.
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

mr_status
mr_fit_least_squares(mr_ctx *ctx, mr_fit_surface *surface, const mr_v3 *point, const double *spacing,
    size_t n, double noise, const mr_fit_opts *opts, size_t passes, bool outliers, mr_fit_foot *foot,
    mr_v3 *x, mr_fit_result *result)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *z = MR_NEW(ctx, surface->level[0].nv, mr_v3);
	double *w = MR_NEW(ctx, n, double), *share = MR_NEW(ctx, n, double);
	mr_fit_system system;
	size_t steps = 0;
	double edge = (1 << MR_FIT_LEVEL) * mr_mesh_edge_scale(ctx, &surface->m);
	mr_fit_guard *guard;

	MR_TRY(mr_fit_system_build(ctx, surface, x, form_kept(noise), &system));
	MR_TRY(mr_fit_guard_new(ctx, surface, x, &guard));
	for (size_t i = 0; i < passes; i++) {
		mr_progress(ctx, "fitting", (double)i / (double)passes);
		share_area(ctx, foot, spacing, n, surface->level[0].nf, share);
		weigh(ctx, foot, share, n, MR_FIT_NEAR * edge, outliers, w);
		mr_fit_system_fill(ctx, &system, x, point, foot, w, n, opts->fairness);
		MR_TRY(mr_fit_solve(ctx, &system, z, &steps));
		MR_TRY(mr_fit_step(ctx, guard, x, z, &result->damped));
		mr_fit_surface_move(ctx, surface, x);
		mr_fit_attach(ctx, surface, point, n, false, foot);
	}
	result->cg_steps = (double)steps / (double)passes;
	result->crossing_faces = mr_fit_crossing(guard);
	if (result->crossing_faces > 0)
		mr_found(ctx, &(mr_finding){
				  .kind = MR_CROSSING, .layer = "control", .count = result->crossing_faces });
	mr_mark_release(ctx, mark);
	return MR_OK;
}
