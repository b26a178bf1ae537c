/* Botsch, Kobbelt 2004: A remeshing approach to multiresolution modeling, section 4: unknowns and right-hand
 * sides. */
#include "edit/deform.h"

#include "base/disjoint_sets.h"
#include "edit/deform_energy.h"
#include "edit/deform_parts.h"
#include "edit/region_transfer.h"

struct mr_deform {
	mr_deform_opts opts;
	size_t nv;
	uint32_t *region; /* nv */
	mr_regions regions;
	uint32_t lowest;              /* region that moves the whole: fixed, or the lowest handle's */
	size_t handles;               /* the highest, and one */
	size_t fixed, handled, loose; /* vertices, and components without a constraint */
	mr_deform_system system;
	mr_energies *energies; /* NULL: poses are linear */
	mr_loose followers;
	double seconds_solve;
};

/* Regions */

static mr_status
count_regions(mr_ctx *ctx, mr_deform *d, const mr_mesh *rest)
{
	size_t free, odd = mr_first_infinite((const double *)rest->p, 3 * d->nv) / 3;

	if (odd < d->nv)
		return mr_fail(ctx, MR_ERANGE, "%s: rest position %zu is not finite", rest->name, odd);
	d->regions = mr_regions_of(ctx, d->region, d->nv);
	d->handles = d->regions.n - MR_REGION_HANDLE;
	free = d->regions.count[MR_REGION_FREE];
	d->fixed = d->regions.count[MR_REGION_FIXED];
	d->handled = d->nv - free - d->fixed;
	while (d->lowest == MR_REGION_FREE || (d->lowest < d->regions.n && !d->regions.count[d->lowest]))
		d->lowest++;
	if (d->opts.unsymmetric && mr_solver_is_symmetric(d->opts.solver.kind))
		return mr_fail(ctx, MR_EUSAGE, "the unsymmetric system has no Cholesky factor");
	if (free == 0 && d->handled == 0)
		return mr_advise(ctx, MR_SELECT_FREE,
		    mr_fail(ctx, MR_EMESH, "%s: no free vertex among %zu", rest->name, d->nv));
	if (free == d->nv)
		return mr_fail(ctx, MR_EMESH,
		    "%s: all %zu vertices are free: nothing holds the surface; select some as fixed or "
		    "handle",
		    rest->name, d->nv);
	if (free == 0)
		mr_found(ctx,
		    &(mr_finding){ .kind = MR_UNHELD, .layer = rest->name, .what = "no vertex is free" });
	return MR_OK;
}

/* The free vertices whose component has a constrained neighbour: the others would make K singular.  part:
 * sets of one vertex each, which become the components' roots. */
static void
find_anchored(mr_ctx *ctx, const mr_deform *d, const mr_mesh *m, bool *anchored, uint32_t *part)
{
	MR_SCOPE(ctx);
	bool *held = MR_NEW_ZERO(ctx, d->nv, bool);

	for (int pass = 0; pass < 2; pass++)
		for (size_t h = 0; h < 3 * m->nf; h++) {
			uint32_t a = mr_he_from(m, (uint32_t)h), b = mr_he_to(m, (uint32_t)h);
			bool both = d->region[a] == MR_REGION_FREE && d->region[b] == MR_REGION_FREE;
			if (pass == 0 && both)
				mr_sets_join(part, a, b);
			if (pass == 1 && !both)
				held[mr_sets_root(part, a)] = held[mr_sets_root(part, b)] = true;
		}
	for (uint32_t v = 0; v < d->nv; v++) {
		part[v] = mr_sets_root(part, v);
		anchored[v] = d->region[v] == MR_REGION_FREE && held[part[v]];
	}
}

/* Says what becomes of parts that no constraint reaches, but for small ones, and lets all of them follow. */
static mr_status
settle_loose(
    mr_ctx *ctx, mr_deform *d, const mr_mesh *rest, const bool *anchored, const uint32_t *part, bool *follows)
{
	for (size_t v = 0; v < d->nv; v++) {
		bool loose = d->region[v] == MR_REGION_FREE && !anchored[v];
		d->loose += loose && !follows[v] && part[v] == v;
		follows[v] = loose;
	}
	if (d->loose)
		mr_found(ctx,
		    &(mr_finding){ .kind = MR_UNHELD,
			.layer = rest->name,
			.count = d->loose,
			.what =
			    d->opts.apart
				? "parts without a constrained vertex stay"
				: "parts without a constrained vertex follow the surface nearest to them" });
	return d->opts.apart ? MR_OK : mr_loose_make(ctx, rest, follows, part, &d->followers);
}

static mr_status
set_up(mr_ctx *ctx, mr_deform *d, const mr_mesh *rest, const mr_ties *ties)
{
	double started = mr_seconds();
	bool *anchored = MR_NEW(ctx, d->nv, bool), *follows = MR_NEW_ZERO(ctx, d->nv, bool);
	uint32_t *part = mr_sets_new(ctx, d->nv);
	mr_mesh stitched = *rest;
	mr_patch patch;

	MR_TRY(count_regions(ctx, d, rest));
	if (!d->opts.apart)
		stitched = mr_stitch(ctx, rest, ties ? ties : &(mr_ties){ 0 }, d->region, follows);
	find_anchored(ctx, d, &stitched, anchored, part);
	MR_TRY(settle_loose(ctx, d, rest, anchored, part, follows));
	mr_patch_build(ctx, &stitched, rest->nf, anchored, d->opts.order, &patch);
	MR_TRY(mr_system_make(ctx, rest, &patch, &d->opts, started, &d->system));
	return MR_BROWSER ? MR_OK : mr_energies_make(ctx, &d->system, d->region, d->lowest, &d->energies);
}

mr_status
mr_deform_new(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const uint32_t *region,
    const mr_deform_opts *opts, mr_deform **deform)
{
	mr_deform *d = MR_NEW_ZERO(ctx, 1, mr_deform);

	d->opts = *opts;
	d->nv = rest->nv;
	d->region = MR_NEW(ctx, d->nv, uint32_t);
	memcpy(d->region, region, d->nv * sizeof *region);
	*deform = d;
	return set_up(ctx, d, rest, ties);
}

size_t
mr_deform_handles(const mr_deform *d)
{
	return d->handles;
}

/* Figures */

void
mr_deform_measures(mr_deform *d, bool residual)
{
	d->system.measures = residual;
}

mr_solve_result
mr_deform_report(mr_ctx *ctx, const mr_deform *d)
{
	static const double worst = 1e-13;
	const mr_deform_system *s = &d->system;
	bool iterates = mr_solver_iterates(s->opts.solver.kind);
	mr_solver_report r = {
		.rcond = NAN, .nnz_factor = NAN, .seconds_analyse = NAN, .seconds_factor = NAN
	};

	if (s->solver)
		r = mr_solver_reported(s->solver);
	mr_note(ctx, "%zu free, %zu fixed, %zu handle vertices", s->patch.end[0], d->fixed, d->handled);
	if (!iterates && r.rcond > 0 && r.rcond < worst)
		mr_found(ctx, &(mr_finding){ .kind = MR_INEXACT,
				  .value = r.rcond,
				  .what = "the system is so ill-conditioned that rounding shows" });
	return (mr_solve_result){ .free = s->patch.end[0],
		.fixed = d->fixed,
		.handle_vertices = d->handled,
		.handles = d->handles,
		.isolated_components = d->loose,
		.negative_weights = s->negative,
		.seconds_assemble = s->seconds_assemble,
		.seconds_solve = d->seconds_solve,
		.residual = s->residual,
		.nnz_factor = r.nnz_factor,
		.seconds_analyse = r.seconds_analyse,
		.seconds_factor = r.seconds_factor,
		.iterations = s->solver && iterates ? r.iterations : MR_UNKNOWN,
		.rcond = iterates ? NAN : r.rcond };
}

/* Tasks */

/* The undeformed solve: nothing is left of the free vertices but what constraints make of them. */
static mr_status
relax(mr_ctx *ctx, mr_deform *d, mr_v3 *p)
{
	mr_box box = mr_box_of(p, d->nv);
	mr_v3 *origin = MR_NEW(ctx, d->nv, mr_v3);
	mr_affine whole = mr_identity();

	for (size_t v = 0; v < d->nv; v++)
		origin[v] = mr_lerp(0.5, box.min, box.max);
	return d->system.solver ? mr_system_follow(ctx, &d->system, &whole, origin, NULL, p) : MR_OK;
}

static mr_status
check_maps(mr_ctx *ctx, const mr_deform *d, const mr_deform_maps *maps)
{
	for (size_t h = 0; h < maps->count; h++)
		if (!mr_is_identity(&maps->t[h]) &&
		    (h >= d->handles || !d->regions.count[MR_REGION_HANDLE + h]))
			return mr_fail(ctx, MR_ERANGE, "handles: handle %zu has no vertex of %s to move", h,
			    d->system.patch.mesh.name);
	return MR_OK;
}

/* Constraints go where the maps have them, and all else follows.  p: p0 at first. */
static mr_status
pose(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, const mr_deform_maps *maps, mr_v3 *p)
{
	mr_affine whole = mr_deform_map(maps, d->lowest);

	for (size_t v = 0; v < d->nv; v++) {
		size_t h = d->region[v] - MR_REGION_HANDLE;
		if (d->region[v] >= MR_REGION_HANDLE && h < maps->count && !mr_is_identity(&maps->t[h]))
			p[v] = mr_apply(&maps->t[h], p[v]);
	}
	if (d->energies)
		MR_TRY(mr_energies_follow(ctx, d->energies, &whole, p0, maps, p));
	else if (d->system.solver)
		MR_TRY(mr_system_follow(ctx, &d->system, &whole, p0, NULL, p));
	mr_loose_follow(ctx, &d->followers, p0, p);
	return MR_OK;
}

mr_status
mr_deform_solve(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, const mr_deform_maps *maps, mr_v3 *out)
{
	MR_SCOPE(ctx);
	double started = mr_seconds();

	memcpy(out, p0, d->nv * sizeof *out);
	if (maps)
		MR_TRY(check_maps(ctx, d, maps));
	MR_TRY(maps ? pose(ctx, d, p0, maps, out) : relax(ctx, d, out));
	d->seconds_solve = mr_seconds() - started;
	return MR_OK;
}

/* Basis functions: Botsch, Kobbelt 2004: An intuitive framework for freeform modeling, section 5. */

static void
row_of(mr_v3 p, double row[4])
{
	memcpy(row, (double[]){ p.x, p.y, p.z, 1 }, 4 * sizeof *row);
}

/* The responses to handle h: (x, y, z, 1) of its own vertices, 0 of the other constraints. */
static mr_status
respond_to(mr_ctx *ctx, mr_deform *d, size_t h, const mr_v3 *p0, double *response)
{
	mr_field f = mr_system_field(&d->system, 4);
	const mr_patch *patch = &d->system.patch;

	for (size_t i = patch->end[0]; i < patch->mesh.nv; i++)
		if (d->region[patch->vertex[i]] == MR_REGION_HANDLE + h)
			row_of(p0[patch->vertex[i]], f.u + 4 * i);
	MR_TRY(mr_system_solve(ctx, &d->system, &f));
	for (size_t i = 0; i < patch->end[0]; i++)
		memcpy(response + 4 * (d->handles * patch->vertex[i] + h), f.u + 4 * i, 4 * sizeof *response);
	return MR_OK;
}

/* Without fixed vertices the lowest handle moves the whole: its response is what the others leave. */
static void
respond_to_whole(const mr_deform *d, const mr_v3 *p0, double *response)
{
	size_t lowest = d->lowest - MR_REGION_HANDLE;

	for (size_t i = 0; i < d->system.patch.end[0]; i++) {
		uint32_t v = d->system.patch.vertex[i];
		double *row = response + 4 * d->handles * v, rest[4];
		row_of(p0[v], rest);
		for (size_t h = 0; h < d->handles; h++)
			for (size_t c = 0; h != lowest && c < 4; c++)
				rest[c] -= row[4 * h + c];
		memcpy(row + 4 * lowest, rest, sizeof rest);
	}
}

mr_status
mr_deform_basis(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, double *response)
{
	double started = mr_seconds();

	memset(response, 0, d->nv * d->handles * 4 * sizeof *response);
	for (size_t v = 0; v < d->nv; v++)
		if (d->region[v] >= MR_REGION_HANDLE)
			row_of(p0[v], response + 4 * (d->handles * v + d->region[v] - MR_REGION_HANDLE));
	for (size_t h = 0; d->system.solver && h < d->handles; h++) {
		MR_SCOPE(ctx);
		mr_progress(ctx, "basis", (double)h / (double)d->handles);
		if (MR_REGION_HANDLE + h != d->lowest)
			MR_TRY(respond_to(ctx, d, h, p0, response));
	}
	if (d->system.solver && d->lowest >= MR_REGION_HANDLE)
		respond_to_whole(d, p0, response);
	mr_loose_respond(&d->followers, d->handles, p0, response);
	d->seconds_solve = mr_seconds() - started;
	return MR_OK;
}

/* The system of the last frame serves as long as nothing that it was made of has changed. */

/* The columns that the system depends on, by their serials: in a key and its deltas the same has the same. */
static void
identify(const mr_frame *f, const char *layer, const char *rest, uint64_t part[MR_DEFORM_PARTS])
{
	const char *const columns[MR_DEFORM_PARTS][2] = { { layer, rest }, { layer, "triangles" },
		{ layer, "region" }, { "mesh", "region" }, { "mesh", "triangles" }, { "mesh", "position" },
		{ "base", "source_face" }, { "base", "source_bary" }, { "mesh", "detail_face" },
		{ "mesh", "detail_bary" } };

	for (int i = 0; i < MR_DEFORM_PARTS; i++) {
		const mr_column *column = mr_frame_find(f, columns[i][0], columns[i][1]);
		part[i] = column ? column->serial : 0;
	}
}

mr_status
mr_deform_cache_get(mr_deform_cache *cache, mr_ctx *ctx, mr_frame *f, const mr_mesh *rest, const char *column,
    const mr_deform_opts *opts, mr_deform **deform)
{
	mr_ctx *keep = mr_keep(ctx, &cache->keep);
	uint64_t part[MR_DEFORM_PARTS];
	const uint32_t *region;
	mr_deform *made;
	mr_ties ties;

	identify(f, rest->name, column, part);
	if (f->key || !cache->deform || memcmp(part, cache->part, sizeof part)) {
		cache->deform = NULL;
		mr_ctx_free(keep);
		MR_TRY(mr_transfer_get(ctx, f, rest, &region));
		MR_TRY(mr_transfer_ties(ctx, f, rest, &ties));
		MR_TRY(mr_fail_as(ctx, keep, mr_deform_new(keep, rest, &ties, region, opts, &made)));
		cache->deform = made;
		memcpy(cache->part, part, sizeof part);
	}
	*deform = cache->deform;
	if (!mr_transfer_applies(f, rest->name))
		return MR_OK;
	return mr_layer_put(ctx, f, rest->name, "region", cache->deform->region, rest->nv);
}

mr_status
mr_deform_put_basis(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, mr_deform *d, const mr_v3 *p0)
{
	enum { MOST = 63 }; /* a row has at most 255 components */
	size_t handles = d->handles;
	double *response;

	if (handles == 0)
		return mr_advise(
		    ctx, MR_SELECT_HANDLE, mr_fail(ctx, MR_EMESH, "%s: no handle to respond to", m->name));
	if (handles > MOST)
		return mr_fail(ctx, MR_ERANGE, "%s: %zu handles are more than a response holds, %d", m->name,
		    handles, MOST);
	response = MR_NEW(ctx, 4 * handles * m->nv, double);
	MR_TRY(mr_deform_basis(ctx, d, p0, response));
	return mr_frame_put(
	    ctx, f, m->name, "response", (mr_shape){ 'v', 'd', (uint8_t)(4 * handles) }, response, m->nv);
}
