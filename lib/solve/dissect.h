/*
 * dissect.h -- parts of a surface that know nothing of each other, for a factorization with little fill.
 */
#ifndef MR_SOLVE_DISSECT_H
#define MR_SOLVE_DISSECT_H

#include "base/vec.h"
#include "solve/sparse.h"

/*
 * Nested dissection: cuts the vertices 0 to n - 1, at positions p and with the neighbours of l's rows, into
 * parts and the separators between them, `reach` edges wide, until a part is small.  part[i] is a number
 * below n; a separator's is higher than those of all that it separates, and of two parts no vertices are
 * within `reach` edges through either.  Neighbours from n on are not looked at.  part: n, the caller's.
 */
void mr_dissect(mr_ctx *ctx, const mr_sparse *l, const mr_v3 *p, size_t n, size_t reach, int *part);

#endif
