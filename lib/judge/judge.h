/* judge.h -- what became of a surface: the parts of mr_judge (mr.h).  Private to this room. */
#ifndef MR_JUDGE_JUDGE_H
#define MR_JUDGE_JUDGE_H

#include "mesh/layers.h"

typedef float mr_float4 __attribute__((vector_size(16)));

/* The faces around a vertex: the sums of their unit normals, then and now, each followed by their number. */
typedef struct mr_ring {
	mr_float4 then, now;
} mr_ring;

/* A surface whose vertices have moved, and figures from one look at each face. */
typedef struct mr_motion {
	const mr_mesh *then;
	const mr_v3 *now; /* then->nv */
	double diagonal;  /* of then, nearly */
	mr_ring *ring;    /* of the vertices */
	double longest;   /* edge, then */
	uint32_t
	    *changed; /* half-edges, each edge once, that are over twice or under half as long as they were */
	size_t changes;
	double cell;    /* the side of small cells, of a few vertices each */
	uint32_t *wide; /* faces that are wider than that, ascending */
	size_t wides;
} mr_motion;

/* A motion of the same triangles.  In the arena. */
mr_motion mr_motion_of(mr_ctx *ctx, const mr_mesh *then, const mr_v3 *now);

/* The support of a surface: base, or a control mesh. */
typedef struct mr_ground {
	mr_mesh then;
	const mr_v3 *now;
	const uint32_t *face;                    /* that the surface's vertices are on */
	const uint32_t *region, *surface_region; /* of its vertices, of the surface's; NULL: none */
} mr_ground;

/* Reports a finding of the surface, at a vertex or MR_NONE. */
void mr_motion_found(mr_ctx *ctx, const mr_motion *m, mr_finding f, uint32_t vertex);

/* New self-intersections.  Near faces that meet, connected there, are harm; far faces that meet may be meant:
 * a limb that meets another one, or a sheet that passes through the one beneath. */
typedef struct mr_harm {
	size_t folds;                /* edges, by more than 170 degrees */
	size_t pairs, far;           /* of faces that intersect, near ones and others */
	uint32_t vertex, far_vertex; /* of the faces that have most of it; MR_NONE without any */
} mr_harm;

/* Looked for where the surface may touch itself: in cells of space that hold a face which turned against
 * those around it, or vertices that were far apart.  marks: of the vertices (NULL: not wanted): sets
 * those of corners of faces that are folded, or meet near or far ones, more than they did. */
enum { MR_HARM_NEAR = 1, MR_HARM_FOLD = 2, MR_HARM_FAR = 4 };
void mr_harm_find(mr_ctx *ctx, const mr_motion *m, uint8_t *marks, mr_harm *harm);

/* Whether so many folds, or near pairs, of nf faces are to be told of. */
bool mr_harm_folds(const mr_harm *h, size_t nf);
bool mr_harm_crosses(const mr_harm *h, size_t nf);

/* Whether faces f and g stand to each other as they did: where they touch, rounding decides the rest. */
bool mr_faces_stand(const mr_mesh *before, const mr_mesh *after, uint32_t f, uint32_t g);

/* Folds and intersections that came. */
void mr_judge_harm(mr_ctx *ctx, const mr_motion *m);

/* Parts that are nearer to each other than the first touch, and are apart beyond the second: shares of the
 * diagonal. */
static const double MR_TOUCH = 0.003, MR_APART_BY = 0.005;

/* Parts that touched and do not any more.  *closed: whether the surface has no boundary. */
void mr_judge_contacts(mr_ctx *ctx, const mr_motion *m, bool *closed);

/* Edges that base does not account for: torn, or too long to follow it. */
void mr_judge_detail(mr_ctx *ctx, const mr_motion *m, const mr_ground *g);

/* Constrained vertices that are not where they belong, and the volume where handles only turn. */
void mr_judge_pose(mr_ctx *ctx, const mr_motion *m, const mr_ground *g, bool closed);

/* A surface of other triangles against its source. */
void mr_judge_remade(mr_ctx *ctx, const mr_mesh *then, const mr_mesh *now);

#endif
