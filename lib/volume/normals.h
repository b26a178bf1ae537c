/*
 * normals.h -- normals of points: the planes of their neighbours, and which side of these is outside.
 */
#ifndef MR_VOLUME_NORMALS_H
#define MR_VOLUME_NORMALS_H

#include "space/sampling.h"

/*
 * Unit normals of n distinct places along the Z curve, of least squares through `neighbours` nearest of the
 * sampling.  toward: n directions to the side that a normal is on, of any length, 0 where none is known:
 * there neighbours tell, and of parts that have none at all it is as without.  Without toward (NULL) they
 * point out of what the places enclose, as mr_volume_wrap finds it; those of flat clouds point all to one
 * side.  MR_EMESH of fewer than three places, and on a line. normal: n, the caller's.
 */
mr_status mr_places_normals(mr_ctx *ctx, mr_v3 *place, size_t n, const mr_sampling *of, const mr_v3 *toward,
    mr_v3 *normal) MR_WARN_UNUSED;

#endif
