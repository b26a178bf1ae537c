/*
 * V-cycles over levels of unknowns.  Coarse matrices are Galerkin products;
 * smoothing is by Chebyshev polynomials of the diagonally scaled matrix (Adams, Brezina, Hu, Tuminaro 2003),
 * which is symmetric and runs on any number of threads; the coarsest level is solved by Cholesky.
 */
#include "base/parallel.h"
#include "solve/preconditioner.h"
#include "solve/sparse.h"

#include <math.h>

enum { GRAIN = 8192 };

typedef struct level {
	mr_sparse a, prolong, restrict_; /* the last two from and to the next level; the coarsest has none */
	double *inverse;                 /* of the diagonal */
	double top;                      /* about the greatest eigenvalue of D^-1 A, not below it */
	double *x, *r, *d;               /* n x MR_WIDTH: solution, its residual, a change of it */
} level;

typedef struct multigrid {
	size_t count; /* levels */
	level *level;
	double low;     /* the spectrum is smoothed from low x top on */
	size_t degree;  /* of the polynomial */
	size_t applied; /* V-cycles of one application: k of L, 1 of A itself */
	double *mass;   /* W^-1, between two of them */
	mr_solver *coarsest;
	double *column; /* its right-hand sides */
} multigrid;

/* Smoothing */

typedef struct step_job {
	const level *l;
	size_t width;
	double f, g;
} step_job;

/* d = f d + g D^-1 r, x = x + d */
static void
step_rows(void *arg, size_t begin, size_t end)
{
	step_job *j = arg;
	const level *l = j->l;

	for (size_t i = begin; i < end; i++)
		for (size_t e = i * j->width; e < (i + 1) * j->width; e++) {
			l->d[e] = j->f * l->d[e] + j->g * l->inverse[i] * l->r[e];
			l->x[e] += l->d[e];
		}
}

/* Improves x, whose residual is r; r follows where `keep`. */
static void
smooth(const mr_ctx *ctx, const multigrid *g, const level *l, mr_multivector s, bool keep)
{
	double low = g->low * l->top, theta = 0.5 * (l->top + low), delta = 0.5 * (l->top - low);
	double rho = delta / theta;
	step_job j = { l, s.width, 0, 1 / theta };

	memset(l->d, 0, s.n * s.width * sizeof *l->d);
	for (size_t step = 0; step < g->degree; step++) {
		double next = 1 / (2 * theta / delta - rho);
		mr_parallel(ctx, s.n, GRAIN, step_rows, &j);
		if (keep || step + 1 < g->degree)
			mr_sparse_add(ctx, &l->a, -1, s.width, l->d, l->r);
		j.f = next * rho;
		j.g = 2 * next / delta;
		rho = next;
	}
}

/* One V-cycle from x = 0: r holds the right-hand sides. */
static mr_status
cycle(mr_ctx *ctx, const multigrid *g, size_t at, size_t width)
{
	level *l = &g->level[at], *coarse = l + 1;
	mr_multivector s = { (size_t)l->a.n, width };

	if (at + 1 == g->count) { /* the coarsest: x = A^-1 r */
		mr_multivector_scatter(s, l->r, g->column);
		MR_TRY(mr_solver_solve(ctx, g->coarsest, g->column, width));
		mr_multivector_gather(s, g->column, l->x);
		return MR_OK;
	}
	memset(l->x, 0, s.n * width * sizeof *l->x);
	smooth(ctx, g, l, s, true);
	mr_sparse_apply(ctx, &l->restrict_, NULL, (size_t)coarse->a.n, width, l->r, coarse->r);
	MR_TRY(cycle(ctx, g, at + 1, width));
	mr_sparse_apply(ctx, &l->prolong, NULL, s.n, width, coarse->x, l->d); /* d = P e */
	mr_multivector_add(ctx, s, MR_ONE, l->d, MR_ONE, l->x);
	mr_sparse_add(ctx, &l->a, -1, width, l->d, l->r);
	smooth(ctx, g, l, s, false);
	return MR_OK;
}

static mr_status
multigrid_apply(mr_ctx *ctx, void *data, mr_multivector s, const double *r, double *z)
{
	const multigrid *g = data;
	const level *finest = g->level;

	memcpy(finest->r, r, s.n * s.width * sizeof *r);
	for (size_t k = 1; k <= g->applied; k++) {
		MR_TRY(cycle(ctx, g, 0, s.width));
		if (k < g->applied)
			mr_multivector_scale(ctx, s, g->mass, finest->x, finest->r);
	}
	memcpy(z, finest->x, s.n * s.width * sizeof *z);
	return MR_OK;
}

/* Set-up */

/* A row that asks for nothing gets a diagonal, so that its unknown stays 0. */
static void
invert_diagonal(mr_ctx *ctx, level *l)
{
	mr_sparse *a = &l->a;

	l->inverse = MR_NEW(ctx, (size_t)a->n, double);
	for (int i = 0; i < a->n; i++) {
		int e = mr_sparse_find(a, i, i);
		l->inverse[i] = e >= 0 && a->value[e] > 0 ? 1 / a->value[e] : 1;
	}
}

/* The greatest eigenvalue of D^-1 A by the power method, from a vector of changing signs, with a margin; 1
 * for a matrix of zeros, of which any bound is one.  4 steps make up to a third more iterations, 50 none
 * less; a margin of 1 or of 1.3 makes up to a tenth more. */
static void
estimate_top(const mr_ctx *ctx, level *l)
{
	enum { STEPS = 12 };
	static const double margin = 1.1;
	mr_multivector s = { (size_t)l->a.n, 1 };
	double size, last = 1;

	l->top = 1;
	mr_rough_start(s.n, l->x);
	for (int step = 0; step < STEPS; step++) {
		mr_multivector_dot(ctx, s, l->x, l->x, &size);
		for (size_t i = 0; i < s.n; i++)
			l->x[i] /= sqrt(size);
		mr_sparse_apply(ctx, &l->a, NULL, s.n, 1, l->x, l->d);
		mr_multivector_scale(ctx, s, l->inverse, l->d, l->x);
		mr_multivector_dot(ctx, s, l->x, l->x, &last);
		if (last == 0)
			return;
	}
	l->top = margin * sqrt(last);
}

static void
make_workspace(mr_ctx *ctx, level *l)
{
	size_t n = (size_t)l->a.n * MR_WIDTH;

	l->x = MR_NEW(ctx, n, double);
	l->r = MR_NEW(ctx, n, double);
	l->d = MR_NEW(ctx, n, double);
}

/* The matrix of the level after l: P' A P. */
static mr_status
coarsen(mr_ctx *ctx, const mr_coarser *c, level *l)
{
	mr_sparse ap;

	l->prolong = c->prolong;
	MR_TRY(mr_sparse_transpose(ctx, &l->prolong, c->n, &l->restrict_));
	MR_TRY(mr_sparse_multiply(ctx, &l->a, &l->prolong, c->n, &ap));
	return mr_sparse_multiply(ctx, &l->restrict_, &ap, c->n, &l[1].a);
}

static mr_status
factor_coarsest(mr_ctx *ctx, multigrid *g)
{
	level *l = &g->level[g->count - 1];
	mr_sparse a = l->a, lower = { a.n, MR_NEW_ZERO(ctx, (size_t)a.n + 1, int),
		MR_NEW(ctx, (size_t)a.start[a.n] + (size_t)a.n, int),
		MR_NEW(ctx, (size_t)a.start[a.n] + (size_t)a.n, double) };
	int n = 0;

	g->column = MR_NEW(ctx, (size_t)a.n * MR_WIDTH, double);
	for (int i = 0; i < a.n; i++) {
		double diagonal = 0;
		for (int e = a.start[i]; e < a.start[i + 1] && a.index[e] <= i; e++)
			if (a.index[e] < i) {
				lower.index[n] = a.index[e];
				lower.value[n++] = a.value[e];
			} else
				diagonal = a.value[e];
		lower.index[n] = i;
		lower.value[n++] = diagonal > 0 ? diagonal : 1;
		lower.start[i + 1] = n;
	}
	g->coarsest = mr_solver_new(ctx);
	return mr_solver_direct(ctx, g->coarsest, MR_CHOLESKY, &lower, NULL);
}

static mr_status
build(mr_ctx *ctx, const mr_hierarchy *h, const mr_sparse *a, multigrid *g, mr_preconditioner *b)
{
	*b = (mr_preconditioner){ multigrid_apply, g, 0 };
	g->count = h->count + 1;
	g->level = mr_alloc_zero(ctx, g->count, sizeof *g->level);
	g->level[0].a = *a;
	for (size_t i = 0; i < g->count; i++) {
		level *l = &g->level[i];
		if (i < h->count)
			MR_TRY(coarsen(ctx, &h->level[i], l));
		make_workspace(ctx, l);
		invert_diagonal(ctx, l);
		estimate_top(ctx, l);
		b->nnz += l->a.start[l->a.n] + (i < h->count ? 2 * l->prolong.start[l->a.n] : 0);
	}
	return factor_coarsest(ctx, g);
}

mr_status
mr_cycles_new(mr_ctx *ctx, const mr_hierarchy *h, mr_preconditioner *b)
{
	multigrid *g = MR_NEW_ZERO(ctx, 1, multigrid);
	size_t n = (size_t)h->laplace->n;

	g->mass = MR_NEW(ctx, n, double);
	for (size_t i = 0; i < n; i++)
		g->mass[i] = 1 / h->weight[i];
	g->low = 0.25;
	g->degree = 2;
	g->applied = h->order;
	return build(ctx, h, h->laplace, g, b);
}

/* An operator of order 2 k has a spectrum that much wider, so there is more of it to smooth. */
mr_status
mr_vcycle_new(mr_ctx *ctx, const mr_sparse *a, const mr_hierarchy *h, mr_preconditioner *b)
{
	multigrid *g = MR_NEW_ZERO(ctx, 1, multigrid);

	g->low = pow(0.25, (double)h->order);
	g->degree = (size_t)1 << h->order;
	g->applied = 1;
	return build(ctx, h, a, g, b);
}
