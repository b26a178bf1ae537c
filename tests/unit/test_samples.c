/* What a volume takes of a cloud: each place once, what it stands for, without what lies on no surface. */
#include "shapes.h"
#include "volume/parts.h"

enum { N = 4000 };

static mr_v3 *
points_on(mr_solid solid, size_t n, uint64_t seed, double *area)
{
	mr_mesh m = shape(solid, 20000);
	mr_v3 *p, *normal;

	*area = mr_mesh_area(&ctx, &m);
	assert_int_equal(mr_surface_sample(&ctx, &m, n, seed, &p, &normal), MR_OK);
	return p;
}

static mr_status
samples_of(const mr_v3 *p, size_t n, double share, mr_volume_cloud *s)
{
	mr_sampling sampling;
	mr_v3 *place;
	size_t places;

	assert_int_equal(mr_sampling_find(&ctx, p, n, NULL, &sampling), MR_OK);
	mr_sampling_places(&ctx, p, &sampling, &place, NULL, &places);
	return mr_volume_samples(&ctx, place, places, &sampling, share, s);
}

static mr_volume_cloud
take(const mr_v3 *p, size_t n, double share)
{
	mr_volume_cloud s;

	assert_int_equal(samples_of(p, n, share, &s), MR_OK);
	return s;
}

static int
by_place(const void *a, const void *b)
{
	return memcmp(a, b, sizeof(mr_v3));
}

/* The points in an order of their own. */
static mr_v3 *
sorted(const mr_v3 *p, size_t n)
{
	mr_v3 *q = MR_NEW(&ctx, n, mr_v3);

	memcpy(q, p, n * sizeof *q);
	qsort(q, n, sizeof *q, by_place);
	return q;
}

/* None is there twice, however often it came, and they stand for the area of the surface together. */
static void
each_place_counts_once(void **state)
{
	static const mr_solid solids[] = { MR_SPHERE, MR_TORUS, MR_KNOT };
	mr_random r = { 1 };

	(void)state;
	for (size_t k = 0; k < 3; k++) {
		double area, sum = 0;
		mr_v3 *p = points_on(solids[k], N, k + 1, &area), *twice = MR_NEW(&ctx, 2 * N, mr_v3), *q;
		mr_volume_cloud s;
		for (size_t i = 0; i < N; i++) {
			twice[2 * i] = p[i];
			twice[2 * i + 1] = p[mr_random_bits(&r) % (i + 1)];
		}
		s = take(twice, 2 * N, 1);
		assert_in_range(s.n, N - N / 1000, N); /* of random points one or another is alone */
		q = sorted(s.p, s.n);
		for (size_t i = 1; i < s.n; i++)
			assert_true(memcmp(&q[i - 1], &q[i], sizeof *q) < 0);
		for (size_t i = 0; i < s.n; i++)
			sum += s.plane.area[i];
		assert_true(
		    fabs(sum / area - 1) < 0.12); /* of random points some have more than their neighbours */
		assert_true(fabs(s.spacing * s.spacing * N / area - 1) < 0.12);
		assert_true(s.noise == 1);
		assert_true(mr_dist(s.box.min, mr_box_of(p, N).min) == 0);
		mr_ctx_free(&ctx);
	}
}

/* Near ones in space come near in memory: a way from point to point that is short. */
static void
neighbours_are_near_in_memory(void **state)
{
	double area, way = 0;
	mr_volume_cloud s = take(points_on(MR_SPHERE, N, 1, &area), N, 1);

	(void)state;
	for (size_t i = 1; i < s.n; i++)
		way += mr_dist(s.p[i], s.p[i - 1]);
	assert_true(way / N < 3 * s.spacing);
}

/* A point and what is known of it. */
typedef struct known {
	mr_v3 p, normal;
	double area;
} known;

static known *
known_by_place(const mr_volume_cloud *s)
{
	known *k = MR_NEW(&ctx, s->n, known);

	for (size_t i = 0; i < s->n; i++)
		k[i] = (known){ s->p[i], s->plane.normal[i], s->plane.area[i] };
	qsort(k, s->n, sizeof *k, by_place);
	return k;
}

/* The same points, and the same known of each, to rounding. */
static void
assert_same(const mr_volume_cloud *a, const mr_volume_cloud *b)
{
	known *x = known_by_place(a), *y = known_by_place(b);

	assert_int_equal(a->n, b->n);
	assert_true(fabs(a->spacing / b->spacing - 1) < 0.01); /* a median, of what is dropped too */
	for (size_t i = 0; i < a->n; i++) {
		assert_true(mr_dist(x[i].p, y[i].p) == 0);
		assert_true(fabs(x[i].area / y[i].area - 1) < 1e-9);
		assert_true(fabs(mr_dot(x[i].normal, y[i].normal)) > 1 - 1e-9);
	}
}

static void
the_order_of_points_does_not_matter(void **state)
{
	double area;
	mr_v3 *p = points_on(MR_TORUS, N, 2, &area), *q = MR_NEW(&ctx, N, mr_v3);
	mr_volume_cloud a, b;

	(void)state;
	for (size_t i = 0; i < N; i++)
		q[i] = p[i * 1237 % N];
	a = take(p, N, 1);
	b = take(q, N, 1);
	assert_same(&a, &b);
}

/* A tenth of the points, from all over, stands for as much. */
static void
a_share_is_taken_from_everywhere(void **state)
{
	double area, sum = 0;
	mr_v3 *p = points_on(MR_SPHERE, N, 3, &area), middle = { 0, 0, 0 };
	mr_volume_cloud s = take(p, N, 0.1);

	(void)state;
	assert_int_equal(s.n, N / 10);
	for (size_t i = 0; i < s.n; i++) {
		sum += s.plane.area[i];
		middle = mr_axpy(1 / (double)s.n, s.p[i], middle);
	}
	assert_true(fabs(sum / area - 1) < 0.15);
	assert_true(mr_norm(middle) < 0.1);
}

/* Points far from all others go, and all is known of the rest as if they had never been. */
static void
points_on_no_surface_go(void **state)
{
	enum { OFF = 5 };
	double area;
	mr_v3 *p = points_on(MR_TORUS, N, 4, &area), *q = MR_NEW(&ctx, N + OFF, mr_v3);
	mr_volume_cloud all, on;

	(void)state;
	memcpy(q, p, N * sizeof *p);
	for (size_t i = 0; i < OFF; i++)
		q[N + i] = mr_vec(0, 0, -30 * (double)(i + 1)); /* the first in memory */
	on = take(p, N, 1);
	all = take(q, N + OFF, 1);
	assert_same(&all, &on);
	assert_true(mr_dist(all.box.min, on.box.min) == 0);
	for (size_t i = 0; i < all.n; i++)
		for (size_t k = 0; k < all.plane.links; k++) {
			uint32_t j = all.plane.neighbor[i * all.plane.links + k];
			assert_true(
			    j == UINT32_MAX || (j < all.n && j != i && mr_dist(all.p[i], all.p[j]) < 0.5));
		}
}

/* Normals are those of the surface, of either sign, also where it is noisy: then of more points. */
static void
planes_are_the_surfaces(void **state)
{
	(void)state;
	for (int noisy = 0; noisy < 2; noisy++) {
		mr_mesh m = shape(MR_SPHERE, 20000);
		mr_v3 *p, *normal;
		double spacing = sqrt(4 * MR_PI / N), mean = 0;
		mr_volume_cloud s;
		assert_int_equal(mr_surface_sample(&ctx, &m, N, 6, &p, &normal), MR_OK);
		mr_add_noise(p, normal, N, noisy * spacing, 7);
		s = take(p, N, 1);
		assert_true((s.noise > 1) == noisy);
		for (size_t i = 0; i < s.n; i++)
			mean += fabs(mr_dot(s.plane.normal[i], mr_unit(s.p[i]))) / (double)s.n;
		assert_true(mean > (noisy ? 0.9 : 0.99));
	}
}

static void
what_has_no_volume_is_refused(void **state)
{
	mr_v3 p[100];
	mr_volume_cloud s = { .n = 77 };

	(void)state;
	for (int i = 0; i < 100; i++)
		p[i] = mr_vec(i, 2 * i, 3 * i);
	assert_int_equal(samples_of(p, 100, 1, &s), MR_EMESH);
	for (int i = 0; i < 100; i++)
		p[i] = mr_vec(i % 10, i / 10, 3);
	assert_int_equal(samples_of(p, 100, 1, &s), MR_EMESH);
	for (int i = 0; i < 100; i++)
		p[i] = mr_vec(i % 3 == 0, i % 3 == 1, i % 3 == 2);
	assert_int_equal(samples_of(p, 100, 1, &s), MR_EMESH);
	assert_string_equal(ctx.error, "3 distinct points enclose nothing: it takes four");
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(each_place_counts_once, setup, teardown),
		cmocka_unit_test_setup_teardown(neighbours_are_near_in_memory, setup, teardown),
		cmocka_unit_test_setup_teardown(the_order_of_points_does_not_matter, setup, teardown),
		cmocka_unit_test_setup_teardown(a_share_is_taken_from_everywhere, setup, teardown),
		cmocka_unit_test_setup_teardown(points_on_no_surface_go, setup, teardown),
		cmocka_unit_test_setup_teardown(planes_are_the_surfaces, setup, teardown),
		cmocka_unit_test_setup_teardown(what_has_no_volume_is_refused, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
