/*
 * deform_loose.h -- parts that no constraint reaches, taken along by the surface near them.
 *
 * A vertex of such a part goes as the nearest vertices of the rest do, by the rigid motion that fits theirs
 * best (Schaefer, McPhail, Warren 2006: Image deformation using moving least squares): a small part moves as
 * one body, and the panels of a soup stay side by side. Private to this room.
 */
#ifndef MR_EDIT_DEFORM_LOOSE_H
#define MR_EDIT_DEFORM_LOOSE_H

#include "edit/deform_parts.h"

/* Vertices of the rest that a part follows, at most. */
enum { MR_ANCHORS = 64 };

struct mr_loose {
	size_t n, parts;
	uint32_t *vertex; /* n, part by part */
	size_t *start;    /* parts + 1: the first vertex of each */
	uint32_t *anchor; /* MR_ANCHORS a part; MR_NONE where there are fewer */
	double *softness; /* of each part: squared distance within which anchors count alike */
};

/* Finds the anchors of the vertices that follow among the anchored and the constrained ones, at rest; part:
 * the vertex that stands for the part that each vertex is of.  d->followers: NULL where there is none. */
mr_status mr_loose_make(mr_ctx *ctx, mr_deform *d, const mr_mesh *rest, const bool *anchored,
    const bool *follows, const uint32_t *part);

/* p has all others where they go from p0; the followers go along. */
void mr_loose_follow(const mr_ctx *ctx, const mr_deform *d, const mr_v3 *p0, mr_v3 *p);

/* The same of responses, which are linear: by the mean of the anchors'. */
void mr_loose_respond(const mr_deform *d, const mr_v3 *p0, double *response);

#endif
