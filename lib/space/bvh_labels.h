/*
 * bvh_labels.h -- of a mesh whose faces have labels, what is near of other labels than one's own.
 *
 * Contract: as that of bvh.h, but for the bound on what a query looks at.
 */
#ifndef MR_SPACE_BVH_LABELS_H
#define MR_SPACE_BVH_LABELS_H

#include "space/bvh.h"

typedef struct mr_bvh_labels {
	const mr_bvh *bvh;
	const uint32_t *face; /* of each face */
	uint32_t *node;       /* what all faces below a node have, MR_NONE where they have several */
} mr_bvh_labels;

/* label: one a face, MR_NONE for what is alone; kept, as is bvh.  labels: in the arena. */
void mr_bvh_label(mr_ctx *ctx, const mr_bvh *bvh, const uint32_t *label, mr_bvh_labels *labels);

/*
 * Of the labels other than `own` that are at most sqrt(dist2) away the `most` nearest ones, and the nearest
 * point of each: out, the caller's, the nearest first, of several the lowest face.  Returns how many.  Where
 * boxes of many faces lie over each other something near may be missed: a query looks at 300 nodes, those
 * of near boxes first.  No label is MR_NONE.
 */
size_t mr_bvh_closest_others(
    const mr_bvh_labels *labels, mr_v3 q, uint32_t own, double dist2, size_t most, mr_closest *out);

#endif
