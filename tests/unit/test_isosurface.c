/* Isosurfaces of fields that have a formula.  (Closed whatever the values: test_volume.c.) */
#include "measure/measure.h"
#include "shapes.h"
#include "volume/isosurface.h"

/* The field of `value` on nodes from -1.5 to 1.5, `cells` along each axis. */
static mr_mesh
surface_of(double (*value)(mr_v3 p), size_t cells)
{
	mr_grid g = { { -1.5, -1.5, -1.5 }, 3.0 / (double)cells, { cells + 1, cells + 1, cells + 1 } };
	float *f = MR_NEW(&ctx, mr_grid_nodes(&g), float);
	mr_mesh m;

	assert_non_null(f);
	for (size_t z = 0; z < g.n[2]; z++)
		for (size_t y = 0; y < g.n[1]; y++)
			for (size_t x = 0; x < g.n[0]; x++)
				f[mr_grid_index(&g, x, y, z)] = (float)value(mr_grid_place(&g, x, y, z));
	assert_int_equal(mr_isosurface(&ctx, &g, f, 0, &m), MR_OK);
	return m;
}

/* Of a closed surface without flaws. */
static mr_census
closed_census_of(const mr_mesh *m)
{
	mr_census c = census_of(m);

	assert_true(c.manifold && c.oriented && c.boundary_edges == 0 && c.isolated_vertices == 0);
	return c;
}

static double
volume_of(const mr_mesh *m)
{
	double six = 0;

	for (size_t f = 0; f < m->nf; f++)
		six += mr_dot(m->p[m->t[f].v[0]], mr_face_cross(m, f));
	return six / 6;
}

/* Distances to a ball, to a torus around z, to two balls, to a shell between two spheres. */
static double
ball(mr_v3 p)
{
	return mr_norm(p) - 1;
}

static double
torus(mr_v3 p)
{
	return hypot(hypot(p.x, p.y) - 1, p.z) - 0.35;
}

static double
balls(mr_v3 p)
{
	return fmin(mr_dist(p, mr_vec(-0.7, 0.1, 0)), mr_dist(p, mr_vec(0.7, -0.1, 0.2))) - 0.6;
}

static double
shell(mr_v3 p)
{
	return fabs(mr_norm(p) - 0.9) - 0.3;
}

#define PI 3.141592653589793

static const struct {
	double (*value)(mr_v3 p);
	size_t components;
	int64_t genus;
	double area, volume;
} fields[] = {
	{ ball, 1, 0, 4 * PI, 4 * PI / 3 },
	{ torus, 1, 1, 4 * PI *PI * 0.35, 2 * PI *PI * 0.1225 },
	{ balls, 2, 0, 8 * PI * 0.36, 8 * PI * 0.216 / 3 },
	{ shell, 2, 0, 4 * PI *(1.44 + 0.36), 4 * PI *(1.728 - 0.216) / 3 },
};

/* The topology; area, volume and place of the vertices are of the second order: a half of the step, a quarter
 * of the error. */
static void
fields_have_their_surfaces(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
		double error[2][3];
		for (int fine = 0; fine < 2; fine++) {
			mr_mesh m = surface_of(fields[i].value, fine ? 74 : 37);
			mr_census c = closed_census_of(&m);
			double step = 3.0 / (fine ? 74 : 37), off = 0;
			assert_int_equal(c.components, fields[i].components);
			assert_int_equal(c.genus, fields[i].genus);
			for (size_t v = 0; v < m.nv; v++)
				off = fmax(off, fabs(fields[i].value(m.p[v])));
			error[fine][0] = off / (step * step);
			error[fine][1] = fabs(mr_mesh_area(&ctx, &m) / fields[i].area - 1) / (step * step);
			error[fine][2] = fabs(volume_of(&m) / fields[i].volume - 1) / (step * step);
			/* 1.5 vertices per squared step of area, as the header says */
			assert_true(fabs((double)m.nv * step * step / fields[i].area - 1.5) < 0.15);
		}
		for (int k = 0; k < 3; k++)
			assert_true(error[0][k] < 2 && error[1][k] < 1.4 * error[0][k]);
	}
}

static mr_v3 slope;

/* A plane, but for the faces of the grid. */
static double
plane(mr_v3 p)
{
	if (fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z))) > 1.45)
		return 1;
	return mr_dot(slope, p) - 0.123;
}

/* What is linear along the edges of the grid is met exactly, but for single precision; triangles look up the
 * slope. */
static void
planes_are_exact(void **state)
{
	mr_random r = { 1 };

	(void)state;
	for (int k = 0; k < 20; k++) {
		size_t on = 0;
		mr_mesh m;
		slope = mr_unit(random_vector(&r));
		m = surface_of(plane, 30);
		closed_census_of(&m);
		for (size_t f = 0; f < m.nf; f++) {
			bool inner = true;
			for (int i = 0; i < 3; i++) {
				mr_v3 p = m.p[m.t[f].v[i]];
				inner &= fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z))) < 1.3;
			}
			if (!inner)
				continue;
			on++;
			for (int i = 0; i < 3; i++)
				assert_true(fabs(mr_dot(slope, m.p[m.t[f].v[i]]) - 0.123) < 1e-6);
			/* slivers have no normal that single precision could tell */
			if (mr_norm(mr_face_cross(&m, f)) > 1e-4)
				assert_true(mr_dot(mr_unit(mr_face_cross(&m, f)), slope) > 1 - 1e-5);
		}
		assert_true(on > 300);
	}
}

/* The grid's origin, step and sides are those asked for, however long each is. */
static void
any_grid_will_do(void **state)
{
	mr_grid g = { { 10, -20, 5 }, 0.5, { 9, 14, 30 } };
	float *f = MR_NEW(&ctx, mr_grid_nodes(&g), float);
	mr_v3 centre = mr_grid_place(&g, 4, 6, 20);
	mr_mesh m;

	(void)state;
	for (size_t z = 0; z < g.n[2]; z++)
		for (size_t y = 0; y < g.n[1]; y++)
			for (size_t x = 0; x < g.n[0]; x++)
				f[mr_grid_index(&g, x, y, z)] =
				    (float)(mr_dist(mr_grid_place(&g, x, y, z), centre) - 1.4);
	assert_int_equal(mr_isosurface(&ctx, &g, f, 0, &m), MR_OK);
	assert_int_equal(closed_census_of(&m).euler, 2);
	for (size_t v = 0; v < m.nv; v++)
		assert_true(fabs(mr_dist(m.p[v], centre) - 1.4) < 0.05);
	for (size_t i = 0; i < mr_grid_nodes(&g); i++)
		f[i] = 1;
	assert_int_equal(mr_isosurface(&ctx, &g, f, 0, &m), MR_OK);
	assert_int_equal(m.nf, 0);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(fields_have_their_surfaces, setup, teardown),
		cmocka_unit_test_setup_teardown(planes_are_exact, setup, teardown),
		cmocka_unit_test_setup_teardown(any_grid_will_do, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
