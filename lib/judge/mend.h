/* mend.h -- a motion of a surface without the harm that it did. */
#ifndef MR_JUDGE_MEND_H
#define MR_JUDGE_MEND_H

#include "mesh/mesh.h"

/* Where the motion of then to `now` (then->nv) folds the surface, or makes faces meet that are near along it,
 * these go along with what is around them, as space does there: by moving least squares (Schaefer, McPhail,
 * Warren 2006: Image deformation using moving least squares, section 2.1).  held: vertices that stay where
 * they are; NULL: none.  Returns how many vertices were moved, some in
 * several rounds. */
size_t mr_mend(mr_ctx *ctx, const mr_mesh *then, const bool *held, mr_v3 *now);

#endif
