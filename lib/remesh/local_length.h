/*
 * local_length.h -- shorter edges where a surface is thinner than an edge.
 *
 * A limb, a plate or a strip that is thinner than an edge cannot be followed by such edges without folds.  It
 * shows where edges cannot be merged since that would fold: there the target length gives way.
 */
#ifndef MR_REMESH_LOCAL_LENGTH_H
#define MR_REMESH_LOCAL_LENGTH_H

#include "remesh/relax.h"

/* Gives every vertex a factor of the target length, 1 to begin with. */
void mr_refine_begin(mr_ctx *ctx, mr_dyn *d);

/* Lowers the factors at the ends of h to what keeps the edge from being too short: by 0.7 at most, and not
 * below 1/8.  Without factors nothing happens. */
void mr_refine_edge(mr_dyn *d, const mr_remesh_source *s, uint32_t h);

/* Lowers factors until lengths grow by at most half of the way along edges. */
void mr_refine_grade(mr_dyn *d, const mr_remesh_source *s);

#endif
