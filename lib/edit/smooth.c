/*
 * Desbrun, Meyer, Schroeder, Barr 1999: Implicit fairing of irregular meshes using diffusion and curvature
 * flow; Taubin 1995: A signal processing approach to fair surface design.
 */
#include "edit/smooth.h"

#include "base/parallel.h"
#include "mesh/edges.h"
#include "op/laplace.h"
#include "op/voronoi_area.h"
#include "solve/solver.h"

enum { GRAIN = 4096 };

typedef struct smoothing {
	const mr_mesh *m;
	mr_sparse l;
	double *area; /* M, nv */
	bool *stays;  /* nv: on the boundary, or without any weight */
	double edge2; /* squared mean edge length */
	double step;  /* time of a pass, in squared mean edge lengths */
	mr_smooth_result found;
} smoothing;

/* The mean edge length and the boundary. */
static mr_status
study_edges(mr_ctx *ctx, smoothing *s)
{
	mr_mark mark = mr_mark_take(ctx);
	const mr_mesh *m = s->m;
	double sum = 0, mean;
	mr_edges edges;

	MR_TRY(mr_edges_build(ctx, m, &edges));
	for (size_t e = 0; e < edges.count; e++) {
		uint32_t h = edges.he[edges.start[e]], a = mr_he_from(m, h), b = mr_he_to(m, h);
		sum += mr_dist(m->p[a], m->p[b]);
		if (mr_edge_faces(&edges, e) == 1)
			s->stays[a] = s->stays[b] = true;
	}
	mean = edges.count ? sum / (double)edges.count : 0;
	s->edge2 = mean * mean;
	s->found.mean_edge = mean;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Vertices without weights have nowhere to go: isolated ones, and those whose faces are all single points. */
static void
study_vertices(smoothing *s)
{
	/* of the mean: so no vertex has no mass; 13 models are the same with 1e-12 and with 1e-4 */
	static const double smallest = 1e-8;
	size_t n = s->m->nv, boundary = 0;
	double mean = 0;

	for (size_t v = 0; v < n; v++) {
		boundary += s->stays[v];
		s->stays[v] |= s->l.value[mr_sparse_find(&s->l, (int)v, (int)v)] == 0;
		mean += s->area[v] / (double)n;
	}
	for (size_t v = 0; v < n; v++)
		s->area[v] = fmax(s->area[v], smallest * mean);
	s->found.boundary_vertices = boundary;
}

static mr_status
study(mr_ctx *ctx, smoothing *s)
{
	s->area = MR_NEW(ctx, s->m->nv, double);
	s->stays = MR_NEW_ZERO(ctx, s->m->nv, bool);
	if (!s->area || !s->stays)
		return MR_EMEM;
	MR_TRY(study_edges(ctx, s));
	MR_TRY(mr_laplace_build(ctx, s->m, &s->l));
	MR_TRY(mr_voronoi_areas(ctx, s->m, s->area));
	study_vertices(s);
	return MR_OK;
}

/* Implicit */

/* The lower triangle of M + t L over the n vertices that move, in squared mean edges. */
static mr_status
implicit_matrix(mr_ctx *ctx, const smoothing *s, const uint32_t *move, size_t n, mr_sparse *a)
{
	MR_TRY(mr_sparse_restrict(ctx, &s->l, move, n, true, a));
	for (int e = 0; e < a->start[n]; e++)
		a->value[e] *= s->step;
	for (size_t i = 0; i < n; i++) /* the diagonal ends the row */
		a->value[a->start[i + 1] - 1] += s->area[move[i]] / s->edge2;
	return MR_OK;
}

/* A pass solves for the motion z: (M + t L) z = -t L p, which is p' = p + z. */
static mr_status
implicit_pass(mr_ctx *ctx, const smoothing *s, const uint32_t *move, size_t n, mr_solver *solver, mr_v3 *p)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *lp = MR_NEW(ctx, s->m->nv, mr_v3);
	double *z = MR_NEW(ctx, 3 * n, double);

	if (!lp || !z)
		return MR_EMEM;
	mr_sparse_apply(ctx, &s->l, NULL, s->m->nv, 3, &p->x, &lp->x);
	for (size_t i = 0; i < n; i++) {
		z[i] = -s->step * lp[move[i]].x;
		z[n + i] = -s->step * lp[move[i]].y;
		z[2 * n + i] = -s->step * lp[move[i]].z;
	}
	MR_TRY(mr_solver_solve(ctx, solver, z, 3));
	for (size_t i = 0; i < n; i++)
		p[move[i]] = mr_add(p[move[i]], mr_vec(z[i], z[n + i], z[2 * n + i]));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static mr_status
implicit_passes(mr_ctx *ctx, smoothing *s, const uint32_t *move, size_t n, mr_solver *solver, mr_v3 *p)
{
	mr_solver_report r = mr_solver_reported(solver);

	s->found.seconds_analyse = r.seconds_analyse;
	s->found.seconds_factor = r.seconds_factor;
	s->found.nnz_factor = r.nnz_factor;
	s->found.rcond = r.rcond;
	for (size_t i = 0; i < s->found.passes; i++) {
		mr_progress(ctx, "smoothing", (double)i / (double)s->found.passes);
		MR_TRY(implicit_pass(ctx, s, move, n, solver, p));
	}
	return MR_OK;
}

static mr_status
implicit(mr_ctx *ctx, smoothing *s, mr_v3 *p)
{
	uint32_t *move = MR_NEW(ctx, s->m->nv, uint32_t);
	size_t n = 0;
	mr_solver *solver;
	mr_status status;
	mr_sparse a;

	if (!move)
		return MR_EMEM;
	for (uint32_t v = 0; v < s->m->nv; v++)
		if (!s->stays[v])
			move[n++] = v;
	if (n == 0)
		return MR_OK;
	MR_TRY(implicit_matrix(ctx, s, move, n, &a));
	MR_TRY(mr_solver_new(ctx, MR_CHOLESKY, &a, NULL, &solver));
	status = implicit_passes(ctx, s, move, n, solver, p);
	mr_solver_free(solver);
	return status;
}

/* Explicit */

/* A vertex goes at the pace of its area, or where that would overshoot at `limit` of the way to its
 * neighbours' mean. */
static mr_status
paces(mr_ctx *ctx, const smoothing *s, double limit, double **pace)
{
	const mr_sparse *l = &s->l;
	double *c = MR_NEW(ctx, s->m->nv, double);

	if (!c)
		return MR_EMEM;
	for (size_t v = 0; v < s->m->nv; v++) {
		double sum = 0;
		for (int e = l->start[v]; e < l->start[v + 1]; e++)
			sum += l->index[e] == (int)v ? 0 : fabs(l->value[e]);
		c[v] = s->stays[v] ? 0 : fmin(s->step * s->edge2 / s->area[v], limit / sum);
	}
	*pace = c;
	return MR_OK;
}

typedef struct step_job {
	const double *pace;
	double factor;
	const mr_v3 *lp;
	mr_v3 *p;
} step_job;

static void
step(void *arg, size_t begin, size_t end)
{
	step_job *j = arg;

	for (size_t v = begin; v < end; v++)
		j->p[v] = mr_axpy(-j->factor * j->pace[v], j->lp[v], j->p[v]);
}

/* p -= factor pace L p */
static void
take_step(mr_ctx *ctx, const smoothing *s, const double *pace, double factor, mr_v3 *lp, mr_v3 *p)
{
	mr_sparse_apply(ctx, &s->l, NULL, s->m->nv, 3, &p->x, &lp->x);
	mr_parallel(ctx, s->m->nv, GRAIN, step, &(step_job){ pace, factor, lp, p });
}

/* The largest share of the way to the neighbours' mean that a pass may go. */
static double
limit_of(int method)
{
	return method == MR_SMOOTH_TAUBIN ? 0.6 : 1;
}

/* On a regular mesh a time of t squared edges goes 4 t of the way to the neighbours' mean. */
static double
share_of(double time)
{
	return 4 * time;
}

static mr_status explicit(mr_ctx *ctx, const smoothing *s, int method, mr_v3 *p)
{
	static const double pass_band = 0.1; /* 1 / lambda + 1 / mu, Taubin's choice */
	double lambda = share_of(s->step), mu = 1 / (pass_band - 1 / lambda), *pace;
	mr_v3 *lp = MR_NEW(ctx, s->m->nv, mr_v3);

	if (!lp)
		return MR_EMEM;
	MR_TRY(paces(ctx, s, limit_of(method), &pace));
	for (size_t i = 0; i < s->found.passes; i++) {
		mr_progress(ctx, "smoothing", (double)i / (double)s->found.passes);
		take_step(ctx, s, pace, 1, lp, p);
		if (method == MR_SMOOTH_TAUBIN)
			take_step(ctx, s, pace, mu / lambda, lp, p);
	}
	return MR_OK;
}

static mr_status
choose_passes(mr_ctx *ctx, const mr_smooth_opts *opts, smoothing *s)
{
	bool one = opts->method == MR_SMOOTH_IMPLICIT;
	double least = one ? 1 : fmax(1, ceil(share_of(opts->time) / limit_of(opts->method)));

	s->found.passes = opts->passes ? opts->passes : one ? 1 : (size_t)fmax(1, ceil(8 * opts->time));
	if ((double)s->found.passes < least)
		return mr_fail(ctx, MR_EUSAGE,
		    "a time of %g needs at least %.0f passes of this method, not %zu", opts->time, least,
		    s->found.passes);
	s->step = opts->time / (double)s->found.passes;
	return MR_OK;
}

mr_status
mr_smooth(mr_ctx *ctx, const mr_mesh *m, const mr_smooth_opts *opts, mr_v3 *out, mr_smooth_result *result)
{
	mr_v3 *p = MR_NEW(ctx, m->nv, mr_v3);
	mr_mark mark = mr_mark_take(ctx);
	smoothing s = { .m = m,
		.found = { .seconds_analyse = NAN, .seconds_factor = NAN, .nnz_factor = NAN, .rcond = NAN } };

	if (!p)
		return MR_EMEM;
	MR_TRY(choose_passes(ctx, opts, &s));
	memcpy(p, m->p, m->nv * sizeof *p);
	MR_TRY(study(ctx, &s));
	if (opts->time > 0 && s.edge2 > 0)
		MR_TRY(opts->method == MR_SMOOTH_IMPLICIT ? implicit(ctx, &s, p)
							  : explicit(ctx, &s, opts->method, p));
	memcpy(out, p, m->nv * sizeof *p);
	if (result)
		*result = s.found;
	mr_mark_release(ctx, mark);
	return MR_OK;
}
