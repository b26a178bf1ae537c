/*
 * fit_guard.h -- steps of a fit that fold nothing.
 *
 * Layer rule: alg.
 */
#ifndef MR_FIT_GUARD_H
#define MR_FIT_GUARD_H

#include "alg/fit_system.h"

/* The control faces whose surface, where the control vertices are at x, passes through another by its
 * triangles of level 3.  crosses: one a control face, the caller's. */
mr_status mr_fit_crossings(mr_ctx *ctx, const mr_fit_surface *surface, const mr_v3 *x, bool *crosses);

/*
 * Moves x by z, and the surface with it: where a face of level 3 would turn over, fold against a neighbour
 * more sharply than it does, or pass through another where none around does, the vertices that it depends on
 * go half as far, and so on; at last they stay.  patch: of mr_fit_system.  crossed: of mr_fit_crossings,
 * brought up to date.  *damped: vertices that did not go all the way.
 */
mr_status mr_fit_step(mr_ctx *ctx, mr_fit_surface *surface, const mr_fit_lists *patch, bool *crossed,
    mr_v3 *x, const mr_v3 *z, size_t *damped);

#endif
