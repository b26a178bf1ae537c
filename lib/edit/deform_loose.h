/*
 * deform_loose.h -- parts that go along with the surface near them, as nothing else holds them.
 *
 * Such a part moves as one body, by the rigid motion that fits best that of the vertices of the rest nearest
 * to it.  Private to this room.
 */
#ifndef MR_EDIT_DEFORM_LOOSE_H
#define MR_EDIT_DEFORM_LOOSE_H

#include "mesh/mesh.h"

/* Vertices of the rest that a part follows. */
enum { MR_ANCHORS = 64 };

typedef struct mr_loose {
	size_t nv, parts;
	uint32_t *part;   /* of each vertex; MR_NONE: it follows nothing */
	uint32_t *anchor; /* MR_ANCHORS a part; MR_NONE where there are fewer */
} mr_loose;

/* Finds the anchors of the vertices that follow, among the others.  root: the vertex that stands for the part
 * that each vertex is of, one that follows too. */
mr_status
mr_loose_make(mr_ctx *ctx, const mr_mesh *rest, const bool *follows, const uint32_t *root, mr_loose *l);

/* p has all others where they go from p0; the followers go along. */
void mr_loose_follow(mr_ctx *ctx, const mr_loose *l, const mr_v3 *p0, mr_v3 *p);

/* The same of responses, which are linear: by the mean of the anchors'. */
void mr_loose_respond(const mr_loose *l, size_t handles, const mr_v3 *p0, double *response);

#endif
