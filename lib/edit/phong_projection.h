/*
 * phong_projection.h -- the foot of a point on a Phong surface: the place w with p = b(w) + h n(w).
 *
 * Contract: both functions only read and may be called by several threads at once.
 */
#ifndef MR_EDIT_PHONG_PROJECTION_H
#define MR_EDIT_PHONG_PROJECTION_H

#include "edit/phong.h"

/* The surface on which feet are looked for. */
typedef struct mr_ground {
	mr_phong surface;
	const mr_incidence *inc;
	double tolerance; /* the residual |b + h n - p| that is accepted */
} mr_ground;

typedef struct mr_foot {
	mr_place at;   /* its coordinates within 1e-9 of the face */
	double height; /* along the Phong normal */
} mr_foot;

/*
 * Newton's method from the place `start`, over edges into neighbouring faces.
 * True where it found a foot with |height| <= limit, on the near side of the surface's
 * centres of curvature; *foot is written only then.
 */
bool mr_foot_walk(const mr_ground *g, mr_v3 p, mr_place start, double limit, mr_foot *foot);

/*
 * The lowest foot on the sheet of `face`, without a good start.  The sheet is the part of the
 * surface that is reached from face to neighbouring face, the nearest to p first, but no more
 * than 4096 faces: far above a fine surface an offset is better than an endless search.  True
 * where there is a foot not higher than twice the distance from p to the sheet; else *foot is
 * the sheet's nearest point, of height 0.
 */
bool mr_foot_search(const mr_ground *g, mr_v3 p, uint32_t face, mr_foot *foot);

#endif
