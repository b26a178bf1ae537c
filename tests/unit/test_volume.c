/* Volumes of clouds whose surface is known, isosurfaces of any values, and clouds that enclose nothing. */
#include "shapes.h"

#include "base/random.h"
#include "measure/measure.h"
#include "shape/shape.h"
#include "space/bvh.h"
#include "space/local_planes.h"
#include "volume/isosurface.h"
#include "volume/parts.h"
#include "volume/volume.h"

static void
assert_closed_manifold(const mr_census *c)
{
	assert_true(c->manifold && c->oriented);
	assert_int_equal(c->boundary_edges, 0);
	assert_int_equal(c->isolated_vertices, 0);
}

static double
volume_of(const mr_mesh *m)
{
	mr_edges edges;
	mr_geometry g;

	mr_edges_build(&ctx, m, &edges);
	mr_measure_geometry(&ctx, m, &edges, &g);
	return g.volume;
}

/* The greatest distance from a point to the surface. */
static double
coverage(const mr_v3 *p, size_t n, const mr_mesh *m)
{
	mr_bvh *bvh;
	double most = 0;

	mr_bvh_build(&ctx, m, &bvh);
	for (size_t i = 0; i < n; i++)
		most = fmax(most, mr_bvh_closest(bvh, p[i]).dist2);
	return sqrt(most);
}

static mr_mesh
solid(mr_solid which, size_t vertices, size_t genus)
{
	mr_mesh m;

	assert_int_equal(
	    mr_solid_make(&ctx, &(mr_make_opts){ .solid = which, .vertices = vertices, .genus = genus }, &m),
	    MR_OK);
	return m;
}

static mr_v3 *
points_on(const mr_mesh *m, size_t n, uint64_t seed)
{
	mr_v3 *p, *normals;

	assert_int_equal(mr_surface_sample(&ctx, m, n, seed, &p, &normals), MR_OK);
	return p;
}

static mr_mesh
wrap(const mr_v3 *p, size_t n)
{
	mr_volume_opts opts = MR_VOLUME_DEFAULTS;
	mr_mesh m;

	assert_int_equal(mr_volume_wrap(&ctx, p, n, &opts, &m, NULL), MR_OK);
	return m;
}

/* Any signs at all: 20 % of the nodes inside, at random, show all 256 cases. */
static void
isosurface_is_always_closed(void **state)
{
	enum { N = 24 };
	static float f[N * N * N];
	mr_grid g = { { 0, 0, 0 }, 1, { N, N, N } };
	mr_random r = { 1 };
	mr_census c;
	mr_mesh m;

	(void)state;
	for (int share = 1; share < 10; share += 2) {
		for (size_t z = 0, i = 0; z < N; z++)
			for (size_t y = 0; y < N; y++)
				for (size_t x = 0; x < N; x++, i++) {
					bool face = x % (N - 1) == 0 || y % (N - 1) == 0 || z % (N - 1) == 0;
					double u = mr_random_real(&r);
					f[i] = (float)(face ? u : u - 0.1 * share);
				}
		assert_int_equal(mr_isosurface(&ctx, &g, f, 0, &m), MR_OK);
		c = census_of(&m);
		assert_closed_manifold(&c);
		assert_true(volume_of(&m) > 0);
	}
}

/* The distance to a sphere: its volume to the second order, its vertices on it. */
static void
isosurface_of_a_sphere(void **state)
{
	enum { N = 41 };
	static float f[N * N * N];
	mr_grid g = { { -1, -1, -1 }, 0.05, { N, N, N } };
	mr_census c;
	mr_mesh m;

	(void)state;
	for (size_t z = 0, i = 0; z < N; z++)
		for (size_t y = 0; y < N; y++)
			for (size_t x = 0; x < N; x++, i++)
				f[i] = (float)(mr_norm(mr_grid_place(&g, x, y, z)) - 0.8);
	assert_int_equal(mr_isosurface(&ctx, &g, f, 0, &m), MR_OK);
	c = census_of(&m);
	assert_closed_manifold(&c);
	assert_int_equal(c.euler, 2);
	assert_true(fabs(volume_of(&m) - (4 * MR_PI / 3 * 0.512)) < 0.01);
	for (size_t i = 0; i < m.nv; i++)
		assert_true(fabs(mr_norm(m.p[i]) - 0.8) < 1e-3);
}

/* Of random insides without any points one wall stays; of two balls the one that has points, and its cavity
 * goes. */
static void
walls_without_points_go(void **state)
{
	enum { N = 40, POINTS = 4000 };
	static float f[N * N * N];
	mr_grid g = { { -2, -2, -2 }, 0.1, { N, N, N } };
	mr_v3 here = mr_vec(-0.9, 0, 0), there = mr_vec(0.9, 0, 0), *normal;
	mr_volume_cloud s = { .n = 0, .spacing = 1 };
	mr_mesh m, ball = solid(MR_SPHERE, 2000, 0);
	mr_random r = { 1 };
	mr_walls w;
	mr_census c;

	(void)state;
	mr_walls_begin(&ctx, &s, &g, &w);
	for (int share = 1; share < 10; share += 2) {
		for (size_t i = 0; i < (size_t)N * N * N; i++) {
			size_t x = i % N, y = i / N % N, z = i / (N * N);
			bool face = x % (N - 1) == 0 || y % (N - 1) == 0 || z % (N - 1) == 0;
			f[i] = (float)(mr_random_real(&r) - (face ? 0 : 0.1 * share));
		}
		assert_int_equal(mr_volume_surface(&ctx, &w, &g, f, 0, &m), MR_OK);
		c = census_of(&m);
		assert_closed_manifold(&c);
		assert_int_equal(c.components, 1);
	}
	assert_int_equal(mr_surface_sample(&ctx, &ball, POINTS, 1, &s.p, &normal), MR_OK);
	s.n = POINTS;
	s.plane.area = MR_NEW(&ctx, POINTS, double);
	s.depth = MR_NEW_ZERO(&ctx, POINTS, uint8_t);
	for (size_t i = 0; i < POINTS; i++) {
		s.p[i] = mr_axpy(0.8, s.p[i], here);
		s.plane.area[i] = 4 * MR_PI * 0.64 / POINTS;
	}
	s.spacing = sqrt(s.plane.area[0]);
	mr_walls_begin(&ctx, &s, &g, &w);
	for (size_t i = 0; i < (size_t)N * N * N; i++) {
		mr_v3 p = mr_grid_place(&g, i % N, i / N % N, i / (N * N));
		double d = fmin(mr_dist(p, here), mr_dist(p, there)) - 0.8;
		f[i] = (float)fmax(d, 0.25 - mr_dist(p, here));
	}
	assert_int_equal(mr_volume_surface(&ctx, &w, &g, f, 0, &m), MR_OK);
	c = census_of(&m);
	assert_closed_manifold(&c);
	assert_int_equal(c.components, 1);
	for (size_t i = 0; i < m.nv; i++)
		assert_true(fabs(mr_dist(m.p[i], here) - 0.8) < 0.01);
}

static void
eigenvectors_of_a_symmetric_matrix(void **state)
{
	mr_random r = { 3 };

	(void)state;
	for (int k = 0; k < 100; k++) {
		double a[6], value[3];
		mr_v3 vector[3];
		for (int i = 0; i < 6; i++)
			a[i] = mr_random_real(&r) - 0.5;
		mr_eigen_sym3(a, value, vector);
		assert_true(value[0] <= value[1] && value[1] <= value[2]);
		for (int i = 0; i < 3; i++) {
			mr_v3 v = vector[i],
			      av = mr_vec(mr_dot(mr_vec(a[0], a[1], a[2]), v),
				  mr_dot(mr_vec(a[1], a[3], a[4]), v), mr_dot(mr_vec(a[2], a[4], a[5]), v));
			assert_true(fabs(mr_norm(v) - 1) < 1e-12);
			assert_true(mr_dist(av, mr_mul(value[i], v)) < 1e-12);
		}
	}
}

/* Normals of a sphere are its radii, and the points share its area. */
static void
planes_of_a_sphere(void **state)
{
	enum { N = 4000 };
	mr_mesh m = solid(MR_SPHERE, 40000, 0);
	mr_v3 *p = points_on(&m, N, 5);
	mr_planes planes;
	double area = 0;

	(void)state;
	assert_int_equal(mr_cloud_planes(&ctx, p, N, 12, 6, false, &planes), MR_OK);
	for (size_t i = 0; i < N; i++) {
		assert_true(fabs(mr_dot(planes.normal[i], mr_unit(p[i]))) > 0.95);
		assert_true(planes.neighbor[6 * i] != i && planes.neighbor[6 * i] < N);
		area += planes.area[i];
	}
	assert_true(fabs(area - (4 * MR_PI)) < 0.1 * 4 * MR_PI);
}

/* Shapes with their genus and volume; random samples, and vertices. */
static void
genus_and_volume_are_right(void **state)
{
	static const struct {
		mr_solid solid;
		size_t boxes;
		int64_t genus;
	} shape[] = { { MR_SPHERE, 0, 0 }, { MR_TORUS, 0, 1 }, { MR_CUBE, 0, 0 }, { MR_KNOT, 0, 1 },
		{ MR_BOXES, 2, 2 }, { MR_BOXES, 5, 5 }, { MR_BUMPY, 0, 0 } };

	(void)state;
	for (size_t i = 0; i < sizeof shape / sizeof *shape; i++) {
		mr_mesh m = solid(shape[i].solid, 8000, shape[i].boxes), w;
		double area = mr_mesh_area(&ctx, &m);
		for (int random = 0; random < 2; random++) {
			const mr_v3 *p = random ? points_on(&m, 8000, 7) : m.p;
			size_t n = random ? 8000 : m.nv;
			mr_census c;
			w = wrap(p, n);
			c = census_of(&w);
			assert_closed_manifold(&c);
			assert_int_equal(c.components, 1);
			assert_int_equal(c.genus, shape[i].genus);
			assert_true(coverage(p, n, &w) < 2 * sqrt(area / (double)n));
			assert_true(fabs(volume_of(&w) / volume_of(&m) - 1) < 0.05);
		}
	}
}

/* Shells of radius 1, 0.7 and 0.4: a hollow body with a body in it, and no points between that tell. */
static void
nested_spheres_bound_a_cavity_and_a_body(void **state)
{
	static const double radius[] = { 1, 0.7, 0.4 };
	mr_mesh m = solid(MR_SPHERE, 30000, 0), w;
	const mr_v3 *on = points_on(&m, 12000, 3);
	mr_v3 *p = MR_NEW(&ctx, 12000, mr_v3);
	size_t n = 0;
	mr_census c;

	(void)state;
	assert_non_null(p);
	for (size_t k = 0; k < 3; k++) /* as dense on each */
		for (size_t i = 0; i < (size_t)(7000 * radius[k] * radius[k]); i++)
			p[n++] = mr_mul(radius[k], on[i]);
	w = wrap(p, n);
	c = census_of(&w);
	assert_closed_manifold(&c);
	assert_int_equal(c.components, 3);
	assert_int_equal(c.genus, 0);
	assert_true(coverage(p, n, &w) < 2 * sqrt(4 * MR_PI / 7000));
	assert_true(fabs(volume_of(&w) / (4 * MR_PI / 3 * (1 - 0.343 + 0.064)) - 1) < 0.02);
}

/* Three steps of the sampling between them. */
static void
near_spheres_stay_apart(void **state)
{
	mr_mesh m = solid(MR_SPHERE, 5000, 0), w;
	double spacing = sqrt(4 * MR_PI / (double)m.nv);
	mr_v3 *p = MR_NEW(&ctx, 2 * m.nv, mr_v3);
	mr_census c;

	(void)state;
	for (size_t i = 0; i < m.nv; i++) {
		p[2 * i] = m.p[i];
		p[2 * i + 1] = mr_add(m.p[i], mr_vec(2 + 3 * spacing, 0, 0));
	}
	w = wrap(p, 2 * m.nv);
	c = census_of(&w);
	assert_closed_manifold(&c);
	assert_int_equal(c.components, 2);
	assert_int_equal(c.genus, 0);
	assert_true(fabs(volume_of(&w) - (8 * MR_PI / 3)) < 0.2);
}

/* A cap of 0.5 radians is not sampled. */
static void
hole_of_the_sampling_is_closed(void **state)
{
	mr_mesh m = solid(MR_SPHERE, 5000, 0), w;
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	size_t n = 0;
	mr_census c;

	(void)state;
	for (size_t i = 0; i < m.nv; i++)
		if (m.p[i].z < cos(0.5))
			p[n++] = m.p[i];
	w = wrap(p, n);
	c = census_of(&w);
	assert_closed_manifold(&c);
	assert_int_equal(c.euler, 2);
	assert_true(fabs(volume_of(&w) - (4 * MR_PI / 3)) < 0.2);
}

/* Points of the unit sphere in a spiral, at equal areas. */
static mr_v3
spiral(size_t i, size_t n)
{
	double z = 1 - (2 * (double)i + 1) / (double)n, r = sqrt(1 - z * z),
	       a = 2.399963229728653 * (double)i;

	return mr_vec(r * cos(a), r * sin(a), z);
}

/*
 * A ball with a round pit that is wider inside than its mouth, and below an open neck: from behind the wall
 * of the pit the flood is nearer than from within.  Their rim is sharp.
 */
static void
pit_before_an_open_neck_stays_a_pit(void **state)
{
	enum { N = 16000, PIT = 5000 };
	const double radius = 0.45, height = 0.75, neck = -0.75;
	mr_v3 *p = MR_NEW(&ctx, N + PIT, mr_v3);
	mr_v3 centre = mr_vec(0, 0, height);
	double cap, lens;
	size_t n = 0;
	mr_census c;
	mr_mesh w;

	(void)state;
	for (size_t i = 0; i < N; i++) {
		mr_v3 q = spiral(i, N);
		if (q.z > neck && mr_dist(q, centre) > radius)
			p[n++] = q;
	}
	for (size_t i = 0; i < PIT; i++) {
		mr_v3 q = mr_axpy(radius, spiral(i, PIT), centre);
		if (mr_norm(q) < 1)
			p[n++] = q;
	}
	w = wrap(p, n);
	c = census_of(&w);
	assert_closed_manifold(&c);
	assert_int_equal(c.components, 1);
	assert_int_equal(c.genus, 0);
	assert_true(coverage(p, n, &w) < 0.06);
	/* a ball without the cap below the neck, flat there, and without the lens of two balls */
	cap = MR_PI * (1 + neck) * (1 + neck) * (2 - neck) / 3;
	lens = MR_PI * pow(1 + radius - height, 2) *
	       (height * height + 2 * height * (1 + radius) - 3 * (1 - radius) * (1 - radius)) /
	       (12 * height);
	assert_true(fabs(volume_of(&w) - (4 * MR_PI / 3 - cap - lens)) < 0.05);
}

/* Points far away make neither blobs nor the grid coarse. */
static void
outliers_are_left_out(void **state)
{
	mr_mesh m = solid(MR_TORUS, 5000, 0), w;
	mr_v3 *p = MR_NEW(&ctx, m.nv + 40, mr_v3);
	mr_random r = { 13 };
	size_t n = m.nv;
	mr_census c;

	(void)state;
	memcpy(p, m.p, n * sizeof *p);
	p[n++] = mr_vec(1000, 0, 0);
	p[n++] = mr_vec(-50, 80, 9);
	while (n < m.nv + 40)
		p[n++] = mr_vec(
		    4 * mr_random_real(&r) - 2, 4 * mr_random_real(&r) - 2, mr_random_real(&r) + 0.8);
	w = wrap(p, n);
	c = census_of(&w);
	assert_closed_manifold(&c);
	assert_int_equal(c.components, 1);
	assert_int_equal(c.genus, 1);
	assert_true(coverage(m.p, m.nv, &w) < 0.1);
}

/* Noise of about the spacing along the normals. */
static void
noise_is_seen_through(void **state)
{
	enum { N = 10000 };
	mr_mesh m = solid(MR_TORUS, 20000, 0), w;
	mr_v3 *p, *normals;
	mr_census c;

	(void)state;
	assert_int_equal(mr_surface_sample(&ctx, &m, N, 3, &p, &normals), MR_OK);
	mr_add_noise(p, normals, N, sqrt(mr_mesh_area(&ctx, &m) / N), 4);
	w = wrap(p, N);
	c = census_of(&w);
	assert_closed_manifold(&c);
	assert_int_equal(c.components, 1);
	assert_int_equal(c.genus, 1);
	assert_true(fabs(volume_of(&w) / volume_of(&m) - 1) < 0.1);
}

/* Noise of about the spacing is told, and makes no handle. */
static void
noise_makes_no_handle(void **state)
{
	enum { N = 4000 };
	mr_mesh m = solid(MR_SPHERE, 8000, 0), w;
	mr_volume_opts opts = MR_VOLUME_DEFAULTS;
	mr_v3 *p, *normals;
	mr_volume_result found;
	mr_census c;

	(void)state;
	assert_int_equal(mr_surface_sample(&ctx, &m, N, 5, &p, &normals), MR_OK);
	mr_add_noise(p, normals, N, sqrt(mr_mesh_area(&ctx, &m) / N), 6);
	assert_int_equal(mr_volume_wrap(&ctx, p, N, &opts, &w, &found), MR_OK);
	assert_true(found.noise > 1);
	c = census_of(&w);
	assert_closed_manifold(&c);
	assert_int_equal(c.genus, 0);
}

/* Too few points for a surface, repeated ones, any place and size: a closed surface, or a refusal. */
static void
any_cloud_gives_a_closed_surface_or_none(void **state)
{
	mr_volume_opts opts = MR_VOLUME_DEFAULTS;
	mr_random r = { 17 };
	mr_v3 p[400];

	(void)state;
	for (int round = 0; round < 100; round++) {
		size_t n = 1 + (size_t)(399 * mr_random_real(&r) * mr_random_real(&r));
		double size = pow(10, 12 * mr_random_real(&r) - 6), offset = round % 3 ? 0 : 1e3 * size;
		mr_mark mark = mr_mark_take(&ctx);
		mr_status status;
		mr_mesh m;
		for (size_t i = 0; i < n; i++) {
			mr_v3 q = mr_vec(mr_random_real(&r) - 0.5, mr_random_real(&r) - 0.5,
			    round % 5 ? mr_random_real(&r) - 0.5 : 0);
			q = round % 2 ? mr_unit(q) : q;
			if (round % 7 == 0) /* two clusters, each much smaller than their distance */
				q = mr_add(mr_mul(1e-7, q), mr_vec(i % 2 ? 1 : -1, 0, 0));
			p[i] = mr_add(mr_mul(size, q), mr_vec(offset, -offset, offset));
		}
		opts.grid = round % 11 == 10 ? 1 + (size_t)(40 * mr_random_real(&r)) : 0;
		status = mr_volume_wrap(&ctx, p, n, &opts, &m, NULL);
		assert_true(status == MR_OK || status == MR_EMESH ||
			    (status == MR_ERANGE && (opts.grid || round % 7 == 0)));
		if (status == MR_OK) {
			mr_census c = census_of(&m);
			assert_closed_manifold(&c);
			assert_true(m.nf > 0);
		}
		mr_mark_release(&ctx, mark);
	}
	opts.grid = 5000;
	for (size_t i = 0; i < 400; i++)
		p[i] = mr_vec((double)(i % 7), (double)(i % 11), (double)(i % 13));
	assert_int_equal(mr_volume_wrap(&ctx, p, 400, &opts, &(mr_mesh){ 0 }, NULL), MR_ERANGE);
	assert_string_equal(ctx.error, "a grid of 5000 cells: 4096 at most");
}

static void
bits_do_not_depend_on_threads_repeats_or_order(void **state)
{
	mr_mesh m = solid(MR_TORUS, 6000, 0), a, b;
	mr_v3 *p = MR_NEW(&ctx, 2 * m.nv, mr_v3);

	(void)state;
	memcpy(p, m.p, m.nv * sizeof *p);
	for (size_t i = 0; i < m.nv; i++)
		p[m.nv + i] = m.p[m.nv - 1 - i];
	a = wrap(p + m.nv, m.nv);
	ctx.threads = 1;
	b = wrap(p, 2 * m.nv);
	assert_int_equal(a.nv, b.nv);
	assert_int_equal(a.nf, b.nf);
	assert_memory_equal(a.p, b.p, a.nv * sizeof *a.p);
	assert_memory_equal(a.t, b.t, a.nf * sizeof *a.t);
}

static void
flat_clouds_are_refused(void **state)
{
	enum { N = 400 };
	mr_volume_opts opts = MR_VOLUME_DEFAULTS;
	mr_random r = { 11 };
	mr_v3 p[N];
	mr_mesh m;

	(void)state;
	for (int dimension = 0; dimension < 3; dimension++) {
		static const char *const said[] = { "1 distinct points enclose nothing: it takes four",
			"the 400 points lie on a line: they enclose nothing",
			"the 400 points lie in a plane: they enclose nothing" };
		for (int i = 0; i < N; i++) {
			double s = dimension > 0 ? mr_random_real(&r) : 0,
			       t = dimension > 1 ? mr_random_real(&r) : 0;
			p[i] = mr_vec(1 + s, 2 - s + 3 * t, 3 + 2 * s - t);
		}
		assert_int_equal(mr_volume_wrap(&ctx, p, N, &opts, &m, NULL), MR_EMESH);
		assert_string_equal(ctx.error, said[dimension]);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(isosurface_is_always_closed, setup, teardown),
		cmocka_unit_test_setup_teardown(isosurface_of_a_sphere, setup, teardown),
		cmocka_unit_test_setup_teardown(walls_without_points_go, setup, teardown),
		cmocka_unit_test_setup_teardown(eigenvectors_of_a_symmetric_matrix, setup, teardown),
		cmocka_unit_test_setup_teardown(planes_of_a_sphere, setup, teardown),
		cmocka_unit_test_setup_teardown(genus_and_volume_are_right, setup, teardown),
		cmocka_unit_test_setup_teardown(nested_spheres_bound_a_cavity_and_a_body, setup, teardown),
		cmocka_unit_test_setup_teardown(near_spheres_stay_apart, setup, teardown),
		cmocka_unit_test_setup_teardown(hole_of_the_sampling_is_closed, setup, teardown),
		cmocka_unit_test_setup_teardown(pit_before_an_open_neck_stays_a_pit, setup, teardown),
		cmocka_unit_test_setup_teardown(outliers_are_left_out, setup, teardown),
		cmocka_unit_test_setup_teardown(noise_is_seen_through, setup, teardown),
		cmocka_unit_test_setup_teardown(noise_makes_no_handle, setup, teardown),
		cmocka_unit_test_setup_teardown(any_cloud_gives_a_closed_surface_or_none, setup, teardown),
		cmocka_unit_test_setup_teardown(
		    bits_do_not_depend_on_threads_repeats_or_order, setup, teardown),
		cmocka_unit_test_setup_teardown(flat_clouds_are_refused, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
