/*
 * fit.h -- control meshes whose Loop limit surface comes close to points (Jeong, Kim 2001, section 4).
 */
#ifndef MR_FIT_H
#define MR_FIT_H

#include "space/sampling.h"
#include "subdivide/loop.h"

/*
 * Fits the control mesh, oriented manifold, to n points: out, control->nv positions, the caller's.  of_mesh:
 * they are a mesh's vertices.  sampling: the points', or NULL if unknown.  MR_EMESH without points or with
 * all at one place.  result: or NULL.
 */
mr_status mr_fit(mr_ctx *ctx, const mr_mesh *control, const uint8_t *crease, const mr_v3 *point, size_t n,
    bool of_mesh, const mr_sampling *sampling, const mr_fit_opts *opts, mr_v3 *out, mr_fit_result *result);

#endif
