/*
 * Conjugate gradients (Hestenes, Stiefel 1952), preconditioned by the Cholesky factor of the part of the
 * matrix that x, y and z have in common: a ninth of the whole's entries.
 */
#include "alg/fit_solve.h"

#include "solve/simplicial.h"

enum { MOST_STEPS = 50 };

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

/* r: the right-hand side, used up.  z: the solution. */
static mr_status
conjugate_gradients(
    mr_ctx *ctx, const mr_fit_system *s, mr_simplicial *common, double *r, double *z, size_t *steps)
{
	size_t nv = (size_t)s->a.n, n = 3 * nv;
	double *p = MR_NEW_ZERO(ctx, n, double), *q = MR_NEW(ctx, n, double), rho = 1, first = 0;

	if (!p || !q)
		return MR_EMEM;
	memset(z, 0, n * sizeof *z);
	for (size_t i = 0; i < MOST_STEPS; i++) {
		double before = rho, alpha;
		for (size_t k = 0; k < 3; k++)
			mr_simplicial_solve(common, r + k * nv, q + k * nv);
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
	mr_simplicial *common;
	mr_status status;

	if (!z)
		return MR_EMEM;
	MR_TRY(mr_simplicial_new(ctx, &system->a, &common));
	status = conjugate_gradients(ctx, system, common, system->b, z, steps);
	mr_simplicial_free(common);
	MR_TRY(status);
	for (size_t v = 0; v < nv; v++)
		motion[v] = mr_vec(z[v], z[nv + v], z[2 * nv + v]);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
