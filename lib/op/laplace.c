/* Pinkall, Polthier 1993: Computing discrete minimal surfaces and their conjugates. */
#include "op/laplace.h"

#include "base/parallel.h"

enum { GRAIN = 4096 };

void
mr_cotangents(mr_v3 a, mr_v3 b, mr_v3 c, double cot[3])
{
	static const double flattest = 1e-6;
	mr_v3 ab = mr_sub(b, a), bc = mr_sub(c, b), ca = mr_sub(a, c);
	double twice = mr_norm(mr_cross(ab, bc));
	double longest2 = fmax(mr_norm2(ab), fmax(mr_norm2(bc), mr_norm2(ca)));
	double scale = longest2 > 0 ? 1 / fmax(twice, flattest * longest2) : 0;

	cot[0] = -mr_dot(ab, ca) * scale;
	cot[1] = -mr_dot(bc, ab) * scale;
	cot[2] = -mr_dot(ca, bc) * scale;
}

typedef struct laplace_job {
	const mr_mesh *m;
	const mr_incidence *inc;
	double (*cot)[3]; /* per face */
	mr_sparse *l;
} laplace_job;

static void
cotangents_of(void *arg, size_t begin, size_t end)
{
	laplace_job *j = arg;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = j->m->t[f].v;
		mr_cotangents(j->m->p[v[0]], j->m->p[v[1]], j->m->p[v[2]], j->cot[f]);
	}
}

/* Neighbour i of vertex v, of two in each face around it; v itself where the face has a vertex twice and no
 * area. */
static uint32_t
neighbour(const laplace_job *j, size_t v, size_t i)
{
	const uint32_t *c = j->m->t[j->inc->face[j->inc->start[v] + i / 2]].v;
	size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
	uint32_t a = c[(k + 1) % 3], b = c[(k + 2) % 3];

	return a == v || b == v ? (uint32_t)v : i % 2 ? b : a;
}

/* Neighbours with which a row is long: that each is there once is told by marks on the vertices. */
enum { LONG = 512 };

static size_t
neighbours(const laplace_job *j, size_t v)
{
	return 2 * (j->inc->start[v + 1] - j->inc->start[v]);
}

static void
count_long_rows(mr_ctx *ctx, laplace_job *j)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *row = NULL; /* that each vertex is of, from 1 on */

	for (size_t v = 0; v < j->m->nv; v++) {
		size_t n = neighbours(j, v);
		if (n < LONG)
			continue;
		if (!row)
			row = MR_NEW_ZERO(ctx, j->m->nv, uint32_t);
		j->l->start[v + 1] = 1;
		row[v] = (uint32_t)v + 1;
		for (size_t i = 0; i < n; i++) {
			uint32_t w = neighbour(j, v, i);
			j->l->start[v + 1] += row[w] != v + 1;
			row[w] = (uint32_t)v + 1;
		}
	}
	mr_mark_release(ctx, mark);
}

/* The length of each other row: the diagonal, and each neighbour once. */
static void
count_rows(void *arg, size_t begin, size_t end)
{
	laplace_job *j = arg;

	for (size_t v = begin; v < end; v++) {
		size_t n = neighbours(j, v);
		uint32_t seen[LONG + 1];
		int length = 1;
		if (n >= LONG)
			continue;
		seen[0] = (uint32_t)v;
		for (size_t i = 0; i < n; i++) {
			int k = 0;
			seen[length] = neighbour(j, v, i);
			while (seen[k] != seen[length])
				k++;
			length += k == length;
		}
		j->l->start[v + 1] = length;
	}
}

/* Adds an entry to a row of *n, kept in ascending order. */
static void
add_entry(int *index, double *value, int *n, int column, double x)
{
	int k = *n;

	while (k > 0 && index[k - 1] > column)
		k--;
	if (k > 0 && index[k - 1] == column) {
		value[k - 1] += x;
		return;
	}
	memmove(index + k + 1, index + k, (size_t)(*n - k) * sizeof *index);
	memmove(value + k + 1, value + k, (size_t)(*n - k) * sizeof *value);
	index[k] = column;
	value[k] = x;
	++*n;
}

static void
rows_of(void *arg, size_t begin, size_t end)
{
	laplace_job *j = arg;

	for (size_t v = begin; v < end; v++) {
		int *index = j->l->index + j->l->start[v], n = 0, d = 0;
		double *value = j->l->value + j->l->start[v], sum = 0;

		add_entry(index, value, &n, (int)v, 0);
		for (size_t i = j->inc->start[v]; i < j->inc->start[v + 1]; i++) {
			const uint32_t *c = j->m->t[j->inc->face[i]].v;
			const double *cot = j->cot[j->inc->face[i]];
			int k = c[0] == v ? 0 : c[1] == v ? 1 : 2, a = (k + 1) % 3, b = (k + 2) % 3;
			if (c[a] != v && c[b] != v) { /* else the face has this vertex twice: no area */
				add_entry(index, value, &n, (int)c[a], -0.5 * cot[b]);
				add_entry(index, value, &n, (int)c[b], -0.5 * cot[a]);
			}
		}
		for (int k = 0; k < n; k++) {
			sum += value[k];
			d = index[k] == (int)v ? k : d;
		}
		value[d] = -sum;
	}
}

mr_status
mr_laplace_build(mr_ctx *ctx, const mr_mesh *m, mr_sparse *l)
{
	mr_mark mark;
	mr_sparse r = { .n = (int)m->nv, .start = MR_NEW(ctx, m->nv + 1, int) };
	laplace_job j = { .m = m, .l = &r };
	mr_incidence inc;

	if (m->nv > INT32_MAX - 1)
		return mr_fail(ctx, MR_ERANGE, "%s: %zu vertices are too many", m->name, m->nv);
	mark = mr_mark_take(ctx);
	mr_incidence_build(ctx, m, &inc);
	j.inc = &inc;
	count_long_rows(ctx, &j);
	mr_parallel(ctx, m->nv, GRAIN, count_rows, &j);
	mr_mark_release(ctx, mark);
	MR_TRY(mr_sparse_starts(ctx, r.start + 1, &r));
	r.index = MR_NEW(ctx, (size_t)r.start[m->nv], int);
	r.value = MR_NEW(ctx, (size_t)r.start[m->nv], double);
	mark = mr_mark_take(ctx);
	j.cot = mr_alloc(ctx, m->nf, sizeof *j.cot);
	mr_incidence_build(ctx, m, &inc);
	mr_parallel(ctx, m->nf, GRAIN, cotangents_of, &j);
	mr_parallel(ctx, m->nv, GRAIN, rows_of, &j);
	mr_mark_release(ctx, mark);
	*l = r;
	return MR_OK;
}
