/* The powers L (W L)^(k-1) of a sparse matrix, row by row, as by Gustavson (sparse_product.c): no power in between is
 * stored. */
#include "solve/sparse.h"

#include "base/parallel.h"

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
times_matrix(const mr_sparse *l, const double *w, const sparse_row *row, int limit, sparse_row *next)
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
		times_matrix(j->l, step > 0 ? j->w : NULL, &row[step % 2], step + 1 < j->k ? j->l->n : last,
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
mr_sparse_power(
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
	MR_TRY(mr_sparse_starts(ctx, j.length, &r));
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
