/*
 * laplace.h -- the cotangent Laplacian and its powers.
 *
 * Contract: any mesh with valid indices and finite positions, non-manifold ones and degenerate
 * faces too: no weight is ever infinite or not a number.  Deterministic for any number of threads.
 * Layer rule: op includes base, mesh and itself.
 */
#ifndef MR_LAPLACE_H
#define MR_LAPLACE_H

#include "mesh/mesh.h"
#include "op/sparse.h"

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

/*
 * The first n rows and columns of L (W L)^(k-1), W = diag(w) with a weight per row of L; with `lower`
 * only entries on and below the diagonal.  Entries (k-1 steps away from row n) of l are read, so
 * those rows must be complete.  out: in the arena.
 */
mr_status mr_laplace_power(
    mr_ctx *ctx, const mr_sparse *l, const double *w, size_t k, size_t n, bool lower, mr_sparse *out);

/*
 * y = A x for the first `rows` rows of A; scaled by w[i] where w is not NULL.  x and y have `width` values
 * (at most 4) per row, next to each other.
 */
void mr_sparse_apply(const mr_ctx *ctx, const mr_sparse *a, const double *w, size_t rows, size_t width,
    const double *x, double *y);

/* y = y + f A x, for all rows of A. */
void mr_sparse_add(const mr_ctx *ctx, const mr_sparse *a, double f, size_t width, const double *x, double *y);

/* mr_sparse_apply in extended precision: for residuals that rounding would drown. */
void mr_sparse_apply_long(const mr_ctx *ctx, const mr_sparse *a, const double *w, size_t rows, size_t width,
    const long double *x, long double *y);

#endif
