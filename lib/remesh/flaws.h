/*
 * flaws.h -- flipped faces and folds (mesh/fold.h) that remeshing left, counted and taken out.
 *
 * Contract: a face is flipped where it points against the faces of the source at all its three corners.
 */
#ifndef MR_REMESH_FLAWS_H
#define MR_REMESH_FLAWS_H

#include "remesh/relax.h"

typedef struct mr_flaws {
	size_t flipped, folded; /* faces and edges */
} mr_flaws;

mr_flaws mr_flaws_count(mr_ctx *ctx, const mr_dyn *d, const mr_remesh_source *s);

/*
 * Around every flaw moves a vertex, on the surface where it can be, flips an edge or merges two vertices, the
 * first that leaves fewer flaws there; until nothing does, then with worse shapes allowed, and as the last
 * resort tips unpinned.  A merge leaves holes in the numbering.
 */
void mr_mend_flaws(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s);

#endif
