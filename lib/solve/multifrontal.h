/* multifrontal.h -- the numbers of a supernodal Cholesky factor.  Private to this room. */
#ifndef MR_SOLVE_MULTIFRONTAL_H
#define MR_SOLVE_MULTIFRONTAL_H

#include "solve/elimination.h"

/*
 * Factors the matrix whose pattern and elimination these are.  Workspace: in the arena of `work`.  value:
 * room for e->l.value_at[e->l.count] numbers.  Returns n, or the first column whose
 * pivot is not positive.  The same bits for any number of threads.
 */
size_t mr_multifrontal(
    mr_ctx *work, const mr_sparse *a, const mr_pattern *pattern, const mr_elimination *e, double *value);

#endif
