/*
 * Botsch, Kobbelt 2004: A remeshing approach to multiresolution modeling, section 4; posing by displacement
 * is ours.
 */
#include "edit/deform_loose.h"
#include "edit/deform_rotations.h"
#include "solve/sparse.h"

mr_patch_field
mr_deform_field(const mr_deform *d, size_t width)
{
	mr_patch_field f = d->work;

	f.width = width;
	f.source = NULL;
	memset(f.u, 0, d->patch.mesh.nv * width * sizeof *f.u);
	return f;
}

/* y -= W source, the rows that follow from L u alone. */
static void
subtract_source(const mr_patch_field *f, const double *w, size_t rows, double *y)
{
	for (size_t i = 0; i < rows * f->width; i++)
		y[i] -= (w ? w[i / f->width] : 1) * f->source[i];
}

/* K applied as L, then k - 1 times L W, each on one ring less. */
void
mr_deform_residual(const mr_ctx *ctx, const mr_deform *d, mr_patch_field *f)
{
	size_t k = d->opts.order, n = d->patch.end[0];
	const double *x = f->u;

	for (size_t step = 1; step <= k; step++) {
		double *y = f->stage[step % 2];
		const double *w = step < k || d->opts.unsymmetric ? d->w : NULL;
		mr_sparse_apply(ctx, &d->l, w, d->patch.end[k - step], f->width, x, y);
		if (step == 1 && f->source)
			subtract_source(f, w, d->patch.end[k - step], y);
		x = y;
	}
	for (size_t c = 0; c < f->width; c++)
		for (size_t i = 0; i < n; i++)
			f->r[c * n + i] = -x[i * f->width + c];
}

static double
norm_of(const double *r, size_t n)
{
	double sum = 0;

	for (size_t i = 0; i < n; i++)
		sum += r[i] * r[i];
	return sqrt(sum);
}

/*
 * The same in extended precision.  The weights are what they are in doubles, so the system that is solved
 * is the same; only the rounding of K u, which a bad condition blows up, is not.
 */
static mr_status
residual_long(mr_ctx *ctx, const mr_deform *d, mr_patch_field *f)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t k = d->opts.order, n = d->patch.end[0], size = d->patch.mesh.nv * f->width;
	long double *x = MR_NEW(ctx, size, long double), *y = MR_NEW(ctx, size, long double);

	if (!x || !y)
		return MR_EMEM;
	for (size_t i = 0; i < size; i++)
		x[i] = f->u[i];
	for (size_t step = 1; step <= k; step++) {
		const double *w = step < k || d->opts.unsymmetric ? d->w : NULL;
		long double *swap = x;
		mr_sparse_apply_long(ctx, &d->l, w, d->patch.end[k - step], f->width, x, y);
		for (size_t i = 0; step == 1 && f->source && i < d->patch.end[k - step] * f->width; i++)
			y[i] -= (w ? (long double)w[i / f->width] : 1) * f->source[i];
		x = y;
		y = swap;
	}
	for (size_t c = 0; c < f->width; c++)
		for (size_t i = 0; i < n; i++)
			f->r[c * n + i] = (double)-x[i * f->width + c];
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* u_f += r */
static void
add_free(const mr_deform *d, mr_patch_field *f)
{
	size_t n = d->patch.end[0];

	for (size_t c = 0; c < f->width; c++)
		for (size_t i = 0; i < n; i++)
			f->u[i * f->width + c] += f->r[c * n + i];
}

/* Iterative refinement (Wilkinson 1963), while a correction is less than half the one before. */
static mr_status
refine(mr_ctx *ctx, mr_deform *d, mr_patch_field *f)
{
	enum { MOST = 5 };
	static const double enough = 1e-14; /* of the solution */
	size_t n = d->patch.end[0] * f->width;
	double size = norm_of(f->u, n), last = INFINITY;

	for (d->refinements = 0; d->refinements < MOST; d->refinements++) {
		double correction;
		MR_TRY(residual_long(ctx, d, f));
		MR_TRY(mr_solver_solve(ctx, d->solver, f->r, f->width));
		correction = norm_of(f->r, n);
		if (!(correction < 0.5 * last))
			break;
		add_free(d, f);
		last = correction;
		if (correction <= enough * size)
			break;
	}
	return MR_OK;
}

/* How far from 1 rounding takes the solution that is 1, as the constraints are; where nothing is next to them
 * it is 0. */
mr_status
mr_deform_rounding(mr_ctx *ctx, mr_deform *d)
{
	mr_patch_field f = mr_deform_field(d, 1);
	size_t n = d->patch.end[0];

	for (size_t i = n; i < d->patch.mesh.nv; i++)
		f.u[i] = 1;
	mr_deform_residual(ctx, d, &f);
	MR_TRY(mr_solver_solve(ctx, d->solver, f.r, 1));
	d->rounding = 0;
	for (size_t i = 0; i < n; i++)
		if (f.r[i] != 0)
			d->rounding = fmax(d->rounding, fabs(f.r[i] - 1));
	return MR_OK;
}

/*
 * Solves K u = 0 on the free vertices, from what u_f is, f->r being its residual; that of u_f = 0 is `scale`.
 * A large residual, or rounding, asks for refinement.
 */
static mr_status
solve_field(mr_ctx *ctx, mr_deform *d, mr_patch_field *f, double scale)
{
	/* Poses of plates and creatures of 3,000 to a million vertices, k = 1, 2, 3, were off by a fifth of
	 * d->rounding at most: 1.4e-7 of the diagonal where it was 3e-6. */
	static const double exact = 1e-9;
	size_t n = d->patch.end[0] * f->width;
	bool iterative = mr_solver_iterates(d->opts.solver.kind);
	bool doubtful = !iterative && d->rounding > exact;
	double tol = iterative ? d->opts.solver.tol : d->opts.tol, after;

	d->refinements = 0;
	MR_TRY(mr_solver_solve(ctx, d->solver, f->r, f->width));
	add_free(d, f);
	mr_deform_residual(ctx, d, f);
	after = norm_of(f->r, n);
	if (scale > 0 && !d->rough && (doubtful || after > tol * scale)) {
		MR_TRY(refine(ctx, d, f));
		mr_deform_residual(ctx, d, f);
		after = norm_of(f->r, n);
	}
	d->residual = scale > 0 ? after / scale : 0;
	return MR_OK;
}

mr_status
mr_deform_solve_field(mr_ctx *ctx, mr_deform *d, mr_patch_field *f)
{
	mr_deform_residual(ctx, d, f);
	return solve_field(ctx, d, f, norm_of(f->r, d->patch.end[0] * f->width));
}

/* The undeformed surface */

static void
set_points(const mr_deform *d, mr_patch_field *f, const mr_v3 *p, mr_v3 origin, size_t begin, size_t end)
{
	for (size_t i = begin; i < end; i++) {
		mr_v3 x = mr_sub(p[d->patch.vertex[i]], origin);
		f->u[3 * i] = x.x;
		f->u[3 * i + 1] = x.y;
		f->u[3 * i + 2] = x.z;
	}
}

/* The correction of p is solved for, which is small where p is smooth already. */
static mr_status
relax(mr_ctx *ctx, mr_deform *d, const mr_v3 *p, mr_v3 *out)
{
	size_t n = d->patch.end[0];
	mr_box box = mr_box_of(p, d->nv);
	mr_v3 origin = mr_lerp(0.5, box.min, box.max);
	double scale;
	mr_patch_field f = mr_deform_field(d, 3);

	set_points(d, &f, p, origin, n, d->patch.mesh.nv);
	mr_deform_residual(ctx, d, &f);
	scale = norm_of(f.r, 3 * n);
	set_points(d, &f, p, origin, 0, n);
	mr_deform_residual(ctx, d, &f);
	MR_TRY(solve_field(ctx, d, &f, scale));
	memmove(out, p, d->nv * sizeof *out);
	for (size_t i = 0; i < n; i++)
		out[d->patch.vertex[i]] = mr_add(mr_vec(f.u[3 * i], f.u[3 * i + 1], f.u[3 * i + 2]), origin);
	return MR_OK;
}

mr_status
mr_deform_relax(mr_ctx *ctx, mr_deform *d, const mr_v3 *p, mr_v3 *out)
{
	mr_mark mark = mr_mark_take(ctx);
	double started = mr_seconds();

	if (d->solver)
		MR_TRY(relax(ctx, d, p, out));
	else
		memmove(out, p, d->nv * sizeof *out);
	mr_mark_release(ctx, mark);
	d->seconds_solve = mr_seconds() - started;
	return MR_OK;
}

/* Posing */

mr_affine
mr_deform_map(const mr_deform_maps *maps, uint32_t region)
{
	return region >= MR_REGION_HANDLE && region - MR_REGION_HANDLE < maps->count
	           ? maps->t[region - MR_REGION_HANDLE]
	           : mr_identity();
}

/* T p, every bit kept by the identity, the sign of a zero too. */
static mr_v3
move(const mr_affine *t, mr_v3 p)
{
	return mr_is_identity(t) ? p : mr_apply(t, p);
}

static mr_status
check_maps(mr_ctx *ctx, const mr_deform *d, const mr_deform_maps *maps)
{
	mr_mark mark = mr_mark_take(ctx);
	bool *present = MR_NEW_ZERO(ctx, d->handles, bool);

	if (!present)
		return MR_EMEM;
	for (size_t v = 0; v < d->nv; v++)
		if (d->region[v] >= MR_REGION_HANDLE)
			present[d->region[v] - MR_REGION_HANDLE] = true;
	for (size_t h = 0; h < maps->count; h++)
		if (!mr_is_identity(&maps->t[h]) && (h >= d->handles || !present[h]))
			return mr_fail(ctx, MR_ERANGE, "handles: handle %zu has no vertex of %s to move", h,
			    d->patch.mesh.name);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* z = p - T p0 on the constraints of the patch, p being where they go; 0 elsewhere. */
static void
set_displacements(
    const mr_deform *d, const mr_affine *whole, const mr_v3 *p0, const mr_v3 *p, mr_patch_field *f)
{
	for (size_t i = d->patch.end[0]; i < d->patch.mesh.nv; i++) {
		uint32_t v = d->patch.vertex[i];
		mr_v3 z = mr_sub(p[v], move(whole, p0[v]));
		f->u[3 * i] = z.x;
		f->u[3 * i + 1] = z.y;
		f->u[3 * i + 2] = z.z;
	}
}

static double
moved(double x, double by)
{
	return by == 0 ? x : x + by;
}

mr_status
mr_deform_follow(
    mr_ctx *ctx, mr_deform *d, const mr_affine *whole, const mr_v3 *p0, const double *source, mr_v3 *p)
{
	size_t n = d->patch.end[0];
	mr_patch_field f = mr_deform_field(d, 3);

	f.source = source;
	set_displacements(d, whole, p0, p, &f);
	MR_TRY(mr_deform_solve_field(ctx, d, &f));
	for (size_t i = 0; i < n; i++) {
		uint32_t v = d->patch.vertex[i];
		mr_v3 at = move(whole, p0[v]);
		const double *z = f.u + 3 * i;
		p[v] = mr_vec(moved(at.x, z[0]), moved(at.y, z[1]), moved(at.z, z[2]));
	}
	return MR_OK;
}

/* The same, into out, which may be p0: p is workspace. */
static mr_status
follow(mr_ctx *ctx, mr_deform *d, const mr_affine *whole, const mr_v3 *p0, const mr_deform_maps *maps,
    mr_v3 *p, mr_v3 *out)
{
	bool rotates = (maps && d->opts.turned) || d->opts.rounds;

	if (d->solver)
		MR_TRY(rotates ? mr_rotations_follow(ctx, d, whole, p0, maps, p)
			       : mr_deform_follow(ctx, d, whole, p0, NULL, p));
	mr_loose_follow(ctx, d, p0, p);
	memcpy(out, p, d->nv * sizeof *out);
	return MR_OK;
}

/* Their memory lasts longer than that of one pose, so it comes first. */
static mr_status
prepare_rotations(mr_ctx *ctx, mr_deform *d, bool maps)
{
	return d->solver && ((maps && d->opts.turned) || d->opts.rounds) ? mr_rotations_make(ctx, d) : MR_OK;
}

mr_status
mr_deform_pose(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, const mr_deform_maps *maps, mr_v3 *out)
{
	mr_affine whole = mr_deform_map(maps, d->lowest);
	double started = mr_seconds();
	mr_mark mark;
	mr_v3 *p;

	MR_TRY(prepare_rotations(ctx, d, true));
	mark = mr_mark_take(ctx);
	p = MR_NEW(ctx, d->nv, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(check_maps(ctx, d, maps));
	for (size_t v = 0; v < d->nv; v++) { /* free ones too, for those of loose components */
		mr_affine map = mr_deform_map(maps, d->region[v]);
		p[v] = move(&map, p0[v]);
	}
	MR_TRY(follow(ctx, d, &whole, p0, maps, p, out));
	mr_mark_release(ctx, mark);
	d->seconds_solve = mr_seconds() - started;
	return MR_OK;
}

mr_status
mr_deform_reach(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, const mr_v3 *target, mr_v3 *out)
{
	mr_affine rest = mr_identity();
	double started = mr_seconds();
	mr_mark mark;
	mr_v3 *p;

	MR_TRY(prepare_rotations(ctx, d, false));
	mark = mr_mark_take(ctx);
	p = MR_NEW(ctx, d->nv, mr_v3);
	if (!p)
		return MR_EMEM;
	for (size_t v = 0; v < d->nv; v++)
		p[v] = d->region[v] == MR_REGION_FREE ? p0[v] : target[v];
	MR_TRY(follow(ctx, d, &rest, p0, NULL, p, out));
	mr_mark_release(ctx, mark);
	d->seconds_solve = mr_seconds() - started;
	return MR_OK;
}

/* Tasks */

mr_status
mr_deform_solve(mr_ctx *ctx, mr_deform *d, const mr_deform_task *task, mr_v3 *out)
{
	if (task->maps)
		return mr_deform_pose(ctx, d, task->p0, task->maps, out);
	if (task->target)
		return mr_deform_reach(ctx, d, task->p0, task->target, out);
	return mr_deform_relax(ctx, d, task->p0, out);
}

/* Basis functions: Botsch, Kobbelt 2004: An intuitive framework for real-time freeform modeling, section 5.
 */

static void
row_of(mr_v3 p, double row[4])
{
	row[0] = p.x;
	row[1] = p.y;
	row[2] = p.z;
	row[3] = 1;
}

/* The responses to handle h: (x, y, z, 1) of its own vertices, 0 of the other constraints. */
static mr_status
respond_to(mr_ctx *ctx, mr_deform *d, size_t h, const mr_v3 *p0, double *response)
{
	size_t n = d->patch.end[0];
	mr_patch_field f = mr_deform_field(d, WIDTH);

	for (size_t i = n; i < d->patch.mesh.nv; i++)
		if (d->region[d->patch.vertex[i]] == MR_REGION_HANDLE + h)
			row_of(p0[d->patch.vertex[i]], f.u + WIDTH * i);
	mr_deform_residual(ctx, d, &f);
	MR_TRY(solve_field(ctx, d, &f, norm_of(f.r, WIDTH * n)));
	for (size_t i = 0; i < n; i++)
		memcpy(response + WIDTH * (d->handles * d->patch.vertex[i] + h), f.u + WIDTH * i,
		    WIDTH * sizeof *response);
	return MR_OK;
}

/*
 * Where nothing is fixed the lowest handle moves the whole, p = T p0 + z: its response is
 * what the others leave of (x, y, z, 1).
 */
static void
respond_to_whole(const mr_deform *d, const mr_v3 *p0, double *response)
{
	size_t lowest = d->lowest - MR_REGION_HANDLE;

	for (size_t i = 0; i < d->patch.end[0]; i++) {
		uint32_t v = d->patch.vertex[i];
		double *row = response + WIDTH * d->handles * v, rest[WIDTH];
		row_of(p0[v], rest);
		for (size_t h = 0; h < d->handles; h++)
			for (size_t c = 0; h != lowest && c < WIDTH; c++)
				rest[c] -= row[WIDTH * h + c];
		memcpy(row + WIDTH * lowest, rest, sizeof rest);
	}
}

mr_status
mr_deform_basis(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, double *response)
{
	mr_mark mark = mr_mark_take(ctx);
	double started = mr_seconds();

	memset(response, 0, d->nv * d->handles * WIDTH * sizeof *response);
	for (size_t v = 0; v < d->nv; v++)
		if (d->region[v] >= MR_REGION_HANDLE)
			row_of(p0[v], response + WIDTH * (d->handles * v + d->region[v] - MR_REGION_HANDLE));
	for (size_t h = 0; d->solver && h < d->handles; h++) {
		mr_progress(ctx, "basis", (double)h / (double)d->handles);
		if (MR_REGION_HANDLE + h != d->lowest)
			MR_TRY(respond_to(ctx, d, h, p0, response));
		mr_mark_release(ctx, mark);
	}
	if (d->solver && d->lowest >= MR_REGION_HANDLE)
		respond_to_whole(d, p0, response);
	mr_loose_respond(d, p0, response);
	d->seconds_solve = mr_seconds() - started;
	return MR_OK;
}
