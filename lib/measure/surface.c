/* Census, geometry and intersections together, and how even the areas of the vertices are. */
#include "measure/measure.h"

#include "op/voronoi_area.h"
#include "space/self_intersect.h"

/* Moves the areas of interior vertices to the front and returns how many there are. */
static size_t
keep_interior(const mr_mesh *m, const mr_edges *edges, bool *boundary, double *area)
{
	size_t n = 0;

	mr_mark_boundary(m, edges, boundary);
	for (size_t v = 0; v < m->nv; v++)
		if (!boundary[v] && area[v] > 0) /* none: isolated, or only in faces without area */
			area[n++] = area[v];
	return n;
}

/* What is rounding of a ratio is zero. */
static double
tidy(double ratio)
{
	return fabs(ratio) < 1e-12 ? 0 : ratio;
}

static void
measure_evenness(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, mr_evenness *out)
{
	MR_SCOPE(ctx);
	double *area = MR_NEW(ctx, m->nv, double), error = 0;
	bool *boundary = MR_NEW(ctx, m->nv, bool);
	mr_spread s;
	size_t n;

	mr_voronoi_areas(ctx, m, area);
	n = keep_interior(m, edges, boundary, area);
	s = mr_spread_of(area, n);
	for (size_t i = 0; i < n; i++)
		error += fabs(area[i] - s.mean);
	*out = (mr_evenness){ n, s.mean, n ? tidy(error / ((double)n * s.mean)) : NAN,
		tidy(s.deviation / s.mean * (s.deviation / s.mean)) };
}

mr_status
mr_measure_surface(mr_ctx *ctx, const mr_mesh *m, bool intersections, mr_surface_figures *out)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_surface_figures s = { .intersections = MR_UNKNOWN };
	mr_edges edges;

	MR_ENTER(ctx);
	mr_edges_build(ctx, m, &edges);
	mr_take_census(ctx, m, &edges, &s.census);
	mr_measure_geometry(ctx, m, &edges, &s.geometry);
	measure_evenness(ctx, m, &edges, &s.evenness);
	mr_mark_release(ctx, mark);
	if (intersections)
		mr_self_intersections(ctx, NULL, m, NULL, &s.intersections);
	*out = s;
	return MR_OK;
}
