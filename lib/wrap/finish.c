/* The last steps of a wrap that is near the points: onto them, without folds, and not through itself. */
#include "remesh/unfold.h"
#include "wrap/parts.h"

enum { ITERATIONS = 4 /* by default */ };

const mr_gaps MR_WRAP_ENOUGH = { .points = { .max = 10, .high = 4 }, .surface = { .max = 6, .high = 2.5 } };

void
mr_wrap_tried(mr_wrap *w, double seconds)
{
	double before = w->found.seconds_tried;

	w->found.seconds_tried = isnan(before) ? seconds : before + seconds;
}

mr_status
mr_wrap_assess(mr_ctx *ctx, const mr_wrap_cloud *cloud, size_t samples, const char *what, mr_wrap *w)
{
	mr_mesh m = mr_dyn_view(&w->d, "control");
	double start = mr_seconds(), s = cloud->spacing;
	const mr_gaps *g = &w->cover.gaps;

	w->folds = mr_count_folds(ctx, &m, w->d.twin);
	MR_TRY(mr_wrap_measure(ctx, cloud, &m, samples, &w->cover));
	w->found.seconds_measure = mr_seconds() - start;
	mr_note(ctx,
	    "%s, %zu faces: points are within %.3g sampling distances of it, 99 %% within %.3g, "
	    "it is within %.3g of points, 99 %% within %.3g",
	    what, w->d.nf, g->points.max / s, g->points.high / s, g->surface.max / s, g->surface.high / s);
	return MR_OK;
}

/* Onto the points. */
static mr_status
settle(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *w)
{
	double start = mr_seconds();

	w->found.iterations = o->iterations ? o->iterations : ITERATIONS;
	MR_TRY(mr_wrap_settle(ctx, cloud, o, w->found.iterations, &w->d));
	w->found.seconds_settle = mr_seconds() - start;
	return MR_OK;
}

mr_status
mr_wrap_finish(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const char *what, mr_wrap *w)
{
	enum { MOST = 3 };
	mr_v3 *home = MR_NEW(ctx, w->d.nv, mr_v3);

	if (!home)
		return MR_EMEM;
	memcpy(home, w->d.p, w->d.nv * sizeof *home);
	MR_TRY(settle(ctx, cloud, o, w));
	for (int round = 0;; round++) {
		mr_unfold(&w->d, true);
		MR_TRY(mr_wrap_assess(ctx, cloud, MR_WRAP_SAMPLES, what, w));
		if (w->cover.crossings == 0 || round == MOST)
			return MR_OK;
		MR_TRY(mr_wrap_part(ctx, home, &w->d));
	}
}
