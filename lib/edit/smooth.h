/*
 * smooth.h -- low-pass filters of the surface: implicit diffusion, and Taubin's.
 *
 * Contract: any mesh with valid indices and finite positions, non-manifold too: cotangent weights need
 * no more than triangles, and the boundary is where an edge has one face.  Boundary vertices and
 * isolated ones stay.
 */
#ifndef MR_EDIT_SMOOTH_H
#define MR_EDIT_SMOOTH_H

#include "mesh/mesh.h"

/*
 * Smooths: out, nv positions, the caller's and not m->p.  MR_EUSAGE where the passes are too few for the
 * time.  result: or NULL.
 */
mr_status
mr_smooth(mr_ctx *ctx, const mr_mesh *m, const mr_smooth_opts *opts, mr_v3 *out, mr_smooth_result *result);

#endif
