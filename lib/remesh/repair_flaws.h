/*
 * repair_flaws.h -- takes the flipped faces and the folds that remeshing left out of a mesh.
 */
#ifndef MR_REMESH_REPAIR_FLAWS_H
#define MR_REMESH_REPAIR_FLAWS_H

#include "remesh/relax.h"

/*
 * Around every flipped face (remesh/orientation.h) and every fold (mesh/fold.h): moves a vertex, on the
 * surface where it can be, flips an edge or merges two vertices, the first that leaves fewer of both there;
 * until nothing does, 8 times at most, then with worse shapes allowed.  Needles are made only when all else
 * has been tried.  A merge leaves holes in the numbering.  As a last resort tips are unpinned and vertices of
 * a boundary or curve merged along it.
 */
void mr_mend_flaws(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, bool last);

#endif
