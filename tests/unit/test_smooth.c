/* Smoothing against its own equations, and what must stay. */
#include "base/random.h"
#include "edit/smooth.h"
#include "op/laplace.h"
#include "op/voronoi_area.h"
#include "shape/shape.h"
#include "unit.h"

enum { SIDE = 20, N = SIDE * SIDE };

static bool
on_boundary(size_t v)
{
	return v % SIDE == 0 || v % SIDE == SIDE - 1 || v < SIDE || v >= N - SIDE;
}

static mr_mesh
bumpy_sheet(void)
{
	mr_v3 *p = MR_NEW(&ctx, N + 1, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * (SIDE - 1) * (SIDE - 1), mr_tri);
	mr_random r = { 2 };
	size_t f = 0;

	for (uint32_t i = 0; i < SIDE; i++)
		for (uint32_t j = 0; j < SIDE; j++)
			p[i * SIDE + j] = mr_vec(
			    j + 0.6 * mr_random_real(&r), i + 0.6 * mr_random_real(&r), mr_random_real(&r));
	p[N] = mr_vec(3, 3, 3); /* isolated */
	for (uint32_t i = 0; i + 1 < SIDE; i++)
		for (uint32_t j = 0; j + 1 < SIDE; j++) {
			uint32_t a = i * SIDE + j;
			t[f++] = (mr_tri){ { a, a + 1, a + SIDE + 1 } };
			t[f++] = (mr_tri){ { a, a + SIDE + 1, a + SIDE } };
		}
	return (mr_mesh){ "mesh", p, t, N + 1, f };
}

static double
energy(const mr_sparse *l, const mr_v3 *p)
{
	mr_v3 *lp = MR_NEW(&ctx, (size_t)l->n, mr_v3);
	double sum = 0;

	mr_sparse_apply(&ctx, l, NULL, (size_t)l->n, 3, &p->x, &lp->x);
	for (int i = 0; i < l->n; i++)
		sum += mr_dot(p[i], lp[i]);
	return sum;
}

/* (M + t L) p' = M p inside, pass after pass. */
static void
test_implicit_solves_its_equation(void **state)
{
	mr_mesh m = bumpy_sheet();
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3), *q = MR_NEW(&ctx, m.nv, mr_v3), *lq = MR_NEW(&ctx, m.nv, mr_v3);
	double *area = MR_NEW(&ctx, m.nv, double), t;
	mr_smooth_result found;
	mr_sparse l;

	(void)state;
	assert_int_equal(
	    mr_smooth(&ctx, &m, &(mr_smooth_opts){ MR_SMOOTH_IMPLICIT, 3, 1, true, NULL }, p, &found), MR_OK);
	assert_int_equal(
	    mr_smooth(&ctx, &m, &(mr_smooth_opts){ MR_SMOOTH_IMPLICIT, 6, 2, true, NULL }, q, NULL), MR_OK);
	assert_int_equal(mr_laplace_build(&ctx, &m, &l), MR_OK);
	mr_voronoi_areas(&ctx, &m, area);
	t = 3 * found.mean_edge * found.mean_edge;
	for (int pass = 0; pass < 2; pass++) {
		const mr_v3 *before = pass ? p : m.p, *after = pass ? q : p;
		mr_sparse_apply(&ctx, &l, NULL, m.nv, 3, &after->x, &lq->x);
		for (size_t v = 0; v < N; v++)
			if (!on_boundary(v))
				assert_true(mr_norm(mr_axpy(area[v], mr_sub(after[v], before[v]),
						mr_mul(t, lq[v]))) < 1e-7);
	}
}

static void
test_boundary_and_isolated_stay(void **state)
{
	mr_mesh m = bumpy_sheet();
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	double before;
	mr_sparse l;

	(void)state;
	assert_int_equal(mr_laplace_build(&ctx, &m, &l), MR_OK);
	before = energy(&l, m.p);
	for (int method = MR_SMOOTH_IMPLICIT; method <= MR_SMOOTH_TAUBIN; method++) {
		double after;
		assert_int_equal(
		    mr_smooth(&ctx, &m, &(mr_smooth_opts){ method, 5, 0, true, NULL }, p, NULL), MR_OK);
		for (size_t v = 0; v <= N; v++)
			if (v == N || on_boundary(v))
				assert_memory_equal(&p[v], &m.p[v], sizeof *p);
		after = energy(&l, p);
		assert_true(after < before && after > 0.3 * before);
	}
}

static void
test_nothing_to_do(void **state)
{
	mr_v3 p[3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, q[3];
	mr_tri t = { { 0, 1, 2 } };
	mr_mesh one = { "mesh", p, &t, 3, 1 };

	(void)state;
	for (int method = MR_SMOOTH_IMPLICIT; method <= MR_SMOOTH_TAUBIN; method++) {
		assert_int_equal(
		    mr_smooth(&ctx, &one, &(mr_smooth_opts){ method, 2, 0, true, NULL }, q, NULL), MR_OK);
		assert_memory_equal(p, q, sizeof p);
	}
	p[1] = p[2] = p[0]; /* no edge has a length */
	assert_int_equal(mr_smooth(&ctx, &one, &(mr_smooth_opts)MR_SMOOTH_DEFAULTS, q, NULL), MR_OK);
	assert_memory_equal(p, q, sizeof p);
	assert_int_equal(
	    mr_smooth(&ctx, &one, &(mr_smooth_opts){ MR_SMOOTH_TAUBIN, 10, 39, true, NULL }, q, NULL),
	    MR_EUSAGE);
}

/* A solid of about n vertices, stretched. */
static mr_mesh
stretched(mr_solid solid, size_t n, mr_v3 by)
{
	mr_make_opts o = MR_MAKE_DEFAULTS;
	mr_v3 *p;
	mr_mesh m;

	o.solid = solid;
	o.vertices = n;
	assert_int_equal(mr_solid_make(&ctx, &o, &m), MR_OK);
	p = MR_NEW(&ctx, m.nv, mr_v3);
	for (size_t v = 0; v < m.nv; v++)
		p[v] = mr_vec(by.x * m.p[v].x, by.y * m.p[v].y, by.z * m.p[v].z);
	m.p = p;
	return m;
}

/* However long, a rod is smoothed no longer than fits its radius, and a plate than fits its thickness; as in
 * the paper both are gone. */
static void
test_bodies_stay(void **state)
{
	const mr_smooth_opts bounded = { MR_SMOOTH_IMPLICIT, 1e4, 1, false, NULL };
	const mr_smooth_opts plain = { MR_SMOOTH_IMPLICIT, 1e4, 1, true, NULL };
	mr_mesh rod = stretched(MR_CYLINDER, 8000, mr_vec(1, 1, 10));
	mr_mesh plate = stretched(MR_CUBE, 8000, mr_vec(1, 1, 0.02));
	mr_v3 *p = MR_NEW(&ctx, rod.nv + plate.nv, mr_v3);
	double high = mr_box_of(rod.p, rod.nv).max.z;
	mr_smooth_result found;

	(void)state;
	assert_int_equal(mr_smooth(&ctx, &rod, &bounded, p, &found), MR_OK);
	assert_int_equal(found.bounded, rod.nv);
	for (size_t v = 0; v < rod.nv; v++)
		if (fabs(rod.p[v].z - high / 2) < high / 4) /* 1 / (1 + t / r^2), t = 0.01 (2 r)^2 */
			assert_true(fabs(hypot(p[v].x, p[v].y) - 1 / 1.04) < 2e-3);
	assert_true(found.volume > 0.9 && found.area > 0.94);
	assert_int_equal(mr_smooth(&ctx, &plate, &bounded, p, &found), MR_OK);
	assert_true(found.volume > 0.95 && found.area > 0.95);
	assert_int_equal(mr_smooth(&ctx, &plate, &plain, p, &found), MR_OK);
	assert_true(found.bounded == 0 && found.area < 0.1);
	assert_int_equal(mr_smooth(&ctx, &rod, &plain, p, &found), MR_OK);
	assert_true(found.volume < 0.1);
}

/* The mesh with `count` of its faces cut in three at a point that is nearly on one of their edges. */
static mr_mesh
with_slivers(mr_mesh m, size_t count)
{
	mr_v3 *p = MR_NEW(&ctx, m.nv + count, mr_v3);
	mr_tri *t = MR_NEW(&ctx, m.nf + 2 * count, mr_tri);
	mr_random random = { 7 };

	memcpy(p, m.p, m.nv * sizeof *p);
	memcpy(t, m.t, m.nf * sizeof *t);
	for (size_t i = 0; i < count; i++) {
		mr_tri *cut = &t[mr_random_bits(&random) % m.nf];
		uint32_t a = cut->v[0], b = cut->v[1], c = cut->v[2], q = (uint32_t)(m.nv + i);
		mr_v3 middle = mr_lerp(0.5, p[a], p[b]);
		p[q] = mr_lerp(1e-9, middle, p[c]);
		*cut = (mr_tri){ { a, b, q } };
		t[m.nf + 2 * i] = (mr_tri){ { b, c, q } };
		t[m.nf + 2 * i + 1] = (mr_tri){ { c, a, q } };
	}
	return (mr_mesh){ "slivers", p, t, m.nv + count, m.nf + 2 * count };
}

/* Slivers make factors of the Laplacian fail; with all of its diagonal raised there were 531 iterations, and
 * there are 284. */
static void
test_slivers_take_few_iterations(void **state)
{
	mr_mesh m = with_slivers(stretched(MR_BUMPY, 2000, mr_vec(1, 1, 1)), 200);
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	mr_smooth_result found;

	(void)state;
	assert_int_equal(mr_smooth(&ctx, &m, &(mr_smooth_opts)MR_SMOOTH_DEFAULTS, p, &found), MR_OK);
	assert_true(found.iterations < 350);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_implicit_solves_its_equation, setup, teardown),
		cmocka_unit_test_setup_teardown(test_boundary_and_isolated_stay, setup, teardown),
		cmocka_unit_test_setup_teardown(test_nothing_to_do, setup, teardown),
		cmocka_unit_test_setup_teardown(test_bodies_stay, setup, teardown),
		cmocka_unit_test_setup_teardown(test_slivers_take_few_iterations, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
