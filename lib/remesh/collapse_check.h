/*
 * collapse_check.h -- what merging two vertices would do to the faces around them.
 */
#ifndef MR_REMESH_COLLAPSE_CHECK_H
#define MR_REMESH_COLLAPSE_CHECK_H

#include "remesh/relax.h"

/*
 * True where merging the neighbours a and b at p would bring a face around them near a fold
 * (mesh/fold.h) against a neighbour that it is not near one with yet, or flip it: turn it against the source
 * at all three corners.  axis: a normal of the surface there, to be quick where all faces look that way.
 */
bool
mr_merging_folds(const mr_dyn *d, const mr_remesh_source *s, uint32_t a, uint32_t b, mr_v3 p, mr_v3 axis);

#endif
