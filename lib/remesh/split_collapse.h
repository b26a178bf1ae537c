/*
 * split_collapse.h -- steps 1 and 2 of the remeshing: splits and merges bring edges to the target length.
 *
 * Contract: topology, curves and corners stay; no merge folds or flips a face.
 */
#ifndef MR_REMESH_SPLIT_COLLAPSE_H
#define MR_REMESH_SPLIT_COLLAPSE_H

#include "remesh/relax.h"

/* What was done, added up. */
typedef struct mr_resampled {
	size_t splits, collapses;
	size_t refused; /* collapses that would have folded: from the next on, lengths give way there */
} mr_resampled;

/* Splits the edges that are longer than 4/3 of their target, or stretched, at their middle. */
mr_status mr_split_long(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, mr_resampled *done);

/* Merges the ends of edges that are shorter than 4/5 of their target, or squeezed. */
mr_status mr_collapse_short(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, mr_resampled *done);

/* Takes out needles: flips their longest side away or merges the ends of a side. */
mr_status mr_mend_needles(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, mr_resampled *done);

#endif
