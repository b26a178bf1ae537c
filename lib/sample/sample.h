/*
 * sample.h -- the displacement of a domain surface to points without connectivity, or to a mesh (Jeong, Kim
 * 2001, section 5).
 */
#ifndef MR_SAMPLE_H
#define MR_SAMPLE_H

#include "space/sampling.h"
#include "subdivide/displaced.h"

enum { MR_SAMPLE_MOST = 128 }; /* neighbours, at most */

/*
 * Heights over the domain to the points: d->m.nv, the caller's.  sampling: the points', or NULL if unknown.
 * A vertex that finds no valid triangle is filled smoothly from its neighbours and counted; heights that fold
 * the surface are drawn to the domain, if `refine` is not 0.  MR_EMESH if the points cannot make a surface
 * (fewer than four, all equal, collinear, coplanar with a closed control mesh).  Figures: see
 * man/mr-sample.1.
 */
mr_status mr_sample_points(mr_ctx *ctx, const mr_domain *d, const mr_v3 *point, size_t n,
    const mr_sampling *sampling, const mr_sample_opts *opts, double *height, mr_sample_result *result);

/* The same to the surface of a mesh, by the first hit of the line along the normal on the near sheet (Lee et
 * al. 2000). */
mr_status mr_sample_mesh(mr_ctx *ctx, const mr_domain *d, const mr_mesh *mesh, const mr_sample_opts *opts,
    double *height, mr_sample_result *result);

/* Carries columns of the points to the vertices of the displaced surface, each from the places that count and
 * lie on its sheet; at most six of the nearest, weighted by the inverse squares of the distances. */
mr_status mr_sample_columns(mr_ctx *ctx, const mr_domain *d, const double *height, const mr_v3 *point,
    const mr_sampling *sampling, const mr_carried *column, size_t count);

/* The same of the vertices of a mesh, each from the nearest place on it. */
void mr_sample_mesh_columns(mr_ctx *ctx, const mr_domain *d, const double *height, const mr_mesh *m,
    const mr_carried *column, size_t count);

#endif
