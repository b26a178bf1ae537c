/* Pieces of fixed size, which threads take as they come: who takes which changes no result.  Helpers are
 * started once, and sleep between loops. */
#include "base/parallel.h"

#include <pthread.h>
#include <stdatomic.h>

typedef struct job job;
struct job {
	size_t count, grain;
	atomic_size_t next; /* the first index that no thread has taken */
	mr_body body;
	void *arg;
	size_t wanted, busy; /* helpers to come; at work */
	job *below;          /* that wants helpers, too */
};

/* All loops of the process share these. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t wanted = PTHREAD_COND_INITIALIZER, done = PTHREAD_COND_INITIALIZER;
static job *jobs;      /* that want helpers */
static size_t idle;    /* helpers that no job wants */
static bool has_hooks; /* pthread_atfork knows the three below */

static void
work(job *j)
{
	size_t begin;

	while ((begin = atomic_fetch_add(&j->next, j->grain)) < j->count)
		j->body(j->arg, begin, j->count - begin < j->grain ? j->count : begin + j->grain);
}

/* Takes the job off the list: no more helpers come to it. */
static void
leave(job *j)
{
	job **p = &jobs;

	while (*p && *p != j)
		p = &(*p)->below;
	if (*p)
		*p = j->below;
	idle += j->wanted;
	j->wanted = 0;
}

static void *
help(void *nothing)
{
	pthread_mutex_lock(&lock);
	for (;;) {
		job *j = jobs;
		if (!j) {
			pthread_cond_wait(&wanted, &lock);
			continue;
		}
		j->busy++;
		if (--j->wanted == 0)
			leave(j);
		pthread_mutex_unlock(&lock);
		work(j);
		pthread_mutex_lock(&lock);
		idle++;
		if (--j->busy == 0)
			pthread_cond_broadcast(&done);
	}
	return nothing;
}

static void
before_fork(void)
{
	pthread_mutex_lock(&lock);
}

static void
after_fork(void)
{
	pthread_mutex_unlock(&lock);
}

/* A new process has none of the helpers. */
static void
in_new_process(void)
{
	pthread_mutex_init(&lock, NULL);
	pthread_cond_init(&wanted, NULL);
	pthread_cond_init(&done, NULL);
	jobs = NULL;
	idle = 0;
}

/* Starts a helper.  If there is none, the others take its pieces. */
static bool
start_helper(void)
{
	pthread_t thread;

	if (!has_hooks)
		has_hooks = pthread_atfork(before_fork, after_fork, in_new_process) == 0;
	if (!has_hooks || pthread_create(&thread, NULL, help, NULL))
		return false;
	pthread_detach(thread);
	idle++;
	return true;
}

/* Calls as many helpers as the job wants. */
static void
call_helpers(job *j)
{
	pthread_mutex_lock(&lock);
	while (idle < j->wanted && start_helper())
		;
	if (j->wanted > idle)
		j->wanted = idle;
	idle -= j->wanted;
	if (j->wanted) {
		j->below = jobs;
		jobs = j;
	}
	for (size_t i = 0; i < j->wanted; i++)
		pthread_cond_signal(&wanted);
	pthread_mutex_unlock(&lock);
}

static void
wait_for_helpers(job *j)
{
	pthread_mutex_lock(&lock);
	leave(j);
	while (j->busy)
		pthread_cond_wait(&done, &lock);
	pthread_mutex_unlock(&lock);
}

void
mr_parallel(const mr_ctx *ctx, size_t count, size_t grain, mr_body body, void *arg)
{
	job j = { .count = count, .grain = grain, .body = body, .arg = arg };
	size_t pieces = (count + grain - 1) / grain, helpers = ctx->threads - 1;

	if (pieces == 0)
		return;
	j.wanted = helpers < pieces - 1 ? helpers : pieces - 1;
	if (j.wanted) {
		call_helpers(&j);
		work(&j);
		wait_for_helpers(&j);
	} else
		work(&j);
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
