#include "solve/simplicial.h"

#include <suitesparse/cs.h>

struct mr_simplicial {
	int n;
	cs_dis *order; /* by minimum degree */
	cs_din *factors;
	double *work; /* n */
};

void
mr_simplicial_free(mr_simplicial *s)
{
	if (!s)
		return;
	cs_di_sfree(s->order);
	cs_di_nfree(s->factors);
	free(s->work);
	free(s);
}

mr_status
mr_simplicial_new(mr_ctx *ctx, const mr_sparse *a, mr_simplicial **out)
{
	/* rows of the lower triangle are columns of the upper one, which is what is read */
	cs_di upper = { a->start[a->n], a->n, a->n, a->start, a->index, a->value, -1 };
	mr_simplicial *s = calloc(1, sizeof *s);
	bool room;

	if (s) {
		s->n = a->n;
		s->work = malloc((size_t)a->n * sizeof *s->work);
		s->order = cs_di_schol(1, &upper);
	}
	room = s && s->work && s->order;
	if (room)
		s->factors = cs_di_chol(&upper, s->order);
	if (room && s->factors) {
		*out = s;
		return MR_OK;
	}
	mr_simplicial_free(s);
	return room ? mr_fail(ctx, MR_ENUMERIC, "a matrix of %d rows is not positive definite", a->n)
	            : mr_fail(ctx, MR_EMEM, "no memory to factor a matrix of %d rows", a->n);
}

void
mr_simplicial_solve(mr_simplicial *s, const double *b, double *x)
{
	cs_di_ipvec(s->order->pinv, b, s->work, s->n);
	cs_di_lsolve(s->factors->L, s->work);
	cs_di_ltsolve(s->factors->L, s->work);
	cs_di_pvec(s->order->pinv, s->work, x, s->n);
}
