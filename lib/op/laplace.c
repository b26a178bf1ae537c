/*
 * Pinkall, Polthier 1993: Computing discrete minimal surfaces and their conjugates, for the weights;
 * Gustavson 1978: Two fast algorithms for sparse matrices, for the product.
 */
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

/* Row lengths to row starts. */
static mr_status
accumulate(mr_ctx *ctx, const int *length, mr_sparse *a)
{
	a->start[0] = 0;
	for (int i = 0; i < a->n; i++)
		if (__builtin_add_overflow(a->start[i], length[i], &a->start[i + 1]))
			return mr_fail(
			    ctx, MR_ERANGE, "the matrix of %d rows has 2^31 entries or more", a->n);
	return MR_OK;
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
	MR_TRY(accumulate(ctx, j.length, &r));
	mr_parallel(ctx, m->nv, GRAIN, close_gaps, &j);
	mr_mark_release(ctx, mark);
	*l = r;
	return MR_OK;
}

/* A sparse row being computed: the columns in `list` are in use, `value` is dense, mark[column] is `stamp` if
 * in use. */
typedef struct sparse_row {
	int *list, *mark;
	double *value;
	int n, stamp;
} sparse_row;

typedef struct power_job {
	const mr_sparse *l;
	const double *w;
	size_t k, blocks;
	bool lower;
	sparse_row (*row)[2]; /* per block */
	int *length;
	mr_sparse *out;
} power_job;

/* next = row W L, or row L without w; only columns below `limit`. */
static void
times_laplace(const mr_sparse *l, const double *w, const sparse_row *row, int limit, sparse_row *next)
{
	next->n = 0;
	next->stamp++;
	for (int a = 0; a < row->n; a++) {
		int m = row->list[a];
		double x = w ? row->value[m] * w[m] : row->value[m];
		for (int e = l->start[m]; e < l->start[m + 1] && l->index[e] < limit; e++) {
			int c = l->index[e];
			if (next->mark[c] != next->stamp) {
				next->mark[c] = next->stamp;
				next->value[c] = 0;
				next->list[next->n++] = c;
			}
			next->value[c] += x * l->value[e];
		}
	}
}

/* Row i of the product: the unit vector times L, then k - 1 times W L. */
static const sparse_row *
power_row(const power_job *j, sparse_row row[2], int i)
{
	int last = j->lower ? i + 1 : j->out->n;

	row[0].n = 1;
	row[0].list[0] = i;
	row[0].value[i] = 1;
	for (size_t step = 0; step < j->k; step++)
		times_laplace(j->l, step > 0 ? j->w : NULL, &row[step % 2], step + 1 < j->k ? j->l->n : last,
		    &row[1 - step % 2]);
	return &row[j->k % 2];
}

/* The rows of a block: one range of rows per thread, which has the dense workspace. */
static int
block_begin(const power_job *j, size_t block)
{
	return (int)((size_t)j->out->n * block / j->blocks);
}

static void
count_rows(void *arg, size_t begin, size_t end)
{
	power_job *j = arg;

	for (size_t b = begin; b < end; b++)
		for (int i = block_begin(j, b); i < block_begin(j, b + 1); i++)
			j->length[i] = power_row(j, j->row[b], i)->n;
}

static void
fill_rows(void *arg, size_t begin, size_t end)
{
	power_job *j = arg;

	for (size_t b = begin; b < end; b++)
		for (int i = block_begin(j, b); i < block_begin(j, b + 1); i++) {
			const sparse_row *row = power_row(j, j->row[b], i);
			int *index = j->out->index + j->out->start[i];
			double *value = j->out->value + j->out->start[i];
			memcpy(index, row->list, (size_t)row->n * sizeof *index);
			mr_sparse_sort(index, row->n);
			for (int k = 0; k < row->n; k++)
				value[k] = row->value[index[k]];
		}
}

static mr_status
power_workspace(mr_ctx *ctx, power_job *j)
{
	size_t n = (size_t)j->l->n;

	j->blocks = ctx->threads;
	j->row = mr_alloc(ctx, j->blocks, sizeof *j->row);
	if (!j->row)
		return MR_EMEM;
	for (size_t b = 0; b < j->blocks; b++)
		for (int i = 0; i < 2; i++) {
			sparse_row r = { .list = MR_NEW(ctx, n, int),
				.mark = MR_NEW_ZERO(ctx, n, int),
				.value = MR_NEW(ctx, n, double) };
			if (!r.list || !r.mark || !r.value)
				return MR_EMEM;
			j->row[b][i] = r;
		}
	return MR_OK;
}

mr_status
mr_laplace_power(
    mr_ctx *ctx, const mr_sparse *l, const double *w, size_t k, size_t n, bool lower, mr_sparse *out)
{
	mr_sparse r = { .n = (int)n, .start = MR_NEW(ctx, n + 1, int) };
	power_job j = { .l = l, .w = w, .k = k, .lower = lower, .out = &r };
	mr_mark mark;

	j.length = MR_NEW(ctx, n, int);
	if (!r.start || !j.length)
		return MR_EMEM;
	mark = mr_mark_take(ctx);
	MR_TRY(power_workspace(ctx, &j));
	mr_parallel(ctx, j.blocks, 1, count_rows, &j);
	mr_mark_release(ctx, mark);
	MR_TRY(accumulate(ctx, j.length, &r));
	r.index = MR_NEW(ctx, (size_t)r.start[n], int);
	r.value = MR_NEW(ctx, (size_t)r.start[n], double);
	mark = mr_mark_take(ctx);
	if (!r.index || !r.value)
		return MR_EMEM;
	MR_TRY(power_workspace(ctx, &j));
	mr_parallel(ctx, j.blocks, 1, fill_rows, &j);
	mr_mark_release(ctx, mark);
	*out = r;
	return MR_OK;
}

typedef struct apply_job {
	const mr_sparse *a;
	const double *w; /* y = W A x, or without it y = A x, */
	double add;      /* or where this is not 0, y = y + add A x */
	size_t width;
	const double *x;
	double *y;
} apply_job;

static inline void
apply_width(const apply_job *j, size_t width, size_t begin, size_t end)
{
	const mr_sparse *a = j->a;

	for (size_t i = begin; i < end; i++) {
		double sum[4] = { 0 }, *y = j->y + i * width;
		for (int e = a->start[i]; e < a->start[i + 1]; e++) {
			const double *x = j->x + (size_t)a->index[e] * width;
			for (size_t c = 0; c < width; c++)
				sum[c] += a->value[e] * x[c];
		}
		for (size_t c = 0; c < width; c++)
			y[c] = j->add != 0 ? y[c] + j->add * sum[c] : j->w ? j->w[i] * sum[c] : sum[c];
	}
}

/* Loops of a known length are faster. */
static void
apply_rows(void *arg, size_t begin, size_t end)
{
	apply_job *j = arg;

	if (j->width == 3)
		apply_width(j, 3, begin, end);
	else if (j->width == 4)
		apply_width(j, 4, begin, end);
	else
		apply_width(j, j->width, begin, end);
}

void
mr_sparse_apply(const mr_ctx *ctx, const mr_sparse *a, const double *w, size_t rows, size_t width,
    const double *x, double *y)
{
	mr_parallel(ctx, rows, GRAIN, apply_rows, &(apply_job){ a, w, 0, width, x, y });
}

void
mr_sparse_add(const mr_ctx *ctx, const mr_sparse *a, double f, size_t width, const double *x, double *y)
{
	mr_parallel(ctx, (size_t)a->n, GRAIN, apply_rows, &(apply_job){ a, NULL, f, width, x, y });
}

typedef struct apply_long_job {
	const mr_sparse *a;
	const double *w;
	size_t width;
	const long double *x;
	long double *y;
} apply_long_job;

static void
apply_rows_long(void *arg, size_t begin, size_t end)
{
	apply_long_job *j = arg;
	const mr_sparse *a = j->a;

	for (size_t i = begin; i < end; i++) {
		long double sum[4] = { 0 };
		for (int e = a->start[i]; e < a->start[i + 1]; e++)
			for (size_t c = 0; c < j->width; c++)
				sum[c] += a->value[e] * j->x[(size_t)a->index[e] * j->width + c];
		for (size_t c = 0; c < j->width; c++)
			j->y[i * j->width + c] = j->w ? j->w[i] * sum[c] : sum[c];
	}
}

void
mr_sparse_apply_long(const mr_ctx *ctx, const mr_sparse *a, const double *w, size_t rows, size_t width,
    const long double *x, long double *y)
{
	mr_parallel(ctx, rows, GRAIN, apply_rows_long, &(apply_long_job){ a, w, width, x, y });
}
