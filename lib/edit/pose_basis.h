/*
 * pose_basis.h -- a layer posed by its stored response to handles.
 */
#ifndef MR_EDIT_POSE_BASIS_H
#define MR_EDIT_POSE_BASIS_H

#include "edit/handles.h"

/*
 * p = p0 + sum over handles h of W_h (T_h - I), W_h the n x 4 block of the response; equal to
 * mr_deform_solve with the same maps where that is linear.  The identity gives p0 bit for bit.  response: n
 * rows of 4 handles values.  out: n, the caller's, may be p0.
 */
void mr_pose_by_response(mr_ctx *ctx, const mr_v3 *p0, size_t n, const double *response, size_t handles,
    const mr_affine *t, mr_v3 *out);

/* The layer's response, which it has, to the frame's handles: finite. */
mr_status
mr_response_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const double **response, mr_handle_rows *handles);

/*
 * Poses the frame's layer, which is m, by its column `response`, where the frame has handles; both are used
 * up.  MR_EMISSING where there are handles and no response.  m: with the posed positions.
 */
mr_status mr_response_apply(mr_ctx *ctx, mr_frame *f, mr_mesh *m);

#endif
