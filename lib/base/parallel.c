/* Pieces of fixed size, which threads take as they come: who takes which changes no result. */
#include "base/parallel.h"

#include <pthread.h>
#include <stdatomic.h>

typedef struct job {
	size_t count, grain;
	atomic_size_t next; /* the first index that no thread has taken */
	mr_body body;
	void *arg;
} job;

static void *
work(void *p)
{
	job *j = p;
	size_t begin;

	while ((begin = atomic_fetch_add(&j->next, j->grain)) < j->count)
		j->body(j->arg, begin, j->count - begin < j->grain ? j->count : begin + j->grain);
	return NULL;
}

void
mr_parallel(const mr_ctx *ctx, size_t count, size_t grain, mr_body body, void *arg)
{
	enum { MOST = 256 };
	job j = { .count = count, .grain = grain, .body = body, .arg = arg };
	size_t pieces = (count + grain - 1) / grain, helpers = ctx->threads - 1;
	pthread_t thread[MOST];
	size_t started = 0;

	if (pieces == 0)
		return;
	if (helpers > pieces - 1)
		helpers = pieces - 1;
	if (helpers > MOST)
		helpers = MOST;
	while (started < helpers && !pthread_create(&thread[started], NULL, work, &j))
		started++; /* a thread that cannot be had is not missed: the others take its pieces */
	work(&j);
	while (started)
		pthread_join(thread[--started], NULL);
}

enum { SUM_GRAIN = 4096 };

typedef struct sum {
	double (*term)(void *arg, size_t i);
	void *arg;
	double *partial; /* one per piece of this batch */
	size_t first;    /* index of the batch's first term */
} sum;

static void
sum_pieces(void *p, size_t begin, size_t end)
{
	sum *s = p;
	double total = 0;

	for (size_t i = begin; i < end; i++)
		total += s->term(s->arg, s->first + i);
	s->partial[begin / SUM_GRAIN] = total;
}

double
mr_parallel_sum(const mr_ctx *ctx, size_t count, double (*term)(void *arg, size_t i), void *arg)
{
	enum { PIECES = 256, BATCH = PIECES * SUM_GRAIN };
	double partial[PIECES], total = 0;

	for (size_t first = 0; first < count; first += BATCH) {
		size_t n = count - first < BATCH ? count - first : BATCH;
		sum s = { term, arg, partial, first };
		mr_parallel(ctx, n, SUM_GRAIN, sum_pieces, &s);
		for (size_t i = 0; i < (n + SUM_GRAIN - 1) / SUM_GRAIN; i++)
			total += partial[i];
	}
	return total;
}
