/* Multigrid on a grid: its transfers by algebra, its solutions against closed forms and a dense solve. */
#include "base/random.h"
#include "unit.h"
#include "volume/parts.h"

static size_t
nodes_of(const size_t n[3])
{
	return n[0] * n[1] * n[2];
}

/* A node of a grid of n, by its number. */
typedef struct node {
	size_t x, y, z;
	bool inner; /* on no face of the grid */
} node;

static node
node_at(const size_t n[3], size_t i)
{
	node a = { i % n[0], i / n[0] % n[1], i / (n[0] * n[1]), false };

	a.inner = a.x > 0 && a.y > 0 && a.z > 0 && a.x + 1 < n[0] && a.y + 1 < n[1] && a.z + 1 < n[2];
	return a;
}

static float *
floats(size_t n)
{
	float *f = MR_NEW_ZERO(&ctx, n, float);

	assert_non_null(f);
	return f;
}

/* Random on inner nodes, 0 on the faces. */
static float *
random_inner(mr_random *r, const size_t n[3])
{
	float *f = floats(nodes_of(n));

	for (size_t i = 0; i < nodes_of(n); i++)
		if (node_at(n, i).inner)
			f[i] = (float)(mr_random_real(r) - 0.5);
	return f;
}

static mr_grid_multigrid
begin(const size_t n[3], size_t levels, bool screened)
{
	mr_grid_multigrid m;

	mr_multigrid_begin(&ctx, n, levels, floats(nodes_of(n)), screened, &m);
	return m;
}

static double
inner_product(const float *a, const float *b, size_t n)
{
	double sum = 0;

	for (size_t i = 0; i < n; i++)
		sum += (double)a[i] * (double)b[i];
	return sum;
}

/* Enough nodes, no more than to the next that coarser grids fit; the coarsest is small. */
static void
coarser_grids_fit(void **state)
{
	(void)state;
	for (size_t cells = 1; cells < 5000; cells += 1 + cells / 7) {
		size_t levels = mr_multigrid_levels(cells), unit = (size_t)1 << (levels - 1);
		size_t n = mr_multigrid_nodes(cells, levels);
		assert_true(n > cells && (n - 1) % unit == 0 && (n - 1) / unit >= 2);
		assert_true((n - 1) / unit <= 13 && (levels == 1 || cells / unit >= 6));
		assert_true(n - 1 - cells < unit || n - 1 == 2 * unit);
	}
}

static void
levels_halve(void **state)
{
	static const size_t n[3] = { 17, 33, 9 };
	mr_grid_multigrid m = begin(n, 3, true);

	(void)state;
	assert_int_equal(m.levels, 3);
	for (size_t i = 0; i < 3; i++) {
		const mr_grid_level *l = &m.level[i];
		for (int k = 0; k < 3; k++)
			assert_int_equal(l->n[k], (n[k] - 1) / ((size_t)1 << i) + 1);
		for (size_t j = 0; j < nodes_of(l->n); j++)
			assert_true(l->u[j] == 0 && l->b[j] == 0 && l->screen[j] == 0);
	}
}

/* Interpolation between nodes is exact for what is linear along each axis, and adds to what is kept. */
static void
prolongation_is_linear_between_nodes(void **state)
{
	static const size_t n[3] = { 17, 9, 13 };
	mr_grid_multigrid m = begin(n, 2, false);
	const mr_grid_level *f = &m.level[0], *c = &m.level[1];
	float *from = floats(nodes_of(c->n)), *to = floats(nodes_of(n));

	(void)state;
	for (size_t i = 0; i < nodes_of(c->n); i++) {
		node at = node_at(c->n, i);
		double a = (double)at.x, b = (double)at.y, d = (double)at.z;
		from[i] = (float)(1 + 2 * a - b * d + 0.25 * a * b * d);
	}
	for (size_t i = 0; i < nodes_of(n); i++)
		to[i] = 8;
	mr_multigrid_prolong(&ctx, f, c, from, to, 0.5f, 3);
	for (size_t i = 0; i < nodes_of(n); i++) {
		node at = node_at(n, i);
		double a = (double)at.x / 2, b = (double)at.y / 2, d = (double)at.z / 2;
		double want = 4 + 3 * (1 + 2 * a - b * d + 0.25 * a * b * d);
		assert_true(fabs((double)to[i] - (at.inner ? want : 8)) < 1e-3);
	}
}

/* Full weighting keeps constants and what is linear, and is an eighth of the transpose of the interpolation.
 */
static void
restriction_is_the_transpose(void **state)
{
	static const size_t n[3] = { 17, 9, 13 };
	mr_grid_multigrid m = begin(n, 2, false);
	const mr_grid_level *f = &m.level[0], *c = &m.level[1];
	float *fine = floats(nodes_of(n)), *coarse = floats(nodes_of(c->n));
	mr_random r = { 1 };

	(void)state;
	for (size_t i = 0; i < nodes_of(n); i++) {
		node at = node_at(n, i);
		fine[i] = (float)(3 + (double)at.x - 2 * (double)at.y + 0.5 * (double)at.z);
	}
	mr_multigrid_restrict(&ctx, f, c, fine, coarse, 2);
	for (size_t i = 0; i < nodes_of(c->n); i++) {
		node at = node_at(c->n, i);
		double want = 2 * (3 + 2 * (double)at.x - 4 * (double)at.y + (double)at.z);
		assert_true(fabs((double)coarse[i] - (at.inner ? want : 0)) < 1e-4);
	}
	for (int k = 0; k < 20; k++) {
		float *a = random_inner(&r, n), *b = random_inner(&r, c->n);
		float *pb = floats(nodes_of(n)), *ra = floats(nodes_of(c->n));
		mr_multigrid_prolong(&ctx, f, c, b, pb, 0, 1);
		mr_multigrid_restrict(&ctx, f, c, a, ra, 1);
		assert_true(fabs(inner_product(pb, a, nodes_of(n)) -
				 8 * inner_product(b, ra, nodes_of(c->n))) < 1e-4);
	}
}

/* sin(a pi x / (n - 1)) along each axis: an eigenvector, of value 6 - 2 sum cos + screen. */
static double
wave(const size_t n[3], const int k[3], node at)
{
	return sin(k[0] * MR_PI * (double)at.x / (double)(n[0] - 1)) *
	       sin(k[1] * MR_PI * (double)at.y / (double)(n[1] - 1)) *
	       sin(k[2] * MR_PI * (double)at.z / (double)(n[2] - 1));
}

/*
 * Once from coarse to fine gives a wave to what differences over a step know of it: the square of its phase
 * in a step, of which 0.2 was measured at most.
 */
static void
waves_are_solved_on_any_grid(void **state)
{
	static const size_t sizes[][3] = { { 17, 17, 17 }, { 33, 33, 33 }, { 65, 65, 65 }, { 33, 65, 17 },
		{ 97, 49, 25 }, { 257, 129, 33 } };
	static const int waves[][3] = { { 1, 1, 1 }, { 1, 2, 3 }, { 4, 3, 2 } };

	(void)state;
	for (size_t s = 0; s < 6; s++)
		for (size_t w = 0; w < (s < 5 ? 3 : 1); w++) {
			const size_t *n = sizes[s];
			size_t most = n[0] > n[1] ? n[0] : n[1];
			mr_grid_multigrid m = begin(n, mr_multigrid_levels(most - 1), false);
			double value = 6, worst = 0, phase = 0;
			for (int k = 0; k < 3; k++) {
				double along = waves[w][k] * MR_PI / (double)(n[k] - 1);
				value -= 2 * cos(along);
				phase = fmax(phase, along);
			}
			for (size_t i = 0; i < nodes_of(n); i++)
				if (node_at(n, i).inner)
					m.level[0].b[i] = (float)(value * wave(n, waves[w], node_at(n, i)));
			mr_multigrid_full(&ctx, &m);
			for (size_t i = 0; i < nodes_of(n); i++) {
				double off = (double)m.level[0].u[i] - wave(n, waves[w], node_at(n, i));
				worst = fmax(worst, fabs(off));
			}
			assert_true(worst < 0.3 * phase * phase);
		}
}

/* Gaussian elimination without pivots, of a matrix that is dominated by its diagonal. */
static void
dense_solve(double *a, double *b, size_t n)
{
	for (size_t j = 0; j < n; j++)
		for (size_t i = j + 1; i < n; i++) {
			double f = a[i * n + j] / a[j * n + j];
			if (f == 0)
				continue;
			for (size_t k = j; k < n; k++)
				a[i * n + k] -= f * a[j * n + k];
			b[i] -= f * b[j];
		}
	for (size_t j = n; j-- > 0;) {
		for (size_t k = j + 1; k < n; k++)
			b[j] -= a[j * n + k] * b[k];
		b[j] /= a[j * n + j];
	}
}

/* (6 + screen) u - sum of the six neighbours = b, by rows and columns. */
static double *
solve_densely(const size_t n[3], const float *screen, const float *b)
{
	size_t m[3] = { n[0] - 2, n[1] - 2, n[2] - 2 }, count = nodes_of(m);
	double *a = MR_NEW_ZERO(&ctx, count * count, double), *x = MR_NEW(&ctx, count, double);
	const size_t far[3] = { 1, m[0], m[0] * m[1] };

	assert_true(a && x);
	for (size_t i = 0; i < count; i++) {
		node at = node_at(m, i);
		size_t full = ((at.z + 1) * n[1] + at.y + 1) * n[0] + at.x + 1,
		       place[3] = { at.x, at.y, at.z };
		a[i * count + i] = 6 + (screen ? (double)screen[full] : 0);
		x[i] = (double)b[full];
		for (int axis = 0; axis < 3; axis++) {
			if (place[axis] > 0)
				a[i * count + i - far[axis]] = -1;
			if (place[axis] + 1 < m[axis])
				a[i * count + i + far[axis]] = -1;
		}
	}
	dense_solve(a, x, count);
	return x;
}

/* Random right sides, and screens that absorb at random places: to 2 % of the greatest value was measured. */
static void
small_systems_are_solved_as_densely(void **state)
{
	static const size_t n[3] = { 9, 13, 9 };
	mr_random r = { 2 };

	(void)state;
	for (int round = 0; round < 6; round++) {
		bool screened = round % 2;
		mr_grid_multigrid m = begin(n, 2, screened);
		mr_grid_level *l = &m.level[0];
		double *want, most = 0, worst = 0;
		for (size_t i = 0; i < nodes_of(n); i++)
			if (!node_at(n, i).inner)
				continue;
			else if (screened)
				l->b[i] = mr_random_bits(&r) % 4 ? 0 : (float)(20 * mr_random_real(&r));
			else
				l->b[i] = (float)(mr_random_real(&r) - 0.2);
		want = solve_densely(n, l->screen, l->b);
		mr_multigrid_full(&ctx, &m);
		for (size_t i = 0; i < nodes_of(n); i++) {
			node at = node_at(n, i);
			double w;
			if (!at.inner) {
				assert_true(l->u[i] == 0);
				continue;
			}
			w = want[((at.z - 1) * (n[1] - 2) + at.y - 1) * (n[0] - 2) + at.x - 1];
			most = fmax(most, fabs(w));
			worst = fmax(worst, fabs((double)l->u[i] - w));
		}
		assert_true(worst < 0.04 * most);
	}
}

static void
threads_do_not_matter(void **state)
{
	static const size_t n[3] = { 65, 33, 97 };
	mr_random r = { 3 };
	float *b = random_inner(&r, n), *first = NULL;

	(void)state;
	for (unsigned threads = 1; threads < 4; threads++) {
		mr_grid_multigrid m = begin(n, 3, false);
		ctx.threads = threads;
		memcpy(m.level[0].b, b, nodes_of(n) * sizeof *b);
		mr_multigrid_full(&ctx, &m);
		if (threads == 1)
			first = m.level[0].u;
		assert_memory_equal(m.level[0].u, first, nodes_of(n) * sizeof *first);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(coarser_grids_fit, setup, teardown),
		cmocka_unit_test_setup_teardown(levels_halve, setup, teardown),
		cmocka_unit_test_setup_teardown(prolongation_is_linear_between_nodes, setup, teardown),
		cmocka_unit_test_setup_teardown(restriction_is_the_transpose, setup, teardown),
		cmocka_unit_test_setup_teardown(waves_are_solved_on_any_grid, setup, teardown),
		cmocka_unit_test_setup_teardown(small_systems_are_solved_as_densely, setup, teardown),
		cmocka_unit_test_setup_teardown(threads_do_not_matter, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
