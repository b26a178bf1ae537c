/* enclosed.h -- the volume that the closed parts of a surface enclose. */
#ifndef MR_SPACE_ENCLOSED_H
#define MR_SPACE_ENCLOSED_H

#include "mesh/mesh.h"

/* The sum of what they enclose, whichever way their faces turn; 0 where none does, as a sheet with two sides.
 */
mr_status mr_enclosed_volume(mr_ctx *ctx, const mr_mesh *m, double *volume) MR_WARN_UNUSED;

/*
 * What they enclose where the vertices are at p, as a share of what they do at rest: a part that was turned
 * inside out counts against the others.  NaN where none encloses any.
 */
mr_status mr_enclosed_share(mr_ctx *ctx, const mr_mesh *m, const mr_v3 *p, double *share) MR_WARN_UNUSED;

#endif
