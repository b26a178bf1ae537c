/*
 * height_energy.h -- heights on the vertices of a mesh as the minimum of a quadratic energy.
 *
 *	E(h) = h^T A h - 2 b^T h + sum_i f_i (h_i - mean of h over the neighbours of i)^2
 *
 * A is symmetric, positive semi-definite, and connects neighbours only.  The second part is the fairness of
 * the subdivision mesh, whose vertices are nearly regular, so it needs no lengths and f none either.
 * Contract: deterministic for any number of threads.
 */
#ifndef MR_SAMPLE_HEIGHT_ENERGY_H
#define MR_SAMPLE_HEIGHT_ENERGY_H

#include "mesh/mesh.h"

typedef struct mr_heights {
	size_t n;
	mr_adjacency adj;
	double *diagonal; /* of A: n; NULL: A and b are zero */
	double *beside;   /* of A, one for each entry of adj.adj */
	double *b;        /* n */
	double *fair;     /* f: n */
	bool *fixed;      /* n: these heights stay; NULL: all are free */
} mr_heights;

/* The energy of m without A and b, f all `fair`; in the arena. */
void mr_heights_new(mr_ctx *ctx, const mr_mesh *m, double fair, mr_heights *e);

/* Adds A and b, not initialised; in the arena. */
void mr_heights_add_data(mr_ctx *ctx, mr_heights *e);

/*
 * Comes closer to the minimum by conjugate gradients: until the gradient is `tol` times as long as at first,
 * or `most` steps.  h: n, changed in place.
 */
mr_status mr_heights_minimise(mr_ctx *ctx, const mr_heights *e, double tol, size_t most, double *h);

/* The same for a few heights: the listed vertices'; all others stay.  It costs no more than these and two
 * rings around them, but for 4 n bytes. */
mr_status mr_heights_minimise_some(
    mr_ctx *ctx, const mr_heights *e, const uint32_t *list, size_t count, double tol, size_t most, double *h);

/*
 * Fills in the heights that are not known from those that are, smoothly; where a component knows none they
 * are zero.  known: n.  *filled: how many.
 */
mr_status mr_heights_fill(mr_ctx *ctx, mr_heights *e, const bool *known, double *h, size_t *filled);

/*
 * Takes back protruding heights: they differ from the median of the known heights around by more than an edge
 * and by more than 6 median deviations.  *dropped: how many of `known` were cleared.
 */
void mr_heights_drop_spikes(
    mr_ctx *ctx, const mr_heights *e, const mr_v3 *p, const double *h, bool *known, size_t *dropped);

#endif
