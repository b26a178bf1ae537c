#include "solve/multivector.h"

#include "base/parallel.h"

enum { GRAIN = 8192, PIECES = 128 };

typedef struct columns_job {
	mr_columns s;
	const double *f, *a, *b;
	double *y;
	double (*partial)[MR_WIDTH];
	size_t first; /* row of a batch of pieces */
} columns_job;

static inline void
dot_width(const columns_job *j, size_t width, size_t begin, size_t end, double *sum)
{
	for (size_t i = begin; i < end; i++)
		for (size_t c = 0; c < width; c++)
			sum[c] += j->a[i * width + c] * j->b[i * width + c];
}

static void
dot_piece(void *arg, size_t begin, size_t end)
{
	columns_job *j = arg;
	double sum[MR_WIDTH] = { 0 };

	if (j->s.width == 3)
		dot_width(j, 3, j->first + begin, j->first + end, sum);
	else
		dot_width(j, j->s.width, j->first + begin, j->first + end, sum);
	memcpy(j->partial[begin / GRAIN], sum, sizeof sum);
}

void
mr_columns_dot(const mr_ctx *ctx, mr_columns s, const double *a, const double *b, double *dot)
{
	double partial[PIECES][MR_WIDTH];
	columns_job j = { .s = s, .a = a, .b = b, .partial = partial };

	memset(dot, 0, s.width * sizeof *dot);
	for (j.first = 0; j.first < s.n; j.first += (size_t)PIECES * GRAIN) {
		size_t n = s.n - j.first < (size_t)PIECES * GRAIN ? s.n - j.first : (size_t)PIECES * GRAIN;
		mr_parallel(ctx, n, GRAIN, dot_piece, &j);
		for (size_t p = 0; p < (n + GRAIN - 1) / GRAIN; p++)
			for (size_t c = 0; c < s.width; c++)
				dot[c] += partial[p][c];
	}
}

static void
add_piece(void *arg, size_t begin, size_t end)
{
	columns_job *j = arg;
	size_t width = j->s.width;

	for (size_t i = begin; i < end; i++)
		for (size_t c = 0; c < width; c++)
			j->y[i * width + c] += j->f[c] * j->a[i * width + c];
}

void
mr_columns_add(const mr_ctx *ctx, mr_columns s, const double *f, const double *x, double *y)
{
	mr_parallel(ctx, s.n, GRAIN, add_piece, &(columns_job){ .s = s, .f = f, .a = x, .y = y });
}

static void
turn_piece(void *arg, size_t begin, size_t end)
{
	columns_job *j = arg;
	size_t width = j->s.width;

	for (size_t i = begin; i < end; i++)
		for (size_t c = 0; c < width; c++)
			j->y[i * width + c] = j->a[i * width + c] + j->f[c] * j->y[i * width + c];
}

void
mr_columns_turn(const mr_ctx *ctx, mr_columns s, const double *f, const double *x, double *y)
{
	mr_parallel(ctx, s.n, GRAIN, turn_piece, &(columns_job){ .s = s, .f = f, .a = x, .y = y });
}

static void
scale_piece(void *arg, size_t begin, size_t end)
{
	columns_job *j = arg;
	size_t width = j->s.width;

	for (size_t i = begin; i < end; i++)
		for (size_t c = 0; c < width; c++)
			j->y[i * width + c] = j->f[i] * j->a[i * width + c];
}

void
mr_columns_scale(const mr_ctx *ctx, mr_columns s, const double *f, const double *x, double *y)
{
	mr_parallel(ctx, s.n, GRAIN, scale_piece, &(columns_job){ .s = s, .f = f, .a = x, .y = y });
}

void
mr_columns_gather(mr_columns s, const double *b, double *rows)
{
	for (size_t c = 0; c < s.width; c++)
		for (size_t i = 0; i < s.n; i++)
			rows[i * s.width + c] = b[c * s.n + i];
}

void
mr_columns_scatter(mr_columns s, const double *rows, double *b)
{
	for (size_t c = 0; c < s.width; c++)
		for (size_t i = 0; i < s.n; i++)
			b[c * s.n + i] = rows[i * s.width + c];
}
