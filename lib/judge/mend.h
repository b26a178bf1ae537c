/* mend.h -- a motion of a surface without the harm that it did. */
#ifndef MR_JUDGE_MEND_H
#define MR_JUDGE_MEND_H

#include "mesh/mesh.h"

/* Mends `now`, the moved vertices of then, where the motion folds the surface or makes near faces intersect.
 * Such a patch follows its surroundings by moving least squares (Schaefer, McPhail, Warren 2006: Image
 * deformation using moving least squares, section 2.1).  held: vertices that must stay; NULL: none. */
void mr_mend(mr_ctx *ctx, const mr_mesh *then, const bool *held, mr_v3 *now);

#endif
