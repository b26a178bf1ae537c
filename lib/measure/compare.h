/*
 * compare.h -- how far two surfaces, or clouds, are from one another.
 *
 * Contract: distances are from points of one to the nearest point of the other,
 * exact point to triangle.  Mean and root mean square are integrals over the
 * surface by the midpoint rule on a subdivision of its faces; the greatest
 * distance lies between max, which is attained, and max_bound.
 * A mesh without faces is a cloud: its points weigh one each.
 */
#ifndef MR_MEASURE_COMPARE_H
#define MR_MEASURE_COMPARE_H

#include "mesh/mesh.h"

typedef struct mr_compare_opts {
	size_t
	    samples; /* pieces of about equal area to integrate over, and one a face at least; 0: 100,000 */
	bool vertices_only; /* measure from the vertices alone, each weighing one */
	double tolerance;   /* max_bound is sought within this share of max */
	size_t
	    effort; /* most pieces looked at for it, besides; 0: 200,000, or two a face where that is more */
} mr_compare_opts;

#define MR_COMPARE_DEFAULTS                                                                                  \
	{                                                                                                    \
		.samples = 0, .vertices_only = false, .tolerance = 1e-3, .effort = 0                         \
	}

/* From one surface to the other, in units of the positions. */
typedef struct mr_distance {
	double min;       /* least of the measured points */
	double max;       /* greatest of them: a lower bound of the one-sided Hausdorff distance */
	double max_bound; /* an upper bound of it */
	double mean, rms;
	size_t samples; /* points measured for mean and rms */
} mr_distance;

/* Of two layers with the same connectivity: vertex by vertex, and |edge of b| / |edge of a|.  NaN where there
 * is none. */
typedef struct mr_deviation {
	double max, mean, rms; /* distances between a vertex of a and of b */
	size_t vertex;         /* where the greatest is */
	double stretch_min, stretch_mean, stretch_max;
} mr_deviation;

typedef struct mr_comparison {
	mr_distance ab, ba;
	mr_distance both; /* the two surfaces weigh the same */
	bool corresponds; /* same connectivity: deviation is there */
	mr_deviation deviation;
	double diagonal; /* of b's bounding box: what relative figures divide by */
} mr_comparison;

/* MR_EMESH where a or b has no points. */
mr_status mr_compare(
    mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *opts, mr_comparison *comparison);

#endif
