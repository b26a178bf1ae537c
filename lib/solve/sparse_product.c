/* Products and transposes (Gustavson 1978: Two fast algorithms for sparse matrices: multiplication and
 * permuted transposition), and parts of matrices. */
#include "solve/sparse.h"

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

mr_status
mr_sparse_restrict(mr_ctx *ctx, const mr_sparse *a, const uint32_t *row, size_t n, bool lower, mr_sparse *out)
{
	mr_sparse r = { .n = (int)n, .start = MR_NEW(ctx, n + 1, int) };
	size_t most = 0;
	uint32_t *number;
	mr_mark mark;
	int at = 0;

	for (size_t i = 0; i < n; i++)
		most += (size_t)(a->start[row[i] + 1] - a->start[row[i]]);
	r.index = MR_NEW(ctx, most, int);
	r.value = MR_NEW(ctx, most, double);
	mark = mr_mark_take(ctx);
	number = MR_NEW(ctx, (size_t)a->n, uint32_t);
	if (!r.start || !r.index || !r.value || !number)
		return MR_EMEM;
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
	mr_mark_release(ctx, mark);
	*out = r;
	return MR_OK;
}

mr_status
mr_sparse_transpose(mr_ctx *ctx, const mr_sparse *a, size_t columns, mr_sparse *t)
{
	size_t nnz = (size_t)a->start[a->n];
	mr_sparse r = { (int)columns, MR_NEW_ZERO(ctx, columns + 1, int), MR_NEW(ctx, nnz, int),
		MR_NEW(ctx, nnz, double) };
	mr_mark mark = mr_mark_take(ctx);
	int *next = MR_NEW(ctx, columns, int);

	if (!r.start || !r.index || !r.value || !next)
		return MR_EMEM;
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
	mr_mark_release(ctx, mark);
	*t = r;
	return MR_OK;
}

/* A row being computed: the columns in `list` are in use, `value` is dense, mark[column] is the row's number.
 */
typedef struct product_row {
	int *list, *mark;
	double *value;
	int n;
} product_row;

/* row = a_i b */
static void
multiply_row(const mr_sparse *a, const mr_sparse *b, int i, product_row *row)
{
	row->n = 0;
	for (int e = a->start[i]; e < a->start[i + 1]; e++) {
		int m = a->index[e];
		for (int g = b->start[m]; g < b->start[m + 1]; g++) {
			int c = b->index[g];
			if (row->mark[c] != i) {
				row->mark[c] = i;
				row->value[c] = 0;
				row->list[row->n++] = c;
			}
			row->value[c] += a->value[e] * b->value[g];
		}
	}
}

static int
count_row(const mr_sparse *a, const mr_sparse *b, int i, product_row *row)
{
	row->n = 0;
	for (int e = a->start[i]; e < a->start[i + 1]; e++)
		for (int m = a->index[e], g = b->start[m]; g < b->start[m + 1]; g++)
			if (row->mark[b->index[g]] != i) {
				row->mark[b->index[g]] = i;
				row->n++;
			}
	return row->n;
}

static void
fill_rows(const mr_sparse *a, const mr_sparse *b, product_row *row, mr_sparse *r)
{
	for (int i = 0; i < a->n; i++) {
		int at = r->start[i];
		multiply_row(a, b, i, row);
		mr_sparse_sort(row->list, row->n);
		for (int k = 0; k < row->n; k++) {
			r->index[at + k] = row->list[k];
			r->value[at + k] = row->value[row->list[k]];
		}
	}
}

static void
unmark(product_row *row, size_t columns)
{
	for (size_t c = 0; c < columns; c++)
		row->mark[c] = -1;
}

mr_status
mr_sparse_multiply(mr_ctx *ctx, const mr_sparse *a, const mr_sparse *b, size_t columns, mr_sparse *c)
{
	product_row row = { MR_NEW(ctx, columns, int), MR_NEW(ctx, columns, int),
		MR_NEW(ctx, columns, double), 0 };
	mr_sparse r = { a->n, MR_NEW_ZERO(ctx, (size_t)a->n + 1, int), NULL, NULL };

	if (!row.list || !row.mark || !row.value || !r.start)
		return MR_EMEM;
	unmark(&row, columns);
	for (int i = 0; i < a->n; i++)
		r.start[i + 1] = count_row(a, b, i, &row);
	MR_TRY(mr_sparse_starts(ctx, r.start + 1, &r));
	r.index = MR_NEW(ctx, (size_t)r.start[r.n], int);
	r.value = MR_NEW(ctx, (size_t)r.start[r.n], double);
	if (!r.index || !r.value)
		return MR_EMEM;
	unmark(&row, columns);
	fill_rows(a, b, &row, &r);
	*c = r;
	return MR_OK;
}
