/*
 * guard_limit.h -- steps of a fit that fold nothing.
 */
#ifndef MR_FIT_GUARD_LIMIT_H
#define MR_FIT_GUARD_LIMIT_H

#include "fit/normal_equations.h"

/* The surface at its triangles of level 3, and what is wrong with it. */
typedef struct mr_fit_guard mr_fit_guard;

/* Looks at the surface where the control vertices are at x; in the arena. */
mr_status mr_fit_guard_new(mr_ctx *ctx, const mr_fit_surface *surface, const mr_v3 *x, mr_fit_guard **guard);

/* One a control face: its surface passes through another. */
const bool *mr_fit_crossed(const mr_fit_guard *guard);

/*
 * Moves x, where the guard saw it last, by z, and the surface with it: where a face of level 3 would turn
 * over, fold against a neighbour more sharply than it does, or pass through another where none around does,
 * the vertices that it depends on go half as far, and so on; at last they stay.  All
 * of them go no farther than mr_fit_control_limit lets them, which may change z.  patch: of mr_fit_system.
 * *damped: vertices that did not go all the way.
 */
mr_status mr_fit_step(mr_ctx *ctx, mr_fit_surface *surface, mr_fit_guard *guard, const mr_fit_lists *patch,
    mr_v3 *x, mr_v3 *z, size_t *damped);

#endif
