/* Sums and products of blocks of vectors, in pieces of rows. */
#include "solve/multivector.h"

#include "base/parallel.h"

/* A thread takes TOGETHER pieces: it costs as much as some of them. */
enum { GRAIN = 8192, PIECES = 128, TOGETHER = 8 };

typedef struct multivector_job {
	mr_multivector s;
	const double *f, *g, *a, *b;
	double *y, *z;
	double (*partial)[MR_WIDTH]; /* sums of each piece of a batch */
	size_t first;                /* row of the batch */
} multivector_job;

const double MR_ONE[MR_WIDTH] = { 1, 1, 1, 1 };

typedef void rows_body(const multivector_job *j, size_t width, size_t begin, size_t end);

/* Loops of a known width are faster, and 1 and 3 are what there is. */
static inline void
by_width(rows_body *body, const multivector_job *j, size_t begin, size_t end)
{
	for (size_t to; begin < end; begin = to) {
		to = end - begin < GRAIN ? end : begin + GRAIN;
		if (j->s.width == 1)
			body(j, 1, begin, to);
		else if (j->s.width == 3)
			body(j, 3, begin, to);
		else
			body(j, j->s.width, begin, to);
	}
}

/* sum[c] = the sum over all rows, of which `body` leaves the partial sums. */
static void
sum_pieces(const mr_ctx *ctx, multivector_job j, mr_body body, double *sum)
{
	double partial[PIECES][MR_WIDTH];
	size_t n = j.s.n, batch = (size_t)PIECES * GRAIN;

	j.partial = partial;
	memset(sum, 0, j.s.width * sizeof *sum);
	for (j.first = 0; j.first < n; j.first += batch) {
		size_t rows = n - j.first < batch ? n - j.first : batch;
		mr_parallel(ctx, rows, TOGETHER * GRAIN, body, &j);
		for (size_t p = 0; p < (rows + GRAIN - 1) / GRAIN; p++)
			for (size_t c = 0; c < j.s.width; c++)
				sum[c] += partial[p][c];
	}
}

static inline void
dot_rows(const multivector_job *j, size_t width, size_t begin, size_t end)
{
	double sum[MR_WIDTH] = { 0 };

	for (size_t i = j->first + begin; i < j->first + end; i++)
		for (size_t c = 0; c < width; c++)
			sum[c] += j->a[i * width + c] * j->b[i * width + c];
	memcpy(j->partial[begin / GRAIN], sum, sizeof sum);
}

static void
dot_piece(void *arg, size_t begin, size_t end)
{
	by_width(dot_rows, arg, begin, end);
}

void
mr_multivector_dot(const mr_ctx *ctx, mr_multivector s, const double *a, const double *b, double *dot)
{
	sum_pieces(ctx, (multivector_job){ .s = s, .a = a, .b = b }, dot_piece, dot);
}

static inline void
step_rows(const multivector_job *j, size_t width, size_t begin, size_t end)
{
	double sum[MR_WIDTH] = { 0 };

	for (size_t i = j->first + begin; i < j->first + end; i++)
		for (size_t c = 0; c < width; c++) {
			size_t k = i * width + c;
			double r = j->z[k] - j->f[c] * j->b[k];
			j->y[k] += j->f[c] * j->a[k];
			j->z[k] = r;
			sum[c] += r * r;
		}
	memcpy(j->partial[begin / GRAIN], sum, sizeof sum);
}

static void
step_piece(void *arg, size_t begin, size_t end)
{
	by_width(step_rows, arg, begin, end);
}

void
mr_multivector_step(const mr_ctx *ctx, mr_multivector s, const double *f, const double *p, const double *q,
    double *x, double *r, double *rr)
{
	sum_pieces(ctx, (multivector_job){ .s = s, .f = f, .a = p, .b = q, .y = x, .z = r }, step_piece, rr);
}

static inline void
add_rows(const multivector_job *j, size_t width, size_t begin, size_t end)
{
	for (size_t i = begin; i < end; i++)
		for (size_t c = 0; c < width; c++)
			j->y[i * width + c] = j->f[c] * j->a[i * width + c] + j->g[c] * j->y[i * width + c];
}

static void
add_piece(void *arg, size_t begin, size_t end)
{
	by_width(add_rows, arg, begin, end);
}

void
mr_multivector_add(
    const mr_ctx *ctx, mr_multivector s, const double *f, const double *x, const double *g, double *y)
{
	mr_parallel(ctx, s.n, TOGETHER * GRAIN, add_piece,
	    &(multivector_job){ .s = s, .f = f, .g = g, .a = x, .y = y });
}

static inline void
scale_rows(const multivector_job *j, size_t width, size_t begin, size_t end)
{
	for (size_t i = begin; i < end; i++)
		for (size_t c = 0; c < width; c++)
			j->y[i * width + c] = j->f[i] * j->a[i * width + c];
}

static void
scale_piece(void *arg, size_t begin, size_t end)
{
	by_width(scale_rows, arg, begin, end);
}

void
mr_multivector_scale(const mr_ctx *ctx, mr_multivector s, const double *f, const double *x, double *y)
{
	mr_parallel(
	    ctx, s.n, TOGETHER * GRAIN, scale_piece, &(multivector_job){ .s = s, .f = f, .a = x, .y = y });
}

void
mr_multivector_gather(mr_multivector s, const double *b, double *rows)
{
	for (size_t c = 0; c < s.width; c++)
		for (size_t i = 0; i < s.n; i++)
			rows[i * s.width + c] = b[c * s.n + i];
}

void
mr_multivector_scatter(mr_multivector s, const double *rows, double *b)
{
	for (size_t c = 0; c < s.width; c++)
		for (size_t i = 0; i < s.n; i++)
			b[c * s.n + i] = rows[i * s.width + c];
}

void
mr_rough_start(size_t n, double *x)
{
	for (size_t i = 0; i < n; i++)
		x[i] = (i * 2654435761u >> 16 & 1 ? 1 : -1) * (1 + (double)(i % 7) / 7);
}
