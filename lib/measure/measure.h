/* measure.h -- the parts of the figures of a mesh and of a cloud (mr.h).  Any mesh with valid indices and
 * finite positions; undefined figures are NaN. */
#ifndef MR_MEASURE_H
#define MR_MEASURE_H

#include "mesh/edges.h"
#include "space/sampling.h"

void mr_take_census(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, mr_census *census);

void mr_measure_geometry(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, mr_geometry *geometry);

/* Marks the ends of boundary edges.  boundary: nv, the caller's. */
void mr_mark_boundary(const mr_mesh *m, const mr_edges *edges, bool *boundary);

/* sampling: of the points, where it is known; NULL: found.  Fails as mr_sampling_find does. */
mr_status mr_measure_points(
    mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_sampling *sampling, mr_cloud_figures *cloud);

#endif
