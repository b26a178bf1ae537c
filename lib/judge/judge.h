/*
 * judge.h -- what became of a surface: the parts of mr_judge (mr.h), which report findings and change
 * nothing.
 *
 * Private to this room.
 */
#ifndef MR_JUDGE_JUDGE_H
#define MR_JUDGE_JUDGE_H

#include "mesh/layers.h"

/* A surface whose vertices have moved. */
typedef struct mr_motion {
	const mr_mesh *then;
	const mr_v3 *now; /* then->nv */
	double diagonal;  /* of then, nearly */
} mr_motion;

/* What a surface stands on: base, or a control mesh. */
typedef struct mr_ground {
	mr_mesh then;
	const mr_v3 *now;
	mr_places at;                            /* of the surface's vertices on it */
	const uint32_t *region, *surface_region; /* of its vertices, of the surface's; NULL: none */
} mr_ground;

/* Reports a finding of the surface, at a vertex or MR_NONE. */
void mr_motion_found(mr_ctx *ctx, const mr_motion *m, mr_finding f, uint32_t vertex);

/* Folds and intersections that came. */
void mr_judge_harm(mr_ctx *ctx, const mr_motion *m);

/* Parts that touched and do not any more.  *closed: whether the surface has no boundary. */
void mr_judge_contacts(mr_ctx *ctx, const mr_motion *m, bool *closed);

/* Edges that base does not account for: torn, or too long to follow it. */
void mr_judge_detail(mr_ctx *ctx, const mr_motion *m, const mr_ground *g);

/* Constrained vertices that are not where they belong, and of a closed surface the volume where handles only
 * turn. */
void mr_judge_pose(mr_ctx *ctx, const mr_motion *m, const mr_ground *g, bool closed);

/* A surface of other triangles against what it was made of. */
void mr_judge_remade(mr_ctx *ctx, const mr_mesh *then, const mr_mesh *now);

/* The largest distance that a vertex went. */
double mr_farthest(const mr_v3 *then, const mr_v3 *now, size_t n);

#endif
