/* gaps.h -- how far points are from their surface, which shows missing parts, and the surface from the
 * points, which shows excess. */
#ifndef MR_MEASURE_GAPS_H
#define MR_MEASURE_GAPS_H

#include "mesh/mesh.h"
#include "space/bvh.h"
#include "space/near.h"

/* The places that count of a cloud, as mr_sampling_places has them, their spacings and index. */
typedef struct mr_gap_cloud {
	const mr_v3 *p;
	const double *spacing;
	const mr_near *near;
	size_t n;
	double usual; /* spacing of the sampling */
} mr_gap_cloud;

/* Statistics of n distances, which are reordered; unmeasured if n is 0. */
mr_gap mr_gap_of(double *distance, size_t n);

/* The widest gap relative to the local spacing. */
typedef struct mr_gap_spot {
	double wide; /* in spacings: 0 of none */
	mr_v3 at;
} mr_gap_spot;

/* gaps->surface and bare: of a place in each of so many equal parts of the area; NULL: not wanted.  Then the
 * widest of them. */
mr_status mr_gap_of_surface(mr_ctx *ctx, const mr_mesh *m, const mr_gap_cloud *cloud, size_t samples,
    mr_gaps *gaps, mr_gap_spot *widest);

/* Reports where too much of a layer is bare. */
void mr_gaps_report(mr_ctx *ctx, const char *layer, const mr_gaps *gaps);

/* The same of a result; else where any place of it is too far from the points, or a point from it. */
void mr_gap_spots_report(mr_ctx *ctx, const char *layer, const mr_gaps *gaps, const mr_gap_spot *of_surface,
    const mr_gap_spot *of_points);

/* How far a surface is from the mesh that it is made for, and this from it. */
typedef struct mr_mesh_gaps {
	mr_gap surface; /* of places of the surface, in equal parts of its area */
	double widest;  /* of all that were looked at, of corners too; at the surface's side or the mesh's */
	mr_v3 at;
	double off; /* the share of the one that is too far from the other, of the two the larger */
} mr_mesh_gaps;

/* Adds to gaps how far places of `from`, so many in equal parts of its area, and as many of its corners are
 * from bvh's surface; off: the limit. */
void mr_gaps_add(
    mr_ctx *ctx, const mr_mesh *from, const mr_bvh *bvh, size_t samples, double off, mr_mesh_gaps *gaps);

void
mr_gaps_to_mesh(mr_ctx *ctx, const mr_mesh *surface, const mr_mesh *mesh, size_t samples, mr_mesh_gaps *gaps);

/* Reports where a layer, the surface of a control mesh, is too far from the mesh that it is made of. */
void mr_mesh_gaps_report(mr_ctx *ctx, const char *layer, const mr_mesh_gaps *gaps, const mr_mesh *mesh);

#endif
