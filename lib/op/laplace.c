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
	mr_incidence inc;
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

/* Columns of a row: the neighbours, and the vertex itself among them, sorted. */
static void
fill_columns(const mr_adjacency *around, size_t v, int *index)
{
	size_t i = around->start[v], end = around->start[v + 1];

	for (; i < end && around->adj[i] < v; i++)
		*index++ = (int)around->adj[i];
	*index++ = (int)v;
	for (; i < end; i++)
		*index++ = (int)around->adj[i];
}

/* The value of a column that the row has. */
static double *
value_of(const mr_sparse *l, size_t row, uint32_t column)
{
	int low = l->start[row], high = l->start[row + 1];

	while (high - low > 1) {
		int middle = low + (high - low) / 2;
		if (l->index[middle] > (int)column)
			high = middle;
		else
			low = middle;
	}
	return l->value + low;
}

static void
rows_of(void *arg, size_t begin, size_t end)
{
	laplace_job *j = arg;
	const mr_sparse *l = j->l;

	for (size_t v = begin; v < end; v++) {
		double sum = 0;
		for (int k = l->start[v]; k < l->start[v + 1]; k++)
			l->value[k] = 0;
		for (size_t i = j->inc.start[v]; i < j->inc.start[v + 1]; i++) {
			const uint32_t *c = j->m->t[j->inc.face[i]].v;
			const double *cot = j->cot[j->inc.face[i]];
			int k = c[0] == v ? 0 : c[1] == v ? 1 : 2, a = (k + 1) % 3, b = (k + 2) % 3;
			if (c[a] == v || c[b] == v) /* the face has this vertex twice: no area */
				continue;
			*value_of(l, v, c[a]) += -0.5 * cot[b];
			*value_of(l, v, c[b]) += -0.5 * cot[a];
		}
		for (int k = l->start[v]; k < l->start[v + 1]; k++)
			sum += l->value[k];
		*value_of(l, v, (uint32_t)v) = -sum;
	}
}

mr_status
mr_laplace_build(mr_ctx *ctx, const mr_mesh *m, mr_sparse *l)
{
	mr_sparse r = { .n = (int)m->nv, .start = MR_NEW(ctx, m->nv + 1, int) };
	laplace_job j = { .m = m, .l = &r };
	mr_adjacency around;
	mr_mark mark;

	if (m->nv > INT32_MAX - 1)
		return mr_fail(ctx, MR_ERANGE, "%s: %zu vertices are too many", m->name, m->nv);
	r.index = MR_NEW(ctx, 6 * m->nf + m->nv, int); /* an upper bound: about twice the real size */
	mark = mr_mark_take(ctx);
	mr_adjacency_build(ctx, m, &around);
	for (size_t v = 0; v < m->nv; v++)
		r.start[v + 1] = (int)(around.start[v + 1] - around.start[v]) + 1;
	MR_TRY(mr_sparse_starts(ctx, r.start + 1, &r));
	for (size_t v = 0; v < m->nv; v++)
		fill_columns(&around, v, r.index + r.start[v]);
	mr_mark_release(ctx, mark);
	r.value = MR_NEW(ctx, (size_t)r.start[m->nv], double);
	mark = mr_mark_take(ctx);
	mr_incidence_build(ctx, m, &j.inc);
	j.cot = mr_alloc(ctx, m->nf, sizeof *j.cot);
	mr_parallel(ctx, m->nf, GRAIN, cotangents_of, &j);
	mr_parallel(ctx, m->nv, GRAIN, rows_of, &j);
	mr_mark_release(ctx, mark);
	*l = r;
	return MR_OK;
}
