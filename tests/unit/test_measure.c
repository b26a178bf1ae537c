/* Figures of surfaces whose true ones are known. */
#include "measure/measure.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static void
assert_near(double a, double b, double tolerance)
{
	if (!(fabs(a - b) <= tolerance))
		fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

static mr_surface_figures
measure(mr_ctx *ctx, const mr_v3 *p, size_t nv, const mr_tri *t, size_t nf)
{
	mr_mesh m = { "mesh", p, t, nv, nf };
	mr_surface_figures s;

	assert_int_equal(mr_measure_surface(ctx, &m, true, &s), MR_OK);
	return s;
}

/* A grid of rows x columns quads, each cut in two, wrapped around where asked. */
typedef struct sheet {
	uint32_t rows, columns;
	bool wrap_rows, wrap_columns;
} sheet;

static mr_mesh
sheet_make(mr_ctx *ctx, sheet s, mr_v3 (*at)(double u, double v))
{
	uint32_t nr = s.rows + !s.wrap_rows, nc = s.columns + !s.wrap_columns;
	mr_v3 *p = MR_NEW(ctx, (size_t)nr * nc, mr_v3);
	mr_tri *t = MR_NEW(ctx, 2 * (size_t)s.rows * s.columns, mr_tri);
	size_t f = 0;

	assert_non_null(p);
	assert_non_null(t);
	for (uint32_t i = 0; i < nr; i++)
		for (uint32_t j = 0; j < nc; j++)
			p[i * nc + j] = at((double)j / s.columns, (double)i / s.rows);
	for (uint32_t i = 0; i < s.rows; i++)
		for (uint32_t j = 0; j < s.columns; j++) {
			uint32_t a = i * nc + j, b = i * nc + (j + 1) % nc;
			uint32_t c = (i + 1) % nr * nc + j, d = (i + 1) % nr * nc + (j + 1) % nc;
			t[f++] = (mr_tri){ { a, b, d } };
			t[f++] = (mr_tri){ { a, d, c } };
		}
	return (mr_mesh){ "mesh", p, t, (size_t)nr * nc, f };
}

static mr_v3
on_plane(double u, double v)
{
	return mr_vec(u, v, 0);
}

static mr_v3
on_torus(double u, double v)
{
	double a = 2 * MR_PI * u, b = 2 * MR_PI * v, r = 2 + cos(b);

	return mr_vec(r * cos(a), r * sin(a), sin(b));
}

static mr_v3
on_cylinder(double u, double v)
{
	return mr_vec(cos(2 * MR_PI * u), sin(2 * MR_PI * u), v);
}

static void
plane_is_flat_and_regular(void **state)
{
	enum { N = 10 };
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_mesh m = sheet_make(&ctx, (sheet){ N, N, false, false }, on_plane);
	mr_surface_figures s = measure(&ctx, m.p, m.nv, m.t, m.nf);
	assert_int_equal(s.census.euler, 1);
	assert_int_equal(s.census.genus, 0);
	assert_int_equal(s.census.boundary_loops, 1);
	assert_int_equal(s.census.boundary_edges, 4 * N);
	assert_int_equal(s.census.edges, 3 * N * N + 2 * N);
	assert_int_equal(s.intersections, 0);
	assert_near(s.geometry.area, 1, 1e-14);
	assert_true(isnan(s.geometry.volume));
	assert_near(s.geometry.diagonal, sqrt(2), 1e-15);
	assert_near(s.geometry.edge.min, 0.1, 1e-15);
	assert_near(s.geometry.edge.max, 0.1 * sqrt(2), 1e-15);
	assert_near(s.geometry.edge.mean, (220 * 0.1 + 100 * 0.1 * sqrt(2)) / 320, 1e-14);
	assert_near(s.geometry.angle_min, 45, 1e-12);
	assert_near(s.geometry.angle_max, 90, 1e-12);
	assert_near(s.geometry.angle_error, 20, 1e-12);
	/* inner vertices have 6 neighbours, those of the sides 4, two corners 3 and two 2 */
	assert_near(s.geometry.valence6, 117.0 / 121, 1e-15);
	assert_int_equal(s.evenness.vertices, 81);
	assert_near(s.evenness.mean, 0.01, 1e-15);
	assert_near(s.evenness.error, 0, 1e-12);
	assert_near(s.evenness.variance, 0, 1e-12);
	mr_ctx_free(&ctx);
}

/* Pappus: area 4 pi^2 R r, volume 2 pi^2 R r^2; the inscribed surface converges with h^2. */
static void
torus_has_genus_one(void **state)
{
	double area = 8 * MR_PI * MR_PI, volume = 4 * MR_PI * MR_PI, before = 1;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (uint32_t n = 20; n <= 160; n *= 2) {
		mr_mesh m = sheet_make(&ctx, (sheet){ n, 2 * n, true, true }, on_torus);
		mr_surface_figures s = measure(&ctx, m.p, m.nv, m.t, m.nf);
		double error = 1 - s.geometry.area / area;
		assert_int_equal(s.census.euler, 0);
		assert_int_equal(s.census.genus, 1);
		assert_int_equal(s.census.components, 1);
		assert_int_equal(s.census.boundary_loops, 0);
		assert_int_equal(s.intersections, 0);
		assert_near(s.geometry.valence6, 1, 0);
		assert_true(error > 0 && error < 0.05);
		if (n > 20)
			assert_near(before / error, 4, 0.2);
		assert_near(s.geometry.volume, volume, 30.0 * volume / (n * n));
		before = error;
	}
	mr_ctx_free(&ctx);
}

/* The icosahedron of radius 1, then each face cut in four and pushed out to the sphere. */
static mr_mesh
icosphere(mr_ctx *ctx, int levels)
{
	static const uint8_t faces[20][3] = { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 },
		{ 0, 10, 11 }, { 1, 5, 9 }, { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 },
		{ 3, 9, 4 }, { 3, 4, 2 }, { 3, 2, 6 }, { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 },
		{ 6, 2, 10 }, { 8, 6, 7 }, { 9, 8, 1 } };
	double g = (1 + sqrt(5)) / 2;
	const mr_v3 corners[12] = { { -1, g, 0 }, { 1, g, 0 }, { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g },
		{ 0, 1, g }, { 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 }, { g, 0, 1 }, { -g, 0, -1 },
		{ -g, 0, 1 } };
	size_t nv = 12, nf = 20;
	mr_v3 *p = MR_NEW(ctx, 10 * ((size_t)1 << 2 * levels) + 2, mr_v3);
	mr_tri *t = MR_NEW(ctx, nf, mr_tri);

	for (size_t i = 0; i < 12; i++)
		p[i] = mr_unit(corners[i]);
	for (size_t f = 0; f < 20; f++)
		t[f] = (mr_tri){ { faces[f][0], faces[f][1], faces[f][2] } };
	for (int level = 0; level < levels; level++) {
		mr_mesh m = { "sphere", p, t, nv, nf };
		mr_edges e;
		mr_edges_build(ctx, &m, &e);
		uint32_t *middle = MR_NEW(ctx, 3 * nf, uint32_t); /* of each half-edge */
		mr_tri *finer = MR_NEW(ctx, 4 * nf, mr_tri);
		for (size_t k = 0; k < e.count; k++) {
			uint32_t h = e.he[e.start[k]];
			p[nv] = mr_unit(mr_add(p[mr_he_from(&m, h)], p[mr_he_to(&m, h)]));
			for (uint32_t i = e.start[k]; i < e.start[k + 1]; i++)
				middle[e.he[i]] = (uint32_t)nv;
			nv++;
		}
		for (size_t f = 0; f < nf; f++) {
			const uint32_t *v = t[f].v, *c = middle + 3 * f;
			finer[4 * f] = (mr_tri){ { v[0], c[0], c[2] } };
			finer[4 * f + 1] = (mr_tri){ { v[1], c[1], c[0] } };
			finer[4 * f + 2] = (mr_tri){ { v[2], c[2], c[1] } };
			finer[4 * f + 3] = (mr_tri){ { c[0], c[1], c[2] } };
		}
		t = finer;
		nf *= 4;
	}
	return (mr_mesh){ "sphere", p, t, nv, nf };
}

static void
sphere_converges(void **state)
{
	double a = 1 / sin(2 * MR_PI / 5), area = 4 * MR_PI, volume = 4 * MR_PI / 3, before = 1;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_mesh m = icosphere(&ctx, 0);
	mr_surface_figures s = measure(&ctx, m.p, m.nv, m.t, m.nf);
	assert_near(s.geometry.area, 5 * sqrt(3) * a * a, 1e-13);
	assert_near(s.geometry.volume, 5 * (3 + sqrt(5)) / 12 * a * a * a, 1e-13);
	assert_near(s.geometry.edge.min, a, 1e-15);
	assert_near(s.geometry.edge.deviation, 0, 1e-15);
	assert_near(s.geometry.angle_error, 0, 1e-12);
	assert_near(s.geometry.valence6, 0, 0);
	assert_near(s.evenness.mean, 5 * sqrt(3) * a * a / 12, 1e-13);
	for (int level = 1; level <= 5; level++) {
		m = icosphere(&ctx, level);
		s = measure(&ctx, m.p, m.nv, m.t, m.nf);
		double error = 1 - s.geometry.area / area;
		assert_int_equal(s.census.euler, 2);
		assert_int_equal(s.census.genus, 0);
		assert_int_equal(s.intersections, 0);
		assert_near(before / error, level > 2 ? 4 : before / error, 0.1);
		assert_true(s.geometry.volume < volume);
		assert_near(s.geometry.valence6, 1 - 12.0 / (double)m.nv, 1e-15);
		assert_near(s.evenness.mean * (double)m.nv, s.geometry.area, 1e-12);
		before = error;
	}
	assert_near(s.geometry.volume, volume, 4e-3);
	mr_ctx_free(&ctx);
}

static void
cylinder_has_two_loops(void **state)
{
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = sheet_make(&ctx, (sheet){ 4, 12, false, true }, on_cylinder);
	mr_surface_figures s = measure(&ctx, m.p, m.nv, m.t, m.nf);
	assert_int_equal(s.census.euler, 0);
	assert_int_equal(s.census.genus, 0);
	assert_int_equal(s.census.boundary_loops, 2);
	assert_near(s.geometry.area, 24 * sin(MR_PI / 12), 1e-13);
	mr_ctx_free(&ctx);
}

/* Small surfaces, each with one flaw. */
static void
flaws_are_counted(void **state)
{
	static const mr_v3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 1 },
		{ 0, -1, 0 }, { 5, 5, 5 }, { 0.5, 0, 0 }, { -1, -1, 0 }, { 0.1, 0.2, 1e-3 },
		{ 0.2, 0.2, -1 } };
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	{ /* three faces at an edge */
		const mr_tri t[] = { { { 0, 1, 2 } }, { { 1, 0, 3 } }, { { 1, 0, 5 } } };
		mr_census c = measure(&ctx, p, 6, t, 3).census;
		assert_int_equal(c.nonmanifold_edges, 1);
		assert_int_equal(c.nonmanifold_vertices, 0);
		assert_int_equal(c.isolated_vertices, 1);
		assert_false(c.manifold);
		assert_int_equal(c.components, 1);
	}
	{ /* two faces at a vertex */
		const mr_tri t[] = { { { 0, 1, 2 } }, { { 0, 8, 5 } } };
		mr_census c = measure(&ctx, p, 9, t, 2).census;
		assert_int_equal(c.nonmanifold_vertices, 1);
		assert_int_equal(c.nonmanifold_edges, 0);
		assert_int_equal(c.boundary_loops, 2);
		assert_int_equal(c.components, 1);
	}
	{ /* neighbours of opposite orientation */
		const mr_tri t[] = { { { 0, 1, 2 } }, { { 0, 1, 5 } } };
		mr_census c = measure(&ctx, p, 6, t, 2).census;
		assert_int_equal(c.inconsistent_edges, 1);
		assert_int_equal(c.folded_edges, 0);
		assert_false(c.oriented);
		assert_true(c.manifold);
	}
	{ /* a vertex twice, a face on a line, a face three times */
		const mr_tri t[] = { { { 0, 0, 2 } }, { { 0, 7, 1 } }, { { 2, 4, 3 } }, { { 3, 2, 4 } },
			{ { 4, 2, 3 } } };
		mr_surface_figures s = measure(&ctx, p, 8, t, 5);
		assert_int_equal(s.census.degenerate_faces, 2);
		assert_int_equal(s.census.duplicate_faces, 2);
		assert_int_equal(s.census.isolated_vertices, 2);
		assert_int_equal(s.intersections, 3);
	}
	{ /* folded over, and the same with one face turned */
		const mr_tri t[] = { { { 0, 1, 2 } }, { { 1, 0, 9 } } },
			     u[] = { { { 0, 1, 2 } }, { { 0, 1, 9 } } };
		assert_int_equal(measure(&ctx, p, 10, t, 2).census.folded_edges, 1);
		assert_int_equal(measure(&ctx, p, 10, u, 2).census.folded_edges, 1);
		assert_int_equal(measure(&ctx, p, 10, t, 2).intersections, 0);
	}
	{ /* a face through another */
		const mr_tri t[] = { { { 0, 1, 2 } }, { { 9, 4, 10 } } };
		assert_int_equal(measure(&ctx, p, 11, t, 2).intersections, 1);
	}
	{ /* no face has area */
		const mr_tri t[] = { { { 0, 0, 2 } }, { { 1, 1, 1 } } };
		mr_surface_figures s = measure(&ctx, p, 3, t, 2);
		assert_int_equal(s.census.degenerate_faces, 2);
		assert_int_equal(s.census.euler, 0);
		assert_true(isnan(s.geometry.angle_min) && isnan(s.geometry.edge.mean));
		assert_true(isnan(s.evenness.mean) && isnan(s.geometry.valence6));
	}
	mr_ctx_free(&ctx);
}

/* The Moebius strip: one edge along which two faces run alike per cut, one loop, Euler number 0. */
static void
moebius_strip_is_not_oriented(void **state)
{
	enum { N = 12 };
	mr_v3 p[2 * N];
	mr_tri t[2 * N];
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (uint32_t i = 0; i < N; i++) {
		double a = 2 * MR_PI * i / N;
		for (uint32_t k = 0; k < 2; k++) {
			double w = k ? 0.3 : -0.3, r = 1 + w * cos(a / 2);
			p[2 * i + k] = mr_vec(r * cos(a), r * sin(a), w * sin(a / 2));
		}
		uint32_t b = i + 1 < N ? 2 * i + 2 : 1, d = i + 1 < N ? 2 * i + 3 : 0;
		t[2 * i] = (mr_tri){ { 2 * i, b, d } };
		t[2 * i + 1] = (mr_tri){ { 2 * i, d, 2 * i + 1 } };
	}
	mr_surface_figures s = measure(&ctx, p, (size_t)2 * N, t, (size_t)2 * N);
	assert_int_equal(s.census.inconsistent_edges, 1);
	assert_int_equal(s.census.boundary_loops, 1);
	assert_int_equal(s.census.euler, 0);
	assert_true(s.census.manifold);
	assert_int_equal(s.intersections, 0);
	mr_ctx_free(&ctx);
}

static void
cloud_is_measured(void **state)
{
	enum { N = 20 };
	mr_v3 p[N * N + 2];
	mr_cloud_figures c;
	mr_ctx ctx;
	size_t n = 0;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (int i = 0; i < N * N; i++)
		p[n++] = mr_vec(2 * (i % N), i / N * 2, 0);
	p[n++] = p[7];
	p[n++] = mr_vec(NAN, 0, 0);
	assert_int_equal(mr_measure_points(&ctx, p, n, NULL, &c), MR_OK);
	assert_int_equal(c.points, n);
	assert_int_equal(c.not_finite, 1);
	assert_int_equal(c.duplicates, 1);
	assert_int_equal(c.places, N * N);
	assert_int_equal(c.outliers, 0);
	assert_near(c.spacing.min, 2, 0.1);
	assert_near(c.usual, 2, 0.1);
	assert_near(c.area, 4 * N * N, 0.2 * 4 * N * N);
	assert_near(c.evenness, 0.85, 0.15);
	assert_near(c.noise, 0, 1e-9);
	assert_near(c.diagonal, sqrt(2) * 2 * (N - 1), 1e-14);
	assert_int_equal(mr_measure_points(&ctx, p, 1, NULL, &c), MR_OK);
	assert_true(isnan(c.spacing.mean) && isnan(c.usual) && isnan(c.noise_spacing));
	assert_int_equal(c.places, 1);
	assert_int_equal(mr_measure_points(&ctx, p, 0, NULL, &c), MR_OK);
	assert_int_equal(c.points, 0);
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(plane_is_flat_and_regular),
		cmocka_unit_test(torus_has_genus_one),
		cmocka_unit_test(sphere_converges),
		cmocka_unit_test(cylinder_has_two_loops),
		cmocka_unit_test(flaws_are_counted),
		cmocka_unit_test(moebius_strip_is_not_oriented),
		cmocka_unit_test(cloud_is_measured),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
