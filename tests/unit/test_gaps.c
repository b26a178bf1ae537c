/* Distances of a surface from points, where they are known; what is bare, and the warning of it. */
#include "measure/gaps.h"
#include "space/sampling.h"

#include "shapes.h"

enum { N = 10000, SAMPLES = 20000 };

/* The square from 0 to 1 in the plane z = 0. */
static const mr_v3 corner[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
static const mr_tri halves[2] = { { { 0, 1, 2 } }, { { 0, 2, 3 } } };
static const mr_mesh square = { "square", corner, halves, 4, 2 };

/* A lattice of N points, over x of 0 to `width` and y of 0 to 1, at z. */
static mr_sampling
strew(double width, double z, mr_v3 *p)
{
	enum { SIDE = 100 };
	mr_sampling s;

	for (size_t i = 0; i < N; i++)
		p[i] = mr_vec(
		    width * ((double)(i % SIDE) + 0.5) / SIDE, ((double)(i / SIDE) + 0.5) / SIDE, z);
	assert_int_equal(mr_sampling_find(&ctx, p, N, NULL, &s), MR_OK);
	return s;
}

static mr_gaps
measure(const mr_mesh *m, const mr_v3 *p, const mr_sampling *s)
{
	mr_v3 *place = MR_NEW(&ctx, N, mr_v3);
	double *spacing = MR_NEW(&ctx, N, double);
	mr_gap_cloud cloud = { .p = place, .spacing = spacing, .usual = s->usual };
	mr_near *near;
	mr_gaps g = { .bare = 0 };

	for (size_t i = 0; i < s->n; i++)
		if (!s->repeat[i] && !s->outlier[i]) {
			place[cloud.n] = p[i];
			spacing[cloud.n++] = s->spacing[i];
		}
	assert_int_equal(mr_near_build(&ctx, place, cloud.n, &near), MR_OK);
	cloud.near = near;
	assert_int_equal(mr_gap_of_surface(&ctx, m, &cloud, SAMPLES, &g, NULL), MR_OK);
	return g;
}

/* Over half of the square the other half is bare, from four spacings of its end: a mean of 1/8, up to 1/2. */
static void
half_without_points(void **state)
{
	static mr_v3 p[N];
	mr_sampling s = strew(0.5, 0, p);
	mr_gaps g = measure(&square, p, &s);

	(void)state;
	assert_float_equal(g.surface.mean, 0.125, 0.005);
	assert_float_equal(g.surface.max, 0.5, 0.01);
	assert_float_equal(g.surface.high, 0.49, 0.01);
	assert_true(fabs(g.bare - (0.5 - 4 * s.usual)) < 0.01);
}

/* A surface beside all of its points is far from them. */
static void
beside_the_points(void **state)
{
	static mr_v3 p[N];
	mr_sampling s = strew(1, 0.2, p);
	mr_gaps g = measure(&square, p, &s);

	(void)state;
	assert_float_equal(g.surface.mean, 0.2, 1e-3);
	assert_true(g.bare == 1);
	s = strew(1, 0.03, p);
	assert_true(measure(&square, p, &s).bare == 0);
}

/* Outliers and repeats are no points that surface may lean on, or miss. */
static void
places_alone(void **state)
{
	static mr_v3 p[N];
	uint8_t mark[N] = { 0 };
	mr_sampling s = strew(1, 0, p), some = s;

	(void)state;
	for (size_t i = 0; i < N; i++)
		mark[i] = p[i].x > 0.5;
	for (size_t i = 0; i < N; i++)
		p[i].z = mark[i] ? 0.3 : 0;
	some.outlier = mark;
	assert_float_equal(measure(&square, p, &some).surface.mean, 0.125, 0.005);
	some = s;
	some.repeat = mark;
	assert_float_equal(measure(&square, p, &some).surface.mean, 0.125, 0.005);
}

/* The places of equal areas: of a sphere's triangles, of whatever size, as many are above as below. */
static void
areas_weigh(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 500);
	mr_v3 pole = { 0, 0, 1 };
	double spacing = 0.1;
	mr_near *near;
	mr_gap_spot widest = { 0 };
	mr_gaps g;

	(void)state;
	assert_int_equal(mr_near_build(&ctx, &pole, 1, &near), MR_OK);
	assert_int_equal(mr_gap_of_surface(&ctx, &m, &(mr_gap_cloud){ &pole, &spacing, near, 1, spacing },
			     SAMPLES, &g, &widest),
	    MR_OK);
	/* of the unit sphere: chords of length c cut off the share c^2 / 4, the mean is 4/3 */
	assert_float_equal(g.surface.mean, 4.0 / 3, 0.01);
	assert_float_equal(g.surface.max, 2, 0.01);
	assert_true(fabs(widest.wide - 2 / spacing) < 0.1);
	assert_true(mr_dist(widest.at, mr_vec(0, 0, -1)) < 0.2);
	assert_true(fabs(g.bare - (1 - 0.16 / 4)) < 0.003);
}

static void
none_to_measure(void **state)
{
	const mr_tri flat = { { 0, 0, 1 } };
	const mr_mesh line = { "line", corner, &flat, 2, 1 };
	static mr_v3 p[N];
	mr_sampling s = strew(1, 0, p);
	mr_gaps g = measure(&line, p, &s);

	(void)state;
	assert_true(isnan(g.surface.mean) && isnan(g.surface.max) && g.bare == 0);
	assert_true(isnan(mr_gap_of(NULL, 0).mean));
}

static void
hear_finding(void *user, const mr_finding *f)
{
	*(mr_finding *)user = *f;
}

static void
reports_what_is_bare(void **state)
{
	mr_gaps g = { .surface = { .max = 3 }, .bare = 0.01 };
	mr_finding heard = { .count = 7 };

	(void)state;
	ctx.listener.found = hear_finding;
	ctx.listener.user = &heard;
	mr_gaps_report(&ctx, "control", &g);
	assert_int_equal(heard.count, 7);
	g.bare = 0.015;
	mr_gaps_report(&ctx, "control", &g);
	assert_true(heard.kind == MR_BARE && heard.value == 0.015);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(half_without_points, setup, teardown),
		cmocka_unit_test_setup_teardown(beside_the_points, setup, teardown),
		cmocka_unit_test_setup_teardown(places_alone, setup, teardown),
		cmocka_unit_test_setup_teardown(areas_weigh, setup, teardown),
		cmocka_unit_test_setup_teardown(none_to_measure, setup, teardown),
		cmocka_unit_test_setup_teardown(reports_what_is_bare, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
