/* Botsch, Kobbelt 2004: A remeshing approach to multiresolution modeling, section 4; the symmetric form with
 * true areas, and posing by displacement, are ours. */
#include "edit/deform_system.h"

#include "op/laplace.h"
#include "op/voronoi_area.h"

/* Assembly */

/* W, made free of units by the mean.  Areas are at least a hundred-millionth of it, and rows of L W L at most
 * 1e8 of their usual size: tiny holes then have a factor. */
static void
weigh(mr_ctx *ctx, mr_deform_system *s)
{
	static const double smallest = 1e-8, largest = 1e8;
	size_t n = s->patch.mesh.nv;
	double mean = 0;

	s->w = MR_NEW(ctx, n, double);
	mr_voronoi_areas(ctx, &s->patch.mesh, s->w);
	for (size_t i = 0; i < n; i++)
		mean += s->w[i] / (double)n;
	for (size_t i = 0; i < n; i++) {
		double d = s->l.value[mr_sparse_find(&s->l, (int)i, (int)i)];
		s->w[i] = s->opts.areas == MR_AREAS_MEAN || !(mean > 0)
		              ? 1
		              : fmin(1 / fmax(s->w[i] / mean, smallest), largest / (d * d));
	}
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

/* The unknowns whose boundary conditions multigrid has wrong: near constraints a few dozen iterations do. */
static void
find_strip(
    mr_ctx *ctx, const mr_deform_system *s, const mr_mesh *rest, const uint32_t *number, mr_hierarchy *h)
{
	uint8_t rings = (uint8_t)(8 << (s->opts.order - 1)), *level = MR_NEW(ctx, rest->nv, uint8_t);
	bool *given = MR_NEW(ctx, rest->nv, bool);
	uint32_t *strip = MR_NEW(ctx, s->patch.end[0], uint32_t);

	for (size_t v = 0; v < rest->nv; v++)
		given[v] = number[v] == MR_NONE;
	mr_patch_levels(rest, given, rings, level);
	for (uint32_t i = 0; i < s->patch.end[0]; i++)
		if (s->opts.order > 1 && level[s->patch.vertex[i]] <= rings)
			strip[h->strip_count++] = i;
	h->strip = strip;
}

/* The levels of multigrid, from remeshings of the whole surface. */
static mr_status
build_hierarchy(mr_ctx *ctx, mr_deform_system *s, const mr_mesh *rest)
{
	size_t n = s->patch.end[0], count;
	uint32_t *number = MR_NEW(ctx, rest->nv, uint32_t);
	mr_coarser *level;

	for (size_t v = 0; v < rest->nv; v++)
		number[v] = MR_NONE;
	for (size_t i = 0; i < n; i++)
		number[s->patch.vertex[i]] = (uint32_t)i;
	MR_TRY(mr_hierarchy_build(ctx, rest, number, n, &level, &count));
	MR_TRY(mr_sparse_power(ctx, &s->l, NULL, 1, n, false, &s->l_ff));
	s->hierarchy = (mr_hierarchy){ &s->l_ff, s->w, s->opts.order, count, level, NULL, 0 };
	find_strip(ctx, s, rest, number, &s->hierarchy);
	return MR_OK;
}

/* A row without any weight (all its faces are single points) asks for nothing: its vertex stays.  The rows of
 * the true D^k are scaled by M_f^-1. */
static mr_status
assemble(mr_ctx *ctx, mr_deform_system *s)
{
	bool lower = mr_solver_is_symmetric(s->opts.solver.kind);
	size_t n = s->patch.end[0];

	MR_TRY(mr_sparse_power(ctx, &s->l, s->w, s->opts.order, n, lower, &s->a));
	for (int i = 0; i < s->a.n; i++) {
		double *own = &s->a.value[mr_sparse_find(&s->a, i, i)];
		*own = *own == 0 ? 1 : *own;
		for (int e = s->a.start[i]; s->opts.unsymmetric && e < s->a.start[i + 1]; e++)
			s->a.value[e] *= s->w[i];
	}
	return MR_OK;
}

static mr_status
say_why(mr_ctx *ctx, const mr_deform_system *s, mr_status status)
{
	bool iterates = mr_solver_iterates(s->opts.solver.kind);

	if (status == MR_ERANGE && !iterates)
		return mr_advise(ctx, MR_LESS_MEMORY, mr_prefix(ctx, status, "%s", s->patch.mesh.name));
	if (status == MR_ENUMERIC)
		return mr_advise(ctx,
		    iterates            ? MR_SOLVE_DIRECTLY
		    : s->opts.order > 1 ? MR_LOWER_ORDER
					: MR_NO_REMEDY,
		    mr_prefix(ctx, status, "%s: the system of order %zu with %zu free vertices",
			s->patch.mesh.name, s->opts.order, s->patch.end[0]));
	return status;
}

static mr_status
open_solver(mr_ctx *ctx, mr_deform_system *s)
{
	mr_system system = { .a = &s->a, .vertex = s->patch.vertex, .hierarchy = &s->hierarchy };
	size_t n = s->patch.end[0];
	int *part = NULL;

	if (mr_solver_is_symmetric(s->opts.solver.kind)) {
		part = MR_NEW(ctx, n, int);
		mr_dissect(ctx, &s->l, s->patch.mesh.p, n, s->opts.order, part);
		system.part = part;
	}
	return mr_solver_open(ctx, s->solver, &s->opts.solver, &system);
}

static mr_status
set_up(mr_ctx *ctx, mr_deform_system *s, const mr_mesh *rest, double started)
{
	mr_status status;
	mr_mark mark;

	s->solver = mr_solver_new(ctx);
	mark = mr_mark_take(ctx);
	MR_TRY(assemble(ctx, s));
	if (!MR_BROWSER && s->opts.solver.kind >= MR_MULTIGRID)
		MR_TRY(build_hierarchy(ctx, s, rest));
	s->seconds_assemble = mr_seconds() - started;
	status = open_solver(ctx, s);
	if (status == MR_ERANGE && s->opts.choose && !mr_solver_iterates(s->opts.solver.kind)) {
		mr_found(ctx, &(mr_finding){ .kind = MR_LIMIT,
				  .what = "the factor does not fit into memory: multigrid takes its place" });
		mr_mark_release(ctx, mark);
		s->opts.solver.kind = MR_MULTIGRID;
		return set_up(ctx, s, rest, started);
	}
	if (!mr_solver_iterates(s->opts.solver.kind))
		mr_mark_release(ctx, mark);
	return say_why(ctx, s, status);
}

static void
make_workspace(mr_ctx *ctx, mr_deform_system *s)
{
	size_t n = s->patch.mesh.nv * MR_FIELD_WIDTH;
	mr_field f = { .u = MR_NEW(ctx, n, double),
		.stage = { MR_NEW(ctx, n, double), MR_NEW(ctx, n, double) },
		.r = MR_NEW(ctx, s->patch.end[0] * MR_FIELD_WIDTH, double) };

	s->work = f;
}

/* It shares s's hierarchy without the strip, which the membrane does not need. */
mr_status
mr_system_membrane(mr_ctx *ctx, const mr_deform_system *s, mr_deform_system *m)
{
	mr_mark mark;

	*m = *s;
	m->solver = mr_solver_new(ctx);
	mark = mr_mark_take(ctx);
	m->opts.order = m->hierarchy.order = 1;
	m->opts.unsymmetric = false;
	m->hierarchy.strip_count = 0;
	MR_TRY(assemble(ctx, m));
	MR_TRY(say_why(ctx, m, open_solver(ctx, m)));
	if (!mr_solver_iterates(m->opts.solver.kind))
		mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Solution */

mr_field
mr_system_field(const mr_deform_system *s, size_t width)
{
	mr_field f = s->work;

	f.width = width;
	f.source = NULL;
	memset(f.u, 0, s->patch.mesh.nv * width * sizeof *f.u);
	return f;
}

/* r = -(K u)_f and what the source asks for; K applied as L, then k - 1 times L W, each on one ring less. */
static void
find_residual(const mr_ctx *ctx, const mr_deform_system *s, mr_field *f)
{
	size_t k = s->opts.order, n = s->patch.end[0];
	const double *x = f->u;

	for (size_t step = 1; step <= k; step++) {
		double *y = f->stage[step % 2];
		const double *w = step < k || s->opts.unsymmetric ? s->w : NULL;
		size_t rows = s->patch.end[k - step];
		mr_sparse_apply(ctx, &s->l, w, rows, f->width, x, y);
		for (size_t i = 0; step == 1 && f->source && i < rows; i++)
			for (size_t c = i * f->width; c < (i + 1) * f->width; c++)
				y[c] -= (w ? w[i] : 1) * f->source[c];
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

mr_status
mr_system_solve(mr_ctx *ctx, mr_deform_system *s, mr_field *f)
{
	size_t n = s->patch.end[0] * f->width;
	double scale;

	find_residual(ctx, s, f);
	scale = s->measures ? norm_of(f->r, n) : 0;
	MR_TRY(mr_solver_solve(ctx, s->solver, f->r, f->width));
	for (size_t c = 0; c < f->width; c++) /* u_f += r */
		for (size_t i = 0; i < s->patch.end[0]; i++)
			f->u[i * f->width + c] += f->r[c * s->patch.end[0] + i];
	s->residual = 0;
	if (!(scale > 0))
		return MR_OK;
	find_residual(ctx, s, f);
	s->residual = norm_of(f->r, n) / scale;
	return MR_OK;
}

mr_status
mr_system_make(mr_ctx *ctx, const mr_mesh *rest, const mr_patch *patch, const mr_deform_opts *opts,
    double started, mr_deform_system *s)
{
	*s = (mr_deform_system){ .opts = *opts, .patch = *patch };
	make_workspace(ctx, s);
	MR_TRY(mr_laplace_build(ctx, &s->patch.mesh, &s->l));
	weigh(ctx, s);
	if (s->patch.end[0] == 0)
		return MR_OK;
	s->negative = share_negative(&s->l, s->patch.end[0]);
	return set_up(ctx, s, rest, started);
}

/* p = T p0 + z: the unknown is z. */
mr_status
mr_system_follow(
    mr_ctx *ctx, mr_deform_system *s, const mr_affine *whole, const mr_v3 *p0, const double *source, mr_v3 *p)
{
	mr_field f = mr_system_field(s, 3);
	bool stays = mr_is_identity(whole); /* which keeps every bit, the sign of a zero too */
	const uint32_t *v = s->patch.vertex;

	f.source = source;
	for (size_t i = s->patch.end[0]; i < s->patch.mesh.nv; i++) {
		mr_v3 z = mr_sub(p[v[i]], stays ? p0[v[i]] : mr_apply(whole, p0[v[i]]));
		memcpy(f.u + 3 * i, &z, sizeof z);
	}
	MR_TRY(mr_system_solve(ctx, s, &f));
	for (size_t i = 0; i < s->patch.end[0]; i++) {
		mr_v3 at = stays ? p0[v[i]] : mr_apply(whole, p0[v[i]]);
		const double *z = f.u + 3 * i;
		p[v[i]] = mr_moved(at, mr_vec(z[0], z[1], z[2]));
	}
	return MR_OK;
}
