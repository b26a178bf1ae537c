/*
 * sparsity.h -- which control vertices a fit couples: those of each control face's surface, and each
 * vertex's neighbours.
 */
#ifndef MR_FIT_SPARSITY_H
#define MR_FIT_SPARSITY_H

#include "fit/limit_surface.h"

/* Small sets of control vertices: list e is member[start[e]] to member[start[e + 1]], ascending. */
typedef struct mr_fit_lists {
	size_t count;
	size_t *start;
	int *member;
} mr_fit_lists;

static inline size_t
mr_fit_length(const mr_fit_lists *l, size_t e)
{
	return l->start[e + 1] - l->start[e];
}

/* The position of c, which is there, among n ascending numbers. */
size_t mr_fit_find(const int *list, size_t n, int c);

/* Of each control face, the vertices that its surface depends on; in the arena. */
void mr_fit_list_patches(mr_ctx *ctx, const mr_fit_surface *s, mr_fit_lists *l);

/* Of each control vertex, itself and its neighbours, on the boundary the two along it; in the arena. */
void mr_fit_list_stars(mr_ctx *ctx, const mr_loop *level, mr_fit_lists *l);

/* The lower triangle of a matrix of nv rows that couples all vertices of each list, values not set; in the
 * arena. */
mr_status
mr_fit_pattern(mr_ctx *ctx, const mr_fit_lists *patch, const mr_fit_lists *star, size_t nv, mr_sparse *a);

/* Where the pairs (i, j <= i) of entries are in a, list after list: first has count + 1; in the arena. */
void mr_fit_place_pairs(mr_ctx *ctx, const mr_fit_lists *l, const mr_sparse *a, size_t **first, int **at);

#endif
