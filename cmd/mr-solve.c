/* mr-solve -- move the free vertices of a base to where its constraints have them.  See man/mr-solve.1. */
#include "base/memory.h"
#include "cmd.h"
#include "edit/deform_cache.h"
#include "edit/handles.h"

static mr_deform_opts opts = MR_DEFORM_DEFAULTS;
static enum { AUTO, CHOLESKY, LU, CG, BICGSTAB, MULTIGRID, VCYCLE } solver;
static double tol, megabytes;
static bool basis, verify;

static const cmd_opt table[] = {
	{ 'k', "order", CMD_COUNT, &opts.order, 1, 3, "K",
	    "1 membrane, 2 thin plate, 3 minimal variation of curvature", NULL },
	{ 's', "solver", CMD_CHOICE, &solver, 0, 0, "auto|cholesky|lu|cg|bicgstab|multigrid|vcycle",
	    "auto: cholesky, lu for --unsymmetric, multigrid where the factor is too large", NULL },
	{ 0, "areas", CMD_CHOICE, &opts.areas, 0, 0, "voronoi|mean",
	    "each vertex its own area, or all the mean", NULL },
	{ 0, "unsymmetric", CMD_FLAG, &opts.unsymmetric, 0, 0, "", "solve the paper's own system", NULL },
	{ 0, "basis", CMD_FLAG, &basis, 0, 0, "", "also write the response to every handle", NULL },
	{ 0, "tol", CMD_REAL, &tol, 0, 1, "T",
	    "relative residual to reach; 0: 1e-12 of cholesky and lu, else 1e-10", NULL },
	{ 0, "iterations", CMD_COUNT, &opts.solver.iterations, 1, 1e9, "N", "at most", NULL },
	{ 0, "memory", CMD_REAL, &megabytes, 0, 1e12, "MB",
	    "megabytes that a factor may take; 0: what there is", NULL },
	{ 0, "precondition", CMD_CHOICE, &opts.solver.precondition, 0, 0, "auto|incomplete|jacobi|multigrid",
	    "of cg and bicgstab; auto: incomplete, multigrid for -k 3 and of bicgstab for -k 2", NULL },
	{ 0, "verify", CMD_FLAG, &verify, 0, 0, "",
	    "record the error, by a direct solution, and the condition", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (c->layer && strcmp(c->layer, "base") && strcmp(c->layer, "control"))
		return mr_fail(&c->ctx, MR_EUSAGE,
		    "--layer: %s cannot be solved for, only base or control: mr-smooth makes the base of a "
		    "mesh",
		    c->layer);
	if (opts.unsymmetric && solver != AUTO && solver != LU && solver != BICGSTAB)
		return mr_fail(&c->ctx, MR_EUSAGE, "--unsymmetric wants -s lu or -s bicgstab");
	if (opts.solver.precondition && solver != CG && solver != BICGSTAB)
		return mr_fail(&c->ctx, MR_EUSAGE, "--precondition is for -s cg and -s bicgstab");
	opts.solver.kind = solver != AUTO     ? (mr_solver_kind)(solver - CHOLESKY)
	                   : opts.unsymmetric ? MR_LU
	                                      : MR_CHOLESKY;
	opts.choose = solver == AUTO && !opts.unsymmetric;
	if (tol > 0)
		opts.tol = opts.solver.tol = tol;
	opts.solver.memory = megabytes > 0 ? 1e6 * megabytes : mr_memory_available();
	return MR_OK;
}

/* Outlives the frame. */
static mr_deform_cache kept;

/* What poses the frame: the handles, or the places of base.target, or nothing.  A control mesh that gets its
 * basis keeps its shape, which the displacement stands on: it is posed at rest. */
static mr_status
read_task(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, mr_deform_task *task)
{
	bool handles = mr_layer_has(f, "handles", "transform"), target = mr_layer_has(f, m->name, "target");
	bool at_rest = basis && !strcmp(m->name, "control");
	const void *places = NULL;
	mr_affine *t = NULL;
	size_t n = 0;

	if (handles && target)
		return mr_fail(
		    ctx, MR_EMESH, "%s has targets, but there are handles too: drop one of them", m->name);
	if (basis && (handles || target))
		return mr_fail(ctx, MR_EUSAGE,
		    "--basis comes before mr-pose, but the frame has handles or targets already");
	if (target)
		MR_TRY(mr_layer_get_rows(ctx, f, m->name, "target", m->nv, &places));
	if (handles || at_rest)
		MR_TRY(mr_handles_rows(ctx, f, 1, &t, &n));
	*task = (mr_deform_task){ m->p, t, n, places };
	return MR_OK;
}

/* The column with the positions that a layer has at rest: to pose those of the undeformed solve, if there was
 * one. */
static mr_status
read_rest(mr_ctx *ctx, mr_frame *f, bool posing, mr_mesh *rest, const char **column)
{
	const void *positions;

	*column = posing && mr_layer_has(f, rest->name, "rest") ? "rest" : "position";
	MR_TRY(mr_layer_get_rows(ctx, f, rest->name, *column, rest->nv, &positions));
	rest->p = positions;
	return MR_OK;
}

/* What poses a frame is used up by that. */
static void
drop_used(mr_frame *f, const char *layer)
{
	mr_frame_drop(f, "handles", NULL, 0);
	mr_frame_drop(f, layer, "target", 0);
}

static mr_status
solve_frame(cmd *c, mr_frame *f)
{
	static const char *const reads[] = { "base", "control", NULL };
	const char *layer, *column;
	mr_deform_task task;
	mr_mesh m, rest;
	mr_deform *d;
	bool posing;
	mr_v3 *p;

	MR_TRY(mr_layer_choose(&c->ctx, f, c->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(&c->ctx, f, layer, &m));
	MR_TRY(read_task(&c->ctx, f, &m, &task));
	posing = task.t || task.target;
	rest = m;
	MR_TRY(read_rest(&c->ctx, f, posing, &rest, &column));
	p = MR_NEW(&c->ctx, m.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_deform_cache_get(&kept, &c->ctx, &c->keep, f, &rest, column, &opts, &d));
	MR_TRY(mr_deform_solve(&c->ctx, d, &task, p));
	if (posing)
		drop_used(f, layer);
	MR_TRY(mr_layer_move(&c->ctx, f, layer, MR_POSED, p, m.nv));
	if (basis)
		MR_TRY(mr_deform_put_basis(&c->ctx, f, &m, d, p));
	mr_deform_report(&c->ctx, d);
	if (verify)
		MR_TRY(mr_deform_verify(&c->ctx, &rest, d, &task, p));
	return posing ? MR_OK : mr_layer_put(&c->ctx, f, layer, "rest", m.p, m.nv);
}

static mr_status
finish(cmd *c)
{
	mr_deform_cache_free(&kept, &c->keep);
	return MR_OK;
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "move the free vertices of a base to where its constraints have them",
		.options = table,
		.prepare = prepare,
		.frame = solve_frame,
		.finish = finish });
}
