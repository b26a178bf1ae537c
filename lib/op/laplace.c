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
	int *index;       /* rows with gaps: row v begins at room_of(v) */
	double *value;
	int *length;
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

/* A row has at most its diagonal and two neighbours per face. */
static size_t
room_of(const laplace_job *j, size_t v)
{
	return 2 * j->inc->start[v] + v;
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
		int *index = j->index + room_of(j, v), n = 0, d = 0;
		double *value = j->value + room_of(j, v), sum = 0;

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
		j->length[v] = n;
	}
}

static void
close_gaps(void *arg, size_t begin, size_t end)
{
	laplace_job *j = arg;

	for (size_t v = begin; v < end; v++) {
		size_t n = (size_t)j->length[v], from = room_of(j, v), to = (size_t)j->l->start[v];
		memcpy(j->l->index + to, j->index + from, n * sizeof *j->index);
		memcpy(j->l->value + to, j->value + from, n * sizeof *j->value);
	}
}

mr_status
mr_laplace_build(mr_ctx *ctx, const mr_mesh *m, mr_sparse *l)
{
	size_t room = m->nv + 6 * m->nf;
	mr_sparse r = { (int)m->nv, MR_NEW(ctx, m->nv + 1, int), NULL, NULL };
	laplace_job j = { .m = m, .l = &r };
	mr_incidence inc;
	mr_mark mark;

	if (m->nv > INT32_MAX - 1)
		return mr_fail(ctx, MR_ERANGE, "%s: %zu vertices are too many", m->name, m->nv);
	r.index = MR_NEW(ctx, room, int);
	r.value = MR_NEW(ctx, room, double);
	mark = mr_mark_take(ctx);
	j.cot = mr_alloc(ctx, m->nf, sizeof *j.cot);
	j.index = MR_NEW(ctx, room, int);
	j.value = MR_NEW(ctx, room, double);
	j.length = MR_NEW(ctx, m->nv, int);
	if (!r.start || !r.index || !r.value || !j.cot || !j.index || !j.value || !j.length)
		return MR_EMEM;
	MR_TRY(mr_incidence_build(ctx, m, &inc));
	j.inc = &inc;
	mr_parallel(ctx, m->nf, GRAIN, cotangents_of, &j);
	mr_parallel(ctx, m->nv, GRAIN, rows_of, &j);
	MR_TRY(mr_sparse_starts(ctx, j.length, &r));
	mr_parallel(ctx, m->nv, GRAIN, close_gaps, &j);
	mr_mark_release(ctx, mark);
	*l = r;
	return MR_OK;
}
