/* laplace.h -- the cotangent Laplacian of any mesh with valid indices; every weight is finite. */
#ifndef MR_OP_LAPLACE_H
#define MR_OP_LAPLACE_H

#include "mesh/mesh.h"
#include "solve/sparse.h"

/* The cotangents at the corners of a triangle, as if its height over the longest edge were at least a
 * millionth of that, which keeps its energy positive semi-definite; zeros of one point. */
void mr_cotangents(mr_v3 a, mr_v3 b, mr_v3 c, double cot[3]);

/* L_ij = -(cot a + cot b) / 2, L_ii = -sum_j L_ij: symmetric, positive semi-definite, every row with its
 * diagonal. l: in the arena. */
mr_status mr_laplace_build(mr_ctx *ctx, const mr_mesh *m, mr_sparse *l);

#endif
