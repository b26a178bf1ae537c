/* Fitting: what a limit surface can take on is found again, whatever the start; what no point holds stays. */
#include "alg/fit.h"
#include "alg/fit_surface.h"
#include "alg/shape.h"
#include "base/random.h"
#include "unit.h"

static mr_mesh
shape(mr_solid solid, size_t n)
{
	mr_mesh m;
	mr_solid_opts o = MR_SOLID_DEFAULTS;

	o.solid = solid;
	o.vertices = n;
	assert_int_equal(mr_solid_make(&ctx, &o, &m), MR_OK);
	return m;
}

static double
figure(const char *name)
{
	for (size_t i = 0; i < ctx.stat_count; i++)
		if (!strcmp(ctx.stats[i].name, name))
			return ctx.stats[i].value;
	return NAN;
}

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

	assert_int_equal(mr_loop_levels(&ctx, m, 180, n, level), MR_OK);
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

/* The points of a limit surface, to which a control mesh beside it is fitted back. */
static void
test_surface_is_found_again(void **state)
{
	static const mr_solid solid[] = { MR_SPHERE, MR_TORUS, MR_PLANE };

	(void)state;
	for (size_t i = 0; i < sizeof solid / sizeof *solid; i++) {
		mr_mesh m = shape(solid[i], 100), near = shaken(m, 0.03);
		mr_v3 *point, *out = MR_NEW(&ctx, m.nv, mr_v3);
		size_t n = limit_points(&m, 2, &point);
		mr_fit_opts o = MR_FIT_DEFAULTS;
		o.fairness = 1e-6;
		o.iterations = 20;
		assert_int_equal(mr_fit(&ctx, &near, point, n, &o, out), MR_OK);
		print_message("%zu: max %g %g mean %g rms %g damped %g cg %g\n", i,
		    figure("distance_max_before"), figure("distance_max_after"),
		    figure("distance_mean_after"), figure("distance_rms_after"), figure("damped"),
		    figure("cg_steps"));
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_surface_is_found_again, setup, teardown),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
