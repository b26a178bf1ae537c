/* Distances between surfaces against closed forms and loops. */
#include "base/random.h"
#include "space/bvh.h"

#include <setjmp.h>
#include <stdarg.h>
#include <time.h>

#include <cmocka.h>

static void
assert_near(double a, double b, double tolerance)
{
	if (!(fabs(a - b) <= tolerance))
		fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

/* n x n quads over [0, size]^2, at height z(x, y). */
static mr_mesh
grid(mr_ctx *ctx, uint32_t n, double size, double (*z)(double x, double y))
{
	size_t row = n + 1u, f = 0;
	mr_v3 *p = MR_NEW(ctx, row * row, mr_v3);
	mr_tri *t = MR_NEW(ctx, 2 * (size_t)n * n, mr_tri);

	assert_non_null(p);
	assert_non_null(t);
	for (uint32_t j = 0; j <= n; j++)
		for (uint32_t i = 0; i <= n; i++)
			p[j * row + i] = mr_vec(size * i / n, size * j / n, z(size * i / n, size * j / n));
	for (uint32_t j = 0; j < n; j++)
		for (uint32_t i = 0; i < n; i++) {
			uint32_t a = j * (n + 1) + i, c = a + n + 1;
			t[f++] = (mr_tri){ { a, a + 1, c + 1 } };
			t[f++] = (mr_tri){ { a, c + 1, c } };
		}
	return (mr_mesh){ "grid", p, t, row * row, f };
}

static double
level(double x, double y)
{
	(void)x;
	(void)y;
	return 0;
}

static double
raised(double x, double y)
{
	return level(x, y) + 0.125;
}

static double
ramp(double x, double y)
{
	(void)y;
	return x / 4;
}

static mr_comparison
compare(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *opts)
{
	static const mr_compare_opts defaults = MR_COMPARE_DEFAULTS;
	mr_comparison c;

	assert_int_equal(mr_compare(ctx, a, b, opts ? opts : &defaults, &c), MR_OK);
	return c;
}

static void
parallel_planes(void **state)
{
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_mesh a = grid(&ctx, 7, 1, level), b = grid(&ctx, 10, 1, raised);
	mr_comparison c = compare(&ctx, &a, &b, NULL);
	assert_near(c.ab.min, 0.125, 1e-15);
	assert_near(c.ab.max, 0.125, 1e-15);
	assert_near(c.ab.mean, 0.125, 1e-14);
	assert_near(c.ab.rms, 0.125, 1e-14);
	assert_true(c.both.max_bound >= c.both.max && c.both.max_bound <= 0.125 * 1.0011);
	assert_near(c.diagonal, sqrt(2), 1e-15);
	assert_false(c.corresponds);
	mr_ctx_free(&ctx);
}

/* From a ramp down to the floor, the distance is x / 4: mean 1/8 and rms 1/(4 sqrt 3); the floor below sees
 * it at an angle. */
static void
ramp_over_a_floor(void **state)
{
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_mesh a = grid(&ctx, 9, 1, ramp), b = grid(&ctx, 5, 1, level);
	mr_comparison c = compare(&ctx, &a, &b, NULL);
	assert_near(c.ab.min, 0, 0);
	assert_near(c.ab.max, 0.25, 1e-15);
	assert_near(c.ab.mean, 0.125, 1e-6);
	assert_near(c.ab.rms, 0.25 / sqrt(3), 1e-5);
	/* from the floor: x sin(angle), but beside the upper end it is the way to the end */
	assert_true(c.ba.max < 0.25 && c.ba.max > 0.2425);
	mr_ctx_free(&ctx);
}

/* One triangle high above a corner of a larger one: greatest in its middle, where no vertex is. */
static void
greatest_distance_is_inside(void **state)
{
	mr_ctx ctx;
	mr_compare_opts opts = MR_COMPARE_DEFAULTS;
	/* two walls left and right of a floor: the floor's middle is farthest from them */
	const mr_v3 floor_p[] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
	const mr_tri floor_t[] = { { { 0, 1, 2 } }, { { 0, 2, 3 } } };
	const mr_v3 wall_p[] = { { -1, -1, 0 }, { -1, 1, 0 }, { -1, 0, 1 }, { 1, -1, 0 }, { 1, 1, 0 },
		{ 1, 0, 1 } };
	const mr_tri wall_t[] = { { { 0, 1, 2 } }, { { 3, 4, 5 } } };
	mr_mesh a = { "floor", floor_p, floor_t, 4, 2 }, b = { "walls", wall_p, wall_t, 6, 2 };

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (double tolerance = 1e-1; tolerance > 1e-5; tolerance /= 10) {
		opts.tolerance = tolerance;
		opts.samples = 3;
		mr_comparison c = compare(&ctx, &a, &b, &opts);
		assert_true(c.ab.max <= 1 && c.ab.max_bound >= 1);
		assert_true(c.ab.max_bound <= c.ab.max * (1 + tolerance) + 1e-11);
	}
	opts.samples = 1000000;
	mr_comparison c = compare(&ctx, &a, &b, &opts);
	assert_near(c.ab.mean, 0.5, 1e-6);
	assert_near(c.ab.rms, sqrt(1.0 / 3), 1e-6);
	opts.vertices_only = true;
	c = compare(&ctx, &a, &b, &opts);
	assert_near(c.ab.max, 0, 0);
	assert_int_equal(c.ab.samples, 4);
	mr_ctx_free(&ctx);
}

/* Latitude and longitude, radius r. */
static mr_mesh
sphere(mr_ctx *ctx, uint32_t n, double r)
{
	uint32_t m = 2 * n;
	mr_v3 *p = MR_NEW(ctx, (size_t)(n - 1) * m + 2, mr_v3);
	mr_tri *t = MR_NEW(ctx, 2 * (size_t)(n - 1) * m, mr_tri);
	uint32_t top = (n - 1) * m, bottom = top + 1;
	size_t f = 0;

	for (uint32_t j = 1; j < n; j++)
		for (uint32_t i = 0; i < m; i++) {
			double u = MR_PI * j / n, v = 2 * MR_PI * i / m;
			p[(j - 1) * m + i] = mr_vec(r * sin(u) * cos(v), r * sin(u) * sin(v), r * cos(u));
		}
	p[top] = mr_vec(0, 0, r);
	p[bottom] = mr_vec(0, 0, -r);
	for (uint32_t i = 0; i < m; i++) {
		uint32_t k = (i + 1) % m;
		t[f++] = (mr_tri){ { top, i, k } };
		t[f++] = (mr_tri){ { bottom, (n - 2) * m + k, (n - 2) * m + i } };
		for (uint32_t j = 0; j + 2 < n; j++) {
			t[f++] = (mr_tri){ { j * m + i, (j + 1) * m + i, (j + 1) * m + k } };
			t[f++] = (mr_tri){ { j * m + i, (j + 1) * m + k, j * m + k } };
		}
	}
	return (mr_mesh){ "sphere", p, t, (size_t)top + 2, f };
}

static void
concentric_spheres(void **state)
{
	mr_ctx ctx;
	double before = 0;

	(void)state;
	mr_ctx_init(&ctx, 2);
	for (uint32_t n = 16; n <= 64; n *= 2) {
		mr_mesh a = sphere(&ctx, n, 1), b = sphere(&ctx, n, 1.5);
		mr_comparison c = compare(&ctx, &a, &b, NULL);
		/* polyhedra lie up to a sagitta inside of their spheres */
		double sagitta = 1.5 * (1 - cos(MR_PI / n)) * 2;
		assert_true(c.ab.min >= 0.5 - sagitta && c.ab.max <= 0.5 + sagitta);
		assert_true(c.ba.min >= 0.5 - sagitta && c.ba.max <= 0.5 + sagitta);
		assert_true(c.both.max_bound <= c.both.max * 1.0011);
		if (n > 16)
			assert_near((0.5 - before) / (0.5 - c.ab.mean), 4, 0.4);
		before = c.ab.mean;
		assert_true(c.corresponds);
		assert_near(c.deviation.max, 0.5, 1e-14);
		assert_near(c.deviation.mean, 0.5, 1e-13);
		assert_near(c.deviation.stretch_min, 1.5, 1e-12);
		assert_near(c.deviation.stretch_max, 1.5, 1e-12);
	}
	mr_ctx_free(&ctx);
}

static void
a_surface_is_at_itself(void **state)
{
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_mesh a = sphere(&ctx, 30, 1e3);
	mr_comparison c = compare(&ctx, &a, &a, NULL);
	assert_near(c.both.max, 0, 1e-12 * c.diagonal);
	assert_near(c.both.max_bound, 0, 1e-11 * c.diagonal);
	assert_near(c.deviation.max, 0, 0);
	assert_near(c.deviation.stretch_mean, 1, 0);
	mr_ctx_free(&ctx);
}

static mr_v3
random_point(mr_random *r)
{
	return mr_vec(mr_random_real(r), mr_random_real(r), mr_random_real(r));
}

static double
loop_distance(const mr_mesh *b, mr_v3 q)
{
	double best = INFINITY;

	for (uint32_t f = 0; f < b->nf; f++)
		best = fmin(best, mr_face_closest(b, f, q).dist2);
	for (size_t i = 0; !b->nf && i < b->nv; i++)
		best = fmin(best, mr_norm2(mr_sub(q, b->p[i])));
	return sqrt(best);
}

/* Random triangles: no point of a lies beyond the bound, and the greatest found by dense sampling is below
 * max. */
static void
soups_and_clouds(void **state)
{
	enum { N = 12, FINE = 40 };
	mr_random r = { 31 };

	(void)state;
	for (int round = 0; round < 8; round++) {
		mr_v3 pa[3 * N], pb[3 * N];
		mr_tri t[N];
		mr_ctx ctx;
		double most = 0;
		mr_ctx_init(&ctx, 1);
		for (uint32_t f = 0; f < N; f++)
			for (uint32_t i = 0; i < 3; i++) {
				t[f].v[i] = 3 * f + i;
				pa[3 * f + i] = random_point(&r);
				pb[3 * f + i] = random_point(&r);
			}
		mr_mesh a = { "a", pa, t, 3 * N, N },
			b = { "b", pb, round % 2 ? t : NULL, 3 * N, round % 2 ? N : 0 };
		mr_comparison c = compare(&ctx, &a, &b, NULL);
		for (size_t f = 0; f < N; f++)
			for (int i = 0; i <= FINE; i++)
				for (int j = 0; i + j <= FINE; j++) {
					mr_v3 w = mr_vec((double)i / FINE, (double)j / FINE,
					    (double)(FINE - i - j) / FINE);
					mr_v3 q = mr_bary_point(w, pa[3 * f], pa[3 * f + 1], pa[3 * f + 2]);
					most = fmax(most, loop_distance(&b, q));
				}
		assert_true(most <= c.ab.max_bound + 1e-12);
		assert_true(most <= c.ab.max * 1.0011);
		assert_true(c.ab.max_bound <= c.ab.max * 1.0011);
		assert_true(c.ab.max <= most + 0.05);
		if (round % 2 == 0)
			assert_int_equal(c.ba.samples, 3 * N);
		mr_ctx_free(&ctx);
	}
}

static void
clouds_correspond(void **state)
{
	mr_ctx ctx;
	const mr_v3 p[] = { { 0, 0, 0 }, { 1, 0, 0 } }, q[] = { { 0, 0, 1 }, { 1, 2, 0 } };
	mr_mesh a = { "a", p, NULL, 2, 0 }, b = { "b", q, NULL, 2, 0 }, none = { "none", NULL, NULL, 0, 0 };
	mr_compare_opts opts = MR_COMPARE_DEFAULTS;
	mr_comparison c;

	(void)state;
	mr_ctx_init(&ctx, 1);
	c = compare(&ctx, &a, &b, NULL);
	assert_true(c.corresponds);
	assert_near(c.deviation.max, 2, 0);
	assert_int_equal(c.deviation.vertex, 1);
	assert_near(c.deviation.rms, sqrt(2.5), 1e-15);
	assert_true(isnan(c.deviation.stretch_mean));
	assert_near(c.ab.min, 1, 0);
	assert_near(c.ab.max, sqrt(2), 1e-15);
	assert_near(c.ab.max_bound, sqrt(2), 1e-15);
	assert_near(c.ab.mean, (1 + sqrt(2)) / 2, 1e-15);
	assert_int_equal(mr_compare(&ctx, &a, &none, &opts, &c), MR_EMESH);
	assert_string_equal(ctx.error, "none: no points to compare");
	mr_ctx_free(&ctx);
}

/* The boxes of long thin faces say little of them: those that stay where they are need no search. */
static void
a_fan_is_at_itself(void **state)
{
	enum { N = 20000 };
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_v3 *p = MR_NEW(&ctx, N + 1, mr_v3);
	mr_tri *t = MR_NEW(&ctx, N, mr_tri);
	assert_non_null(p);
	assert_non_null(t);
	p[N] = mr_vec(0, 0, 0);
	for (uint32_t i = 0; i < N; i++) {
		p[i] = mr_vec(cos(2 * MR_PI * i / N), sin(2 * MR_PI * i / N), 0);
		t[i] = (mr_tri){ { N, i, (i + 1) % N } };
	}
	const mr_mesh m = { "fan", p, t, N + 1, N };
	clock_t start = clock();
	mr_comparison c = compare(&ctx, &m, &m, NULL);
	assert_true(clock() - start < CLOCKS_PER_SEC);
	assert_near(c.both.max_bound, 0, 0);
	mr_ctx_free(&ctx);
}

static void
threads_do_not_matter(void **state)
{
	mr_ctx ctx[2];
	mr_comparison c[2];

	(void)state;
	for (unsigned i = 0; i < 2; i++) {
		mr_ctx_init(&ctx[i], 1 + 2 * i);
		mr_mesh a = sphere(&ctx[i], 41, 1), b = grid(&ctx[i], 60, 1, ramp);
		memset(&c[i], 0, sizeof c[i]);
		c[i] = compare(&ctx[i], &a, &b, NULL);
		mr_ctx_free(&ctx[i]);
	}
	assert_memory_equal(&c[0].ab, &c[1].ab, sizeof c[0].ab);
	assert_memory_equal(&c[0].ba, &c[1].ba, sizeof c[0].ba);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(parallel_planes),
		cmocka_unit_test(ramp_over_a_floor),
		cmocka_unit_test(greatest_distance_is_inside),
		cmocka_unit_test(concentric_spheres),
		cmocka_unit_test(a_surface_is_at_itself),
		cmocka_unit_test(soups_and_clouds),
		cmocka_unit_test(clouds_correspond),
		cmocka_unit_test(a_fan_is_at_itself),
		cmocka_unit_test(threads_do_not_matter),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
