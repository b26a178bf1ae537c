/* align.h -- the rigid motion that brings one surface or cloud onto another, wherever they are; nothing
 * depends on axes, units or threads. */
#ifndef MR_ALIGN_ALIGN_H
#define MR_ALIGN_ALIGN_H

#include "mesh/mesh.h"

/* A surface, or a cloud; normal: of its points, or NULL where they are not known. */
typedef struct mr_align_side {
	const mr_mesh *m;
	const mr_v3 *normal;
} mr_align_side;

/* Brings a to b; scale: it may grow or shrink as well.  *r says whether it was found.  MR_EMESH where a side
 * has too few points. */
mr_status
mr_align(mr_ctx *ctx, mr_align_side a, mr_align_side b, bool scale, mr_align_result *r) MR_WARN_UNUSED;

/* Brings each of n sides to the first that it can be joined with, by way of others; r: of each, by the pair
 * that joins it.  Of parts that cannot be joined the largest is taken, and of that the first stays. */
mr_status mr_align_all(mr_ctx *ctx, const mr_align_side *side, size_t n, mr_align_result *r) MR_WARN_UNUSED;

/* Reports as unaligned what a motion brings to a quarter of its comparison `apart`; where somebody listens.
 * */
mr_status
mr_align_judge(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_comparison *apart) MR_WARN_UNUSED;

#endif
