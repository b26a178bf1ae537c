/*
 * shrinkwrap.h -- a closed mesh drawn tight around unorganised points (Jeong, Kim 2001, section 3).
 */
#ifndef MR_WRAP_SHRINKWRAP_H
#define MR_WRAP_SHRINKWRAP_H

#include "mesh/mesh.h"

typedef enum mr_wrap_method {
	MR_WRAP_AUTO,  /* a box, coarse to fine, searching along normals; the volume where its first level
	                  or its last does not cover the points */
	MR_WRAP_CUBE,  /* the paper's, to the letter: genus 0 */
	MR_WRAP_VOLUME /* volume/volume.h, then projected and smoothed */
} mr_wrap_method;

typedef struct mr_wrap_opts {
	int method;
	size_t resolution; /* edges of the wrap along a side of the bounding cube; 0: by the sampling */
	size_t grid;       /* cells of the volume; 0: from the sampling density */
	double alpha;      /* share of the way to the nearest point */
	double lambda;     /* of tangential smoothing */
	size_t iterations; /* of projection and smoothing; 0: as many as the method needs by default */
} mr_wrap_opts;

#define MR_WRAP_DEFAULTS                                                                                     \
	{                                                                                                    \
		.method = MR_WRAP_AUTO, .alpha = 0.5, .lambda = 0.2                                          \
	}

/*
 * Wraps n points; those that repeat a place count once.  MR_EMESH where they cannot have a closed surface:
 * fewer than four places, collinear, coplanar.  out: in the arena.  Figures: see man/mr-shrinkwrap.1.
 */
mr_status mr_shrinkwrap(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_wrap_opts *opts, mr_mesh *out);

/* Wraps a given mesh (a template, already about in place) around the points: its connectivity stays.  p:
 * start->nv, the caller's. */
mr_status mr_wrap_template(
    mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_mesh *start, const mr_wrap_opts *opts, mr_v3 *p);

#endif
