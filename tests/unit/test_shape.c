/* The generated shapes: closed, oriented outward, of the genus, size and measures that shape.h states. */
#include "shape/shape.h"
#include "unit.h"

static mr_mesh
made(mr_solid solid, size_t n, size_t genus, bool open)
{
	mr_mesh m;

	assert_int_equal(
	    mr_solid_make(
		&ctx, &(mr_make_opts){ .solid = solid, .vertices = n, .genus = genus, .open = open }, &m),
	    MR_OK);
	return m;
}

/* V - E + F, the half-edges without twin, and the enclosed volume. */
typedef struct facts {
	long euler;
	size_t boundary;
	double volume, area;
} facts;

static facts
facts_of(const mr_mesh *m)
{
	mr_topology topo;
	facts r = { 0 };
	size_t edges = 0;

	if (mr_topology_build(&ctx, m, &topo) != MR_OK)
		fail_msg("%s", ctx.error);
	for (size_t h = 0; h < 3 * m->nf; h++) {
		r.boundary += topo.twin[h] == MR_NONE;
		edges += topo.twin[h] == MR_NONE || topo.twin[h] > h;
	}
	for (size_t v = 0; v < m->nv; v++)
		assert_true(topo.out[v] != MR_NONE);
	r.euler = (long)m->nv - (long)edges + (long)m->nf;
	for (size_t f = 0; f < m->nf; f++)
		r.volume += mr_dot(mr_face_cross(m, f), m->p[m->t[f].v[0]]) / 6;
	r.area = mr_mesh_area(&ctx, m);
	return r;
}

static void
check_near(double a, double b, double relative)
{
	if (!(fabs(a - b) <= relative * fabs(b)))
		fail_msg("%.17g is not %.17g to within %g", a, b, relative);
}

static void
closed_of_any_size(void **state)
{
	static const size_t sizes[] = { 1, 4, 12, 100, 1234, 10000 };

	(void)state;
	for (int solid = 0; solid < MR_SOLIDS; solid++) {
		for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
			mr_mesh m = made((mr_solid)solid, sizes[i], 3, false);
			facts f = facts_of(&m);
			bool disk = solid == MR_PLANE;
			long genus = solid == MR_TORUS || solid == MR_KNOT ? 1 : solid == MR_BOXES ? 3 : 0;

			assert_int_equal(f.euler, disk ? 1 : 2 - 2 * genus);
			assert_true(disk ? f.boundary > 0 : f.boundary == 0);
			if (!disk && !(f.volume > 0))
				fail_msg("%s of %zu vertices: volume %g", m.name, m.nv, f.volume);
			if (sizes[i] >= (solid == MR_BUMPY ? 5000 : 1234))
				check_near((double)m.nv, (double)sizes[i], 0.2);
		}
	}
}

static void
measures_of_closed_form(void **state)
{
	facts f;
	mr_mesh m;

	(void)state;
	m = made(MR_SPHERE, 40000, 0, false);
	f = facts_of(&m);
	check_near(f.area, 4 * MR_PI, 1e-3);
	check_near(f.volume, 4 * MR_PI / 3, 1e-3);
	m = made(MR_TORUS, 40000, 0, false);
	f = facts_of(&m);
	check_near(f.area, 4 * MR_PI * MR_PI * 0.4, 1e-3);
	check_near(f.volume, 2 * MR_PI * MR_PI * 0.16, 1e-3);
	m = made(MR_CUBE, 1000, 0, false);
	f = facts_of(&m);
	check_near(f.area, 24, 1e-12);
	check_near(f.volume, 8, 1e-12);
	m = made(MR_PLANE, 1000, 0, false);
	f = facts_of(&m);
	check_near(f.area, 4, 1e-12);
	assert_true(mr_face_cross(&m, 0).z > 0);
	m = made(MR_CYLINDER, 40000, 0, false);
	f = facts_of(&m);
	check_near(f.area, 10 * MR_PI, 1e-3);
	check_near(f.volume, 4 * MR_PI, 1e-3);
	m = made(MR_CYLINDER, 40000, 0, true);
	f = facts_of(&m);
	check_near(f.area, 8 * MR_PI, 1e-3);
	assert_int_equal(f.euler, 0);
	m = made(MR_BOXES, 1000, 4, false);
	f = facts_of(&m);
	check_near(f.volume, 3 * 9 - 4, 1e-12);
	check_near(f.area, 2 * 23 + 2 * (9 + 3) + 4 * 4, 1e-12);
}

static void
vertex_counts(void **state)
{
	(void)state;
	for (size_t f = 1; f < 40; f++) {
		assert_int_equal(made(MR_SPHERE, 10 * f * f + 2, 0, false).nv, 10 * f * f + 2);
		assert_int_equal(made(MR_CUBE, 6 * f * f + 2, 0, false).nv, 6 * f * f + 2);
		assert_int_equal(made(MR_PLANE, (f + 1) * (f + 1), 0, false).nv, (f + 1) * (f + 1));
	}
}

/* The creature's triangles are fair, and its edges of about one length. */
static void
bumpy_is_even(void **state)
{
	mr_mesh m = made(MR_BUMPY, 0, 0, false);
	double longest = 0, mean = mr_mesh_edge_scale(&ctx, &m);

	(void)state;
	assert_in_range(m.nv, 20000, 40000);
	for (size_t f = 0; f < m.nf; f++)
		for (int i = 0; i < 3; i++)
			longest = fmax(longest, mr_dist(m.p[m.t[f].v[i]], m.p[m.t[f].v[(i + 1) % 3]]));
	assert_true(longest < 8 * mean);
}

static void
sample_is_uniform(void **state)
{
	enum { N = 40000 };
	mr_mesh m = made(MR_CUBE, 8, 0, false);
	size_t upper = 0, corner = 0;
	mr_v3 *p, *normal, *q;

	(void)state;
	assert_int_equal(mr_surface_sample(&ctx, &m, N, 7, &p, &normal), MR_OK);
	for (size_t i = 0; i < N; i++) {
		double most = fmax(fabs(p[i].x), fmax(fabs(p[i].y), fabs(p[i].z)));
		check_near(most, 1, 1e-12);
		check_near(mr_dot(p[i], normal[i]), 1, 1e-12);
		upper += normal[i].z > 0.5;
		corner += normal[i].z > 0.5 && p[i].x > 0 && p[i].y > 0;
	}
	assert_in_range(upper, N / 6 - 400, N / 6 + 400); /* over 5 standard deviations */
	assert_in_range(corner, N / 24 - 220, N / 24 + 220);
	assert_int_equal(mr_surface_sample(&ctx, &m, N, 7, &q, &normal), MR_OK);
	assert_memory_equal(p, q, N * sizeof *p);
	assert_int_equal(mr_surface_sample(&ctx, &m, N, 8, &q, &normal), MR_OK);
	assert_memory_not_equal(p, q, N * sizeof *p);
}

static void
noise_is_gaussian(void **state)
{
	enum { N = 40000 };
	mr_v3 *p = MR_NEW_ZERO(&ctx, N, mr_v3), *normal = MR_NEW(&ctx, N, mr_v3);
	double sum = 0, squares = 0;
	size_t within = 0;

	(void)state;
	for (size_t i = 0; i < N; i++)
		normal[i] = mr_vec(0, 0, 1);
	mr_add_noise(p, normal, N, 0.5, 3);
	for (size_t i = 0; i < N; i++) {
		sum += p[i].z;
		squares += p[i].z * p[i].z;
		within += fabs(p[i].z) < 0.5;
	}
	assert_true(fabs(sum / N) < 0.0125); /* 5 standard deviations of the mean */
	check_near(sqrt(squares / N), 0.5, 0.02);
	check_near((double)within / N, 0.6827, 0.02);
}

static void
refusals(void **state)
{
	mr_mesh m = { .name = "untouched" };
	mr_v3 point = { 0, 0, 0 }, *p = &point, *normal = &point;
	mr_tri t = { { 0, 0, 0 } };
	mr_mesh flat = { .name = "flat", .p = &point, .t = &t, .nv = 1, .nf = 1 };

	(void)state;
	assert_int_equal(
	    mr_solid_make(&ctx,
		&(mr_make_opts){ .solid = MR_SPHERE, .vertices = 5000000000u, .genus = 0, .open = false },
		&m),
	    MR_ERANGE);
	assert_int_equal(
	    mr_solid_make(&ctx,
		&(mr_make_opts){ .solid = MR_BOXES, .vertices = 100, .genus = 5000000, .open = false }, &m),
	    MR_ERANGE);
	assert_string_equal(m.name, "untouched");
	assert_int_equal(mr_surface_sample(&ctx, &flat, 3, 1, &p, &normal), MR_EMESH);
	assert_ptr_equal(p, &point);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(closed_of_any_size, setup, teardown),
		cmocka_unit_test_setup_teardown(measures_of_closed_form, setup, teardown),
		cmocka_unit_test_setup_teardown(vertex_counts, setup, teardown),
		cmocka_unit_test_setup_teardown(bumpy_is_even, setup, teardown),
		cmocka_unit_test_setup_teardown(sample_is_uniform, setup, teardown),
		cmocka_unit_test_setup_teardown(noise_is_gaussian, setup, teardown),
		cmocka_unit_test_setup_teardown(refusals, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
