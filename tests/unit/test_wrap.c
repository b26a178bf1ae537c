/* The parts of the shrink-wrapping: the guard of moves, coverage, openings, and want of memory. */
#include "mesh/guarded_move.h"
#include "shapes.h"
#include "wrap/parts.h"

/* A box from the origin on, of n^2 squares of two triangles a side. */
static mr_mesh
box(size_t n, mr_v3 size)
{
	mr_mesh m = shape(MR_CUBE, 6 * n * n + 2);

	for (size_t v = 0; v < m.nv; v++) {
		mr_v3 p = mr_mul(0.5, mr_add(m.p[v], mr_vec(1, 1, 1)));
		((mr_v3 *)m.p)[v] = mr_vec(size.x * p.x, size.y * p.y, size.z * p.z);
	}
	return m;
}

/* The middle of a side that would go through the box stays; that of the opposite side, outward, goes. */
static void
test_moves_turn_no_face(void **state)
{
	mr_mesh m = shape(MR_CUBE, 26);
	mr_v3 *to;
	mr_dyn d;

	(void)state;
	assert_int_equal(mr_wrap_dyn(&ctx, &m, &d), MR_OK);
	to = MR_NEW(&ctx, d.nv, mr_v3);
	assert_non_null(to);
	for (size_t v = 0; v < d.nv; v++)
		to[v] = mr_norm(d.p[v]) > 1 ? d.p[v]
		                            : mr_vec(d.p[v].x > 0 ? -5 : 1.2 * d.p[v].x, d.p[v].y, d.p[v].z);
	assert_int_equal(mr_move_unfolded(&ctx, &m, &(mr_topology){ d.twin, d.out }, 0.02, to), MR_OK);
	for (size_t v = 0; v < d.nv; v++)
		assert_true(to[v].x == (mr_norm(m.p[v]) > 1 || m.p[v].x >= 0 ? m.p[v].x : -1.2));
}

/* The vertex in the middle of a box's top, drawn through its bottom, comes back; what is far from it stays.
 */
static void
test_crossings_are_taken_back(void **state)
{
	mr_mesh m = box(16, mr_vec(1, 1, 0.25)), drawn;
	mr_wrap_cover c;
	mr_wrap_cloud cloud;
	mr_dyn d;

	(void)state;
	assert_int_equal(mr_wrap_cloud_open(&ctx, m.p, m.nv, NULL, &cloud), MR_OK);
	assert_int_equal(mr_wrap_dyn(&ctx, &m, &d), MR_OK);
	for (size_t v = 0; v < d.nv; v++) {
		if (mr_dist(m.p[v], mr_vec(0.5, 0.5, 0.25)) < 1e-9)
			d.p[v].z = -0.5;
		else if (m.p[v].x == 0)
			d.p[v].x = -0.01;
	}
	drawn = mr_dyn_view(&d, "control");
	assert_int_equal(mr_wrap_measure(&ctx, &cloud, &drawn, 1, &c), MR_OK);
	assert_true(c.crossings > 0);
	assert_int_equal(mr_wrap_part(&ctx, m.p, &d), MR_OK);
	for (size_t v = 0; v < d.nv; v++)
		assert_true(d.p[v].z > 0 || m.p[v].z == 0);
	for (size_t v = 0; v < d.nv; v++)
		assert_true(m.p[v].x > 0 || d.p[v].x == -0.01);
	assert_int_equal(mr_wrap_measure(&ctx, &cloud, &drawn, 1, &c), MR_OK);
	assert_int_equal(c.crossings, 0);
}

/* Points on a cube, a wrap of it, and one that is longer and lacks a side of the cube. */
static void
test_coverage_goes_both_ways(void **state)
{
	mr_mesh m = box(4, mr_vec(1, 1, 1)), far = box(4, mr_vec(1, 1, 3));
	mr_wrap_cloud cloud;
	mr_wrap_cover c;

	(void)state;
	assert_int_equal(mr_wrap_cloud_open(&ctx, m.p, m.nv, NULL, &cloud), MR_OK);
	assert_int_equal(mr_wrap_measure(&ctx, &cloud, &m, 1 << 20, &c), MR_OK);
	assert_true(c.gaps.points.max < 1e-15 && c.gaps.surface.max < 0.25);
	assert_int_equal(mr_wrap_measure(&ctx, &cloud, &far, 1 << 20, &c), MR_OK);
	assert_true(fabs(c.gaps.points.max - 0.5) < 1e-12); /* the middle of the side that is not there */
	assert_true(c.gaps.surface.max > 2 && c.gaps.surface.max < 2.25);
}

/* A lattice of points, edges one long, of which those within `hole` of the middle are left out; a flat mesh
 * over it and beyond, and what is cut out of it. */
static mr_wrap_lids
cut_over_a_hole(double hole, int how, mr_mesh *m)
{
	mr_mesh points = lattice(60);
	mr_v3 middle = mr_lerp(0.5, points.p[0], points.p[points.nv - 1]);
	mr_wrap_lids lids = { 0 };
	mr_wrap_cloud cloud;
	mr_v3 *p = MR_NEW(&ctx, points.nv, mr_v3);
	size_t n = 0;

	assert_non_null(p);
	for (size_t v = 0; v < points.nv; v++)
		if (mr_dist(points.p[v], middle) > hole) {
			p[n++] = points.p[v];
			p[n - 1].z += 0.01 * (double)(v % 7); /* in a plane they would enclose nothing */
		}
	assert_int_equal(mr_wrap_cloud_open(&ctx, p, n, NULL, &cloud), MR_OK);
	*m = lattice(80);
	for (size_t v = 0; v < m->nv; v++)
		((mr_v3 *)m->p)[v] = mr_add(m->p[v], mr_mul(-10, mr_vec(1.5, sqrt(0.75), 0)));
	assert_int_equal(mr_wrap_cut(&ctx, &cloud, how, false, m, &lids), MR_OK);
	return lids;
}

/* The rim around the points is an opening; a hole in them is from eight spacings on, or five where all are.
 */
static void
test_wide_openings_are_cut_out(void **state)
{
	static const struct {
		double hole;
		int how;
		size_t loops, holes, doubtful;
	} cases[] = {
		{ 0, MR_LIDS_AUTO, 1, 0, 0 },
		{ 1.5, MR_LIDS_AUTO, 1, 0, 0 },
		{ 1.5, MR_LIDS_NONE, 1, 0, 0 },
		{ 3.2, MR_LIDS_AUTO, 1, 1, 1 },
		{ 3.2, MR_LIDS_NONE, 2, 0, 0 },
		{ 4.6, MR_LIDS_AUTO, 2, 0, 1 },
		{ 6, MR_LIDS_AUTO, 2, 0, 0 },
		{ 8, MR_LIDS_AUTO, 2, 0, 0 },
	};

	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		mr_mesh m;
		mr_wrap_lids lids = cut_over_a_hole(cases[i].hole, cases[i].how, &m);
		mr_census c = census_of(&m);
		assert_true(c.manifold && c.oriented && c.components == 1);
		assert_int_equal(c.boundary_loops, cases[i].loops);
		assert_int_equal(lids.openings, cases[i].loops);
		assert_int_equal(lids.holes, cases[i].holes);
		assert_int_equal(lids.doubtful, cases[i].doubtful);
		assert_int_equal(lids.width > 0, cases[i].doubtful);
	}
}

/* Caps of a sphere, from a height on: those that are not too steep, nor too noisy, are height fields. */
static void
test_sheets_are_told_from_bodies(void **state)
{
	static const struct {
		double from, noise;
		bool is_sheet;
	} cases[] = {
		{ 0.5, 0, true },
		{ 0.3, 0, true },
		{ -0.5, 0, false },
		{ -2, 0, false },
		{ 0.5, 0.1, false },
	};

	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		enum { MANY = 4000 };
		mr_random r = { 5 };
		mr_wrap_cloud cloud;
		mr_v3 *p = MR_NEW(&ctx, MANY, mr_v3);
		mr_wrap_field *field;
		size_t fields;
		size_t n = 0;
		assert_non_null(p);
		while (n < MANY) {
			mr_v3 q = random_vector(&r);
			double off = cases[i].noise * (mr_random_real(&r) - 0.5);
			if (mr_norm(q) > 0.5 || mr_norm(q) < 0.1 || q.z < cases[i].from * mr_norm(q))
				continue;
			p[n++] = mr_mul((1 + off) / mr_norm(q), q);
		}
		assert_int_equal(mr_wrap_cloud_open(&ctx, p, n, NULL, &cloud), MR_OK);
		cloud.sides = NULL;
		assert_int_equal(mr_wrap_find_fields(&ctx, &cloud, &field, &fields), MR_OK);
		assert_int_equal(fields, cases[i].is_sheet);
		assert_true(fields == 0 || fabs(field->axis[2].z) > 0.99);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_moves_turn_no_face, setup, teardown),
		cmocka_unit_test_setup_teardown(test_crossings_are_taken_back, setup, teardown),
		cmocka_unit_test_setup_teardown(test_coverage_goes_both_ways, setup, teardown),
		cmocka_unit_test_setup_teardown(test_wide_openings_are_cut_out, setup, teardown),
		cmocka_unit_test_setup_teardown(test_sheets_are_told_from_bodies, setup, teardown),
	};
	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
