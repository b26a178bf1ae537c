/* local_quadric.h -- the quadric through points around one, as heights over a plane. */
#ifndef MR_SPACE_LOCAL_QUADRIC_H
#define MR_SPACE_LOCAL_QUADRIC_H

#include "base/ctx.h"
#include "base/vec.h"

/* The most points whose distances are asked for. */
enum { MR_QUADRIC_POINTS = 40 };

/*
 * The signed distances of k points from the quadric through them over their plane; off: k, the caller's.
 * Returns their deviation: the root of the mean square, for the points beyond as many as make a quadric; 0,
 * and no distances, where these make none.
 */
double mr_quadric_residuals(const mr_v3 *q, size_t k, double *off);

#endif
