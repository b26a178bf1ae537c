/* sort.h -- short lists of numbers in ascending order, by insertion; medians. */
#ifndef MR_BASE_SORT_H
#define MR_BASE_SORT_H

#include "base/ctx.h"

/* Sorts and drops repetitions; returns how many are left. */
size_t mr_sort_unique(uint32_t *x, size_t n);

/* The k-th smallest, from 0, of n > k numbers, none of them nan, which are reordered. */
double mr_kth(double *x, size_t n, size_t k);

/* The upper median of n > 0 numbers, of 10007 at equal strides where there are more. */
void mr_median(mr_ctx *ctx, const double *x, size_t n, double *median);

#endif
