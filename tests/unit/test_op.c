/* Areas, the cotangent Laplacian and its powers against their definitions. */
#include "base/random.h"
#include "op/laplace.h"
#include "op/voronoi_area.h"
#include "unit.h"

static void
assert_near(double a, double b, double tolerance)
{
	if (!(fabs(a - b) <= tolerance))
		fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

/* An n x n grid over the unit square, bent and perturbed. */
static mr_mesh
sheet(uint32_t n, double noise)
{
	mr_v3 *p = MR_NEW(&ctx, (size_t)n * n, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * (size_t)(n - 1) * (n - 1), mr_tri);
	mr_random r = { 3 };
	size_t f = 0;

	for (uint32_t i = 0; i < n; i++)
		for (uint32_t j = 0; j < n; j++) {
			double x = (j + noise * mr_random_real(&r)) / (n - 1);
			double y = (i + noise * mr_random_real(&r)) / (n - 1);
			p[i * n + j] = mr_vec(x, y, 0.3 * x * y);
		}
	for (uint32_t i = 0; i + 1 < n; i++)
		for (uint32_t j = 0; j + 1 < n; j++) {
			uint32_t a = i * n + j;
			t[f++] = (mr_tri){ { a, a + 1, a + n + 1 } };
			t[f++] = (mr_tri){ { a, a + n + 1, a + n } };
		}
	return (mr_mesh){ "mesh", p, t, (size_t)n * n, f };
}

static double *
dense_of(const mr_sparse *a, size_t columns)
{
	double *d = MR_NEW_ZERO(&ctx, (size_t)a->n * columns, double);

	for (size_t i = 0; i < (size_t)a->n; i++)
		for (int e = a->start[i]; e < a->start[i + 1]; e++) {
			if (e > a->start[i])
				assert_true(a->index[e] > a->index[e - 1]);
			d[i * columns + (size_t)a->index[e]] = a->value[e];
		}
	return d;
}

static void
test_corners_share_the_triangle(void **state)
{
	double part[3];

	(void)state;
	mr_voronoi_corners(mr_vec(0, 0, 0), mr_vec(1, 0, 0), mr_vec(0.5, sqrt(0.75), 0), part);
	for (int k = 0; k < 3; k++)
		assert_near(part[k], sqrt(3) / 12, 1e-15);
	mr_voronoi_corners(mr_vec(0, 0, 0), mr_vec(1, 0, 0), mr_vec(0, 2, 0), part); /* a right angle */
	assert_near(part[0], 0.5, 1e-15);
	assert_near(part[1], 0.25, 1e-15);
	mr_voronoi_corners(
	    mr_vec(0, 0, 0), mr_vec(1, 0, 0), mr_vec(-3, 1, 0), part); /* obtuse at the first */
	assert_near(part[0], 0.25, 1e-15);
	assert_near(part[2], 0.125, 1e-15);
	mr_voronoi_corners(mr_vec(0, 0, 0), mr_vec(1, 0, 0), mr_vec(2, 0, 0), part);
	assert_true(part[0] == 0 && part[1] == 0 && part[2] == 0);
	mr_voronoi_corners(mr_vec(1, 1, 1), mr_vec(1, 1, 1), mr_vec(1, 1, 1), part);
	assert_true(part[0] == 0 && part[1] == 0 && part[2] == 0);
}

/* A corner's part is the points of an acute triangle that are nearest it: count them. */
static void
test_corners_are_voronoi_cells(void **state)
{
	enum { STEPS = 1200 };
	mr_v3 p[3] = { { 0, 0, 0 }, { 1, 0.1, 0 }, { 0.45, 0.8, 0.3 } };
	double part[3], count[3] = { 0 }, all = 0;

	(void)state;
	mr_voronoi_corners(p[0], p[1], p[2], part);
	for (int i = 0; i < STEPS; i++)
		for (int j = 0; i + j < STEPS; j++) {
			double u = (i + 1. / 3) / STEPS, v = (j + 1. / 3) / STEPS;
			mr_v3 q = mr_bary_point(mr_vec(1 - u - v, u, v), p[0], p[1], p[2]);
			double d[3] = { mr_dist(q, p[0]), mr_dist(q, p[1]), mr_dist(q, p[2]) };
			count[d[0] <= d[1] && d[0] <= d[2] ? 0 : d[1] <= d[2] ? 1 : 2]++;
			all++;
		}
	for (int k = 0; k < 3; k++)
		assert_near(part[k] / (part[0] + part[1] + part[2]), count[k] / all, 2e-3);
}

static void
test_areas_add_up(void **state)
{
	mr_mesh m = sheet(40, 0.8);
	double *area = MR_NEW(&ctx, m.nv, double), sum = 0;

	(void)state;
	mr_voronoi_areas(&ctx, &m, area);
	for (size_t v = 0; v < m.nv; v++)
		sum += area[v];
	assert_near(sum, mr_mesh_area(&ctx, &m), 1e-13);
}

/* On an equilateral lattice D p = (1/A) sum w (p_j - p_i) of x^2 + y^2 is 4, and L of a linear function 0. */
static void
test_laplacian_of_a_lattice(void **state)
{
	enum { N = 9, MIDDLE = N * 4 + 4 };
	mr_mesh m = sheet(N, 0);
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	double *area = MR_NEW(&ctx, m.nv, double), u[2 * N * N], y[2 * N * N];
	mr_sparse l;

	(void)state;
	for (uint32_t i = 0; i < N; i++)
		for (uint32_t j = 0; j < N; j++)
			p[i * N + j] = mr_vec(j - 0.5 * i, sqrt(0.75) * i, 0);
	m.p = p;
	assert_int_equal(mr_laplace_build(&ctx, &m, &l), MR_OK);
	mr_voronoi_areas(&ctx, &m, area);
	assert_int_equal(l.start[MIDDLE + 1] - l.start[MIDDLE], 7);
	for (size_t v = 0; v < m.nv; v++) {
		u[2 * v] = mr_norm2(p[v]);
		u[2 * v + 1] = 3 * p[v].x - p[v].y + 2;
	}
	mr_sparse_apply(&ctx, &l, NULL, m.nv, 2, u, y);
	assert_near(-y[2 * MIDDLE] / area[MIDDLE], 4, 1e-12);
	assert_near(y[2 * MIDDLE + 1], 0, 1e-13);
}

/* Symmetric, rows that sum to 0, and x' L x the Dirichlet energy of each triangle's linear function. */
static void
test_laplacian_is_the_energy(void **state)
{
	mr_mesh m = sheet(12, 1.5);
	double *u = MR_NEW(&ctx, m.nv, double), *y = MR_NEW(&ctx, m.nv, double), form = 0, energy = 0, *d;
	mr_random r = { 5 };
	mr_sparse l;

	(void)state;
	assert_int_equal(mr_laplace_build(&ctx, &m, &l), MR_OK);
	d = dense_of(&l, m.nv);
	for (size_t i = 0; i < m.nv; i++) {
		double sum = 0;
		for (size_t j = 0; j < m.nv; j++) {
			assert_near(d[i * m.nv + j], d[j * m.nv + i], 1e-12);
			sum += d[i * m.nv + j];
		}
		assert_near(sum, 0, 1e-12);
		u[i] = mr_random_real(&r);
	}
	mr_sparse_apply(&ctx, &l, NULL, m.nv, 1, u, y);
	for (size_t i = 0; i < m.nv; i++)
		form += u[i] * y[i];
	for (size_t f = 0; f < m.nf; f++) {
		const uint32_t *v = m.t[f].v;
		mr_v3 n = mr_face_cross(&m, f), g = { 0, 0, 0 };
		for (int k = 0; k < 3; k++) { /* grad u = sum u_k n x e_k / |n|^2 */
			mr_v3 e = mr_sub(m.p[v[(k + 2) % 3]], m.p[v[(k + 1) % 3]]);
			g = mr_axpy(u[v[k]] / mr_norm2(n), mr_cross(n, e), g);
		}
		energy += mr_norm2(g) * mr_norm(n) / 2;
	}
	assert_near(form / energy, 1, 1e-11);
}

static void
test_cotangents_of_flat_triangles(void **state)
{
	double cot[3];

	(void)state;
	mr_cotangents(mr_vec(0, 0, 0), mr_vec(1, 0, 0), mr_vec(0, 1, 0), cot);
	assert_near(cot[0], 0, 0);
	assert_near(cot[1], 1, 0);
	mr_cotangents(mr_vec(0, 0, 0), mr_vec(1, 0, 0), mr_vec(0.5, 0, 0), cot); /* its energy stays >= 0 */
	assert_true(isfinite(cot[0]) && isfinite(cot[2]));
	assert_true(cot[0] * cot[1] + cot[1] * cot[2] + cot[2] * cot[0] >= -1e-4);
	mr_cotangents(mr_vec(2, 2, 2), mr_vec(2, 2, 2), mr_vec(2, 2, 2), cot);
	assert_true(cot[0] == 0 && cot[1] == 0 && cot[2] == 0);
}

/* The sparse product is the dense one, and threads change no bit. */
static void
test_powers_are_products(void **state)
{
	mr_mesh m = sheet(11, 0.9);
	size_t n = m.nv, rows = 70;
	double *w = MR_NEW(&ctx, n, double), *d, *power;
	mr_random r = { 9 };
	mr_sparse l;

	(void)state;
	assert_int_equal(mr_laplace_build(&ctx, &m, &l), MR_OK);
	d = dense_of(&l, n);
	power = d;
	for (size_t i = 0; i < n; i++)
		w[i] = 0.5 + mr_random_real(&r);
	for (size_t k = 1; k <= 3; k++) {
		mr_sparse lower, full, again;
		double *a, *b, *next = MR_NEW_ZERO(&ctx, n * n, double);
		assert_int_equal(mr_sparse_power(&ctx, &l, w, k, rows, true, &lower), MR_OK);
		assert_int_equal(mr_sparse_power(&ctx, &l, w, k, rows, false, &full), MR_OK);
		a = dense_of(&lower, rows);
		b = dense_of(&full, rows);
		for (size_t i = 0; i < rows; i++)
			for (size_t j = 0; j < rows; j++) {
				assert_near(
				    b[i * rows + j], power[i * n + j], 1e-12 * (1 + fabs(power[i * n + i])));
				assert_near(a[i * rows + j], j <= i ? b[i * rows + j] : 0, 0);
			}
		ctx.threads = 1;
		assert_int_equal(mr_sparse_power(&ctx, &l, w, k, rows, true, &again), MR_OK);
		ctx.threads = 2;
		assert_memory_equal(
		    again.value, lower.value, (size_t)lower.start[rows] * sizeof *lower.value);
		for (size_t i = 0; i < n; i++)
			for (size_t s = 0; s < n; s++)
				for (size_t j = 0; j < n && power[i * n + s] != 0; j++)
					next[i * n + j] += power[i * n + s] * w[s] * d[s * n + j];
		power = next;
	}
}

/* Parts that meet no lower part within `reach` edges are apart from each other: most vertices are in such. */
static void
test_dissection_separates(void **state)
{
	enum { MOST = 100 };
	mr_mesh m = sheet(140, 0.5);
	size_t n = m.nv - 200; /* the last rows are not to be cut */
	int *part = MR_NEW(&ctx, n, int), *again = MR_NEW(&ctx, n, int);
	double *w = MR_NEW(&ctx, m.nv, double);
	mr_sparse l, power;

	(void)state;
	for (size_t i = 0; i < m.nv; i++)
		w[i] = 1;
	assert_int_equal(mr_laplace_build(&ctx, &m, &l), MR_OK);
	for (size_t reach = 1; reach <= 3; reach++) {
		bool meets_lower[MOST] = { false };
		size_t count[MOST] = { 0 }, apart = 0, parts = 0;
		ctx.threads = 2;
		mr_dissect(&ctx, &l, m.p, n, reach, part);
		ctx.threads = 1;
		mr_dissect(&ctx, &l, m.p, n, reach, again);
		assert_memory_equal(part, again, n * sizeof *part);
		assert_int_equal(mr_sparse_power(&ctx, &l, w, reach, n, false, &power), MR_OK);
		for (size_t i = 0; i < n; i++) {
			assert_in_range(part[i], 0, MOST - 1);
			count[part[i]]++;
			for (int e = power.start[i]; e < power.start[i + 1]; e++)
				meets_lower[part[i]] |= part[power.index[e]] < part[i];
		}
		for (int k = 0; k < MOST; k++)
			if (count[k] && !meets_lower[k]) {
				assert_true(count[k] <= 2000);
				apart += count[k];
				parts++;
			}
		assert_true(parts >= 10 && 10 * apart > 8 * n);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_corners_share_the_triangle, setup, teardown),
		cmocka_unit_test_setup_teardown(test_corners_are_voronoi_cells, setup, teardown),
		cmocka_unit_test_setup_teardown(test_areas_add_up, setup, teardown),
		cmocka_unit_test_setup_teardown(test_laplacian_of_a_lattice, setup, teardown),
		cmocka_unit_test_setup_teardown(test_laplacian_is_the_energy, setup, teardown),
		cmocka_unit_test_setup_teardown(test_cotangents_of_flat_triangles, setup, teardown),
		cmocka_unit_test_setup_teardown(test_powers_are_products, setup, teardown),
		cmocka_unit_test_setup_teardown(test_dissection_separates, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
