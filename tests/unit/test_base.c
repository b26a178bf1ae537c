/* The arena, errors, parallel loops and sums. */
#include "base/ctx.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/sort.h"

#include <math.h>
#include <setjmp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

/* Memory of another size keeps its bytes and its alignment, wherever the heap puts it. */
static void
memory_grows_and_shrinks(void **state)
{
	const mr_ctx ctx = { 0 };
	unsigned char *p = NULL;
	void *between[40];

	(void)state;
	for (size_t k = 0; k < 40; k++) {
		p = mr_memory(&ctx, p, 100 * (k + 1));
		between[k] = malloc(16); /* so that it moves */
		assert_int_equal((uintptr_t)p % 64, 0);
		for (size_t i = 0; i < 100 * k; i++)
			assert_int_equal(p[i], (unsigned char)(i * 7));
		for (size_t i = 100 * k; i < 100 * (k + 1); i++)
			p[i] = (unsigned char)(i * 7);
	}
	p = mr_memory(&ctx, p, 10);
	assert_int_equal(p[9], 63);
	mr_memory_free(p);
	for (size_t k = 0; k < 40; k++)
		free(between[k]);
	mr_memory_free(NULL);
	assert_null(mr_memory(&ctx, NULL, SIZE_MAX - 10));
}

/* What is large lies in a file: what was in memory goes there, and nothing is left of it in the folder. */
static void
large_memory_lies_in_a_file(void **state)
{
	enum { MB = 1 << 20 };
	char folder[] = "/tmp/mr-scratch-XXXXXX";
	mr_ctx ctx = { 0 };
	unsigned char *p;

	(void)state;
	assert_non_null(mkdtemp(folder));
	ctx.scratch = folder;
	p = mr_memory(&ctx, NULL, MB);
	memset(p, 7, MB);
	for (size_t size = 65; size < 200; size += 65) {
		p = mr_memory(&ctx, p, size * MB);
		assert_non_null(p);
		assert_int_equal((uintptr_t)p % 64, 0);
		assert_int_equal(p[0], 7);
		assert_int_equal(p[MB - 1], 7);
		assert_int_equal(p[size * MB - 1], 0); /* a file's bytes are 0 */
	}
	assert_int_equal(rmdir(folder), 0);
	mr_memory_free(p);
	assert_null(mr_memory(&ctx, NULL, 65 * MB));
	mr_no_memory(&ctx, "65 MB", 65 * MB);
	assert_non_null(strstr(ctx.error, "no room for 65 MB in /tmp/mr-scratch-"));
	ctx.scratch = NULL;
	mr_no_memory(&ctx, "65 MB", 65 * MB);
	assert_int_equal(ctx.remedy, MR_SCRATCH);
}

static void
memory_is_aligned_and_released_in_order(void **state)
{
	mr_ctx ctx;
	mr_mark mark;
	char *kept, *again;

	(void)state;
	mr_ctx_init(&ctx, 1);
	kept = MR_NEW(&ctx, 100, char);
	memset(kept, 7, 100);
	mark = mr_mark_take(&ctx);
	for (size_t n = 1; n < 5000000; n *= 3)
		assert_int_equal((uintptr_t)MR_NEW_ZERO(&ctx, n, char) % 64, 0);
	mr_mark_release(&ctx, mark);
	again = MR_NEW(&ctx, 1, char);
	assert_ptr_equal(again, kept + 128); /* what was released is used again */
	assert_int_equal(kept[99], 7);
	mr_ctx_free(&ctx);
}

/* Workspace taken again at the end of a block asks the system for memory once. */
static void
a_released_block_is_kept_for_the_next(void **state)
{
	mr_ctx ctx;
	mr_mark mark;
	char *p;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mark = mr_mark_take(&ctx);
	p = MR_NEW(&ctx, 100, char);
	mr_mark_release(&ctx, mark);
	assert_null(ctx.top);
	assert_non_null(ctx.spare);
	assert_ptr_equal(MR_NEW(&ctx, 100, char), p);
	assert_null(ctx.spare);
	mr_ctx_free(&ctx);
	assert_null(ctx.spare);
}

/* An array that grows past large sizes frees its old places; marks taken meanwhile stay good. */
static void
growing_keeps_contents_and_marks(void **state)
{
	mr_ctx ctx;
	uint32_t *a = NULL;
	mr_mark first, inner;

	(void)state;
	mr_ctx_init(&ctx, 1);
	first = mr_mark_take(&ctx);
	for (size_t n = 1, used = 0; n < 3000000; used = n, n *= 2) {
		a = mr_grow(&ctx, a, used, n, sizeof *a);
		assert_non_null(a);
		for (size_t i = used; i < n; i++)
			a[i] = (uint32_t)i;
		inner = mr_mark_take(&ctx);
		assert_non_null(MR_NEW(&ctx, 100000, char));
		mr_mark_release(&ctx, inner);
		for (size_t i = 0; i < n; i += 997)
			assert_int_equal(a[i], i);
	}
	inner = mr_mark_take(&ctx);
	a = mr_grow(&ctx, a, 1000, 4000000, sizeof *a); /* the block of the mark goes */
	assert_non_null(MR_NEW(&ctx, 100000, char));
	mr_mark_release(&ctx, inner);
	assert_non_null(MR_NEW(&ctx, 100000, char));
	mr_mark_release(&ctx, first);
	assert_null(ctx.top);
	mr_ctx_free(&ctx);
}

/* An array filled one by one is copied seldom, and keeps its contents. */
static void
reserving_doubles(void **state)
{
	mr_ctx ctx;
	uint32_t *a = NULL, *before;
	size_t n = 0, room = 0, moves = 0;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (; n < 100000; n++) {
		before = a;
		MR_RESERVE(&ctx, a, n, 1, &room);
		assert_true(room > n);
		moves += a != before;
		a[n] = (uint32_t)n;
	}
	assert_true(moves < 12);
	for (size_t i = 0; i < n; i++)
		assert_int_equal(a[i], i);
	mr_ctx_free(&ctx);
}

/* The n-th request, of a size that cannot be had. */
static mr_status
ask(mr_ctx *ctx, size_t n, size_t count, bool *behind)
{
	void *p;

	MR_ENTER(ctx);
	for (size_t i = 1; i < n; i++)
		p = mr_alloc(ctx, 1, 1);
	p = mr_grow(ctx, mr_alloc(ctx, 1, 8), 1, count, 8);
	*behind = p != NULL;
	return MR_OK;
}

static void
drop_one(void *count)
{
	++*(int *)count;
}

/* It owns one thing before and one within; only that goes with what fails. */
static mr_status
own_and_ask(mr_ctx *ctx, int *dropped, bool *behind)
{
	MR_ENTER(ctx);
	mr_own(ctx, drop_one, dropped);
	MR_TRY(ask(ctx, 3, SIZE_MAX / 4, behind));
	return MR_OK;
}

/* What cannot be had unwinds to the newest entry: MR_EMEM, a sentence, and the arena as it was. */
static void
impossible_sizes_unwind(void **state)
{
	bool behind = false;
	int before = 0, within = 0;
	mr_ctx ctx, keep = { 0 };
	mr_mark mark;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_own(&ctx, drop_one, &before);
	mark = mr_mark_take(&ctx);
	assert_int_equal(ask(&ctx, 1000, SIZE_MAX / 4, &behind), MR_EMEM);
	assert_false(behind);
	assert_non_null(strstr(ctx.error, "no memory"));
	assert_memory_equal(&mark, &(mr_mark[]){ mr_mark_take(&ctx) }[0], sizeof mark);
	ctx.fail_at = 3;
	assert_int_equal(ask(&ctx, 1000, 2, &behind), MR_EMEM);
	assert_int_equal(ask(&ctx, 1000, 2, &behind), MR_OK);
	assert_true(behind);
	assert_int_equal(own_and_ask(&ctx, &within, &behind), MR_EMEM);
	assert_int_equal(within, 0);
	mr_mark_release(&ctx, mark);
	assert_int_equal(within, 1);
	assert_int_equal(before, 0);
	mr_keep(&ctx, &keep);
	ctx.fail_at = 0;
	assert_int_equal(ask(&keep, 1, SIZE_MAX / 4, &behind), MR_EMEM);
	mr_ctx_free(&keep);
	mr_ctx_free(&ctx);
	assert_int_equal(before, 1);
}

static void
sentences_keep_their_status_and_take_prefixes(void **state)
{
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	assert_int_equal(mr_fail(&ctx, MR_ERANGE, "face %u has vertex %u of %u", 1, 2, 3), MR_ERANGE);
	assert_int_equal(mr_prefix(&ctx, MR_ERANGE, "frame %d", 4), MR_ERANGE);
	assert_string_equal(ctx.error, "frame 4: face 1 has vertex 2 of 3");
	assert_int_equal(mr_prefix(&ctx, MR_END, "frame %d", 5), MR_END);
	assert_string_equal(ctx.error, "frame 4: face 1 has vertex 2 of 3");
	mr_ctx_free(&ctx);
}

static void
increment(void *arg, size_t begin, size_t end)
{
	for (size_t i = begin; i < end; i++)
		((unsigned char *)arg)[i]++;
}

static double
term(void *arg, size_t i)
{
	(void)arg;
	return 1.0 / (double)(i * i + 1);
}

static void
loops_visit_each_index_once_and_sums_do_not_depend_on_threads(void **state)
{
	enum { N = 3000001 };
	mr_ctx ctx;
	unsigned char *seen;
	double one;

	(void)state;
	mr_ctx_init(&ctx, 1);
	one = mr_parallel_sum(&ctx, N, term, NULL);
	seen = MR_NEW_ZERO(&ctx, N, unsigned char);
	for (ctx.threads = 1; ctx.threads < 9; ctx.threads++) {
		mr_parallel(&ctx, N, 1000, increment, seen);
		assert_true(mr_parallel_sum(&ctx, N, term, NULL) == one);
	}
	for (size_t i = 0; i < N; i++)
		assert_int_equal(seen[i], 8);
	mr_parallel(&ctx, 0, 10, increment, NULL);
	mr_ctx_free(&ctx);
}

typedef struct nest {
	const mr_ctx *ctx;
	double sum[40];
} nest;

static void
sum_again(void *arg, size_t begin, size_t end)
{
	nest *n = arg;

	for (; begin < end; begin++)
		n->sum[begin] = mr_parallel_sum(n->ctx, 20000, term, NULL);
}

/* Also where helpers were at work before the process was copied, which has none of them; a thread sanitizer
 * ends such a copy as soon as it starts a thread. */
static void
loops_in_loops_and_in_a_copy_of_the_process(void **state)
{
	mr_ctx ctx;
	nest n;
	int status = 0;
	pid_t child = 0;

	(void)state;
	mr_ctx_init(&ctx, 4);
	n.ctx = &ctx;
	mr_parallel(&ctx, 40, 1, sum_again, &n);
#ifndef __SANITIZE_THREAD__
	child = fork();
	assert_true(child >= 0);
#endif
	for (int i = 0; i < 10; i++)
		mr_parallel(&ctx, 40, 1, sum_again, &n);
	for (int i = 0; i < 40; i++)
		status |= n.sum[i] != mr_parallel_sum(&ctx, 20000, term, NULL);
#ifndef __SANITIZE_THREAD__
	if (child == 0)
		_exit(status);
	assert_int_equal(status, 0);
	assert_int_equal(waitpid(child, &status, 0), child);
#endif
	assert_int_equal(status, 0);
	mr_ctx_free(&ctx);
}

/* Lists of all lengths about the one where insertion ends: ascending, and each value once. */
static void
lists_are_sorted(void **state)
{
	uint32_t x[100];
	mr_random r = { 1 };

	(void)state;
	for (size_t n = 0; n <= 100; n++) {
		size_t kept, seen = 0;
		bool there[50] = { false };
		for (size_t i = 0; i < n; i++) {
			x[i] = (uint32_t)(50 * mr_random_real(&r));
			seen += !there[x[i]];
			there[x[i]] = true;
		}
		kept = mr_sort_unique(x, n);
		assert_int_equal(kept, seen);
		for (size_t i = 0; i < kept; i++)
			assert_true(there[x[i]] && (i == 0 || x[i - 1] < x[i]));
	}
}

/* Of few numbers the upper median; of very many one near it. */
static void
medians(void **state)
{
	enum { MANY = 100000 };
	static double x[MANY];
	double m;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (size_t i = 0; i < MANY; i++)
		x[i] = (double)((i * 7919 + 1) % MANY);
	mr_median(&ctx, (const double[]){ 3, 1, 2, 5 }, 4, &m);
	assert_true(m == 3);
	mr_median(&ctx, x, MANY, &m);
	assert_true(fabs(m - MANY / 2) < MANY / 100);
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(memory_grows_and_shrinks),
		cmocka_unit_test(large_memory_lies_in_a_file),
		cmocka_unit_test(memory_is_aligned_and_released_in_order),
		cmocka_unit_test(a_released_block_is_kept_for_the_next),
		cmocka_unit_test(growing_keeps_contents_and_marks),
		cmocka_unit_test(reserving_doubles),
		cmocka_unit_test(impossible_sizes_unwind),
		cmocka_unit_test(sentences_keep_their_status_and_take_prefixes),
		cmocka_unit_test(lists_are_sorted),
		cmocka_unit_test(medians),
		cmocka_unit_test(loops_visit_each_index_once_and_sums_do_not_depend_on_threads),
		cmocka_unit_test(loops_in_loops_and_in_a_copy_of_the_process),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
