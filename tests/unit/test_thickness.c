/* Thickness of bodies and gaps of which it is known. */
#include "shapes.h"
#include "space/thickness.h"

static double *
thickness_of(const mr_mesh *m, double most)
{
	double *d = MR_NEW(&ctx, m->nv, double);

	mr_thickness(&ctx, m, most, d);
	return d;
}

static void
test_sphere(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 2000);
	double *d = thickness_of(&m, 10);

	(void)state;
	for (size_t v = 0; v < m.nv; v++)
		assert_true(d[v] > 1.97 && d[v] <= 2.15); /* an edge more where no ray is */
}

/* A sheet has no other side, two have one: whichever way they are turned. */
static void
test_sheets(void **state)
{
	mr_mesh one = shape(MR_PLANE, 400), two = both(&one, &one, mr_vec(0, 0, 0.1));
	double *d = thickness_of(&one, 5);

	(void)state;
	for (size_t v = 0; v < one.nv; v++)
		assert_true(d[v] == 5);
	d = thickness_of(&two, 5);
	for (size_t v = 0; v < two.nv; v++)
		assert_true(fabs(d[v] - 0.1) < 1e-12);
	d = thickness_of(&two, 0.05);
	for (size_t v = 0; v < two.nv; v++)
		assert_true(d[v] == 0.05);
}

/* Along the surface it grows no faster than one walks: a rod's ends are not as thick as the rod is long. */
static void
test_walks(void **state)
{
	mr_make_opts o = MR_MAKE_DEFAULTS;
	mr_mesh m;
	mr_v3 *p;
	double *d;

	(void)state;
	o.solid = MR_CYLINDER;
	o.vertices = 4000;
	assert_int_equal(mr_solid_make(&ctx, &o, &m), MR_OK);
	p = MR_NEW(&ctx, m.nv, mr_v3);
	for (size_t v = 0; v < m.nv; v++)
		p[v] = mr_vec(m.p[v].x, m.p[v].y, 10 * m.p[v].z);
	m.p = p;
	d = thickness_of(&m, 100);
	for (size_t f = 0; f < m.nf; f++)
		for (int k = 0; k < 3; k++) {
			uint32_t a = m.t[f].v[k], b = m.t[f].v[(k + 1) % 3];
			assert_true(d[a] <= (1 + 1e-5) * (d[b] + mr_dist(p[a], p[b])));
		}
	for (size_t v = 0; v < m.nv; v++)
		assert_true(d[v] > 1.99 && d[v] < 3.5); /* a diameter, and a radius more on the ends */
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_sphere, setup, teardown),
		cmocka_unit_test_setup_teardown(test_sheets, setup, teardown),
		cmocka_unit_test_setup_teardown(test_walks, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
