/*
 * pose_basis.h -- a layer posed by its stored response to handles.
 */
#ifndef MR_EDIT_POSE_BASIS_H
#define MR_EDIT_POSE_BASIS_H

#include "mesh/layers.h"

/*
 * Poses the frame's layer, which is m, by its column `response`, where the frame has handles; both are used
 * up.  MR_EMISSING where there are handles and no response.  m: with the posed positions.  *degrees: by how
 * much two constraints turn at most against each other across what is between them, which a response, being
 * linear, can not do well.
 */
mr_status mr_response_apply(mr_ctx *ctx, mr_frame *f, mr_mesh *m, double *degrees);

#endif
