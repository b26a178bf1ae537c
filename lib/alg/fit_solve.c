/*
 * Conjugate gradients (Hestenes, Stiefel 1952), preconditioned by the incomplete Cholesky factor without fill
 * (Meijerink, van der Vorst 1977) of the part of the matrix that x, y and z have in common: a ninth of the
 * whole's entries.  The matrix has all that a control face couples, and is solved to a thousandth, so that
 * there is little to gain by fill.
 */
#include "alg/fit_solve.h"

#include <math.h>

enum { MOST_STEPS = 100 };

static const double ACCURACY = 1e-3; /* of the solution, in the norm of the energy */

static double
dot(const double *a, const double *b, size_t n)
{
	double sum = 0;

	for (size_t i = 0; i < n; i++)
		sum += a[i] * b[i];
	return sum;
}

/* p = a p + q */
static void
combine(double a, double *p, const double *q, size_t n)
{
	for (size_t i = 0; i < n; i++)
		p[i] = a * p[i] + q[i];
}

/* Row i of the factor, from those before; at: of each column, its entry in the row, or -1 before and after.
 * False where the pivot is not positive. */
static bool
factor_row(mr_sparse *l, int i, int *at)
{
	int first = l->start[i], last = l->start[i + 1] - 1; /* the diagonal ends the row */
	double pivot = l->value[last];

	for (int e = first; e < last; e++)
		at[l->index[e]] = e;
	for (int e = first; e < last; e++) {
		int k = l->index[e], end = l->start[k + 1] - 1;
		double sum = l->value[e];
		for (int g = l->start[k]; g < end; g++)
			if (at[l->index[g]] >= 0)
				sum -= l->value[g] * l->value[at[l->index[g]]];
		l->value[e] = sum / l->value[end];
		pivot -= l->value[e] * l->value[e];
	}
	for (int e = first; e < last; e++)
		at[l->index[e]] = -1;
	l->value[last] = sqrt(pivot);
	return pivot > 0;
}

static bool
factor(const mr_sparse *a, double shift, mr_sparse *l, int *at)
{
	memcpy(l->value, a->value, (size_t)a->start[a->n] * sizeof *l->value);
	for (int i = 0; i < a->n; i++) {
		l->value[l->start[i + 1] - 1] *= 1 + shift;
		if (!factor_row(l, i, at))
			return false;
	}
	return true;
}

/* a = L L^T but for what does not fit in; the diagonal is raised until all pivots are positive (Manteuffel
 * 1980). */
static mr_status
factor_incompletely(mr_ctx *ctx, const mr_sparse *a, mr_sparse *l)
{
	static const double first = 1e-3, last = 10;
	double shift = 0;
	int *at = MR_NEW(ctx, (size_t)a->n, int);

	*l = *a;
	l->value = MR_NEW(ctx, (size_t)a->start[a->n], double);
	if (!at || !l->value)
		return MR_EMEM;
	for (int i = 0; i < a->n; i++)
		at[i] = -1;
	while (!factor(a, shift, l, at)) {
		shift = shift > 0 ? 2 * shift : first;
		if (shift > last)
			return mr_fail(ctx, MR_ENUMERIC, "the equations have no incomplete factor");
	}
	return MR_OK;
}

/* z = (L L^T)^-1 r; three columns side by side */
static void
substitute(const mr_sparse *l, const double *r, double *z)
{
	size_t n = (size_t)l->n;

	memcpy(z, r, 3 * n * sizeof *z);
	for (int i = 0; i < l->n; i++) {
		int last = l->start[i + 1] - 1;
		double *x = z + i, inverse = 1 / l->value[last], sum[3] = { x[0], x[n], x[2 * n] };
		for (int e = l->start[i]; e < last; e++)
			for (size_t k = 0; k < 3; k++)
				sum[k] -= l->value[e] * z[k * n + (size_t)l->index[e]];
		for (size_t k = 0; k < 3; k++)
			x[k * n] = inverse * sum[k];
	}
	for (int i = l->n; i-- > 0;) {
		int last = l->start[i + 1] - 1;
		double *x = z + i, inverse = 1 / l->value[last];
		for (size_t k = 0; k < 3; k++)
			x[k * n] *= inverse;
		for (int e = l->start[i]; e < last; e++)
			for (size_t k = 0; k < 3; k++)
				z[k * n + (size_t)l->index[e]] -= l->value[e] * x[k * n];
	}
}

/* r: the right-hand side, used up.  z: the solution. */
static mr_status
conjugate_gradients(
    mr_ctx *ctx, const mr_fit_system *s, const mr_sparse *l, double *r, double *z, size_t *steps)
{
	size_t n = 3 * (size_t)s->a.n;
	double *p = MR_NEW_ZERO(ctx, n, double), *q = MR_NEW(ctx, n, double), rho = 1, first = 0;

	if (!p || !q)
		return MR_EMEM;
	memset(z, 0, n * sizeof *z);
	for (size_t i = 0; i < MOST_STEPS; i++) {
		double before = rho, alpha;
		substitute(l, r, q);
		rho = dot(r, q, n);
		first = i == 0 ? rho : first;
		if (!(rho > ACCURACY * ACCURACY * first))
			break;
		combine(i == 0 ? 0 : rho / before, p, q, n);
		mr_fit_system_apply(s, p, q);
		alpha = rho / dot(p, q, n);
		for (size_t k = 0; k < n; k++) {
			z[k] += alpha * p[k];
			r[k] -= alpha * q[k];
		}
		++*steps;
	}
	return MR_OK;
}

mr_status
mr_fit_solve(mr_ctx *ctx, mr_fit_system *system, mr_v3 *motion, size_t *steps)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = (size_t)system->a.n;
	double *z = MR_NEW(ctx, 3 * nv, double);
	mr_sparse l;

	if (!z)
		return MR_EMEM;
	MR_TRY(factor_incompletely(ctx, &system->a, &l));
	MR_TRY(conjugate_gradients(ctx, system, &l, system->b, z, steps));
	for (size_t v = 0; v < nv; v++)
		motion[v] = mr_vec(z[v], z[nv + v], z[2 * nv + v]);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
