/*
 * solve_step.h -- the motion that solves the equations of a fit.
 */
#ifndef MR_FIT_SOLVE_STEP_H
#define MR_FIT_SOLVE_STEP_H

#include "fit/normal_equations.h"

/* The motion of the control vertices, the caller's, to a thousandth; uses the right-hand side up.  *steps
 * grows by those of the iteration. */
mr_status mr_fit_solve(mr_ctx *ctx, mr_fit_system *system, mr_v3 *motion, size_t *steps);

#endif
