/* parallel.h -- loops over several threads whose result does not depend on their number: a body writes only
 * to its own indices, and sums are taken per piece and added in order. */
#ifndef MR_BASE_PARALLEL_H
#define MR_BASE_PARALLEL_H

#include "base/ctx.h"

/* Works on the indices [begin, end); `arg` is the caller's. */
typedef void (*mr_body)(void *arg, size_t begin, size_t end);

/* Runs `body` over [0, count) on the context's threads, in pieces that begin at multiples of `grain`.  Which
 * thread takes which is not fixed.  Small loops run in the caller.  No process is forked within a body. */
void mr_parallel(const mr_ctx *ctx, size_t count, size_t grain, mr_body body, void *arg);

/* The sum of `term(arg, i)` over [0, count): pieces of 4096 terms are summed in order, then the pieces in
 * order, for any number of threads. */
double mr_parallel_sum(const mr_ctx *ctx, size_t count, double (*term)(void *arg, size_t i), void *arg);

#endif
