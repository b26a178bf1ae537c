/*
 * near.h -- the nearest points of a cloud, by FLANN, which near_shim.cc alone knows.
 *
 * Contract: exact, and the same for every number of threads.  Points at one
 * position count once, by the lowest index.  Coordinates are finite and below
 * 1e150 in magnitude (else MR_ERANGE).
 */
#ifndef MR_SPACE_NEAR_H
#define MR_SPACE_NEAR_H

#include "base/vec.h"

typedef struct mr_near mr_near;

/* Builds the index over p[0] to p[n - 1], n >= 1, which must outlive it. */
mr_status mr_near_build(mr_ctx *ctx, const mr_v3 *p, size_t n, mr_near **near) MR_WARN_UNUSED;

/* The same of points none of which are at one position. */
mr_status mr_near_build_distinct(mr_ctx *ctx, const mr_v3 *p, size_t n, mr_near **near) MR_WARN_UNUSED;

/* How many points are left where each position counts once. */
size_t mr_near_distinct(const mr_near *near);

/*
 * The k nearest points of each of nq queries, nearest first, equal distances by index (of several at the k-th
 * distance, which one is returned is fixed, not by index).  index and dist2 (squared distances): nq
 * x k, the caller's; where k exceeds the distinct points, the rest is MR_NONE (UINT32_MAX) at infinite
 * distance.  dist2 may be NULL.
 */
mr_status mr_near_query(mr_ctx *ctx, const mr_near *near, const mr_v3 *q, size_t nq, size_t k,
    uint32_t *index, double *dist2) MR_WARN_UNUSED;

/* The same of points that are asked for once: builds the index and releases it. */
mr_status mr_near_once(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_v3 *q, size_t nq, size_t k,
    uint32_t *index, double *dist2) MR_WARN_UNUSED;

#endif
