/* Meshes cut along a line: how much is left, of what topology. */
#include "mesh/clip.h"
#include "shapes.h"

/* What is below a plane across the z axis. */
static mr_mesh
clipped(const mr_mesh *m, double above)
{
	double *value = MR_NEW(&ctx, m->nv, double);
	mr_mesh out;

	assert_non_null(value);
	for (size_t v = 0; v < m->nv; v++)
		value[v] = m->p[v].z - above;
	mr_mesh_clip(&ctx, m, value, &out);
	return out;
}

static void
test_half_a_sphere_has_a_loop_along_the_plane(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 2000), out = clipped(&m, 0.0123);
	mr_census c = census_of(&out);
	mr_edges edges;
	bool *boundary = MR_NEW(&ctx, out.nv, bool);

	(void)state;
	assert_true(c.manifold && c.oriented && c.isolated_vertices == 0 && c.degenerate_faces == 0);
	assert_int_equal(c.euler, 1);
	assert_int_equal(c.boundary_loops, 1);
	assert_true(fabs(mr_mesh_area(&ctx, &out) / mr_mesh_area(&ctx, &m) - (1 + 0.0123) / 2) < 0.005);
	mr_edges_build(&ctx, &out, &edges);
	assert_non_null(boundary);
	memset(boundary, 0, out.nv);
	mr_mark_boundary(&out, &edges, boundary);
	for (size_t v = 0; v < out.nv; v++)
		assert_true(boundary[v] ? fabs(out.p[v].z - 0.0123) < 0.005 : out.p[v].z < 0.0123);
}

static void
test_a_cut_torus_is_a_ring_or_two(void **state)
{
	mr_mesh m = shape(MR_TORUS, 3000);
	double low = 0, high = 0;

	(void)state;
	for (size_t v = 0; v < m.nv; v++) {
		low = fmin(low, m.p[v].z);
		high = fmax(high, m.p[v].z);
	}
	for (double share = 0.1; share < 1; share += 0.1) {
		mr_mesh out = clipped(&m, low + share * (high - low));
		mr_census c = census_of(&out);
		assert_true(c.manifold && c.oriented && c.boundary_loops > 0);
		assert_int_equal(
		    c.euler + (int64_t)c.boundary_loops, 2 * ((int64_t)c.components - (int64_t)c.genus));
	}
}

static void
test_all_or_nothing_is_left(void **state)
{
	mr_mesh m = shape(MR_CUBE, 500), all = clipped(&m, 100), none = clipped(&m, -100);

	(void)state;
	assert_int_equal(all.nv, m.nv);
	assert_int_equal(all.nf, m.nf);
	assert_memory_equal(all.t, m.t, m.nf * sizeof *m.t);
	assert_int_equal(none.nv + none.nf, 0);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(
		    test_half_a_sphere_has_a_loop_along_the_plane, setup, teardown),
		cmocka_unit_test_setup_teardown(test_a_cut_torus_is_a_ring_or_two, setup, teardown),
		cmocka_unit_test_setup_teardown(test_all_or_nothing_is_left, setup, teardown),
	};
	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
