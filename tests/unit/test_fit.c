/* Fitting: what a limit surface can take on is found again, whatever the start; what no point holds stays. */
#include "base/random.h"
#include "fit/fit.h"
#include "fit/guard.h"
#include "mesh/fold.h"
#include "shapes.h"
#include "space/self_intersect.h"

/* The mesh with its vertices moved at random by up to `most` in each coordinate. */
static mr_mesh
shaken(mr_mesh m, double most)
{
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	mr_random r = { 7 };

	for (size_t v = 0; v < m.nv; v++)
		p[v] = mr_add(
		    m.p[v], mr_mul(2 * most, mr_vec(mr_random_real(&r) - 0.5, mr_random_real(&r) - 0.5,
						 mr_random_real(&r) - 0.5)));
	m.p = p;
	return m;
}

/* The limit points of level n. */
static size_t
limit_points(const mr_mesh *m, size_t n, mr_v3 **points)
{
	mr_loop *level = MR_NEW(&ctx, n + 1, mr_loop);
	mr_sparse s;

	assert_int_equal(mr_loop_levels(&ctx, m, 180, NULL, n, level), MR_OK);
	assert_int_equal(mr_loop_limit_matrix(&ctx, level, n, &s), MR_OK);
	*points = MR_NEW(&ctx, level[n].nv, mr_v3);
	for (size_t v = 0; v < level[n].nv; v++) {
		mr_v3 sum = { 0, 0, 0 };
		for (int e = s.start[v]; e < s.start[v + 1]; e++)
			sum = mr_axpy(s.value[e], m->p[s.index[e]], sum);
		(*points)[v] = sum;
	}
	return level[n].nv;
}

/* The points of a limit surface, to which a control mesh beside it is fitted back: to the third order of a
 * triangle of level 1. */
static void
test_surface_is_found_again(void **state)
{
	static const mr_solid solid[] = { MR_SPHERE, MR_TORUS, MR_PLANE };
	static const double rms[] = { 5e-4, 5e-4, 1e-5 }; /* of a start at 1e-2 */

	(void)state;
	for (size_t i = 0; i < sizeof solid / sizeof *solid; i++) {
		mr_mesh m = shape(solid[i], 100), near = shaken(m, 0.03);
		mr_v3 *point, *out = MR_NEW(&ctx, m.nv, mr_v3);
		size_t n = limit_points(&m, 3, &point);
		mr_fit_opts o = MR_FIT_DEFAULTS;
		mr_fit_result found;
		o.fairness = 1e-6;
		o.iterations = 20;
		assert_int_equal(mr_fit(&ctx, &near, NULL, point, n, false, NULL, &o, out, &found), MR_OK);
		assert_true(found.distance_rms_before > 5e-3);
		assert_true(found.distance_rms_after < rms[i]);
	}
}

/* n points at random on the unit sphere, above the height. */
static mr_v3 *
sphere_points(size_t n, double above)
{
	mr_v3 *p = MR_NEW(&ctx, n, mr_v3);
	mr_random r = { 11 };

	for (size_t i = 0; i < n;) {
		mr_v3 q = mr_vec(
		    2 * mr_random_real(&r) - 1, 2 * mr_random_real(&r) - 1, 2 * mr_random_real(&r) - 1);
		double d = mr_norm(q);
		if (d > 0.1 && d < 1 && q.z / d > above)
			p[i++] = mr_mul(1 / d, q);
	}
	return p;
}

static mr_mesh
icosahedron(void)
{
	static const double g = 1.618033988749895;
	static const mr_tri t[20] = { { { 0, 11, 5 } }, { { 0, 5, 1 } }, { { 0, 1, 7 } }, { { 0, 7, 10 } },
		{ { 0, 10, 11 } }, { { 1, 5, 9 } }, { { 5, 11, 4 } }, { { 11, 10, 2 } }, { { 10, 7, 6 } },
		{ { 7, 1, 8 } }, { { 3, 9, 4 } }, { { 3, 4, 2 } }, { { 3, 2, 6 } }, { { 3, 6, 8 } },
		{ { 3, 8, 9 } }, { { 4, 9, 5 } }, { { 2, 4, 11 } }, { { 6, 2, 10 } }, { { 8, 6, 7 } },
		{ { 9, 8, 1 } } };
	static mr_v3 p[12];

	for (int i = 0; i < 4; i++) {
		double a = i % 2 ? 1 : -1, b = i / 2 ? -g : g;
		p[i] = mr_vec(a, b, 0);
		p[4 + i] = mr_vec(0, a, b);
		p[8 + i] = mr_vec(b, 0, a);
	}
	return (mr_mesh){ "control", p, t, 12, 20 };
}

/* An icosahedron's limit surface is one of a single radius where it comes closest to the sphere. */
static void
test_icosahedron_becomes_the_best_sphere(void **state)
{
	mr_mesh m = icosahedron();
	mr_v3 out[12], *point = sphere_points(4000, -2);

	(void)state;
	assert_int_equal(
	    mr_fit(&ctx, &m, NULL, point, 4000, false, NULL, &(mr_fit_opts)MR_FIT_DEFAULTS, out, NULL),
	    MR_OK);
	for (int v = 0; v < 12; v++) {
		assert_true(fabs(mr_norm(out[v]) / mr_norm(out[0]) - 1) < 2e-2);
		assert_true(mr_dist(mr_unit(out[v]), mr_unit(m.p[v])) < 2e-2);
	}
}

/* Where there are no points the surface stays: the lower half of a sphere of another radius. */
static void
test_what_has_no_points_stays(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 300);
	mr_v3 *point = sphere_points(4000, 0.2), *out = MR_NEW(&ctx, m.nv, mr_v3);
	mr_fit_result found;
	double most = 0;

	(void)state;
	assert_int_equal(
	    mr_fit(&ctx, &m, NULL, point, 4000, false, NULL, &(mr_fit_opts)MR_FIT_DEFAULTS, out, &found),
	    MR_OK);
	for (size_t v = 0; v < m.nv; v++)
		most = m.p[v].z < -0.3 ? fmax(most, mr_dist(out[v], m.p[v])) : most;
	assert_true(found.distance_rms_after < 1e-3);
	assert_true(most < 0.1);
}

/* Outliers pull little: a fiftieth of the points anywhere. */
static void
test_outliers_pull_little(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 300);
	mr_v3 *point = sphere_points(5000, -2), *out = MR_NEW(&ctx, m.nv, mr_v3);
	mr_random r = { 5 };
	mr_fit_surface s;
	double most = 0;

	(void)state;
	for (size_t i = 0; i < 5000; i += 50)
		point[i] = mr_mul(0.2 + 1.5 * mr_random_real(&r), point[i]);
	assert_int_equal(
	    mr_fit(&ctx, &m, NULL, point, 5000, false, NULL, &(mr_fit_opts)MR_FIT_DEFAULTS, out, NULL),
	    MR_OK);
	m.p = out;
	assert_int_equal(mr_fit_surface_build(&ctx, &m, NULL, &s), MR_OK);
	for (size_t v = 0; v < s.m.nv; v++)
		most = fmax(most, fabs(mr_norm(s.node[v]) - 1));
	assert_true(most < 2e-2);
}

/* Of a sphere's vertices all are to go outward a little, but one far to the side: what is on the other half
 * gets there, and nothing folds or passes through itself. */
static void
test_steps_fold_nothing(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 400), to = m;
	mr_v3 *x = MR_NEW(&ctx, m.nv, mr_v3), *z = MR_NEW(&ctx, m.nv, mr_v3);
	mr_fit_surface s;
	mr_fit_guard *guard;
	size_t pairs;

	(void)state;
	for (size_t v = 0; v < m.nv; v++) {
		x[v] = m.p[v];
		z[v] = mr_mul(0.01, m.p[v]);
	}
	z[0] = mr_mul(12, mr_unit(mr_cross(m.p[0], mr_vec(m.p[0].y, m.p[0].z, m.p[0].x))));
	assert_int_equal(mr_fit_surface_build(&ctx, &m, NULL, &s), MR_OK);
	assert_int_equal(mr_fit_guard_new(&ctx, &s, x, &guard), MR_OK);
	assert_int_equal(mr_fit_step(&ctx, guard, x, z), MR_OK);
	assert_true(mr_dist(x[0], m.p[0]) > 0);
	for (size_t v = 0; v < m.nv; v++)
		if (mr_dot(m.p[v], m.p[0]) < 0)
			assert_true(mr_dist(x[v], mr_mul(1.01, m.p[v])) < 1e-12);
	to.p = x;
	assert_int_equal(mr_count_folds(&ctx, &to, s.level[0].topo.twin), 0);
	mr_self_intersections(&ctx, NULL, &to, NULL, &pairs);
	assert_int_equal(pairs, 0);
	assert_int_equal(mr_fit_crossing(guard), 0);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_surface_is_found_again, setup, teardown),
		cmocka_unit_test_setup_teardown(test_icosahedron_becomes_the_best_sphere, setup, teardown),
		cmocka_unit_test_setup_teardown(test_what_has_no_points_stays, setup, teardown),
		cmocka_unit_test_setup_teardown(test_outliers_pull_little, setup, teardown),
		cmocka_unit_test_setup_teardown(test_steps_fold_nothing, setup, teardown),
	};
	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
