/*
 * moved.h -- what a motion has done to a surface: looked for, put into the result, and warned of.
 *
 * Of a sequence it is warned of once, and again where the harm has doubled.  Private to this room.
 */
#ifndef MR_TOOL_MOVED_H
#define MR_TOOL_MOVED_H

#include "edit/detail.h"
#include "edit/held.h"
#include "tool/cache.h"

typedef struct mr_moved {
	mr_frame *f;
	mr_cache *cache;     /* NULL: no sequence */
	const mr_mesh *mesh; /* as it stood */
	const mr_edges *edges;
	const mr_v3 *p;          /* where its vertices are now */
	const mr_mesh *base;     /* that it follows, now; NULL: none, as for those that say so */
	const mr_incidence *inc; /* of base */
	const mr_detail *detail;
	double gain; /* of detail, or heights */
	mr_decode_result *result;
} mr_moved;

/* Folds, and faces that intersect.  The first of all looks: it begins a sequence.  base: may be NULL. */
mr_status mr_moved_harm(mr_ctx *ctx, const mr_moved *m) MR_WARN_UNUSED;

/* Detail that is torn where base is not. */
void mr_moved_strayed(mr_ctx *ctx, const mr_moved *m);

/* Straight edges that cut across a bend of base, or a twist. */
mr_status mr_moved_chords(mr_ctx *ctx, const mr_moved *m) MR_WARN_UNUSED;

/* Parts that touched and do not any more.  base: may be NULL. */
void mr_moved_gaps(mr_ctx *ctx, const mr_moved *m, const mr_contacts *contacts);

/* Constrained vertices that are not where they belong, and what turning handles did to the volume, since
 * the pose began.  base: may be NULL. */
mr_status mr_moved_pose(mr_ctx *ctx, const mr_moved *m, const mr_held_pose *pose) MR_WARN_UNUSED;

#endif
