/*
 * near_shim.h -- FLANN's exact k-d tree, in C: where memory fails these functions return, nothing is thrown.
 *
 * Private to this room.
 */
#ifndef MR_SPACE_NEAR_SHIM_H
#define MR_SPACE_NEAR_SHIM_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An index of `rows` points, 1 at least, distinct and finite, which must stay; NULL where there is no memory.
 */
void *mr_tree_build(const double (*point)[3], size_t rows, int leaf);

/*
 * The k nearest rows, at most as many as there are, to each of n queries, nearest first, of equal ones any:
 * row[n k], and their squared distances.  False where there is no memory.
 */
bool
mr_tree_query(const void *tree, const double (*query)[3], size_t n, size_t k, size_t *row, double *distance);

/* Accepts NULL. */
void mr_tree_free(void *tree);

#ifdef __cplusplus
}
#endif

#endif
