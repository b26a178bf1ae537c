/* Signs of normals: of surfaces whose right ones are known, from any signs and votes of which most are right.
 */
#include "shapes.h"
#include "volume/parts.h"

enum { LINKS = 8, NEAREST = 16 };

static size_t untold;

/* Points of a surface with their planes, as they come, and the surface's own normals. */
static mr_volume_cloud
sampled(const mr_mesh *m, size_t n, uint64_t seed, mr_v3 **truth)
{
	mr_volume_cloud s = { .n = n };

	assert_int_equal(mr_surface_sample(&ctx, m, n, seed, &s.p, truth), MR_OK);
	assert_int_equal(mr_cloud_planes(&ctx, s.p, n, NEAREST, LINKS, true, &s.plane), MR_OK);
	s.depth = MR_NEW_ZERO(&ctx, n, uint8_t);
	s.box = mr_box_of(s.p, n);
	return s;
}

/* Random signs; what each point says of its own: as much as `sure`, and wrongly by a share. */
static double *
vote(mr_volume_cloud *s, const mr_v3 *truth, mr_random *r, double sure, double wrong)
{
	double *v = MR_NEW(&ctx, s->n, double);

	for (size_t i = 0; i < s->n; i++) {
		bool right;
		if (mr_random_bits(r) % 2)
			s->plane.normal[i] = mr_mul(-1, s->plane.normal[i]);
		right = mr_dot(s->plane.normal[i], truth[i]) > 0;
		v[i] = sure * (right == (mr_random_real(r) >= wrong) ? 1 : -1);
	}
	return v;
}

static size_t
count_wrong(const mr_volume_cloud *s, const mr_v3 *truth)
{
	size_t wrong = 0;

	for (size_t i = 0; i < s->n; i++)
		wrong += mr_dot(s->plane.normal[i], truth[i]) <= 0;
	return wrong;
}

/* On smooth surfaces all are right, of any random signs, where four of ten votes are wrong. */
static void
most_votes_orient_a_smooth_surface(void **state)
{
	static const mr_solid solids[] = { MR_SPHERE, MR_TORUS, MR_KNOT };

	(void)state;
	for (uint64_t seed = 1; seed < 10; seed++) {
		mr_mesh m = shape(solids[seed % 3], 20000);
		mr_random r = { seed };
		mr_v3 *truth;
		mr_volume_cloud s = sampled(&m, 4000, seed, &truth);
		double *v = vote(&s, truth, &r, 0.01 * (double)seed, 0.4);
		assert_int_equal(mr_volume_orient(&ctx, &s, v, NULL, false, &untold), MR_OK);
		assert_int_equal(count_wrong(&s, truth), 0);
		mr_ctx_free(&ctx);
	}
}

/* Where most say the opposite, all are the opposite: the votes decide, not the signs at the begin. */
static void
votes_and_not_signs_decide(void **state)
{
	mr_mesh m = shape(MR_TORUS, 20000);
	mr_random r = { 1 };
	mr_v3 *truth;
	mr_volume_cloud s = sampled(&m, 3000, 1, &truth);
	double *v = vote(&s, truth, &r, 0.05, 0.7);

	(void)state;
	for (size_t i = 0; i < s.n; i++)
		assert_true(fabs(mr_norm(s.plane.normal[i]) - 1) < 1e-12);
	assert_int_equal(mr_volume_orient(&ctx, &s, v, NULL, false, &untold), MR_OK);
	assert_int_equal(count_wrong(&s, truth), s.n);
	for (size_t i = 0; i < s.n; i++)
		assert_true(fabs(mr_norm(s.plane.normal[i]) - 1) < 1e-12);
}

/* Two surfaces that nothing links are oriented each by its own votes. */
static void
parts_that_are_apart_have_votes_of_their_own(void **state)
{
	mr_mesh one = shape(MR_SPHERE, 10000), m = both(&one, &one, mr_vec(5, 0, 0));
	mr_random r = { 2 };
	mr_v3 *truth;
	mr_volume_cloud s = sampled(&m, 4000, 2, &truth);
	double *v = vote(&s, truth, &r, 0.1, 0.3);

	(void)state;
	for (size_t i = 0; i < s.n; i++)
		if (s.p[i].x > 2) {
			v[i] = -v[i];
			truth[i] = mr_mul(-1, truth[i]);
		}
	assert_int_equal(mr_volume_orient(&ctx, &s, v, NULL, false, &untold), MR_OK);
	assert_int_equal(count_wrong(&s, truth), 0);
}

/* Signs pass around a sharp rim: of two cones back to back, the lower one follows the upper. */
static void
signs_pass_around_a_rim(void **state)
{
	enum { RIM = 24 };
	mr_v3 p[RIM + 2];
	mr_tri t[2 * RIM];
	mr_mesh m = { "cones", p, t, RIM + 2, 2 * RIM };

	for (uint32_t i = 0; i < RIM; i++) {
		double a = 2 * MR_PI * i / RIM;
		p[i] = mr_vec(cos(a), sin(a), 0);
		t[2 * i] = (mr_tri){ { i, (i + 1) % RIM, RIM } };
		t[2 * i + 1] = (mr_tri){ { (i + 1) % RIM, i, RIM + 1 } };
	}
	p[RIM] = mr_vec(0, 0, 0.8);
	p[RIM + 1] = mr_vec(0, 0, -0.8);
	(void)state;
	for (uint64_t seed = 1; seed < 6; seed++) {
		mr_random r = { seed };
		mr_v3 *truth;
		mr_volume_cloud s = sampled(&m, 4000, seed, &truth);
		double *v = vote(&s, truth, &r, 0.05, 0);
		for (size_t i = 0; i < s.n; i++)
			v[i] *= truth[i].z > 0;
		assert_int_equal(mr_volume_orient(&ctx, &s, v, NULL, false, &untold), MR_OK);
		assert_true(count_wrong(&s, truth) < s.n / 200); /* on the rim itself */
	}
}

/* Parts that are sure do not follow their neighbours: the halves of a sphere, each sure of the opposite. */
static void
parts_that_are_sure_stay_apart(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 20000);
	mr_random r = { 3 };
	mr_v3 *truth;
	mr_volume_cloud s = sampled(&m, 4000, 3, &truth);
	double *v = vote(&s, truth, &r, 1, 0), *flood = MR_NEW(&ctx, s.n, double);

	(void)state;
	for (size_t i = 0; i < s.n; i++)
		if (s.p[i].z < 0) {
			v[i] = -v[i];
			truth[i] = mr_mul(-1, truth[i]);
		}
	for (size_t i = 0; i < s.n; i++)
		flood[i] = 1.1; /* 0.05 of it on the other side */
	assert_int_equal(mr_volume_orient(&ctx, &s, v, flood, true, &untold), MR_OK);
	assert_true(
	    count_wrong(&s, truth) < s.n / 100); /* along the equator they may take the other's side */
}

/* But they do follow them where that is not asked for, and where the flood is on both sides. */
static void
unsure_parts_stay_together(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 20000);
	mr_random r = { 3 };
	mr_v3 *truth;
	mr_volume_cloud s = sampled(&m, 4000, 3, &truth);
	double *flood = MR_NEW(&ctx, s.n, double);

	(void)state;
	for (size_t i = 0; i < s.n; i++)
		flood[i] = 2;
	for (int apart = 0; apart < 2; apart++) {
		double *v = vote(&s, truth, &r, 1, 0);
		for (size_t i = 0; i < s.n; i++)
			v[i] *= s.p[i].z < -0.3 ? -1 : 1;
		assert_int_equal(mr_volume_orient(&ctx, &s, v, flood, apart, &untold), MR_OK);
		assert_int_equal(count_wrong(&s, truth), 0);
	}
}

/* A third of the directions has no length, a third is no number; the others are right, of any length. */
static void
directions_tell_sides(void **state)
{
	enum { N = 3000 };
	mr_mesh m = shape(MR_TORUS, 2000);
	mr_v3 *truth, *toward = MR_NEW(&ctx, N, mr_v3);
	mr_volume_cloud s = sampled(&m, N, 5, &truth);
	mr_volume_sides j;
	mr_random r = { 3 };

	(void)state;
	(void)vote(&s, truth, &r, 1, 0);
	for (size_t i = 0; i < N; i++)
		toward[i] = i % 3 == 0   ? mr_vec(0, 0, 0)
		            : i % 3 == 1 ? mr_vec(NAN, 1, 0)
		                         : mr_mul(1e-3 * (double)i, truth[i]);
	j = mr_volume_judge(&s, toward);
	assert_int_equal(j.told, N / 3);
	assert_true(j.near == 1 && j.alike == 1);
	assert_int_equal(mr_volume_orient_toward(&ctx, &s, toward, &untold), MR_OK);
	assert_int_equal(count_wrong(&s, truth), 0);
}

/* Directions that are all one lie along the planes or not, by chance, and tell neighbours the same side; of
 * any sign they lie along them and tell any side; none tell nothing. */
static void
directions_are_judged(void **state)
{
	enum { N = 4000 };
	mr_mesh m = shape(MR_SPHERE, 2000);
	mr_v3 *truth, *toward = MR_NEW_ZERO(&ctx, N, mr_v3);
	mr_volume_cloud s = sampled(&m, N, 6, &truth);
	mr_random r = { 4 };
	mr_volume_sides j;

	(void)state;
	j = mr_volume_judge(&s, toward);
	assert_true(j.told == 0 && isnan(j.near) && isnan(j.alike));
	for (size_t i = 0; i < N; i++)
		toward[i] = mr_vec(0, 0, 2);
	j = mr_volume_judge(&s, toward);
	assert_float_equal(j.near, 0.5, 0.03);
	assert_true(j.alike > 0.98);
	for (size_t i = 0; i < N; i++)
		toward[i] = mr_random_bits(&r) % 2 ? truth[i] : mr_mul(-1, truth[i]);
	j = mr_volume_judge(&s, toward);
	assert_true(j.near == 1);
	assert_float_equal(j.alike, 0.5, 0.03);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(directions_tell_sides, setup, teardown),
		cmocka_unit_test_setup_teardown(directions_are_judged, setup, teardown),
		cmocka_unit_test_setup_teardown(most_votes_orient_a_smooth_surface, setup, teardown),
		cmocka_unit_test_setup_teardown(votes_and_not_signs_decide, setup, teardown),
		cmocka_unit_test_setup_teardown(
		    parts_that_are_apart_have_votes_of_their_own, setup, teardown),
		cmocka_unit_test_setup_teardown(signs_pass_around_a_rim, setup, teardown),
		cmocka_unit_test_setup_teardown(parts_that_are_sure_stay_apart, setup, teardown),
		cmocka_unit_test_setup_teardown(unsure_parts_stay_together, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
