/* Outliers among points of a sphere: those that are found, and the points that are taken for none. */
#include "base/random.h"
#include "space/outlier.h"
#include "unit.h"

enum { ON = 4000, OFF = 400 };

static double
centred(mr_random *r)
{
	return 2 * mr_random_real(r) - 1;
}

/* In the box of the unit sphere; arguments of a call have no order. */
static mr_v3
anywhere(mr_random *r)
{
	double x = centred(r), y = centred(r), z = centred(r);

	return mr_vec(x, y, z);
}

static mr_v3
direction(mr_random *r)
{
	mr_v3 p;

	do
		p = anywhere(r);
	while (!(mr_norm2(p) < 1 && mr_norm2(p) > 0.01));
	return mr_unit(p);
}

static double
off_sphere(mr_v3 p)
{
	return fabs(sqrt(mr_norm2(p)) - 1);
}

static size_t
find(const mr_v3 *p, size_t n, const double *off, bool *outlier)
{
	mr_sampling s;
	size_t count;

	assert_int_equal(mr_sampling_find(&ctx, p, n, NULL, &s), MR_OK);
	mr_find_outliers(&ctx, &s, off, 0, outlier, &count);
	return count;
}

/* Points of a unit sphere with noise, then some anywhere in its box. */
static void
with_noise(void **state)
{
	mr_random r = { 3 };
	mr_v3 p[ON + OFF];
	double off[ON + OFF];
	bool outlier[ON + OFF];
	size_t count, far = 0, found = 0, wrong = 0;

	(void)state;
	for (size_t i = 0; i < ON + OFF; i++) {
		double noise = 1 + 0.02 * centred(&r);
		p[i] = i < ON ? mr_mul(noise, direction(&r)) : mr_mul(1.2, anywhere(&r));
		off[i] = off_sphere(p[i]);
	}
	count = find(p, ON + OFF, off, outlier);
	for (size_t i = 0; i < ON + OFF; i++) {
		far += i >= ON && off[i] > 0.2;
		found += i >= ON && off[i] > 0.2 && outlier[i];
		wrong += i < ON && outlier[i];
	}
	assert_true(count >= found && count <= OFF);
	assert_true(far > 150 && 10 * found >= 9 * far); /* of six draws 91 to 95 % were found */
	assert_int_equal(wrong, 0);
}

/* A second sphere, of which the surface knows nothing. */
static void
keeps_surfaces(void **state)
{
	mr_random r = { 5 };
	mr_v3 p[ON];
	double off[ON];
	bool outlier[ON];

	(void)state;
	for (size_t i = 0; i < ON; i++) {
		p[i] = direction(&r);
		if (i % 10 == 0)
			p[i] = mr_axpy(0.3, p[i], mr_vec(2, 0, 0));
		off[i] = off_sphere(p[i]);
	}
	assert_int_equal(find(p, ON, off, outlier), 0);
}

/* Sampled ever more sparsely from one pole to the other. */
static void
keeps_sparse_parts(void **state)
{
	mr_random r = { 7 };
	mr_v3 p[ON];
	double off[ON];
	bool outlier[ON];

	(void)state;
	for (size_t i = 0; i < ON; i++) {
		do
			p[i] = direction(&r);
		while (mr_random_real(&r) > exp(-3 * (1 + p[i].z)));
		p[i] = mr_mul(1 + 0.005 * centred(&r), p[i]);
		off[i] = off_sphere(p[i]);
	}
	assert_int_equal(find(p, ON, off, outlier), 0);
}

static void
few_points(void **state)
{
	mr_v3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 9 } };
	double off[] = { 0, 0, 0, 9 };
	bool outlier[4];

	(void)state;
	assert_int_equal(find(p, 4, off, outlier), 0);
}

int
main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test_setup_teardown(with_noise, setup, teardown),
		cmocka_unit_test_setup_teardown(keeps_surfaces, setup, teardown),
		cmocka_unit_test_setup_teardown(keeps_sparse_parts, setup, teardown),
		cmocka_unit_test_setup_teardown(few_points, setup, teardown) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
