/* Rotations, their logarithms with all their turns, and the rotation nearest to a matrix. */
#include "base/random.h"
#include "base/rotation.h"
#include "unit.h"

static double
apart(const mr_mat3 *a, const mr_mat3 *b)
{
	double most = 0;

	for (int i = 0; i < 9; i++)
		most = fmax(most, fabs(a->m[i] - b->m[i]));
	return most;
}

static mr_v3
random_vector(mr_random *r, double size)
{
	return mr_vec(size * (2 * mr_random_real(r) - 1), size * (2 * mr_random_real(r) - 1),
	    size * (2 * mr_random_real(r) - 1));
}

static mr_mat3
random_matrix(mr_random *r)
{
	mr_mat3 a;

	for (int i = 0; i < 9; i++)
		a.m[i] = 2 * mr_random_real(r) - 1;
	return a;
}

static double
determinant(const mr_mat3 *a)
{
	const double *m = a->m;

	return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
	       m[2] * (m[3] * m[7] - m[4] * m[6]);
}

static void
assert_rotation(const mr_mat3 *r)
{
	mr_mat3 one = mr_mat3_identity(), product = mr_mat3_multiply_transposed(r, r);

	assert_true(apart(&product, &one) < 1e-14);
	assert_true(fabs(determinant(r) - 1) < 1e-14);
}

static double
trace_with(const mr_mat3 *r, const mr_mat3 *a)
{
	double sum = 0;

	for (int i = 0; i < 9; i++)
		sum += r->m[i] * a->m[i];
	return sum;
}

static void
test_exponentials_are_rotations(void **state)
{
	mr_mat3 one = mr_mat3_identity(), none = mr_rotation_exp(mr_vec(0, 0, 0)),
		quarter = mr_rotation_exp(mr_vec(0, 0, MR_PI / 2));
	mr_random r = { 3 };

	(void)state;
	assert_memory_equal(&none, &one, sizeof one);
	assert_true(mr_dist(mr_mat3_apply(&quarter, mr_vec(1, 0, 2)), mr_vec(0, 1, 2)) < 1e-15);
	for (int i = 0; i < 200; i++) {
		mr_v3 w = random_vector(&r, i % 2 ? 20 : 1e-5);
		mr_mat3 a = mr_rotation_exp(w), half = mr_rotation_exp(mr_mul(0.5, w));
		mr_mat3 twice = mr_mat3_multiply(&half, &half);
		assert_rotation(&a);
		assert_true(apart(&a, &twice) < 1e-14);
		assert_true(mr_dist(mr_mat3_apply(&a, w), w) < 1e-13);
	}
}

/* From half a turn off the logarithm is found that was there, whatever it is. */
static void
test_logarithms_keep_their_turns(void **state)
{
	mr_random r = { 5 };

	(void)state;
	for (int i = 0; i < 500; i++) {
		mr_v3 w = random_vector(&r, i % 3 ? 15 : 1e-4),
		      off = mr_mul(0.4 * mr_random_real(&r), mr_unit(w));
		mr_mat3 a = mr_rotation_exp(w);
		mr_v3 found = mr_rotation_log(&a, i % 3 ? mr_add(w, off) : mr_vec(0, 0, 0));
		assert_true(mr_dist(found, w) < 1e-11);
		found = mr_rotation_log(&a, mr_vec(0, 0, 0));
		assert_true(mr_norm(found) < MR_PI + 1e-12);
		assert_true(mr_dist(mr_rotation_log(&a, found), found) < 1e-14);
	}
	for (int turns = -3; turns <= 3; turns++) { /* of which nothing is left to see but the count */
		mr_v3 w = mr_mul(2 * MR_PI * turns, mr_unit(mr_vec(1, 2, -2)));
		mr_mat3 a = mr_rotation_exp(w), one = mr_mat3_identity();
		assert_true(mr_dist(mr_rotation_log(&a, w), w) < 1e-14 * (1 + mr_norm(w)));
		assert_true(mr_dist(mr_rotation_log(&one, w), w) < 1e-14 * (1 + mr_norm(w)));
	}
	for (int i = 0; i < 50; i++) { /* half a turn, on either side */
		mr_v3 w = mr_mul(MR_PI, mr_unit(random_vector(&r, 1)));
		mr_mat3 a = mr_rotation_exp(w);
		assert_true(mr_dist(mr_rotation_log(&a, w), w) < 1e-13);
		assert_true(mr_dist(mr_rotation_log(&a, mr_mul(-1, w)), mr_mul(-1, w)) < 1e-13);
	}
}

/* No small turn of it comes nearer, of no matrix; those of mirrors and of a plane or a line are rotations
 * too. */
static void
test_nearest_rotation_is_the_best(void **state)
{
	mr_random r = { 7 };

	(void)state;
	for (int i = 0; i < 300; i++) {
		mr_mat3 a = random_matrix(&r), b;
		double best;
		if (i % 3 == 1)
			memset(a.m + 6, 0, 3 * sizeof *a.m);
		if (i % 3 == 2)
			for (int k = 3; k < 9; k++)
				a.m[k] = (k < 6 ? 2 : -1) * a.m[k % 3];
		b = mr_rotation_nearest(&a);
		assert_rotation(&b);
		best = trace_with(&b, &a);
		for (int k = 0; k < 60; k++) {
			mr_mat3 turn = mr_rotation_exp(random_vector(&r, k % 2 ? 3 : 1e-3));
			turn = mr_mat3_multiply(&turn, &b);
			assert_true(trace_with(&turn, &a) <= best + 1e-14);
		}
	}
}

static void
test_nearest_rotation_of_a_stretched_one(void **state)
{
	const mr_mat3 mirror = { { -1, 0, 0, 0, -1, 0, 0, 0, -1 } }, none = { { 0 } };
	mr_mat3 one = mr_mat3_identity(), found = mr_rotation_nearest(&one);
	mr_random r = { 9 };

	(void)state;
	assert_memory_equal(&found, &one, sizeof one);
	found = mr_rotation_nearest(&none);
	assert_memory_equal(&found, &one, sizeof one);
	found = mr_rotation_nearest(&mirror);
	assert_rotation(&found);
	for (int i = 0; i < 200; i++) {
		mr_mat3 a = mr_rotation_exp(random_vector(&r, 3)), b = random_matrix(&r), stretch, stretched;
		double size = pow(10, 60 * (mr_random_real(&r) - 0.5));
		stretch = mr_mat3_multiply_transposed(&b, &b); /* symmetric, positive */
		stretch = mr_mat3_axpy(0.1, &one, &stretch);
		stretched = mr_mat3_multiply(&a, &stretch);
		for (int k = 0; k < 9; k++)
			stretched.m[k] *= size;
		found = mr_rotation_nearest(&stretched);
		assert_true(apart(&found, &a) < 1e-13);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_exponentials_are_rotations),
		cmocka_unit_test(test_logarithms_keep_their_turns),
		cmocka_unit_test(test_nearest_rotation_is_the_best),
		cmocka_unit_test(test_nearest_rotation_of_a_stretched_one),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
