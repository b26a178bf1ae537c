/* Domains of displaced subdivision surfaces: prefixes, levels, displacing, and what a frame may hold. */
#include "domain.h"
#include "shapes.h"

static double *
waves(size_t n)
{
	double *h = MR_NEW(&ctx, n, double);

	for (size_t i = 0; i < n; i++)
		h[i] = 0.1 * sin(0.7 * (double)i);
	return h;
}

static void
test_levels_are_prefixes(void **state)
{
	mr_mesh torus = shape(MR_TORUS, 60), plane = shape(MR_PLANE, 60);
	const mr_mesh *controls[] = { &torus, &plane };

	(void)state;
	for (int k = 0; k < 2; k++) {
		mr_domain fine = domain(controls[k], 4);
		for (size_t n = 0; n < 4; n++) {
			mr_domain d = domain(controls[k], n);
			assert_int_equal(d.m.nv, fine.level[n].nv);
			for (size_t v = 0; v < d.m.nv; v++) {
				assert_true(mr_dist(d.m.p[v], fine.m.p[v]) < 1e-14);
				assert_true(mr_dist(d.normal[v], fine.normal[v]) < 1e-12);
			}
		}
	}
}

static void
test_levels_by_count(void **state)
{
	mr_mesh sphere = shape(MR_SPHERE, 12), plane = shape(MR_PLANE, 9);
	static const struct {
		size_t count, n;
	} cases[] = { { 0, 0 }, { 12, 0 }, { 22, 0 }, { 23, 1 }, { 42, 1 }, { 100, 2 }, { 10242, 5 } };
	size_t n;

	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		assert_int_equal(mr_domain_level(&ctx, &sphere, cases[i].count, &n), MR_OK);
		assert_int_equal(n, cases[i].n);
	}
	assert_int_equal(mr_domain_level(&ctx, &sphere, SIZE_MAX, &n), MR_OK);
	assert_true(mr_loop_count(sphere.nv, sphere.nf, 0, n + 1) == SIZE_MAX || n == MR_LEVEL_MAX);
	assert_int_equal(mr_domain_level(&ctx, &plane, 81, &n), MR_OK);
	assert_int_equal(n, 2); /* 3^2, 5^2, 9^2 */
}

static void
test_displacing(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 42);
	mr_domain d = domain(&m, 2);
	double *h = waves(d.m.nv);
	mr_v3 *p = MR_NEW(&ctx, d.m.nv, mr_v3);

	(void)state;
	mr_domain_displace(&ctx, &d, h, 0, p);
	assert_memory_equal(p, d.m.p, d.m.nv * sizeof *p);
	mr_domain_displace(&ctx, &d, h, -2, p);
	for (size_t v = 0; v < d.m.nv; v++) {
		mr_v3 expected = mr_axpy(-2 * h[v], d.normal[v], d.m.p[v]);
		assert_true(mr_dist(p[v], expected) < 1e-15);
	}
}

static mr_frame *
frame_of(const mr_domain *d, const double *height)
{
	mr_frame *f;

	assert_int_equal(mr_frame_new(&ctx, "test", &f), MR_OK);
	assert_int_equal(mr_displacement_put(&ctx, f, d, height), MR_OK);
	return f;
}

static void
refuse(const mr_mesh *m, mr_frame *f, const char *sentence)
{
	const double *height = NULL;
	size_t n = 77;

	assert_true(mr_displacement_get(&ctx, f, m, &n, &height) < 0);
	assert_string_equal(ctx.error, sentence);
	assert_true(n == 77 && !height);
}

static void
test_frames(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 42), other = shape(MR_SPHERE, 92);
	mr_domain d = domain(&m, 2);
	double *h = waves(d.m.nv);
	mr_frame *f = frame_of(&d, h), *empty;
	uint32_t level = 16;
	const double *back;
	size_t n;

	(void)state;
	assert_int_equal(mr_displacement_get(&ctx, f, &m, &n, &back), MR_OK);
	assert_int_equal(n, 2);
	assert_memory_equal(back, h, d.m.nv * sizeof *h);
	refuse(&other, f, "displacement: 642 heights, but level 2 of sphere has 1442 vertices");
	h[5] = NAN;
	refuse(&m, f, "displacement: height 5 is not finite");
	assert_int_equal(mr_layer_put(&ctx, f, "displacement", "level", &level, 1), MR_OK);
	refuse(&m, f, "displacement: level 16 of at most 15");
	assert_int_equal(mr_frame_new(&ctx, "empty", &empty), MR_OK);
	refuse(&m, empty, "no layer displacement; the frame has none");
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_levels_are_prefixes, setup, teardown),
		cmocka_unit_test_setup_teardown(test_levels_by_count, setup, teardown),
		cmocka_unit_test_setup_teardown(test_displacing, setup, teardown),
		cmocka_unit_test_setup_teardown(test_frames, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
