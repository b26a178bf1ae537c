/* Hestenes, Stiefel 1952: Methods of conjugate gradients for solving linear systems. */
#include "solve/preconditioner.h"
#include "solve/sparse.h"

void
mr_cg_apply(const mr_ctx *ctx, const void *a, mr_multivector s, const double *x, double *y)
{
	mr_sparse_apply(ctx, a, NULL, s.n, s.width, x, y);
}

mr_status
mr_cg_improve(mr_ctx *ctx, const mr_cg *g, double *x, double *r, size_t *iterations)
{
	MR_SCOPE(ctx);
	mr_multivector s = g->s;
	double *p = MR_NEW_ZERO(ctx, s.n * s.width, double), *q = MR_NEW(ctx, s.n * s.width, double);
	double rz[MR_WIDTH], last[MR_WIDTH] = { 0 }, pq[MR_WIDTH], rr[MR_WIDTH], f[MR_WIDTH], goal[MR_WIDTH];

	mr_multivector_dot(ctx, s, r, r, rr);
	for (bool first = true, stuck; *iterations < g->most; first = false, ++*iterations) {
		if (g->goal && mr_multivector_within(s, rr, g->goal))
			break;
		MR_TRY(g->b->apply(ctx, g->b->data, s, r, q)); /* z = B r, where q will be */
		mr_multivector_dot(ctx, s, r, q, rz);
		for (size_t c = 0; c < s.width; c++) {
			goal[c] = first ? g->tol * sqrt(rz[c]) : goal[c];
			f[c] = mr_ratio(rz[c], last[c]); /* beta */
		}
		if (!g->goal && mr_multivector_within(s, rz, goal))
			break;
		mr_multivector_add(ctx, s, MR_ONE, q, f, p); /* p = z + beta p */
		memcpy(last, rz, sizeof rz);
		g->apply(ctx, g->a, s, p, q); /* q = A p */
		mr_multivector_dot(ctx, s, p, q, pq);
		stuck = true;
		for (size_t c = 0; c < s.width; c++) {
			f[c] = pq[c] > 0 ? mr_ratio(rz[c], pq[c]) : 0; /* alpha */
			stuck = stuck && f[c] == 0;
		}
		if (stuck)
			break;
		mr_multivector_step(ctx, s, f, p, q, x, r, rr); /* x += alpha p, r -= alpha q */
	}
	return MR_OK;
}
