/*
 * deform_parts.h -- components of a surface, for what deforms it: those that touch are made one, those that
 * nothing else holds go along.  Private to this room.
 */
#ifndef MR_EDIT_DEFORM_PARTS_H
#define MR_EDIT_DEFORM_PARTS_H

#include "edit/deform_opts.h"

/*
 * A model of parts that are held by different constraints would come apart.  Triangles between them that no
 * one sees carry the system across: its Laplacian, its weights and its rotations are those of one surface.
 *
 * rest, and a triangle from each vertex that is near another component, to two corners of the face there; so
 * too for each of the ties.  None of parts that are small beside what they are near, unconstrained and not
 * tied, if the ties are known: they have no shape of their own to solve for, and are true in follows (one a
 * vertex, false at first).  Its faces are rest's, or in the arena.
 */
mr_mesh
mr_stitch(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const uint32_t *region, bool *follows);

/*
 * A part that follows moves as one body, by the rigid motion that fits best that of the vertices of the rest
 * nearest to it, so many of them.
 */
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
