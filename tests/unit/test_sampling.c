/* The sampling of clouds whose spacing, noise and outliers are known. */
#include "base/random.h"
#include "mesh/layers.h"
#include "space/sampling.h"
#include "unit.h"

enum { MOST = 12000 };

static mr_v3 p[MOST];

static double
centred(mr_random *r)
{
	return 2 * mr_random_real(r) - 1;
}

/* Of deviation 1 (Box, Muller 1958). */
static double
normal(mr_random *r)
{
	double u = 1 - mr_random_real(r);

	return sqrt(-2 * log(u)) * cos(2 * MR_PI * mr_random_real(r));
}

static mr_v3
direction(mr_random *r)
{
	mr_v3 q;

	do
		q = mr_vec(centred(r), centred(r), centred(r));
	while (!(mr_norm2(q) < 1 && mr_norm2(q) > 0.01));
	return mr_unit(q);
}

/* n points strewn over the unit sphere, off it by a normal deviate of `noise` spacings. */
static double
sphere(size_t n, double noise, uint64_t seed)
{
	double spacing = sqrt(4 * MR_PI / (double)n);
	mr_random r = { seed };

	for (size_t i = 0; i < n; i++)
		p[i] = mr_mul(1 + noise * spacing * normal(&r), direction(&r));
	return spacing;
}

static mr_sampling
find(const mr_v3 *q, size_t n)
{
	mr_sampling s;

	assert_int_equal(mr_sampling_find(&ctx, q, n, NULL, &s), MR_OK);
	return s;
}

static void
near_to(double x, double wanted, double share)
{
	if (!(fabs(x / wanted - 1) <= share))
		fail_msg("%.17g is not %.17g to within %g", x, wanted, share);
}

/* Grids of 1 and of 0.01, jittered: the median is within 6 % of it, the area of the whole within 15 %, rims
 * and all. */
static void
grids_have_their_spacing(void **state)
{
	enum { N = 100 };
	mr_random r = { 1 };

	(void)state;
	for (int round = 0; round < 6; round++) {
		double h = round % 2 ? 0.01 : 1, jitter = 0.15 * (round / 2) * h;
		mr_sampling s;
		for (size_t i = 0; i < N * N; i++)
			p[i] = mr_vec(h * (double)(i % N) + jitter * centred(&r),
			    h * (double)(i / N) + jitter * centred(&r), 0);
		s = find(p, N * N);
		near_to(s.usual, h, 0.06);
		near_to(s.area, N * h * N * h, 0.15);
		assert_true(s.evenness > 0.8 && s.evenness <= 1);
		assert_true(s.noise < 1e-9 * h);
		assert_int_equal(s.neighbours, 16);
		assert_int_equal(s.places, N * N);
		assert_int_equal(s.outliers, 0);
	}
}

/* Points strewn over a sphere: its area. */
static void
strewn_points_have_the_area(void **state)
{
	(void)state;
	for (size_t n = 500; n <= 8000; n *= 4) {
		mr_sampling s;
		sphere(n, 0, n);
		s = find(p, n);
		near_to(s.area, 4 * MR_PI, 0.04);
		assert_true(s.outliers <= 1);
	}
}

/* To within 8 % up to half a spacing, 12 % of one spacing, through which it takes more neighbours to see. */
static void
noise_is_told(void **state)
{
	static const double noise[] = { 0.1, 0.2, 0.3, 0.5, 1 };
	double spacing = sphere(8000, 0, 2);

	(void)state;
	assert_true(find(p, 8000).noise < 0.02 * spacing);
	for (size_t i = 0; i < 5; i++) {
		mr_sampling s;
		spacing = sphere(8000, noise[i], 3 + i);
		s = find(p, 8000);
		near_to(s.noise, noise[i] * spacing, noise[i] < 1 ? 0.08 : 0.12);
		assert_true((s.neighbours > 16) == (noise[i] >= 0.5));
	}
}

/* A tenth more in a box: of those off by four spacings nine tenths, and of the others one in a thousand. */
static void
outliers_are_found(void **state)
{
	enum { ON = 6000, OFF = 600 };

	(void)state;
	for (int round = 0; round < 3; round++) {
		double spacing = sphere(ON, 0.2 * round, 11 + (uint64_t)round);
		mr_random r = { 21 + (uint64_t)round };
		size_t far = 0, found = 0, wrong = 0;
		mr_sampling s;
		for (size_t i = ON; i < ON + OFF; i++)
			p[i] = mr_vec(1.2 * centred(&r), 1.2 * centred(&r), 1.2 * centred(&r));
		p[ON] = mr_vec(500, 0, 0);
		s = find(p, ON + OFF);
		for (size_t i = 0; i < ON + OFF; i++) {
			bool off = fabs(mr_norm(p[i]) - 1) > 4 * spacing;
			far += off;
			found += off && s.outlier[i];
			wrong += i < ON && s.outlier[i];
		}
		assert_true(far > OFF / 3 && 10 * found >= 9 * far && 1000 * wrong <= ON);
		assert_true(s.outlier[ON]);
		assert_int_equal(s.places, ON + OFF);
	}
}

/* Ever more sparse to one side, no point of it is an outlier; the evenness tells it. */
static void
sparse_parts_are_none(void **state)
{
	enum { N = 8000 };
	mr_random r = { 31 };
	mr_sampling s;

	(void)state;
	for (size_t i = 0; i < N; i++)
		do
			p[i] = direction(&r);
		while (mr_random_real(&r) > exp(-2 * (1 + p[i].z)));
	s = find(p, N);
	assert_true(s.outliers * 1000 < N);
	assert_true(s.evenness < 0.4);
}

/* A limb that is ever more sparse to its end, where no few points lie in a plane: none of it is an outlier.
 */
static void
sparse_ends_are_none(void **state)
{
	enum { N = 8000 };
	const double radius = 0.06, length = 3;
	mr_random r = { 32 };
	mr_sampling s;
	size_t wrong = 0;

	(void)state;
	for (size_t i = 0; i < N; i++) {
		double x, angle = 2 * MR_PI * mr_random_real(&r);
		do
			x = length * mr_random_real(&r);
		while (mr_random_real(&r) > exp(-1.6 * x));
		p[i] = mr_vec(x, radius * cos(angle), radius * sin(angle));
	}
	s = find(p, N);
	for (size_t i = 0; i < N; i++)
		wrong += s.outlier[i];
	assert_true(wrong * 1000 < N);
}

static void
same(const mr_sampling *a, const mr_sampling *b, double size, double share)
{
	near_to(b->usual, size * a->usual, share);
	near_to(b->area, size * size * a->area, share);
	near_to(b->noise, size * a->noise, share);
	near_to(b->evenness, a->evenness, share);
	assert_int_equal(b->neighbours, a->neighbours);
	assert_int_equal(b->places, a->places);
	assert_int_equal(b->outliers, a->outliers);
}

/* Another order and number of threads: the same bits; turned, scaled and moved: the same but for rounding. */
static void
order_place_and_size_do_not_matter(void **state)
{
	enum { N = 5000 };
	const mr_v3 x = { 2.0 / 3, 2.0 / 3, 1.0 / 3 }, y = { -2.0 / 3, 1.0 / 3, 2.0 / 3 },
		    z = { 1.0 / 3, -2.0 / 3, 2.0 / 3 };
	mr_v3 *q = MR_NEW(&ctx, N, mr_v3);
	mr_sampling a, b;

	(void)state;
	assert_non_null(q);
	sphere(N, 0.3, 41);
	for (size_t i = 0; i < N / 50; i++)
		p[i] = mr_mul(1.5, p[50 * i]);
	p[N - 1] = p[7];
	a = find(p, N);
	assert_true(a.outliers > N / 100 && a.places == N - 1);
	for (size_t i = 0; i < N; i++)
		q[i] = p[i * 1237 % N];
	ctx.threads = 1;
	b = find(q, N);
	for (size_t i = 0; i < N; i++) {
		assert_memory_equal(&b.spacing[i], &a.spacing[i * 1237 % N], sizeof *a.spacing);
		assert_int_equal(b.outlier[i], a.outlier[i * 1237 % N]);
	}
	assert_true(b.noise == a.noise && b.usual == a.usual && b.evenness == a.evenness);
	same(&a, &b, 1, 1e-12);
	for (size_t i = 0; i < N; i++)
		q[i] = mr_add(mr_mul(1e-3, mr_vec(mr_dot(x, p[i]), mr_dot(y, p[i]), mr_dot(z, p[i]))),
		    mr_vec(1, -2, 0));
	b = find(q, N);
	same(&a, &b, 1e-3, 1e-9);
	for (size_t i = 0; i < N; i++)
		assert_int_equal(b.outlier[i], a.outlier[i]);
}

/* Each point three times: as each once, and the later ones repeat it. */
static void
repeats_count_once(void **state)
{
	enum { N = 2000 };
	mr_sampling once, all;
	mr_v3 *place;
	size_t count;

	(void)state;
	sphere(N, 0.1, 51);
	memcpy(p + N, p, N * sizeof *p);
	memcpy(p + (size_t)2 * N, p, N * sizeof *p);
	once = find(p, N);
	all = find(p, (size_t)3 * N);
	same(&once, &all, 1, 1e-12);
	for (size_t i = 0; i < (size_t)3 * N; i++) {
		assert_int_equal(all.repeat[i], i >= N);
		assert_true(all.spacing[i] == once.spacing[i % N]);
	}
	mr_sampling_places(&ctx, p, &all, &place, NULL, &count);
	assert_int_equal(count, once.places - once.outliers);
}

static void
few_points_have_no_figures(void **state)
{
	(void)state;
	for (size_t n = 0; n < 20; n++) {
		mr_sampling s;
		sphere(n, 0, 61);
		s = find(p, n);
		assert_int_equal(s.places, n);
		assert_int_equal(s.outliers, 0);
		assert_true((s.usual > 0) == (n > 1));
		assert_true((s.noise > 0) == (n >= 16));
	}
}

static mr_frame *
frame_of(size_t n)
{
	mr_frame *f;

	assert_int_equal(mr_frame_new(&ctx, "cloud", &f), MR_OK);
	assert_int_equal(mr_layer_move(&ctx, f, "points", MR_POSED, p, n), MR_OK);
	return f;
}

static mr_sampling
of_layer(mr_frame *f)
{
	mr_mesh m;
	mr_sampling s;

	assert_int_equal(mr_layer_points(&ctx, f, "points", &m), MR_OK);
	assert_int_equal(mr_sampling_of(&ctx, f, &m, &s), MR_OK);
	return s;
}

/* What is found is put there, and read again; with other positions it is gone. */
static void
layers_keep_it(void **state)
{
	enum { N = 1000 };
	mr_sampling a, b;
	mr_frame *f;
	bool stored;

	(void)state;
	sphere(N, 0.2, 71);
	f = frame_of(N);
	assert_int_equal(mr_sampling_stored(&ctx, f, "points", N, &b, &stored), MR_OK);
	assert_false(stored);
	a = of_layer(f);
	assert_int_equal(mr_sampling_stored(&ctx, f, "points", N, &b, &stored), MR_OK);
	assert_true(stored);
	assert_ptr_equal(b.spacing, a.spacing);
	assert_true(b.noise == a.noise && b.usual == a.usual && b.area == a.area && b.evenness == a.evenness);
	same(&a, &b, 1, 0);
	assert_int_equal(mr_layer_move(&ctx, f, "points", MR_POSED, p + 1, N), MR_OK);
	assert_false(mr_layer_has(f, "points", "spacing") || mr_layer_has(f, "points", "outlier") ||
		     mr_layer_has(f, "points", "repeat") || mr_layer_has(f, "points", "sampling"));
}

/* A surface does not get the columns. */
static void
surfaces_do_not(void **state)
{
	const mr_tri t = { { 0, 1, 2 } };
	mr_frame *f;
	mr_mesh m;
	mr_sampling s;

	(void)state;
	sphere(100, 0, 81);
	assert_int_equal(mr_frame_new(&ctx, "surface", &f), MR_OK);
	m = (mr_mesh){ .name = "mesh", .p = p, .t = &t, .nv = 100, .nf = 1 };
	assert_int_equal(mr_layer_put_mesh(&ctx, f, "mesh", &m), MR_OK);
	assert_int_equal(mr_sampling_of(&ctx, f, &m, &s), MR_OK);
	assert_int_equal(s.places, 100);
	assert_false(mr_layer_has(f, "mesh", "spacing"));
}

/* Columns that others wrote. */
static void
damage_is_refused(void **state)
{
	enum { N = 100 };
	static const double whole[][2] = { { -1, 16 }, { NAN, 16 }, { 0, 15 }, { 0, 1e300 }, { 0, NAN } };
	double spacing[N] = { 0 };
	uint8_t flag[N] = { 0 };
	mr_sampling s;
	bool stored;

	(void)state;
	sphere(N, 0, 91);
	for (int round = 0; round < 10; round++) {
		mr_frame *f = frame_of(N);
		of_layer(f);
		spacing[3] = round == 0 ? -1 : round == 1 ? INFINITY : 1;
		flag[5] = round == 2 || round == 3 ? 2 : 0;
		if (round < 2)
			assert_int_equal(mr_layer_put(&ctx, f, "points", "spacing", spacing, N), MR_OK);
		else if (round < 4)
			assert_int_equal(
			    mr_layer_put(&ctx, f, "points", round == 2 ? "outlier" : "repeat", flag, N),
			    MR_OK);
		else if (round < 9)
			assert_int_equal(
			    mr_layer_put(&ctx, f, "points", "sampling", whole[round - 4], 1), MR_OK);
		else
			assert_int_equal(mr_layer_put(&ctx, f, "points", "outlier", flag, N - 1), MR_OK);
		assert_int_equal(mr_sampling_stored(&ctx, f, "points", N, &s, &stored), MR_ERANGE);
		assert_false(stored);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(grids_have_their_spacing, setup, teardown),
		cmocka_unit_test_setup_teardown(strewn_points_have_the_area, setup, teardown),
		cmocka_unit_test_setup_teardown(noise_is_told, setup, teardown),
		cmocka_unit_test_setup_teardown(outliers_are_found, setup, teardown),
		cmocka_unit_test_setup_teardown(sparse_parts_are_none, setup, teardown),
		cmocka_unit_test_setup_teardown(sparse_ends_are_none, setup, teardown),
		cmocka_unit_test_setup_teardown(order_place_and_size_do_not_matter, setup, teardown),
		cmocka_unit_test_setup_teardown(repeats_count_once, setup, teardown),
		cmocka_unit_test_setup_teardown(few_points_have_no_figures, setup, teardown),
		cmocka_unit_test_setup_teardown(layers_keep_it, setup, teardown),
		cmocka_unit_test_setup_teardown(surfaces_do_not, setup, teardown),
		cmocka_unit_test_setup_teardown(damage_is_refused, setup, teardown),
	};
	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
