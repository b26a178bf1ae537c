/*
 * judge.h -- what became of a surface: the parts of mr_judge (mr.h), which report findings and change
 * nothing.
 *
 * Private to this room.
 */
#ifndef MR_JUDGE_JUDGE_H
#define MR_JUDGE_JUDGE_H

#include "mesh/edges.h"
#include "mesh/layers.h"

/* A surface whose vertices have moved. */
typedef struct mr_motion {
	const mr_mesh *then;
	const mr_v3 *now; /* then->nv */
	const mr_edges *edges;
	double diagonal; /* of then */
} mr_motion;

/* What a surface stands on: base, or a control mesh. */
typedef struct mr_ground {
	mr_mesh then;
	const mr_v3 *now;
	mr_places at;      /* of the surface's vertices on it; face NULL: `foot` is given */
	const mr_v3 *foot; /* what they stand on, as it stood */
	const uint32_t *region, *surface_region; /* of its vertices, of the surface's; NULL: none */
} mr_ground;

/* Folds and intersections that came. */
void mr_judge_harm(mr_ctx *ctx, const mr_motion *m);

/* Parts that touched and do not any more. */
void mr_judge_contacts(mr_ctx *ctx, const mr_motion *m);

/* Edges that base does not account for: torn, or too long to follow it.  g: with places. */
void mr_judge_detail(mr_ctx *ctx, const mr_motion *m, const mr_ground *g);

/* Constrained vertices that are not where they belong, and the volume where handles only turn. */
mr_status mr_judge_pose(mr_ctx *ctx, const mr_motion *m, const mr_ground *g);

/* A surface of other triangles against what it was made of. */
mr_status mr_judge_remade(mr_ctx *ctx, const mr_mesh *then, const mr_mesh *now);

/* The largest distance that a vertex went. */
double mr_farthest(const mr_v3 *then, const mr_v3 *now, size_t n);

#endif
