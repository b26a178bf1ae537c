/* smooth.h -- low-pass filters of the surface: implicit diffusion, and Taubin's.  Any mesh with valid indices
 * and finite positions; boundary and isolated vertices stay. */
#ifndef MR_EDIT_SMOOTH_H
#define MR_EDIT_SMOOTH_H

#include "mesh/mesh.h"

/* Smooths to out, nv, not m->p.  MR_EUSAGE where the passes are too few for the time.  result: or NULL. */
mr_status
mr_smooth(mr_ctx *ctx, const mr_mesh *m, const mr_smooth_opts *opts, mr_v3 *out, mr_smooth_result *result);

#endif
