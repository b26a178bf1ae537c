/*
 * fit_system.h -- the normal equations of points on a limit surface, with a smoothness term.
 *
 * Contract: the unknown is a motion z of the control vertices.  It minimises
 *
 *	(nv / n) sum_i w_i |q_i - s_i(x + z)|^2 + fairness |L z + t|^2 + small |z|^2
 *
 * over points q_i with feet s_i, which are linear in the vertices.  L takes from each vertex the mean of its
 * neighbours, along the boundary of the two there; t is the part of L x along the surface.  So vertices
 * spread evenly, and a motion is smooth, but curvature costs nothing.  Dividing by n and multiplying by nv
 * makes `fairness` a share that neither units nor sampling change.
 * Layer rule: alg.
 */
#ifndef MR_FIT_SYSTEM_H
#define MR_FIT_SYSTEM_H

#include "alg/fit_surface.h"

/* Small sets of control vertices: list e is member[start[e]] to member[start[e + 1]], ascending. */
typedef struct mr_fit_lists {
	size_t count;
	size_t *start;
	int *member;
} mr_fit_lists;

typedef struct mr_fit_system {
	const mr_fit_surface *surface;
	mr_fit_lists patch;      /* of each control face: the vertices that its surface depends on */
	mr_fit_lists star;       /* of each control vertex: those in its row of L */
	double *basis;           /* of each control face: 24 nodes x vertices of its list */
	double *star_row;        /* of each entry of star: of L */
	mr_sparse a;             /* lower triangle */
	int *patch_at, *star_at; /* where the pairs of a list's entries are in a */
	size_t *patch_pairs, *star_pairs;
	double *b; /* right-hand sides: x of all vertices, then y, then z */
} mr_fit_system;

/* The pattern of the equations, in the arena. */
mr_status mr_fit_system_build(mr_ctx *ctx, const mr_fit_surface *surface, mr_fit_system *system);

/* The equations for n points with weights w at control vertices x, of which the surface is. */
mr_status mr_fit_system_fill(mr_ctx *ctx, mr_fit_system *system, const mr_v3 *x, const mr_v3 *point,
    const mr_fit_foot *foot, const double *w, size_t n, double fairness);

#endif
