/* The system that deform.c describes, assembled, and the solver that it asks for set up. */
#include "edit/deform_parts.h"

#include "edit/multigrid_levels.h"
#include "op/laplace.h"
#include "op/voronoi_area.h"
#include "solve/dissect.h"

#include <math.h>

static double
diagonal(const mr_sparse *l, size_t i)
{
	return l->value[mr_sparse_find(l, (int)i, (int)i)];
}

static double
square(double x)
{
	return x * x;
}

/*
 * W, made free of units by the mean.  An area below a hundred-millionth of the mean (a vertex
 * whose faces have none) counts as that much: W stays finite.  So does one so small for the weights there
 * that a row of L W L has that over its usual size: a hole of a billionth of the diagonal, whose rows are
 * 1e16 times the others', has no factor.  Of 92 models two have such vertices.
 */
static mr_status
weigh(mr_ctx *ctx, mr_deform *d)
{
	static const double smallest = 1e-8, largest = 1e8;
	size_t n = d->patch.mesh.nv;
	double mean = 0;

	d->w = MR_NEW(ctx, n, double);
	if (!d->w)
		return MR_EMEM;
	MR_TRY(mr_voronoi_areas(ctx, &d->patch.mesh, d->w));
	for (size_t i = 0; i < n; i++)
		mean += d->w[i] / (double)n;
	for (size_t i = 0; i < n; i++)
		d->w[i] = d->opts.areas == MR_AREAS_MEAN || !(mean > 0)
		              ? 1
		              : fmin(
				    1 / fmax(d->w[i] / mean, smallest), largest / square(diagonal(&d->l, i)));
	return MR_OK;
}

/* A row without any weight (all its faces are single points) asks for nothing: its vertex stays. */
static void
hold_empty_rows(mr_sparse *k)
{
	for (int i = 0; i < k->n; i++) {
		double *diagonal = &k->value[mr_sparse_find(k, i, i)];
		if (*diagonal == 0)
			*diagonal = 1;
	}
}

/* The rows of the true D^k: scaled by M_f^-1. */
static void
scale_rows(mr_sparse *k, const double *w)
{
	for (int i = 0; i < k->n; i++)
		for (int e = k->start[i]; e < k->start[i + 1]; e++)
			k->value[e] *= w[i];
}

/* The weights w_ij = -L_ij of the edges at free vertices: the share that is negative. */
static double
share_negative(const mr_sparse *l, size_t n)
{
	size_t edges = 0, negative = 0;

	for (size_t i = 0; i < n; i++)
		for (int e = l->start[i]; e < l->start[i + 1]; e++)
			if (l->index[e] > (int)i) {
				edges++;
				negative += l->value[e] > 0;
			}
	return edges ? (double)negative / (double)edges : 0;
}

/*
 * The unknowns whose boundary conditions multigrid has wrong: within so many rings of the constraints that a
 * few dozen iterations do.  The membrane has none.
 */
static mr_status
find_strip(mr_ctx *ctx, const mr_deform *d, const mr_mesh *rest, const uint32_t *number, mr_hierarchy *h)
{
	uint8_t rings = (uint8_t)(8 << (d->opts.order - 1)), *level = MR_NEW(ctx, d->nv, uint8_t);
	bool *given = MR_NEW(ctx, d->nv, bool);
	uint32_t *strip = MR_NEW(ctx, d->patch.end[0], uint32_t);

	if (!level || !given || !strip)
		return MR_EMEM;
	for (size_t v = 0; v < d->nv; v++)
		given[v] = number[v] == MR_NONE;
	mr_patch_levels(rest, given, rings, level);
	for (uint32_t i = 0; i < d->patch.end[0]; i++)
		if (d->opts.order > 1 && level[d->patch.vertex[i]] <= rings)
			strip[h->strip_count++] = i;
	h->strip = strip;
	return MR_OK;
}

/* The levels of multigrid, from remeshings of the whole surface. */
static mr_status
build_hierarchy(mr_ctx *ctx, mr_deform *d, const mr_mesh *rest)
{
	size_t n = d->patch.end[0];
	uint32_t *number = MR_NEW(ctx, d->nv, uint32_t);
	mr_coarser *level;
	size_t count;

	if (!number)
		return MR_EMEM;
	for (size_t v = 0; v < d->nv; v++)
		number[v] = MR_NONE;
	for (size_t i = 0; i < n; i++)
		number[d->patch.vertex[i]] = (uint32_t)i;
	MR_TRY(mr_hierarchy_build(ctx, rest, number, n, &level, &count));
	MR_TRY(mr_sparse_power(ctx, &d->l, NULL, 1, n, false, &d->l_ff));
	d->hierarchy = (mr_hierarchy){ &d->l_ff, d->w, d->opts.order, d->opts.unsymmetric, count, level, NULL,
		0 };
	return find_strip(ctx, d, rest, number, &d->hierarchy);
}

static mr_status
assemble_matrix(mr_ctx *ctx, mr_deform *d)
{
	bool lower = d->opts.solver.kind == MR_CHOLESKY;
	size_t n = d->patch.end[0];

	MR_TRY(mr_sparse_power(ctx, &d->l, d->w, d->opts.order, n, lower, &d->a));
	hold_empty_rows(&d->a);
	if (d->opts.unsymmetric)
		scale_rows(&d->a, d->w);
	d->nnz = (size_t)d->a.start[n];
	return MR_OK;
}

static mr_status
assemble(mr_ctx *ctx, mr_deform *d, const mr_mesh *rest)
{
	MR_TRY(assemble_matrix(ctx, d));
	return mr_solver_multigrid(&d->opts.solver) ? build_hierarchy(ctx, d, rest) : MR_OK;
}

static mr_status
open_solver(mr_ctx *ctx, mr_deform *d, double started)
{
	size_t n = d->patch.end[0], k = d->opts.order;
	mr_system system = { .a = &d->a, .vertex = d->patch.vertex, .hierarchy = &d->hierarchy };
	int *part = NULL;
	mr_status status;

	if (d->opts.solver.kind == MR_CHOLESKY) {
		part = MR_NEW(ctx, n, int);
		if (!part)
			return MR_EMEM;
		MR_TRY(mr_dissect(ctx, &d->l, d->patch.mesh.p, n, k, part));
		system.part = part;
	}
	d->seconds_assemble = mr_seconds() - started;
	status = mr_solver_open(ctx, &d->opts.solver, &system, &d->solver);
	if (status == MR_ERANGE && !d->opts.choose && !mr_solver_iterates(d->opts.solver.kind))
		return mr_prefix(ctx, status,
		    "%s: multigrid takes less memory than this, and mr-solve-mpi divides it among processes",
		    d->patch.mesh.name);
	if (status == MR_ENUMERIC)
		return mr_prefix(ctx, status, "%s: the system of order %zu with %zu free vertices%s",
		    d->patch.mesh.name, k, n,
		    mr_solver_iterates(d->opts.solver.kind)
			? " has no preconditioner of this kind in doubles (-s cholesky may solve it)"
		    : k > 1 ? " has no solution in doubles (a lower -k may have)"
			    : "");
	return status;
}

mr_status
mr_deform_assemble(mr_ctx *ctx, mr_deform *d, const mr_mesh *rest, double started)
{
	mr_mark mark;
	mr_status status;

	MR_TRY(mr_laplace_build(ctx, &d->patch.mesh, &d->l));
	MR_TRY(weigh(ctx, d));
	if (d->patch.end[0] == 0)
		return MR_OK;
	d->negative = share_negative(&d->l, d->patch.end[0]);
	mark = mr_mark_take(ctx);
	MR_TRY(assemble(ctx, d, rest));
	status = open_solver(ctx, d, started);
	if (status == MR_ERANGE && d->opts.choose && !mr_solver_iterates(d->opts.solver.kind)) {
		mr_warn(ctx, "%s: multigrid takes its place (mr-solve-mpi divides it among processes)",
		    ctx->error);
		mr_mark_release(ctx, mark);
		d->opts.solver.kind = MR_MULTIGRID;
		MR_TRY(assemble(ctx, d, rest));
		status = open_solver(ctx, d, started);
	}
	if (mr_solver_iterates(d->opts.solver.kind))
		return status;
	mr_mark_release(ctx, mark);
	return status == MR_OK ? mr_deform_rounding(ctx, d) : status;
}

/* Its hierarchy is that of d without the strip, which the membrane does not need. */
mr_status
mr_deform_membrane(mr_ctx *ctx, mr_deform *d, mr_deform *m)
{
	mr_mark mark = mr_mark_take(ctx);

	*m = *d;
	m->solver = NULL;
	m->rough = true;
	m->opts.order = m->hierarchy.order = 1;
	m->opts.unsymmetric = m->hierarchy.scaled = false;
	m->hierarchy.strip_count = 0;
	MR_TRY(assemble_matrix(ctx, m));
	MR_TRY(open_solver(ctx, m, mr_seconds()));
	if (!mr_solver_iterates(m->opts.solver.kind))
		mr_mark_release(ctx, mark);
	return MR_OK;
}
