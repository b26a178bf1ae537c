/* phong_projection.h -- the foot of a point on a Phong surface: the place w with p = b(w) + h n(w).  It only
 * reads. */
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

/* Newton's method from `start`, over edges into neighbouring faces.  True where it found a foot with |height|
 * <= limit, this side of the centres of curvature; *foot is written only then. */
bool mr_foot_walk(const mr_ground *g, mr_v3 p, mr_place start, double limit, mr_foot *foot);

#endif
