/* Products of a sparse matrix and a few vectors.  Rows are summed in order: the same for any number of
 * threads. */
#include "solve/sparse.h"

#include "base/parallel.h"

enum { GRAIN = 32768 }; /* less takes no longer than to wake a thread */

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
