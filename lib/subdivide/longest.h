/*
 * longest.h -- long edges divided, the surface as it was.
 */
#ifndef MR_SUBDIVIDE_LONGEST_H
#define MR_SUBDIVIDE_LONGEST_H

#include "subdivide/columns.h"

/* As many triangles may come of it. */
enum { MR_LONGEST_MOST = 100000000 };

/*
 * Divides every edge that is longer than `length` (to a share of 1e-9), evenly and the same from both sides.
 * New vertices lie on the old triangles.  Any mesh will do.
 *
 * r: in the arena; r->m is m, r->level NULL.  MR_ERANGE where there may be more than MR_LONGEST_MOST
 * triangles, before any work, with a length that makes fewer.
 */
mr_status mr_divide_longest(mr_ctx *ctx, const mr_mesh *m, double length, mr_refined *r) MR_WARN_UNUSED;

#endif
