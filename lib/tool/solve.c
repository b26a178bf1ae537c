/* mr-solve: the free vertices to where the constraints have them. */
#include "tool/tool.h"

#include "base/memory.h"
#include "base/options.h"
#include "edit/detail.h"
#include "edit/handles.h"
#include "edit/region_transfer.h"
#include "tool/cache.h"

/* Each option by itself. */
static mr_status
check_options(mr_ctx *ctx, const mr_solve_opts *o)
{
	MR_TRY(mr_check_number(ctx, "order", (double)o->order, 1, 3));
	MR_TRY(mr_check_choice(ctx, "solver", o->solver, MR_SOLVER_VCYCLE));
	MR_TRY(mr_check_choice(ctx, "areas", o->areas, MR_AREAS_MEAN));
	MR_TRY(mr_check_choice(ctx, "rotations", o->rotations, MR_ROTATIONS_LINEAR));
	MR_TRY(mr_check_number(ctx, "tol", o->tol, 0, 1));
	MR_TRY(mr_check_number(ctx, "memory", o->memory, 0, 1e18));
	return mr_check_number(ctx, "iterations", (double)o->iterations, 1, 1e9);
}

/* The solver that the options ask for; MR_EUSAGE where they contradict each other. */
static mr_status
choose_solver(mr_ctx *ctx, const mr_solve_opts *o, mr_deform_opts *deform)
{
	*deform = (mr_deform_opts)MR_DEFORM_DEFAULTS;
	MR_TRY(check_options(ctx, o));
	if (o->layer && strcmp(o->layer, "base") && strcmp(o->layer, "control"))
		return mr_fail(ctx, MR_EUSAGE, "%s cannot be solved for, only base or control", o->layer);
	if (o->unsymmetric && o->solver != MR_SOLVER_AUTO && o->solver != MR_SOLVER_LU)
		return mr_fail(ctx, MR_EUSAGE, "--unsymmetric wants -s lu");
	if (o->basis && o->arap)
		return mr_fail(ctx, MR_EUSAGE, "--arap is for poses, and --basis comes before them");
	deform->order = o->order;
	deform->areas = o->areas;
	deform->unsymmetric = o->unsymmetric;
	deform->rotations = o->basis || o->flatten ? MR_ROTATIONS_LINEAR : o->rotations;
	deform->rounds = o->arap;
	deform->apart = o->apart || o->flatten;
	deform->choose = o->solver == MR_SOLVER_AUTO && !o->unsymmetric;
	deform->solver.kind = o->solver != MR_SOLVER_AUTO ? (mr_solver_kind)(o->solver - MR_SOLVER_CHOLESKY)
	                      : o->unsymmetric            ? MR_LU
	                                                  : MR_CHOLESKY;
	deform->solver.iterations = o->iterations;
	deform->solver.memory = o->memory > 0 ? o->memory : mr_memory_available();
	if (o->tol > 0)
		deform->solver.tol = o->tol;
	return MR_OK;
}

mr_status
mr_solve_check(mr_ctx *ctx, const mr_solve_opts *opts)
{
	mr_deform_opts deform;

	return choose_solver(ctx, opts, &deform);
}

/* The handles' maps; NULL where nothing poses the frame. */
static mr_status
read_maps(mr_ctx *ctx, mr_frame *f, const mr_solve_opts *o, mr_deform_maps **maps)
{
	mr_handle_rows row;

	*maps = NULL;
	if (!mr_layer_has(f, "handles", "transform"))
		return MR_OK;
	if (o->flatten || o->basis)
		return mr_fail(ctx, MR_EUSAGE, "%s comes before a pose, but the frame has handles already",
		    o->flatten ? "the undeformed solve" : "a basis");
	MR_TRY(mr_handles_rows(ctx, f, 1, &row));
	*maps = MR_NEW(ctx, 1, mr_deform_maps);
	**maps = (mr_deform_maps){ row.map, row.turn, row.n };
	return MR_OK;
}

/* The column with a layer's positions at rest: for posing, the undeformed solve's, if there was one. */
static mr_status
read_rest(mr_ctx *ctx, mr_frame *f, bool posing, mr_mesh *rest, const char **column)
{
	const void *positions;

	*column = posing && mr_layer_has(f, rest->name, "rest") ? "rest" : "position";
	MR_TRY(mr_layer_get_rows(ctx, f, rest->name, *column, rest->nv, &positions));
	rest->p = positions;
	return MR_OK;
}

/* Nothing is to be solved for: the positions are the rest positions. */
static mr_status
keep_rest(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, mr_solve_result *result)
{
	const uint32_t *region;

	MR_TRY(mr_transfer_get(ctx, f, m, &region));
	if (mr_transfer_applies(f, m->name))
		MR_TRY(mr_layer_put(ctx, f, m->name, "region", region, m->nv));
	mr_note(ctx, "%s stays as it is: nothing poses it", m->name);
	if (result)
		mr_unmeasured(result, sizeof *result);
	return mr_layer_put(ctx, f, m->name, "rest", m->p, m->nv);
}

/* The rest of a control mesh that leaves its displacement for the first time, or is posed without one. */
static mr_status
keep_encoded(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, bool posing)
{
	bool leaves = posing || mr_frame_has_layer(f, "displacement");

	if (strcmp(m->name, "control") != 0 || !leaves || mr_layer_has(f, m->name, "encoded"))
		return MR_OK;
	return mr_layer_put(ctx, f, m->name, "encoded", m->p, m->nv);
}

static mr_status
solve(mr_ctx *ctx, mr_frame *f, const mr_solve_opts *o, mr_deform_cache *kept, mr_solve_result *result)
{
	static const char *const reads[] = { "base", "control", NULL };
	const char *layer, *column;
	mr_deform_maps *maps;
	mr_deform_opts opts;
	mr_solve_result report;
	mr_mesh m, rest;
	mr_deform *d;
	bool posing;
	mr_v3 *p;

	MR_TRY(choose_solver(ctx, o, &opts));
	MR_TRY(mr_layer_choose(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	MR_TRY(read_maps(ctx, f, o, &maps));
	posing = maps != NULL;
	if (!posing && !o->basis && !o->flatten)
		return keep_rest(ctx, f, &m, result);
	rest = m;
	MR_TRY(read_rest(ctx, f, posing, &rest, &column));
	p = MR_NEW(ctx, m.nv, mr_v3);
	MR_TRY(mr_deform_cache_get(kept, ctx, f, &rest, column, &opts, &d));
	mr_deform_measures(d, result != NULL);
	if (posing || o->flatten)
		MR_TRY(mr_deform_solve(ctx, d, m.p, maps, p));
	else
		memcpy(p, m.p, m.nv * sizeof *p);
	if (mr_first_infinite((const double *)p, 3 * m.nv) < 3 * m.nv)
		return mr_fail(ctx, MR_ERANGE,
		    "%s: vertices go beyond all numbers: their coordinates, or those of its handles, are too "
		    "large",
		    layer);
	MR_TRY(keep_encoded(ctx, f, &m, posing));
	if (posing) {
		MR_TRY(mr_detail_keep_before(ctx, f, &m));
		mr_handles_drop(f);
	}
	if (posing || o->flatten)
		MR_TRY(mr_layer_move(ctx, f, layer, MR_POSED, p, m.nv));
	if (o->basis)
		MR_TRY(mr_deform_put_basis(ctx, f, &m, d, p));
	report = mr_deform_report(ctx, d);
	if (result)
		*result = report;
	return posing ? MR_OK : mr_layer_put(ctx, f, layer, "rest", m.p, m.nv);
}

mr_status
mr_solve_frame(mr_ctx *ctx, mr_frame *f, const mr_solve_opts *opts, mr_cache *cache, mr_solve_result *result)
{
	static const mr_solve_opts defaults = MR_SOLVE_DEFAULTS;
	mr_solve_result r;

	MR_ON_COPY(ctx, f, done, result, r,
	    solve(
		ctx, &done, opts ? opts : &defaults, &mr_cache_for(ctx, cache)->deform, result ? &r : NULL));
}
