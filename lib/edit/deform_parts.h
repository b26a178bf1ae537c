/* deform_parts.h -- components that touch are deformed as one, those that nothing else holds go along.
 * Private to this room. */
#ifndef MR_EDIT_DEFORM_PARTS_H
#define MR_EDIT_DEFORM_PARTS_H

#include "edit/deform_opts.h"

/* rest, and a triangle from each vertex near another component, and for each of the ties, to two corners of
 * the face there, so that the system is one surface's.  Small unconstrained parts get none if the ties are
 * known: they are true in follows (one a vertex, false at first).  Its faces are rest's, or in the arena. */
mr_mesh
mr_stitch(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const uint32_t *region, bool *follows);

/* A part that follows moves by the rigid motion that best fits so many vertices nearest to it. */
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
