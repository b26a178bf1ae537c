/*
 * simplicial.h -- Cholesky factors of small systems.  CXSparse (Davis 2006: Direct Methods for Sparse Linear
 * Systems) needs no BLAS, whose threads take longer to begin than such a system to solve.
 *
 * Layer rule: solve; CXSparse only behind it.
 */
#ifndef MR_SIMPLICIAL_H
#define MR_SIMPLICIAL_H

#include "op/sparse.h"

typedef struct mr_simplicial mr_simplicial;

/* Factors a, the lower triangle of a positive definite matrix.  MR_ENUMERIC where it is not.  Free it. */
mr_status mr_simplicial_new(mr_ctx *ctx, const mr_sparse *a, mr_simplicial **out);

/* x = A^-1 b.  x, b: n, the caller's, may be the same. */
void mr_simplicial_solve(mr_simplicial *s, const double *b, double *x);

void mr_simplicial_free(mr_simplicial *s);

#endif
