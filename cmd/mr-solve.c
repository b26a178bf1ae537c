/* mr-solve -- move the free vertices of a base to where its constraints have them.  See man/mr-solve.1. */
#include "cmd.h"
#include "tool/tool.h"

static mr_solve_opts opts = MR_SOLVE_DEFAULTS;
static double megabytes;

static const cmd_opt table[] = {
	{ 'k', "order", CMD_COUNT, &opts.order, 1, 3, "K",
	    "1 membrane, 2 thin plate, 3 minimal variation of curvature", NULL },
	{ 's', "solver", CMD_CHOICE, &opts.solver, 0, 0, "auto|cholesky|cholmod|lu|cg|multigrid|vcycle",
	    "auto: cholesky, lu for --unsymmetric, multigrid if the factor is too large", NULL },
	{ 0, "areas", CMD_CHOICE, &opts.areas, 0, 0, "voronoi|mean",
	    "each vertex its own area, or all the mean", NULL },
	{ 0, "unsymmetric", CMD_FLAG, &opts.unsymmetric, 0, 0, "", "solve the paper's own system", NULL },
	{ 0, "rotations", CMD_CHOICE, &opts.rotations, 0, 0, "interpolated|linear",
	    "how to turn the surface between handles", NULL },
	{ 0, "arap", CMD_COUNT, &opts.arap, 0, 1000, "N", "then run N as-rigid-as-possible rounds", NULL },
	{ 0, "apart", CMD_FLAG, &opts.apart, 0, 0, "",
	    "let touching parts come apart, and unconstrained parts stay", NULL },
	{ 0, "flatten", CMD_FLAG, &opts.flatten, 0, 0, "",
	    "without handles: solve for the free vertices as they are, as the paper does", NULL },
	{ 0, "basis", CMD_FLAG, &opts.basis, 0, 0, "", "also write the response to every handle", NULL },
	{ 0, "tol", CMD_REAL, &opts.tol, 0, 1, "T",
	    "relative residual that iterative solvers reach; 0: 1e-10", NULL },
	{ 0, "iterations", CMD_COUNT, &opts.iterations, 1, 1e9, "N", "at most", NULL },
	{ 0, "memory", CMD_REAL, &megabytes, 0, 1e12, "MB",
	    "megabytes that a factor may take; 0: all free memory", NULL },
	{ 0 },
};

#define FIGURE(field) CMD_FIGURE(mr_solve_result, field)
static const cmd_field figures[] = { FIGURE(free), FIGURE(fixed), FIGURE(handles),
	FIGURE(isolated_components), FIGURE(negative_weights), FIGURE(seconds_assemble),
	FIGURE(seconds_solve), FIGURE(residual), FIGURE(nnz_factor), FIGURE(seconds_analyse),
	FIGURE(seconds_factor), FIGURE(iterations), FIGURE(rcond), { 0 } };

static mr_status
prepare(cmd *c)
{
	bool factors = opts.solver == MR_SOLVER_CHOLESKY || opts.solver == MR_SOLVER_LU ||
	               (opts.solver == MR_SOLVER_AUTO && opts.unsymmetric);

	opts.layer = c->layer;
	opts.memory = 1e6 * megabytes;
	MR_TRY(cmd_idle(c, "iterations", factors, "on a direct solver"));
	MR_TRY(cmd_idle(c, "memory", opts.solver > MR_SOLVER_LU, "on an iterative solver"));
	return mr_solve_check(&c->ctx, &opts);
}

static mr_status
solve_frame(cmd *c, mr_frame *f)
{
	return mr_solve_frame(&c->ctx, f, &opts, c->cache, c->result);
}

const cmd_tool cmd_this = {
	.summary = "move the free vertices of a base to where its constraints have them",
	.options = table,
	.prepare = prepare,
	.frame = solve_frame,
	.figures = figures,
	.caches = true,
};
