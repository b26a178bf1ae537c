/*
 * normal_equations.h -- the normal equations of points on a limit surface, with a smoothness term.
 *
 * Contract: the unknown is a motion z of the control vertices x, which began at h.  It minimises
 *
 *	(nv / n) sum_i w_i (slip |r_i|^2 + (1 - slip) (d_i . r_i)^2)
 *	    + fairness sum_v (|L (x + z - c_v h)|^2 + bare_v |x + z - h|^2) + small |z|^2
 *
 * with r_i = q_i - s_i(x + z) from the feet s_i, which are linear in the vertices, to the points q_i, and d_i
 * the normals there.  L takes from each vertex the mean of its neighbours, along the boundary of the two
 * there: the thin plate energy, where vertices are even, and it makes them so.  A vertex is bare, 0 to 1, as
 * far as no points stand around it: then it keeps its place and form.  Elsewhere it keeps a share `form` of
 * its form: c_v is the greater of the two.  Dividing by n and multiplying by nv makes `fairness` a share that
 * neither units nor sampling change.
 */
#ifndef MR_FIT_NORMAL_EQUATIONS_H
#define MR_FIT_NORMAL_EQUATIONS_H

#include "fit/limit_surface.h"
#include "solve/sparse.h"

/*
 * The share of a point's distance along the surface that counts.  On 16 models 0.01 leaves 6 % less
 * distance in the mean, more on three of them, for thrice the steps of conjugate gradients; 0.3 leaves 6 %
 * more.
 */
static const double MR_FIT_SLIP = 0.1;

/* A symmetric matrix: xx, yy, zz, xy, yz, zx. */
enum { MR_FIT_BLOCK = 6 };
typedef struct mr_fit_block {
	double m[MR_FIT_BLOCK];
} mr_fit_block;

/* The matrix is a, the same for x, y and z, plus the blocks, which couple them. */
typedef struct mr_fit_system {
	const mr_fit_surface *surface;
	mr_v3 *home;                     /* the control vertices to begin with */
	double form;                     /* the share of how they were bent that is no bending */
	mr_sparse patch;                 /* of each control face: the vertices that its surface depends on */
	mr_sparse star, around, bending; /* L, its transpose, and L^T L */
	mr_sparse a;                     /* positive definite */
	mr_fit_block *block;             /* of each entry of a: of trace 0 */
	mr_v3 *b;                        /* right-hand side */
} mr_fit_system;

/* The pattern of the equations, in the arena; x: where the control vertices begin. */
mr_status mr_fit_system_build(
    mr_ctx *ctx, const mr_fit_surface *surface, const mr_v3 *x, double form, mr_fit_system *system);

/* The equations for n points with weights w at control vertices x, of which the surface is. */
void mr_fit_system_fill(mr_ctx *ctx, mr_fit_system *system, const mr_v3 *x, const mr_v3 *point,
    const mr_fit_foot *foot, const double *w, size_t n, double fairness);

/* The motion of the control vertices, the caller's, to a thousandth; uses the right-hand side up. */
mr_status mr_fit_solve(mr_ctx *ctx, mr_fit_system *system, mr_v3 *motion);

#endif
