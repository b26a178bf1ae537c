/*
 * local_planes.h -- figures of the neighbourhood of each point of a cloud: its plane, the area it stands for.
 */
#ifndef MR_SPACE_LOCAL_PLANES_H
#define MR_SPACE_LOCAL_PLANES_H

#include "base/vec.h"

typedef struct mr_planes {
	mr_v3 *normal;     /* n: unit normals of the planes, of either sign */
	double *variation; /* n: least eigenvalue over their sum: 0 in a plane, 1/3 in a ball */
	double *area;      /* n: that a point has to itself */
	uint32_t
	    *neighbor; /* n x links: the nearest points, itself left out; UINT32_MAX where there are none */
	size_t links;
} mr_planes;

/*
 * Planes of least squares of each point's k nearest (itself among them), k >= 3, and its `links` < k
 * nearest, in the arena.  The points must be distinct.
 *
 * around: the plane is of the nearest points in at most eight directions, not of the k nearest, so that rows
 * of points far apart do not tilt it.  For points without noise.
 */
mr_status mr_cloud_planes(mr_ctx *ctx, const mr_v3 *p, size_t n, size_t k, size_t links, bool around,
    mr_planes *out) MR_WARN_UNUSED;

/* Unit normal of the plane of least squares through k points; variation: as above. */
mr_v3 mr_plane_fit(const mr_v3 *p, size_t k, double *variation);

/* The plane that `around` speaks of; q[0]: the point, then its nearest, k in all. */
mr_v3 mr_plane_around(const mr_v3 *q, size_t k, double *variation);

/*
 * The area of the surface that a point has to itself, by the squared distances of its k nearest others, of
 * which eight are best: among points strewn over a plane the disc out to the j-th is the area of j, so PI sum
 * d_j^2 / sum j. 0 where k is 0.
 */
double mr_own_area(const double *dist2, size_t k);

/*
 * How many dimensions the points extend in, 0 to 3: by a deviation of more than 1e-6 of their spread, which
 * is beyond the rounding of single precision.
 */
int mr_cloud_dimensions(const mr_v3 *p, size_t n);

/* Sums of the products xx xy xz yy yz zz of k points, about their mean and times `scale`. */
void mr_covariance(const mr_v3 *p, size_t k, double scale, double sum[6]);

/* Eigenvalues, ascending, of the symmetric matrix xx xy xz yy yz zz, and its eigenvectors (Jacobi). */
void mr_eigen_sym3(const double a[6], double value[3], mr_v3 vector[3]);

#endif
