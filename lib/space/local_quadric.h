/* local_quadric.h -- the quadric through points around one, as heights over a plane. */
#ifndef MR_SPACE_LOCAL_QUADRIC_H
#define MR_SPACE_LOCAL_QUADRIC_H

#include "base/ctx.h"
#include "base/vec.h"

/* Coefficients of 1 x y xx rxy yy, r the root of 2: the norm of the last three is that of their matrix. */
enum { MR_QUADRIC_TERMS = 6 };

/* These at (x, y). */
void mr_quadric_row(double x, double y, double row[MR_QUADRIC_TERMS]);

/*
 * The quadric of least squares through n weighted heights t; row: n x 6, those of each, x and y of about 1.
 * The quadratic terms shrink a little, whatever the axes, which keeps the system definite.  False where it is
 * not, and the coefficients are as they were.
 */
bool mr_quadric_fit(
    const double *row, const double *t, const double *weight, size_t n, double coefficient[MR_QUADRIC_TERMS]);

/* The most points whose distances are asked for. */
enum { MR_QUADRIC_POINTS = 40 };

/*
 * The signed distances of k points from the quadric through them over their plane; off: k, the caller's.
 * Returns their deviation: the root of the mean square, for the points beyond as many as make a quadric; 0,
 * and no distances, where these make none.
 */
double mr_quadric_residuals(const mr_v3 *q, size_t k, double *off);

#endif
