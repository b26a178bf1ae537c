/*
 * guard.h -- steps of a fit that fold nothing, neither the limit surface nor the control mesh, which is to be
 * edited, and let nothing pass through itself.
 *
 * Contract: existing folds may move on, else they would never come apart.
 */
#ifndef MR_FIT_GUARD_H
#define MR_FIT_GUARD_H

#include "fit/limit_surface.h"

/* The control mesh and the nodes of its surface, and their flaws. */
typedef struct mr_fit_guard mr_fit_guard;

/* Looks at them where the control vertices are at x, as the surface's are; in the arena. */
mr_status mr_fit_guard_new(mr_ctx *ctx, mr_fit_surface *surface, const mr_v3 *x, mr_fit_guard **guard);

/* How many control faces have a surface that passes through another. */
size_t mr_fit_crossing(const mr_fit_guard *guard);

/*
 * Moves x, where the guard saw it last, by z, and the surface with it.  If that would close an edge of the
 * control mesh beyond 170 degrees that was less so, or let a face of it pass through another, z becomes more
 * like the motions around.  Then vertices that still would go half as far, and so on; at last it stays.  So
 * do the corners of faces whose surface would close beyond 150 degrees or pass through itself.
 */
mr_status mr_fit_step(mr_ctx *ctx, mr_fit_guard *guard, mr_v3 *x, mr_v3 *z);

#endif
