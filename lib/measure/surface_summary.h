/*
 * surface_summary.h -- every figure of a surface that mr-info reports: counts, sizes, intersections, vertex
 * areas.
 */
#ifndef MR_MEASURE_SURFACE_SUMMARY_H
#define MR_MEASURE_SURFACE_SUMMARY_H

#include "measure/measure.h"

/* Mixed Voronoi areas A of the interior vertices, those of faces that no boundary edge ends at.  NaN without
 * any. */
typedef struct mr_evenness {
	size_t vertices;
	double mean;
	double error;    /* mean |A - mean| / mean */
	double variance; /* variance / mean^2 */
} mr_evenness;

typedef struct mr_surface_figures {
	mr_census census;
	mr_geometry geometry;
	mr_evenness evenness;
	size_t intersections; /* pairs of faces (space/self_intersect.h) */
} mr_surface_figures;

/* All of them; intersections is 0 where they are not asked for. */
mr_status mr_measure_surface(mr_ctx *ctx, const mr_mesh *m, bool intersections, mr_surface_figures *surface);

#endif
