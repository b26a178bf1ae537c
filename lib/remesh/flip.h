/*
 * flip.h -- regular connectivity by flips: step 3 of the remeshing, and beyond it the gliding of
 * dislocations.
 */
#ifndef MR_REMESH_FLIP_H
#define MR_REMESH_FLIP_H

#include "mesh/dynmesh.h"

/*
 * Flips every edge whose flip lowers the sum of squared deviations from valence 6 (4 on the boundary), then
 * lets dislocations, adjacent pairs of a 5- and a 7-valent vertex, glide.  A glide has up to `reach` flips
 * that keep the sum, and a last one that lowers it.  No flip turns a face over or makes a needle.  *flips:
 * how many, without glides that came to nothing.
 */
void mr_regularize(mr_ctx *ctx, mr_dyn *d, unsigned reach, size_t *flips);

/*
 * True where the two faces after the flip of h face the old ones' common way, within 60 degrees, are not near
 * a fold against their neighbours, and are no needles.
 */
bool mr_flip_is_good(const mr_dyn *d, uint32_t h);

#endif
