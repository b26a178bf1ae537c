/*
 * suspects.h -- the faces of a mesh that a face may intersect.
 *
 * Contract: boxes of all faces around a vertex meet there, so that of the faces of a fan each would be
 * looked at with each.  Such faces intersect where their directions, as seen from the vertex, do: an index of
 * these tells the few that can.
 */
#ifndef MR_SPACE_SUSPECTS_H
#define MR_SPACE_SUSPECTS_H

#include "space/bvh_labels.h"

typedef struct mr_fan mr_fan;

typedef struct mr_suspects {
	mr_bvh_labels fans; /* the fan that a face is of, or MR_NONE */
	const mr_fan *fan;  /* NULL without any */
} mr_suspects;

/* Of the mesh of bvh, which is kept; in the arena. */
mr_status mr_suspects_find(mr_ctx *ctx, const mr_bvh *bvh, mr_suspects *s) MR_WARN_UNUSED;

/* Calls visit(arg, g) for every face g that may have more in common with face than a corner, among others,
 * as mr_bvh_overlap does. */
bool mr_suspects_of(const mr_suspects *s, uint32_t face, bool (*visit)(void *arg, uint32_t face), void *arg);

#endif
