/* turns.h -- how a surface has turned around each of its vertices. */
#ifndef MR_EDIT_TURNS_H
#define MR_EDIT_TURNS_H

#include "base/rotation.h"
#include "mesh/scatter.h"

/* The gradient of the motion some rings around, times their area, 0 where nothing moved; and that area. */
typedef struct mr_turn {
	double sum[10];
} mr_turn;

/* A smooth field.  now: where the vertices of rest have gone.  Returns nv, in the arena. */
const mr_turn *mr_turns(mr_ctx *ctx, const mr_mesh *rest, const mr_scatter *scatter, const mr_v3 *now);

/* Turns the unit normal n of the surface at rest. */
mr_v3 mr_turn_normal(const mr_turn *turn, mr_v3 n);

/* The rotation nearest to what became of the surface at a place of a face. */
mr_mat3 mr_turn_rotation(const mr_turn *turn, const uint32_t v[3], mr_v3 bary);

#endif
