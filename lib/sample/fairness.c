/* The fairness of heights, from the noisy points alone, by generalised cross-validation (Golub, Heath, Wahba
 * 1979): the least sum of w r^2 over (n - trace)^2, the trace from a random vector (Hutchinson 1990). */
#include "base/parallel.h"
#include "base/random.h"
#include "base/sort.h"
#include "sample/parts.h"

#include <float.h>

enum { GRAIN = 1 << 15 };

typedef struct means {
	const mr_adjacency *adj;
	const double *from;
	double *to;
} means;

/* The squared deviation of a height from its neighbours'. */
static void
square_differences(void *arg, size_t begin, size_t end)
{
	const means *m = arg;

	for (size_t i = begin; i < end; i++) {
		double sum = 0, n = (double)(m->adj->start[i + 1] - m->adj->start[i]);
		for (size_t k = m->adj->start[i]; k < m->adj->start[i + 1]; k++)
			sum += m->from[i] - m->from[m->adj->adj[k]];
		m->to[i] = n > 0 ? sum / n * (sum / n) : 0;
	}
}

static void
average(void *arg, size_t begin, size_t end)
{
	const means *m = arg;

	for (size_t i = begin; i < end; i++) {
		double sum = m->from[i];
		for (size_t k = m->adj->start[i]; k < m->adj->start[i + 1]; k++)
			sum += m->from[m->adj->adj[k]];
		m->to[i] = sum / (double)(1 + m->adj->start[i + 1] - m->adj->start[i]);
	}
}

/* x: each so often to the mean of it and its neighbours'. */
static void
spread(mr_ctx *ctx, const mr_heights *e, size_t rounds, double *x)
{
	mr_mark mark = mr_mark_take(ctx);
	double *w = MR_NEW(ctx, e->n, double);

	for (size_t round = 0; round < rounds; round++) {
		mr_parallel(ctx, e->n, GRAIN, average, &(means){ &e->adj, x, w });
		memcpy(x, w, e->n * sizeof *x);
	}
	mr_mark_release(ctx, mark);
}

void
mr_fairness_adapt(mr_ctx *ctx, const mr_heights *e, const double *height, double factor)
{
	/* what fewer rounds show is the noise: 1 % of it leaves 0.205 % of the diagonal with 3, 0.195 with 8
	 */
	enum { ROUNDS = 8 };
	static const double least = 1. / 300, most = 30;
	mr_mark mark = mr_mark_take(ctx);
	double *u = MR_NEW(ctx, e->n, double), *w = MR_NEW(ctx, e->n, double), middle;

	mr_parallel(ctx, e->n, GRAIN, square_differences, &(means){ &e->adj, height, u });
	spread(ctx, e, ROUNDS, u);
	memcpy(w, u, e->n * sizeof *w);
	middle = mr_kth(w, e->n, e->n / 2);
	for (size_t i = 0; i < e->n; i++)
		e->fair[i] = factor * fmin(fmax(middle / fmax(u[i], DBL_MIN), least), most);
	mr_mark_release(ctx, mark);
}

/* The fit that is validated, of a part of the vertices; all others stay. */
typedef struct validation {
	mr_heights *e;
	const mr_wish *wish;
	size_t n;
	const mr_tri *t;
	const double *height;
	size_t steps;
	bool *taken;    /* e->n */
	uint32_t *list; /* of those */
	size_t count;   /* of the list */
	double *fair;   /* as it came: e->n */
	double *trial;  /* heights: e->n */
	double *probe;  /* a random vector, and its image: e->n */
	double *image;
} validation;

/* Takes blocks of faces at even distances, each of some roots of the domain.  All blocks of a million
 * vertices would take as long as the rest of the fit, for less than 1 % of the score. */
static void
take_part(validation *x, size_t nf)
{
	enum { BLOCK = 1 << 12, ENOUGH = 1 << 16 };
	size_t every = 1 + (nf - 1) / (2 * ENOUGH);

	for (size_t f = 0; f < nf; f++)
		for (int k = 0; k < 3 && f / BLOCK % every == 0; k++) {
			uint32_t v = x->t[f].v[k];
			if (!x->taken[v])
				x->list[x->count++] = v;
			x->taken[v] = true;
		}
}

static bool
is_taken(const validation *x, const mr_wish *w)
{
	const uint32_t *v = x->t[w->face].v;

	return x->taken[v[0]] && x->taken[v[1]] && x->taken[v[2]];
}

/* The sign of point i, +1 or -1. */
static double
sign_of(size_t i)
{
	return mr_random_bits(&(mr_random){ i }) & 1 ? 1 : -1;
}

static void
build_probe(const validation *x)
{
	for (size_t i = 0; i < x->n; i++) {
		const mr_wish *w = &x->wish[i];
		const uint32_t *v = x->t[w->face].v;
		double z = sign_of(i) * sqrt((double)w->weight);
		for (int k = 0; k < 3 && is_taken(x, w); k++)
			x->probe[v[k]] += z * w->c[k];
	}
}

static double
weigh(const mr_wish *w, const uint32_t *v, const double *x)
{
	return w->c[0] * x[v[0]] + w->c[1] * x[v[1]] + w->c[2] * x[v[2]];
}

static double
score(const validation *x)
{
	double squares = 0, trace = 0, n = 0;

	for (size_t i = 0; i < x->n; i++) {
		const mr_wish *w = &x->wish[i];
		const uint32_t *v = x->t[w->face].v;
		double r;
		if (!is_taken(x, w))
			continue;
		r = w->r - weigh(w, v, x->trial);
		n++;
		squares += (double)w->weight * r * r;
		trace += sign_of(i) * sqrt((double)w->weight) * weigh(w, v, x->image);
	}
	return squares / ((n - trace) * (n - trace));
}

/* Fits the heights, and the random vector, with the fairness times 10^exponent. */
static mr_status
validate(mr_ctx *ctx, validation *x, double exponent, double *result)
{
	static const double close = 0.05; /* 0.01 takes twice as long and finds the same */
	double *b = x->e->b, factor = pow(10, exponent);

	for (size_t i = 0; i < x->e->n; i++)
		x->e->fair[i] = factor * x->fair[i];
	memcpy(x->trial, x->height, x->e->n * sizeof *x->trial);
	MR_TRY(mr_heights_minimise_some(ctx, x->e, x->list, x->count, close, x->steps, x->trial));
	memset(x->image, 0, x->e->n * sizeof *x->image);
	x->e->b = x->probe;
	MR_TRY(mr_heights_minimise_some(ctx, x->e, x->list, x->count, close, x->steps, x->image));
	x->e->b = b;
	*result = score(x);
	return MR_OK;
}

/* The exponent of least score, within a third: the score falls, is flat, and rises. */
static mr_status
search(mr_ctx *ctx, validation *x, double *exponent)
{
	enum { TRIALS = 6 };
	static const double low = -3.3, step = 0.7;
	double least = INFINITY;

	for (int i = 0; i < TRIALS; i++) {
		double at = low + step * i, now;
		MR_TRY(validate(ctx, x, at, &now));
		if (!(now < least))
			break;
		*exponent = at;
		least = now;
	}
	return MR_OK;
}

mr_status
mr_fairness_validate(mr_ctx *ctx, mr_heights *e, const mr_wish *wish, size_t n, const mr_mesh *surface,
    const double *height, size_t steps, double *factor)
{
	mr_mark mark = mr_mark_take(ctx);
	validation x = { e, wish, n, surface->t, height, steps, MR_NEW_ZERO(ctx, e->n, bool),
		MR_NEW(ctx, e->n, uint32_t), 0, MR_NEW(ctx, e->n, double), MR_NEW(ctx, e->n, double),
		MR_NEW_ZERO(ctx, e->n, double), MR_NEW(ctx, e->n, double) };
	double exponent = 0;

	memcpy(x.fair, e->fair, e->n * sizeof *x.fair);
	take_part(&x, surface->nf);
	build_probe(&x);
	MR_TRY(search(ctx, &x, &exponent));
	*factor = pow(10, exponent);
	for (size_t i = 0; i < e->n; i++)
		e->fair[i] = *factor * x.fair[i];
	mr_mark_release(ctx, mark);
	return MR_OK;
}
