/*
 * guard_control.h -- steps of a fit that leave the control mesh fit to be edited: without folds and without
 * faces that pass through others, but for those it had.
 */
#ifndef MR_FIT_GUARD_CONTROL_H
#define MR_FIT_GUARD_CONTROL_H

#include "subdivide/loop.h"

/* A control mesh before and after a step. */
typedef struct mr_fit_control {
	const mr_loop *level;
	mr_v3 *seen;           /* its vertices where they were looked at last */
	mr_v3 *before, *after; /* unit normals of its faces when the vertices came to rest, and as seen */
	bool *tangled;         /* vertices of faces that passed through others when they came to rest */
	bool *crosses, *bad;   /* faces as seen: pass through others; that they are not to */
	bool *moved;           /* faces: since they were seen last */
	int smooths;           /* of the motions of a step, to be done yet */
} mr_fit_control;

/* The control mesh with vertices at x; in the arena. */
mr_status mr_fit_control_new(mr_ctx *ctx, const mr_loop *level, const mr_v3 *x, mr_fit_control *c);

/* The vertices stay where they were seen last: the next step begins there. */
void mr_fit_control_rest(mr_fit_control *c);

/*
 * Where the vertices go: to = x + share z.  Where that closes an edge beyond 160 degrees that was less so, or
 * lets a face pass through another but around those that do, the motions z of the corners become more like
 * those around them, a few times over all the calls for a step, so that what sticks out moves as a whole;
 * then their shares are halved, at last to 0, until it does not.
 */
mr_status
mr_fit_control_limit(mr_ctx *ctx, mr_fit_control *c, const mr_v3 *x, mr_v3 *z, double *share, mr_v3 *to);

#endif
