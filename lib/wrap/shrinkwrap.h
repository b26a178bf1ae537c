/*
 * shrinkwrap.h -- a mesh drawn tight around unorganised points (Jeong, Kim 2001, section 3).
 */
#ifndef MR_WRAP_SHRINKWRAP_H
#define MR_WRAP_SHRINKWRAP_H

#include "space/sampling.h"
#include "volume/volume.h"

/*
 * Wraps n points; those that repeat a place count once, outliers not at all.  sampling, sides: the points',
 * or NULL if unknown.  The mesh is manifold, and open where the options leave it so.  MR_EMESH if they cannot
 * have a closed surface: fewer than four places, collinear, coplanar.  out: in the arena.  result: or NULL.
 */
mr_status mr_shrinkwrap(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling,
    const mr_outer_sides *sides, const mr_wrap_opts *opts, mr_mesh *out, mr_wrap_result *result);

/* Wraps a given mesh (a template, already about in place) around the points: its connectivity stays.  p:
 * start->nv, the caller's. */
mr_status mr_wrap_template(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling,
    const mr_mesh *start, const mr_wrap_opts *opts, mr_v3 *p, mr_wrap_result *result);

#endif
