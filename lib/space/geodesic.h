/* geodesic.h -- distances over a surface. */
#ifndef MR_SPACE_GEODESIC_H
#define MR_SPACE_GEODESIC_H

#include "mesh/mesh.h"

/*
 * The distance over the surface from the surface's point nearest to p, for each vertex that is not
 * farther than reach; infinite for the others.  Works on any mesh.  Good to 1e-4 of the distance where
 * the surface unfolds into the plane, to a few thousandths where it is curved.
 * distance: nv, the caller's.
 */
void mr_geodesic_distances(mr_ctx *ctx, const mr_mesh *m, mr_v3 p, double reach, double *distance);

/* The same from a point on a face, MR_NONE: from nowhere; inc: of the mesh. */
void mr_geodesic_from(mr_ctx *ctx, const mr_mesh *m, const mr_incidence *inc, uint32_t face, mr_v3 source,
    double reach, double *distance);

#endif
