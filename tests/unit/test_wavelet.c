/* Heights as wavelet coefficients: exact inverses, prefixes, gains; columns that go along with subdivision.
 */
#include "base/random.h"
#include "shapes.h"
#include "subdivide/columns.h"
#include "subdivide/wavelet.h"

enum { LEVELS = 3 };

static mr_loop level[LEVELS + 1];

static mr_mesh
shape_and_levels(mr_solid solid, size_t n)
{
	mr_mesh m = shape(solid, n);

	assert_int_equal(mr_loop_levels(&ctx, &m, 180, NULL, LEVELS, level), MR_OK);
	return m;
}

static double *
random_heights(uint64_t seed)
{
	double *x = MR_NEW(&ctx, level[LEVELS].nv, double);
	mr_random r = { seed };

	for (size_t v = 0; v < level[LEVELS].nv; v++)
		x[v] = 2 * mr_random_real(&r) - 1;
	return x;
}

static double *
copy(const double *x, size_t n)
{
	double *y = MR_NEW(&ctx, n, double);

	memcpy(y, x, n * sizeof *y);
	return y;
}

static void
assert_close(const double *x, const double *y, size_t n, double tolerance)
{
	for (size_t v = 0; v < n; v++)
		if (!(fabs(x[v] - y[v]) <= tolerance))
			fail_msg("%zu: %.17g is not %.17g", v, x[v], y[v]);
}

static void
test_synthesis_undoes_analysis(void **state)
{
	static const mr_solid solids[] = { MR_SPHERE, MR_PLANE, MR_KNOT };

	(void)state;
	for (int i = 0; i < 3; i++) {
		shape_and_levels(solids[i], 300);
		size_t n = level[LEVELS].nv;
		double *x = random_heights(7), *y = copy(x, n), ones[LEVELS + 1] = { 1, 1, 1, 1 };
		mr_wavelet_analyse(&ctx, level, LEVELS, y);
		assert_memory_equal(x, y, level[0].nv * sizeof *x);
		mr_wavelet_synthesize(&ctx, level, LEVELS, y);
		assert_close(x, y, n, 4 * 0x1p-52); /* a rounding of a number below 2 a level and way */
		memcpy(y, x, n * sizeof *y);
		assert_int_equal(mr_equalize(&ctx, level, LEVELS, ones, y), MR_OK);
		assert_close(x, y, n, 4 * 0x1p-52);
	}
}

/* What Loop's stencils make of the coarse heights has no coefficients above them. */
static void
test_predictions_have_no_coefficients(void **state)
{
	(void)state;
	shape_and_levels(MR_TORUS, 100);
	double *x = random_heights(3);
	for (size_t i = 1; i <= LEVELS; i++)
		mr_loop_predict(&ctx, &level[i - 1], &level[i], 1, x, x + level[i - 1].nv);
	mr_wavelet_analyse(&ctx, level, LEVELS, x);
	for (size_t v = level[0].nv; v < level[LEVELS].nv; v++)
		assert_true(x[v] == 0);
}

/* Levels j and below of the result do not depend on what is above, nor on its gains. */
static void
test_levels_stay_prefixes(void **state)
{
	static const double gain[LEVELS + 1] = { 0.5, 2, 0, -1 };

	(void)state;
	shape_and_levels(MR_SPHERE, 42);
	double *x = random_heights(5), *all = copy(x, level[LEVELS].nv);
	assert_int_equal(mr_equalize(&ctx, level, LEVELS, gain, all), MR_OK);
	for (size_t j = 0; j < LEVELS; j++) {
		double *part = copy(x, level[j].nv);
		assert_int_equal(mr_equalize(&ctx, level, j, gain, part), MR_OK);
		assert_memory_equal(part, all, level[j].nv * sizeof *part);
	}
	for (size_t v = 0; v < level[0].nv; v++)
		assert_true(all[v] == 0.5 * x[v]);
}

/* Gains multiply: one after another is their product; all of 0 leave nothing. */
static void
test_gains_multiply(void **state)
{
	static const double a[LEVELS + 1] = { 0.5, 2, 1, -1 }, b[LEVELS + 1] = { 4, 0.25, 3, 2 };
	static const double ab[LEVELS + 1] = { 2, 0.5, 3, -2 }, none[LEVELS + 1] = { 0 };

	(void)state;
	shape_and_levels(MR_PLANE, 60);
	size_t n = level[LEVELS].nv;
	double *x = random_heights(6), *y = copy(x, n);
	assert_int_equal(mr_equalize(&ctx, level, LEVELS, a, x), MR_OK);
	assert_int_equal(mr_equalize(&ctx, level, LEVELS, b, x), MR_OK);
	assert_int_equal(mr_equalize(&ctx, level, LEVELS, ab, y), MR_OK);
	assert_close(x, y, n, 1e-13);
	assert_int_equal(mr_equalize(&ctx, level, LEVELS, none, y), MR_OK);
	for (size_t v = 0; v < n; v++)
		assert_true(y[v] == 0);
}

static void
test_refusals(void **state)
{
	static const double large[LEVELS + 1] = { 1, 1, 1, 1.7e308 };

	(void)state;
	shape_and_levels(MR_SPHERE, 300);
	assert_int_equal(mr_equalize(&ctx, level, LEVELS, large, random_heights(8)), MR_ERANGE);
}

static const void *
carried(const mr_carried *c, size_t n, const char *name, size_t rows)
{
	for (size_t i = 0; i < n; i++)
		if (!strcmp(c[i].name, name)) {
			assert_int_equal(c[i].rows, rows);
			return c[i].to;
		}
	return NULL;
}

static void
test_columns_go_along(void **state)
{
	mr_mesh m = shape_and_levels(MR_PLANE, 60);
	mr_refined r = { .m = m,
		.fine = { .nv = level[2].nv, .nf = level[2].nf, .t = level[2].t },
		.level = level,
		.n = 2 };
	mr_carried *c;
	mr_frame *f;
	size_t n;
	uint32_t *region = MR_NEW(&ctx, m.nv, uint32_t), *group = MR_NEW(&ctx, m.nf, uint32_t);
	unsigned char *color = MR_NEW(&ctx, 4 * m.nv, unsigned char);
	double *uv = MR_NEW(&ctx, 2 * m.nv, double), *fine = MR_NEW(&ctx, 2 * level[2].nv, double);

	(void)state;
	for (size_t v = 0; v < m.nv; v++) {
		region[v] = (uint32_t)v % 3;
		uv[2 * v] = m.p[v].x;
		uv[2 * v + 1] = m.p[v].y * m.p[v].x;
		memset(color + 4 * v, v % 2 ? 255 : 200, 4);
	}
	for (size_t k = 0; k < m.nf; k++)
		group[k] = (uint32_t)k;
	assert_int_equal(mr_frame_new(&ctx, "test", &f), MR_OK);
	assert_int_equal(mr_layer_put(&ctx, f, "mesh", "region", region, m.nv), MR_OK);
	assert_int_equal(mr_layer_put(&ctx, f, "mesh", "texcoord", uv, m.nv), MR_OK);
	assert_int_equal(mr_layer_put(&ctx, f, "mesh", "color", color, m.nv), MR_OK);
	assert_int_equal(mr_layer_put(&ctx, f, "mesh", "group", group, m.nf), MR_OK);
	assert_int_equal(mr_refine_columns(&ctx, f, "mesh", &r, &c, &n), MR_OK);
	const uint32_t *regions = carried(c, n, "region", level[2].nv),
		       *groups = carried(c, n, "group", level[2].nf);
	const unsigned char *colors = carried(c, n, "color", level[2].nv);
	assert_memory_equal(regions, region, m.nv * sizeof *region);
	for (size_t i = 0; i < level[1].nv - m.nv; i++) {
		uint32_t h = level[1].edge[i], a = region[mr_he_from(&m, h)], b = region[mr_he_to(&m, h)];
		assert_int_equal(regions[m.nv + i], a < b ? a : b);
	}
	for (size_t k = 0; k < level[2].nf; k++)
		assert_int_equal(groups[k], k / 16);
	for (size_t i = 0; i < 4 * level[2].nv; i++)
		assert_in_range(colors[i], 200, 255);
	mr_loop_values(&ctx, level, 2, 2, uv, fine);
	assert_memory_equal(carried(c, n, "texcoord", level[2].nv), fine, 2 * level[2].nv * sizeof *fine);
	assert_int_equal(mr_layer_put(&ctx, f, "mesh", "color", color, m.nv - 1), MR_OK);
	assert_int_equal(mr_refine_columns(&ctx, f, "mesh", &r, &c, &n), MR_ERANGE);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_synthesis_undoes_analysis, setup, teardown),
		cmocka_unit_test_setup_teardown(test_predictions_have_no_coefficients, setup, teardown),
		cmocka_unit_test_setup_teardown(test_levels_stay_prefixes, setup, teardown),
		cmocka_unit_test_setup_teardown(test_gains_multiply, setup, teardown),
		cmocka_unit_test_setup_teardown(test_refusals, setup, teardown),
		cmocka_unit_test_setup_teardown(test_columns_go_along, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
