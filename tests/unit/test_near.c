/* Nearest points against loops over all points, and the traps of the index below. */
#include "base/random.h"
#include "space/near.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { MOST = 12 };

static mr_v3
random_point(mr_random *r, double size)
{
	return mr_vec(size * mr_random_real(r), size * mr_random_real(r), size * mr_random_real(r));
}

/* The k nearest distinct positions, by insertion. */
static void
loop(const mr_v3 *p, size_t n, mr_v3 q, size_t k, uint32_t *index, double *dist2)
{
	size_t have = 0;

	for (uint32_t i = 0; i < n; i++) {
		double d = mr_norm2(mr_sub(q, p[i]));
		bool seen = false;
		for (size_t j = 0; j < have; j++)
			seen |= dist2[j] == d && mr_dist(p[index[j]], p[i]) == 0;
		if (seen || (have == k && d >= dist2[k - 1]))
			continue;
		size_t j = have < k ? have++ : k - 1;
		for (; j > 0 && dist2[j - 1] > d; j--) {
			dist2[j] = dist2[j - 1];
			index[j] = index[j - 1];
		}
		dist2[j] = d;
		index[j] = i;
	}
	for (; have < k; have++) {
		index[have] = UINT32_MAX;
		dist2[have] = INFINITY;
	}
}

static void
equals_a_loop(void **state)
{
	mr_random r = { 1 };

	(void)state;
	for (size_t n = 1; n < 3000; n = 2 * n + 1)
		for (unsigned threads = 1; threads <= 2; threads++) {
			enum { QUERIES = 200 };
			mr_ctx ctx;
			mr_near *near = NULL;
			mr_v3 q[QUERIES];
			uint32_t index[QUERIES * MOST], expected[MOST];
			double dist2[QUERIES * MOST], expected2[MOST];
			mr_ctx_init(&ctx, threads);
			mr_v3 *p = MR_NEW(&ctx, n, mr_v3);
			for (size_t i = 0; i < n; i++)
				p[i] = i % 3 == 2 ? p[i / 2] : random_point(&r, 1);
			for (size_t i = 0; i < QUERIES; i++)
				q[i] = i % 4 ? random_point(&r, 1) : p[i % n];
			assert_int_equal(mr_near_build(&ctx, p, n, &near), MR_OK);
			assert_int_equal(mr_near_query(&ctx, near, q, QUERIES, MOST, index, dist2), MR_OK);
			for (size_t i = 0; i < QUERIES; i++) {
				loop(p, n, q[i], MOST, expected, expected2);
				assert_memory_equal(index + i * MOST, expected, sizeof expected);
				assert_memory_equal(dist2 + i * MOST, expected2, sizeof expected2);
			}
			mr_ctx_free(&ctx);
		}
}

static void
equal_points_count_once(void **state)
{
	enum { N = 100000 };
	mr_ctx ctx;
	mr_near *near;
	uint32_t index[2];

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_v3 *p = MR_NEW(&ctx, N, mr_v3);
	for (size_t i = 0; i < N; i++)
		p[i] = mr_vec(i % 2 ? -0.0 : 0.0, 1, 2);
	assert_int_equal(mr_near_build(&ctx, p, N, &near), MR_OK);
	assert_int_equal(mr_near_distinct(near), 1);
	assert_int_equal(mr_near_query(&ctx, near, p, 1, 2, index, NULL), MR_OK);
	assert_int_equal(index[0], 0);
	assert_int_equal(index[1], UINT32_MAX);
	mr_ctx_free(&ctx);
}

static void
bad_input_is_refused(void **state)
{
	mr_ctx ctx;
	mr_near *near = NULL;
	mr_v3 p[2] = { { 0, 0, 0 }, { 1, NAN, 0 } };
	uint32_t index;

	(void)state;
	mr_ctx_init(&ctx, 1);
	assert_int_equal(mr_near_build(&ctx, p, 0, &near), MR_ERANGE);
	assert_int_equal(mr_near_build(&ctx, p, 2, &near), MR_ERANGE);
	assert_string_equal(ctx.error, "point 1 (1 nan 0) is not below 1e150");
	assert_null(near);
	assert_int_equal(mr_near_build(&ctx, p, 1, &near), MR_OK);
	assert_int_equal(mr_near_query(&ctx, near, p, 2, 1, &index, NULL), MR_ERANGE);
	assert_int_equal(mr_near_query(&ctx, near, p, 0, 1, NULL, NULL), MR_OK);
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(equals_a_loop),
		cmocka_unit_test(equal_points_count_once),
		cmocka_unit_test(bad_input_is_refused),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
