/*
 * fit_solve.h -- the motion that solves the equations of a fit.
 *
 * Layer rule: alg.
 */
#ifndef MR_FIT_SOLVE_H
#define MR_FIT_SOLVE_H

#include "fit/normal_equations.h"

/* The motion of the control vertices, the caller's, to a thousandth; uses the right-hand side up.  *steps
 * grows by those of the iteration. */
mr_status mr_fit_solve(mr_ctx *ctx, mr_fit_system *system, mr_v3 *motion, size_t *steps);

#endif
