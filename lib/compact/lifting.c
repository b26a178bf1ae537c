/* Whole numbers to coefficients and back, level by level. */
#include "compact/lifting.h"

#include "base/parallel.h"
#include "subdivide/loop_ring.h"

enum { GRAIN = 2048, MOST = 1 << 30 };

static inline int32_t
fit(int64_t x)
{
	return (int32_t)(x > MOST ? MOST : x < -MOST ? -MOST : x);
}

/* x / 2^n, rounded to the nearest, halves upward. */
static inline int64_t
part(int64_t x, unsigned n)
{
	int64_t half = (int64_t)1 << (n - 1), whole = (int64_t)1 << n;

	x += half;
	return x >= 0 ? x / whole : -((whole - 1 - x) / whole);
}

/* The sum of the two wings on the side of half-edge h, whose own corner is at x[c]. */
static inline int64_t
wings(const mr_loop *l, uint32_t h, uint32_t c, const int32_t *x)
{
	uint32_t g = l->topo.twin[mr_he_next(h)], k = l->topo.twin[mr_he_prev(h)];

	return (int64_t)x[g == MR_NONE ? c : mr_loop_opposite(l, g)] +
	       x[k == MR_NONE ? c : mr_loop_opposite(l, k)];
}

static inline int64_t
prediction(const mr_loop *l, uint32_t h, const int32_t *x)
{
	int64_t ends = (int64_t)x[mr_loop_from(l, h)] + x[mr_loop_to(l, h)];
	uint32_t g = l->topo.twin[h], c, d;

	if (mr_loop_sharp(l, h))
		return part(ends, 1);
	c = mr_loop_opposite(l, h);
	d = mr_loop_opposite(l, g);
	return part(8 * ends + 2 * ((int64_t)x[c] + x[d]) - wings(l, h, c, x) - wings(l, g, d, x), 4);
}

typedef struct lifting {
	const mr_loop *coarse, *fine;
	int32_t *x;
	int64_t *sum; /* coarse->nv */
	int sign;
} lifting;

static void
predict(void *arg, size_t begin, size_t end)
{
	const lifting *l = arg;
	int32_t *odd = l->x + l->coarse->nv;

	for (size_t i = begin; i < end; i++)
		odd[i] = fit(odd[i] + l->sign * prediction(l->coarse, l->fine->edge[i], l->x));
}

static void
update(const lifting *l)
{
	size_t nv = l->coarse->nv;

	memset(l->sum, 0, nv * sizeof *l->sum);
	for (size_t i = nv; i < l->fine->nv; i++) {
		uint32_t h = l->fine->edge[i - nv];
		l->sum[mr_loop_from(l->coarse, h)] += l->x[i];
		l->sum[mr_loop_to(l->coarse, h)] += l->x[i];
	}
	for (size_t v = 0; v < nv; v++)
		l->x[v] = fit(l->x[v] - l->sign * part(l->sum[v], 3));
}

static lifting
lifting_of(const mr_loop *fine, int sign, int32_t *x, int64_t *sum)
{
	return (lifting){ fine - 1, fine, x, sum, sign };
}

void
mr_lifting_analyse(mr_ctx *ctx, const mr_loop *level, size_t n, int32_t *x)
{
	MR_SCOPE(ctx);
	int64_t *sum = MR_NEW(ctx, level[n].coarse_nv, int64_t);

	for (size_t i = n; i > 0; i--) {
		lifting l = lifting_of(&level[i], -1, x, sum);
		mr_parallel(ctx, l.fine->nv - l.coarse->nv, GRAIN, predict, &l);
		update(&l);
	}
}

void
mr_lifting_synthesize(mr_ctx *ctx, const mr_loop *level, size_t n, int32_t *x)
{
	MR_SCOPE(ctx);
	int64_t *sum = MR_NEW(ctx, level[n].coarse_nv, int64_t);

	for (size_t i = 1; i <= n; i++) {
		lifting l = lifting_of(&level[i], 1, x, sum);
		update(&l);
		mr_parallel(ctx, l.fine->nv - l.coarse->nv, GRAIN, predict, &l);
	}
}
