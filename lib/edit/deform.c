/*
 * Botsch, Kobbelt 2004: A remeshing approach to multiresolution modeling, section 4; the symmetric form
 * with true areas is ours.
 */
#include "base/disjoint_sets.h"
#include "base/text.h"
#include "edit/deform_loose.h"
#include "edit/deform_rotations.h"
#include "edit/deform_stitch.h"

/* Regions */

static void
count_regions(mr_deform *d)
{
	d->lowest = UINT32_MAX;
	for (size_t v = 0; v < d->nv; v++) {
		uint32_t r = d->region[v];
		d->free += r == MR_REGION_FREE;
		d->fixed += r == MR_REGION_FIXED;
		d->handled += r >= MR_REGION_HANDLE;
		if (r >= MR_REGION_HANDLE && r - MR_REGION_HANDLE >= d->handles)
			d->handles = r - MR_REGION_HANDLE + 1;
		if (r != MR_REGION_FREE && r < d->lowest)
			d->lowest = r;
	}
}

/* Joins the free vertices of each face. */
static void
join_free(const mr_mesh *m, const uint32_t *region, uint32_t *parent)
{
	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++) {
			uint32_t a = m->t[f].v[k], b = m->t[f].v[(k + 1) % 3];
			if (region[a] == MR_REGION_FREE && region[b] == MR_REGION_FREE)
				mr_sets_join(parent, a, b);
		}
}

/* The free vertices whose component has a constrained neighbour: the others would make K singular.  parent:
 * sets of one vertex each, which become the components' with their roots.  Riders are none of the loose ones.
 */
static mr_status
find_anchored(
    mr_ctx *ctx, mr_deform *d, const mr_mesh *m, const bool *rides, bool *anchored, uint32_t *parent)
{
	mr_mark mark = mr_mark_take(ctx);
	bool *root_anchored = MR_NEW_ZERO(ctx, d->nv, bool);

	if (!root_anchored)
		return MR_EMEM;
	join_free(m, d->region, parent);
	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++) {
			uint32_t a = m->t[f].v[k], b = m->t[f].v[(k + 1) % 3];
			if (d->region[a] != MR_REGION_FREE || d->region[b] != MR_REGION_FREE)
				root_anchored[mr_sets_root(parent, a)] =
				    root_anchored[mr_sets_root(parent, b)] = true;
		}
	for (uint32_t v = 0; v < d->nv; v++) {
		anchored[v] = d->region[v] == MR_REGION_FREE && root_anchored[mr_sets_root(parent, v)];
		if (d->region[v] == MR_REGION_FREE && !anchored[v] && !rides[v]) {
			d->loose_vertices++;
			d->loose += parent[v] == v;
		}
	}
	for (uint32_t v = 0; v < d->nv; v++)
		parent[v] = mr_sets_root(parent, v);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Counts the constrained vertices beside free ones with no constrained vertex k rings deep within k rings. */
static mr_status
count_narrow(mr_ctx *ctx, mr_deform *d, const mr_mesh *m, const bool *anchored)
{
	mr_mark mark = mr_mark_take(ctx);
	uint8_t k = (uint8_t)d->opts.order, *depth = MR_NEW(ctx, d->nv, uint8_t);
	uint8_t *back = MR_NEW(ctx, d->nv, uint8_t);
	bool *deep = MR_NEW(ctx, d->nv, bool);

	if (!depth || !back || !deep)
		return MR_EMEM;
	mr_patch_levels(m, anchored, k, depth);
	for (size_t v = 0; v < d->nv; v++)
		deep[v] = depth[v] >= k && d->region[v] != MR_REGION_FREE;
	mr_patch_levels(m, deep, k, back);
	for (size_t v = 0; v < d->nv; v++)
		d->narrow += depth[v] == 1 && d->region[v] != MR_REGION_FREE && back[v] > k;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static mr_status
check_problem(mr_ctx *ctx, const mr_deform *d, const mr_mesh *rest)
{
	for (size_t v = 0; v < d->nv; v++)
		if (!mr_finite(rest->p[v]))
			return mr_fail(ctx, MR_ERANGE, "%s: rest position %zu is not finite", rest->name, v);
	if (d->opts.unsymmetric && d->opts.solver.kind == MR_CHOLESKY)
		return mr_fail(ctx, MR_EUSAGE, "the unsymmetric system has no Cholesky factor");
	if (d->free == 0 && d->handled == 0)
		return mr_fail(ctx, MR_EMESH, "%s: no free vertex among %zu: select some by mr-select --free",
		    rest->name, d->nv);
	if (d->free == d->nv)
		return mr_fail(ctx, MR_EMESH,
		    "%s: all %zu vertices are free: nothing holds the surface; select some as fixed or "
		    "handle",
		    rest->name, d->nv);
	return MR_OK;
}

/* Where no vertex is free the edges from region to region alone give way. */
static void
look_for_room(mr_ctx *ctx, const mr_deform *d, const mr_mesh *rest)
{
	double longest = 0;

	for (size_t h = 0; d->free == 0 && h < 3 * rest->nf; h++) {
		uint32_t a = mr_he_from(rest, (uint32_t)h), b = mr_he_to(rest, (uint32_t)h);
		if (d->region[a] != d->region[b])
			longest = fmax(longest, mr_dist(rest->p[a], rest->p[b]));
	}
	if (longest > 0)
		mr_warn(ctx,
		    "%s: no vertex is free, and all that gives way are edges from region to region: free "
		    "some, or make more first, by mr-subdivide --longest %.2g",
		    rest->name, longest / 2);
}

/* Says what becomes of parts that no constraint reaches.  follows: riders, and then what is to follow. */
static mr_status
settle_loose(
    mr_ctx *ctx, mr_deform *d, const mr_mesh *rest, const bool *anchored, const uint32_t *part, bool *follows)
{
	static const char *const does[] = { "follows the surface nearest to it", "stays" };

	if (d->loose && d->opts.loose == MR_LOOSE_REFUSE)
		return mr_fail(ctx, MR_EMESH,
		    "%s: %zu part%s (%zu of %zu vertices) without a constrained vertex: select some of them "
		    "as fixed or handle",
		    rest->name, d->loose, mr_plural(d->loose), d->loose_vertices, d->nv);
	if (d->loose)
		mr_warn(ctx, "%s: %zu part%s (%zu of %zu vertices) without a constrained vertex: each %s",
		    rest->name, d->loose, mr_plural(d->loose), d->loose_vertices, d->nv, does[d->opts.loose]);
	for (size_t v = 0; d->opts.loose == MR_LOOSE_FOLLOW && v < d->nv; v++)
		follows[v] |= d->region[v] == MR_REGION_FREE && !anchored[v];
	return mr_loose_make(ctx, d, rest, anchored, follows, part);
}

static mr_status
make_workspace(mr_ctx *ctx, mr_deform *d)
{
	size_t n = d->patch.mesh.nv * WIDTH;
	mr_patch_field f = { .u = MR_NEW(ctx, n, double),
		.stage = { MR_NEW(ctx, n, double), MR_NEW(ctx, n, double) },
		.r = MR_NEW(ctx, d->patch.end[0] * WIDTH, double) };

	if (!f.u || !f.stage[0] || !f.stage[1] || !f.r)
		return MR_EMEM;
	d->work = f;
	return MR_OK;
}

static mr_status
set_up(mr_ctx *ctx, mr_deform *d, const mr_mesh *rest, const mr_ties *ties)
{
	double started = mr_seconds();
	bool *anchored = MR_NEW(ctx, d->nv, bool), *follows = MR_NEW_ZERO(ctx, d->nv, bool);
	uint32_t *part = mr_sets_new(ctx, d->nv);
	const mr_ties none = { 0 };
	mr_mesh stitched;

	if (!anchored || !follows || !part)
		return MR_EMEM;
	count_regions(d);
	MR_TRY(check_problem(ctx, d, rest));
	look_for_room(ctx, d, rest);
	stitched = *rest;
	if (!d->opts.apart)
		MR_TRY(mr_stitch(ctx, rest, ties ? ties : &none, d->region, &stitched, follows));
	MR_TRY(find_anchored(ctx, d, &stitched, follows, anchored, part));
	MR_TRY(settle_loose(ctx, d, rest, anchored, part, follows));
	MR_TRY(count_narrow(ctx, d, rest, anchored));
	MR_TRY(mr_patch_build(ctx, &stitched, rest->nf, anchored, d->opts.order, &d->patch));
	MR_TRY(make_workspace(ctx, d));
	return mr_deform_assemble(ctx, d, rest, started);
}

/* Incomplete factors stall on systems of high order. */
static void
choose_preconditioner(mr_deform_opts *o)
{
	if (o->solver.precondition == MR_BY_ORDER && o->order > (o->solver.kind == MR_BICGSTAB ? 1 : 2))
		o->solver.precondition = MR_VCYCLES;
}

mr_status
mr_deform_new(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const uint32_t *region,
    const mr_deform_opts *opts, mr_deform **deform)
{
	mr_deform *d = MR_NEW_ZERO(ctx, 1, mr_deform);

	if (!d)
		return MR_EMEM;
	d->opts = *opts;
	d->keep = ctx;
	choose_preconditioner(&d->opts);
	d->nv = rest->nv;
	d->region = MR_NEW(ctx, d->nv, uint32_t);
	if (!d->region)
		return MR_EMEM;
	memcpy(d->region, region, d->nv * sizeof *region);
	MR_TRY(set_up(ctx, d, rest, ties));
	*deform = d;
	return MR_OK;
}

void
mr_deform_free(mr_deform *d)
{
	if (!d)
		return;
	mr_rotations_free(d);
	mr_solver_free(d->solver);
}

const uint32_t *
mr_deform_region(const mr_deform *d)
{
	return d->region;
}

size_t
mr_deform_handles(const mr_deform *d)
{
	return d->handles;
}

/* Figures */

static void
report_solver(mr_ctx *ctx, const mr_deform *d, mr_solve_result *result)
{
	static const double worst = 1e-13;
	mr_solver_report r = mr_solver_reported(d->solver);

	result->nnz_factor = r.nnz_factor;
	result->seconds_analyse = r.seconds_analyse;
	result->seconds_factor = r.seconds_factor;
	result->bytes_factor = r.bytes_factor;
	if (mr_solver_iterates(d->opts.solver.kind)) {
		result->iterations = r.iterations;
		mr_note(ctx, "%zu iterations", r.iterations);
		return;
	}
	result->rcond = r.rcond;
	if (r.rcond < worst)
		mr_note(
		    ctx, "the system of order %zu is ill-conditioned, rcond %.1e", d->opts.order, r.rcond);
}

mr_solve_result
mr_deform_report(mr_ctx *ctx, const mr_deform *d)
{
	mr_solve_result result = { .free = d->patch.end[0],
		.fixed = d->fixed,
		.handle_vertices = d->handled,
		.handles = d->handles,
		.isolated_components = d->loose,
		.isolated_vertices = d->loose_vertices,
		.narrow_strip_vertices = d->narrow,
		.nnz_matrix = d->nnz,
		.negative_weights = d->negative,
		.seconds_assemble = d->seconds_assemble,
		.seconds_solve = d->seconds_solve,
		.residual = d->residual,
		.refinements = d->refinements,
		.nnz_factor = NAN,
		.seconds_analyse = NAN,
		.seconds_factor = NAN,
		.bytes_factor = NAN,
		.iterations = MR_UNKNOWN,
		.rcond = NAN,
		.error = NAN,
		.condition = NAN };

	if (d->solver)
		report_solver(ctx, d, &result);
	mr_note(ctx, "%zu free, %zu fixed, %zu handle vertices; residual %.1e", result.free, d->fixed,
	    d->handled, d->residual);
	if (!mr_solver_iterates(d->opts.solver.kind) && !d->rough && d->residual > d->opts.tol)
		mr_warn(ctx,
		    "the residual %.1e is over the %.1e that was to be reached: rounding keeps it there",
		    d->residual, d->opts.tol);
	if (d->narrow)
		mr_note(ctx, "%zu constrained vertices beside free ones have less than %zu rings behind them",
		    d->narrow, d->opts.order);
	return result;
}
