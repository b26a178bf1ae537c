/*
 * laplace.h -- the cotangent Laplacian.
 *
 * Contract: any mesh with valid indices and finite positions, non-manifold ones and degenerate
 * faces too: no weight is ever infinite or not a number.  Deterministic for any number of threads.
 */
#ifndef MR_OP_LAPLACE_H
#define MR_OP_LAPLACE_H

#include "mesh/mesh.h"
#include "solve/sparse.h"

/*
 * The cotangents at the corners of a triangle.  Where its height over the longest edge is below a
 * millionth of that edge all three are computed as if it were that much, which keeps the
 * triangle's energy positive semi-definite; a triangle of one point has zeros.
 */
void mr_cotangents(mr_v3 a, mr_v3 b, mr_v3 c, double cot[3]);

/*
 * The Laplacian of all vertices: L_ij = -(cot a + cot b) / 2, L_ii = -sum_j L_ij; symmetric, positive
 * semi-definite.  Every row has its diagonal.  l: in the arena.
 */
mr_status mr_laplace_build(mr_ctx *ctx, const mr_mesh *m, mr_sparse *l);

#endif
