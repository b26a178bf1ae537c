/*
 * sizing.h -- edge lengths adapted to curvature (Dunyach, Vanderhaeghe, Barthe, Botsch 2013, section 3).
 */
#ifndef MR_REMESH_SIZING_H
#define MR_REMESH_SIZING_H

#include "mesh/dynmesh.h"

/*
 * The length of an edge at each vertex whose middle is `error` away from a surface of the vertex's largest
 * absolute curvature.  Within [shortest, longest], and growing by at most half of the way along edges.
 * Curvatures follow Meyer et al. 2003.  On the curves, the boundary among them, the curve's own counts,
 * since across it the surface ends or has an edge that is kept.  d: still a copy of m.  length: nv, the
 * caller's, in units of the model.
 */
void mr_sizing_field(mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, const mr_dyn *d, double error,
    double shortest, double longest, double *length);

/* Lengths that grow by at most half of the way along edges. */
void mr_sizing_grade(mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, double *length);

/*
 * The uniform length, and shorter ones where sharp edges turn within an edge, down to an eighth, so that the
 * middle of an edge is at most an eighth of the uniform length away from the curve; elsewhere growing by at
 * most half of the way along edges.  Not along boundaries: a scan's are ragged.  d: still a copy of m.
 * *length: nv in the arena, NULL where it is uniform everywhere.
 */
void mr_sizing_curves(
    mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, const mr_dyn *d, double uniform, double **length);

#endif
