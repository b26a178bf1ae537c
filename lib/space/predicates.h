/*
 * predicates.h -- on which side a point lies: the exact sign, for any doubles.
 *
 * Contract: a fast evaluation with an error bound, and exact arithmetic where the
 * bound does not decide; so equal answers for every permutation of the arguments
 * (up to its sign).  Exact as long as no product leaves the range of doubles
 * (coordinates between 1e-70 and 1e70, or zero).
 */
#ifndef MR_SPACE_PREDICATES_H
#define MR_SPACE_PREDICATES_H

#include "base/vec.h"

/* The sign, 1, 0 or -1, of the volume of a b c d: 1 where a b c runs counter-clockwise seen from d. */
int mr_orient3d(mr_v3 a, mr_v3 b, mr_v3 c, mr_v3 d);

/* The same without exact arithmetic: false where that would be needed. */
bool mr_orient3d_is_plain(mr_v3 a, mr_v3 b, mr_v3 c, mr_v3 d, int *side);

/* The sign of the area of a b c in the plane of two coordinates (axis dropped: 0 x, 1 y, 2 z), in cyclic
 * order. */
int mr_orient2d(mr_v3 a, mr_v3 b, mr_v3 c, int dropped);

#endif
