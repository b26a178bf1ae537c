/* Heights as a thin plate through data, fair by the square of the umbrella (Kobbelt et al. 1998).  The
 * matrix, whose rows reach two rings, is not stored: conjugate gradients ask for its products only. */
#include "sample/height_energy.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "solve/preconditioner.h"

/* Less takes no longer than to start a thread. */
enum { GRAIN = 1 << 15 };

void
mr_heights_new(mr_ctx *ctx, const mr_mesh *m, double fair, mr_heights *e)
{
	mr_heights r = { .n = m->nv, .fair = MR_NEW(ctx, m->nv, double) };

	for (size_t i = 0; i < m->nv; i++)
		r.fair[i] = fair;
	mr_adjacency_build(ctx, m, &r.adj);
	*e = r;
}

void
mr_heights_add_data(mr_ctx *ctx, mr_heights *e)
{
	double *diagonal = MR_NEW(ctx, e->n, double), *b = MR_NEW(ctx, e->n, double);
	double *beside = MR_NEW(ctx, e->adj.start[e->n], double);

	e->diagonal = diagonal;
	e->beside = beside;
	e->b = b;
}

static double
degree(const mr_heights *e, size_t i)
{
	return (double)(e->adj.start[i + 1] - e->adj.start[i]);
}

/* f_i / n_i^2: what the squared sum of the differences to the n_i neighbours counts. */
static double
fairness(const mr_heights *e, size_t i)
{
	double n = degree(e, i);

	return n > 0 ? e->fair[i] / (n * n) : 0;
}

static double
differences(const mr_heights *e, const double *x, size_t i)
{
	double sum = 0;

	for (size_t k = e->adj.start[i]; k < e->adj.start[i + 1]; k++)
		sum += x[i] - x[e->adj.adj[k]];
	return sum;
}

/* The matrix of the energy: A + D F N^-2 D, with D the graph's Laplacian and N the degrees. */
typedef struct matrix {
	const mr_heights *e;
	double *weight;  /* F N^-2 */
	double *inverse; /* of the diagonal; 0 where the height is fixed */
	double *u;       /* F N^-2 D x: workspace */
} matrix;

typedef struct product {
	const matrix *a;
	const double *x;
	double *y;
} product;

static void
apply_first(void *arg, size_t begin, size_t end)
{
	const product *j = arg;

	for (size_t i = begin; i < end; i++)
		j->a->u[i] = j->a->weight[i] * differences(j->a->e, j->x, i);
}

static double
apply_row(const product *j, size_t i)
{
	const mr_heights *e = j->a->e;
	double sum = differences(e, j->a->u, i);

	if (e->diagonal) {
		sum += e->diagonal[i] * j->x[i];
		for (size_t k = e->adj.start[i]; k < e->adj.start[i + 1]; k++)
			sum += e->beside[k] * j->x[e->adj.adj[k]];
	}
	return sum;
}

static void
apply_second(void *arg, size_t begin, size_t end)
{
	const product *j = arg;

	for (size_t i = begin; i < end; i++)
		j->y[i] = j->a->inverse[i] > 0 ? apply_row(j, i) : 0;
}

/* y = A x, but 0 where the height is fixed. */
static void
apply(const mr_ctx *ctx, const void *a, mr_multivector s, const double *x, double *y)
{
	product j = { a, x, y };

	mr_parallel(ctx, s.n, GRAIN, apply_first, &j);
	mr_parallel(ctx, s.n, GRAIN, apply_second, &j);
}

/* From the weights. */
static void
invert_diagonal(void *arg, size_t begin, size_t end)
{
	const matrix *a = arg;
	const mr_heights *e = a->e;

	for (size_t i = begin; i < end; i++) {
		double n = degree(e, i), sum = n * n * a->weight[i] + (e->diagonal ? e->diagonal[i] : 0);
		for (size_t k = e->adj.start[i]; k < e->adj.start[i + 1]; k++)
			sum += a->weight[e->adj.adj[k]];
		a->inverse[i] = sum > 0 && !(e->fixed && e->fixed[i]) ? 1 / sum : 0;
	}
}

/* r = b - A h where the height is free, else 0. */
static void
find_residual(const mr_ctx *ctx, const matrix *a, const double *h, double *r)
{
	const mr_heights *e = a->e;

	apply(ctx, a, (mr_multivector){ e->n, 1 }, h, r);
	for (size_t i = 0; i < e->n; i++)
		r[i] = (e->b && a->inverse[i] > 0 ? e->b[i] : 0) - r[i];
}

mr_status
mr_heights_minimise(mr_ctx *ctx, const mr_heights *e, double tol, size_t most, double *h)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t n = e->n, taken = 0;
	double *r = MR_NEW(ctx, n, double);
	matrix a = { e, MR_NEW(ctx, n, double), MR_NEW(ctx, n, double), MR_NEW(ctx, n, double) };
	mr_preconditioner b = mr_jacobi_of(a.inverse, n);
	mr_cg g = { .s = { n, 1 }, .apply = apply, .a = &a, .b = &b, .tol = tol, .most = most };

	for (size_t i = 0; i < n; i++)
		a.weight[i] = fairness(e, i);
	mr_parallel(ctx, n, GRAIN, invert_diagonal, &a);
	find_residual(ctx, &a, h, r);
	MR_TRY(mr_cg_improve(ctx, &g, h, r, &taken));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* A part of an energy: the vertices that are free, then two rings around them. */
typedef struct part {
	uint32_t *number; /* of each vertex in the part, or MR_NONE */
	uint32_t *vertex; /* the other way */
	size_t n;
} part;

/* Numbers the neighbours of those that are there. */
static void
add_ring(const mr_heights *e, part *p)
{
	size_t n = p->n;

	for (size_t i = 0; i < n; i++)
		for (size_t k = e->adj.start[p->vertex[i]]; k < e->adj.start[p->vertex[i] + 1]; k++) {
			uint32_t j = e->adj.adj[k];
			if (p->number[j] == MR_NONE) {
				p->number[j] = (uint32_t)p->n;
				p->vertex[p->n++] = j;
			}
		}
}

static void
part_new(mr_ctx *ctx, const mr_heights *e, const uint32_t *list, size_t count, part *p, size_t *inner)
{
	p->number = MR_NEW(ctx, e->n, uint32_t);
	p->vertex = MR_NEW(ctx, e->n, uint32_t);
	for (size_t i = 0; i < e->n; i++)
		p->number[i] = MR_NONE;
	for (size_t i = 0; i < count; i++)
		p->number[list[i]] = (uint32_t)i;
	memcpy(p->vertex, list, count * sizeof *list);
	p->n = count;
	add_ring(e, p);
	*inner = p->n;
	add_ring(e, p);
}

/* The energy of the part; those from `inner` on, whose own neighbours are not all there, have none. */
static void
part_energy(mr_ctx *ctx, const mr_heights *e, const part *p, size_t count, size_t inner, mr_heights *out)
{
	size_t entries = 0;
	size_t *start = MR_NEW(ctx, p->n + 1, size_t);
	uint32_t *adj;

	for (size_t i = 0; i < inner; i++)
		entries += (size_t)degree(e, p->vertex[i]);
	adj = MR_NEW(ctx, entries, uint32_t);
	*out = (mr_heights){ .n = p->n, .fair = MR_NEW(ctx, p->n, double), .fixed = MR_NEW(ctx, p->n, bool) };
	out->adj = (mr_adjacency){ .start = start, .adj = adj };
	start[p->n] = entries; /* what the data go by */
	mr_heights_add_data(ctx, out);
	entries = 0;
	for (size_t i = 0; i < p->n; i++) {
		uint32_t v = p->vertex[i];
		start[i] = entries;
		out->fair[i] = e->fair[v];
		out->fixed[i] = i >= count;
		out->diagonal[i] = e->diagonal[v];
		out->b[i] = e->b[v];
		for (size_t k = e->adj.start[v]; i < inner && k < e->adj.start[v + 1]; k++) {
			out->beside[entries] = e->beside[k];
			adj[entries++] = p->number[e->adj.adj[k]];
		}
	}
}

mr_status
mr_heights_minimise_some(
    mr_ctx *ctx, const mr_heights *e, const uint32_t *list, size_t count, double tol, size_t most, double *h)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_heights some;
	size_t inner;
	double *x;
	part p;

	part_new(ctx, e, list, count, &p, &inner);
	x = MR_NEW(ctx, p.n, double);
	part_energy(ctx, e, &p, count, inner, &some);
	for (size_t i = 0; i < p.n; i++)
		x[i] = h[p.vertex[i]];
	MR_TRY(mr_heights_minimise(ctx, &some, tol, most, x));
	for (size_t i = 0; i < count; i++)
		h[list[i]] = x[i];
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Fronts: each vertex next to the known takes the mean of its known neighbours, ring after ring. */
static void
fill_rings(mr_ctx *ctx, const mr_heights *e, const bool *known, double *h)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *queue = MR_NEW(ctx, e->n, uint32_t), *ring = MR_NEW(ctx, e->n, uint32_t);
	size_t head = 0, tail = 0;

	for (size_t i = 0; i < e->n; i++) {
		ring[i] = known[i] ? 0 : UINT32_MAX;
		if (known[i])
			queue[tail++] = (uint32_t)i;
		else
			h[i] = 0;
	}
	while (head < tail) {
		uint32_t i = queue[head++];
		double sum = 0, count = 0;
		for (size_t k = e->adj.start[i]; k < e->adj.start[i + 1]; k++) {
			uint32_t j = e->adj.adj[k];
			if (ring[j] == UINT32_MAX) {
				ring[j] = ring[i] + 1;
				queue[tail++] = j;
			} else if (ring[j] < ring[i]) {
				sum += h[j];
				count++;
			}
		}
		if (ring[i] > 0)
			h[i] = sum / count;
	}
	mr_mark_release(ctx, mark);
}

mr_status
mr_heights_fill(mr_ctx *ctx, mr_heights *e, const bool *known, double *h, size_t *filled)
{
	/* they are a start only: to 1e-8 the mean gap after the fit differs by 4 % either way on clouds that
	 * leave thousands open, by less than 0.1 % on others */
	enum { STEPS = 100 };
	mr_heights plate = { .n = e->n, .adj = e->adj, .fair = e->fair };
	mr_mark mark = mr_mark_take(ctx);
	size_t count = 0;

	for (size_t i = 0; i < e->n; i++)
		count += !known[i];
	*filled = count;
	if (count == 0)
		return MR_OK;
	fill_rings(ctx, e, known, h);
	plate.fixed = MR_NEW(ctx, e->n, bool);
	memcpy(plate.fixed, known, e->n * sizeof *known);
	MR_TRY(mr_heights_minimise(ctx, &plate, 1e-4, count < e->n ? STEPS : 0, h));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The median of n values, which are reordered. */
static double
median(double *x, size_t n)
{
	double high = mr_kth(x, n, n / 2);

	return n % 2 ? high : (mr_kth(x, n, n / 2 - 1) + high) / 2;
}

typedef struct spikes {
	const mr_heights *e;
	const mr_v3 *p;
	const double *h;
	const bool *known;
	bool *spike;
} spikes;

static bool
sticks_out(const spikes *s, size_t i)
{
	enum { MOST = 64 };
	double around[MOST], middle, deviation, length = 0;
	size_t n = 0;

	for (size_t k = s->e->adj.start[i]; k < s->e->adj.start[i + 1] && n < MOST; k++) {
		uint32_t j = s->e->adj.adj[k];
		if (!s->known[j])
			continue;
		around[n++] = s->h[j];
		length += mr_dist(s->p[i], s->p[j]);
	}
	if (n < 3)
		return false;
	middle = median(around, n);
	for (size_t k = 0; k < n; k++)
		around[k] = fabs(around[k] - middle);
	deviation = median(around, n);
	return fabs(s->h[i] - middle) > fmax(length / (double)n, 6 * deviation);
}

static void
find_spikes(void *arg, size_t begin, size_t end)
{
	const spikes *s = arg;

	for (size_t i = begin; i < end; i++)
		s->spike[i] = s->known[i] && sticks_out(s, i);
}

void
mr_heights_drop_spikes(
    mr_ctx *ctx, const mr_heights *e, const mr_v3 *p, const double *h, bool *known, size_t *dropped)
{
	mr_mark mark = mr_mark_take(ctx);
	spikes s = { e, p, h, known, MR_NEW(ctx, e->n, bool) };

	mr_parallel(ctx, e->n, GRAIN, find_spikes, &s);
	*dropped = 0;
	for (size_t i = 0; i < e->n; i++) {
		*dropped += s.spike[i];
		known[i] = known[i] && !s.spike[i];
	}
	mr_mark_release(ctx, mark);
}
