/* Products and transposes (Gustavson 1978: Two fast algorithms for sparse matrices: multiplication and
 * permuted transposition), and parts of matrices. */
#include "solve/sparse.h"

#include "base/parallel.h"

/* Row lengths to row starts. */
mr_status
mr_sparse_starts(mr_ctx *ctx, const int *length, mr_sparse *a)
{
	a->start[0] = 0;
	for (int i = 0; i < a->n; i++)
		if (__builtin_add_overflow(a->start[i], length[i], &a->start[i + 1]))
			return mr_fail(
			    ctx, MR_ERANGE, "the matrix of %d rows has 2^31 entries or more", a->n);
	return MR_OK;
}

void
mr_sparse_restrict(mr_ctx *ctx, const mr_sparse *a, const uint32_t *row, size_t n, bool lower, mr_sparse *out)
{
	mr_sparse r = { .n = (int)n, .start = MR_NEW(ctx, n + 1, int) };
	size_t most = 0;
	uint32_t *number;
	int at = 0;

	for (size_t i = 0; i < n; i++)
		most += (size_t)(a->start[row[i] + 1] - a->start[row[i]]);
	r.index = MR_NEW(ctx, most, int);
	r.value = MR_NEW(ctx, most, double);
	MR_SCOPE(ctx);
	number = MR_NEW(ctx, (size_t)a->n, uint32_t);
	memset(number, 0xff, (size_t)a->n * sizeof *number);
	for (uint32_t i = 0; i < n; i++)
		number[row[i]] = i;
	for (uint32_t i = 0; i < n; i++) {
		r.start[i] = at;
		for (int e = a->start[row[i]]; e < a->start[row[i] + 1]; e++)
			if (number[a->index[e]] < (lower ? i + 1 : n)) {
				r.index[at] = (int)number[a->index[e]];
				r.value[at++] = a->value[e];
			}
	}
	r.start[n] = at;
	*out = r;
}

mr_status
mr_sparse_transpose(mr_ctx *ctx, const mr_sparse *a, size_t columns, mr_sparse *t)
{
	size_t nnz = (size_t)a->start[a->n];
	mr_sparse r = { (int)columns, MR_NEW_ZERO(ctx, columns + 1, int), MR_NEW(ctx, nnz, int),
		MR_NEW(ctx, nnz, double) };
	MR_SCOPE(ctx);
	int *next = MR_NEW(ctx, columns, int);

	for (size_t e = 0; e < nnz; e++)
		r.start[a->index[e] + 1]++;
	MR_TRY(mr_sparse_starts(ctx, r.start + 1, &r));
	memcpy(next, r.start, columns * sizeof *next);
	for (int i = 0; i < a->n; i++)
		for (int e = a->start[i]; e < a->start[i + 1]; e++) {
			int to = next[a->index[e]]++;
			r.index[to] = i;
			r.value[to] = a->value[e];
		}
	*t = r;
	return MR_OK;
}

/* A row being computed: the columns in `list` are in use, `value` is dense, mark[column] is `stamp` if in
 * use. */
typedef struct product_row {
	int *list, *mark;
	double *value;
	int n, stamp;
} product_row;

/* c = a W b; each thread has a block of rows and a row of workspace. */
typedef struct product_job {
	const mr_sparse *a, *b;
	const double *w; /* NULL: ones */
	int columns;     /* of c; further columns of b are left out */
	bool lower;      /* so are those above the diagonal */
	size_t blocks;
	product_row *row;
	int *length;
	mr_sparse c;
} product_job;

static void
multiply_row(const product_job *j, int i, product_row *row)
{
	const mr_sparse *a = j->a, *b = j->b;
	const int limit = j->lower ? i + 1 : j->columns;

	row->n = 0;
	row->stamp++;
	for (int e = a->start[i]; e < a->start[i + 1]; e++) {
		int m = a->index[e];
		double x = j->w ? a->value[e] * j->w[m] : a->value[e];
		for (int g = b->start[m]; g < b->start[m + 1] && b->index[g] < limit; g++) {
			int c = b->index[g];
			if (row->mark[c] != row->stamp) {
				row->mark[c] = row->stamp;
				row->value[c] = 0;
				row->list[row->n++] = c;
			}
			row->value[c] += x * b->value[g];
		}
	}
}

static int
block_begin(const product_job *j, size_t block)
{
	return (int)((size_t)j->c.n * block / j->blocks);
}

static void
count_rows(void *arg, size_t begin, size_t end)
{
	product_job *j = arg;

	for (size_t b = begin; b < end; b++)
		for (int i = block_begin(j, b); i < block_begin(j, b + 1); i++) {
			multiply_row(j, i, &j->row[b]);
			j->length[i] = j->row[b].n;
		}
}

static void
fill_rows(void *arg, size_t begin, size_t end)
{
	product_job *j = arg;

	for (size_t b = begin; b < end; b++)
		for (int i = block_begin(j, b); i < block_begin(j, b + 1); i++) {
			const product_row *row = &j->row[b];
			int at = j->c.start[i];
			multiply_row(j, i, &j->row[b]);
			mr_sparse_sort(row->list, row->n);
			for (int k = 0; k < row->n; k++, at++) {
				j->c.index[at] = row->list[k];
				j->c.value[at] = row->value[row->list[k]];
			}
		}
}

static void
make_rows(mr_ctx *ctx, product_job *j)
{
	size_t n = (size_t)j->columns;

	for (size_t b = 0; b < j->blocks; b++) {
		product_row r = { MR_NEW(ctx, n, int), MR_NEW_ZERO(ctx, n, int), MR_NEW(ctx, n, double), 0,
			0 };
		j->row[b] = r;
	}
}

/* Fills c, which has its number of rows. */
static mr_status
multiply(mr_ctx *ctx, product_job *j)
{
	size_t n = (size_t)j->c.n;
	mr_mark mark;

	j->blocks = ctx->threads;
	j->row = MR_NEW(ctx, j->blocks, product_row);
	j->length = MR_NEW(ctx, n, int);
	j->c.start = MR_NEW(ctx, n + 1, int);
	mark = mr_mark_take(ctx);
	make_rows(ctx, j);
	mr_parallel(ctx, j->blocks, 1, count_rows, j);
	mr_mark_release(ctx, mark);
	MR_TRY(mr_sparse_starts(ctx, j->length, &j->c));
	j->c.index = MR_NEW(ctx, (size_t)j->c.start[n], int);
	j->c.value = MR_NEW(ctx, (size_t)j->c.start[n], double);
	mark = mr_mark_take(ctx);
	make_rows(ctx, j);
	mr_parallel(ctx, j->blocks, 1, fill_rows, j);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_sparse_multiply(mr_ctx *ctx, const mr_sparse *a, const mr_sparse *b, size_t columns, mr_sparse *c)
{
	product_job j = { .a = a, .b = b, .columns = (int)columns, .c.n = a->n };

	MR_TRY(multiply(ctx, &j));
	*c = j.c;
	return MR_OK;
}

/* The first n rows and columns. */
static void
crop(mr_ctx *ctx, const mr_sparse *l, size_t n, bool lower, mr_sparse *out)
{
	uint32_t *row = MR_NEW(ctx, n, uint32_t);

	for (size_t i = 0; i < n; i++)
		row[i] = (uint32_t)i;
	mr_sparse_restrict(ctx, l, row, n, lower, out);
}

mr_status
mr_sparse_power(
    mr_ctx *ctx, const mr_sparse *l, const double *w, size_t k, size_t n, bool lower, mr_sparse *out)
{
	mr_sparse rows = { (int)n, l->start, l->index, l->value };

	if (k == 1) {
		crop(ctx, l, n, lower, out);
		return MR_OK;
	}
	for (size_t step = 2; step <= k; step++) {
		product_job j = {
			.a = &rows, .b = l, .w = w, .columns = step < k ? l->n : (int)n, .c.n = (int)n
		};
		j.lower = lower && step == k;
		MR_TRY(multiply(ctx, &j));
		rows = j.c;
	}
	*out = rows;
	return MR_OK;
}
