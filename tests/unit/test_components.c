/* Parts of a volume and its cavities: counted by flooding random ones, dropped where no points bound them. */
#include "base/random.h"
#include "unit.h"
#include "volume/parts.h"

enum { N = 18, NODES = N * N * N };

static const mr_grid GRID = { { 0, 0, 0 }, 1, { N, N, N } };

/* Visits what hangs together with a node: over edges, or over diagonals of faces too. */
static void
flood(const bool *in, bool value, bool diagonals, size_t from, bool *seen)
{
	size_t *stack = MR_NEW(&ctx, NODES, size_t), waiting = 0;

	assert_non_null(stack);
	stack[waiting++] = from;
	seen[from] = true;
	while (waiting > 0) {
		size_t at = stack[--waiting];
		int p[3] = { (int)(at % N), (int)(at / N % N), (int)(at / (N * N)) };
		for (int d = 0; d < 27; d++) {
			int w[3] = { d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1 };
			int far = abs(w[0]) + abs(w[1]) + abs(w[2]);
			bool on = true;
			size_t to;
			for (int k = 0; k < 3; k++)
				on &= p[k] + w[k] >= 0 && p[k] + w[k] < N;
			if (!on || far == 0 || far > (diagonals ? 2 : 1))
				continue;
			to = (size_t)(((p[2] + w[2]) * N + p[1] + w[1]) * N + p[0] + w[0]);
			if (in[to] != value || seen[to])
				continue;
			seen[to] = true;
			stack[waiting++] = to;
		}
	}
}

/* How many parts the inside has, and how many cavities: parts of the outside without the first node's. */
static void
count(const bool *in, size_t *parts, size_t *cavities)
{
	bool *seen = MR_NEW_ZERO(&ctx, NODES, bool);

	*parts = *cavities = 0;
	flood(in, false, true, 0, seen);
	for (size_t i = 0; i < NODES; i++)
		if (!seen[i]) {
			flood(in, in[i], !in[i], i, seen);
			*parts += in[i];
			*cavities += !in[i];
		}
}

static float *
field_from(const bool *in, mr_random *r)
{
	float *f = MR_NEW(&ctx, NODES, float);

	assert_non_null(f);
	for (size_t i = 0; i < NODES; i++)
		f[i] = (float)((in[i] ? -1 : 1) * (0.1 + mr_random_real(r)));
	return f;
}

static void
clean(const mr_volume_cloud *s, float *f)
{
	mr_filled in;

	mr_filled_new(&ctx, &GRID, &in);
	for (size_t i = 0; i < NODES; i++)
		in.bit[i / N] |= (uint64_t)(f[i] < 0) << i % N;
	assert_int_equal(mr_volume_clean(&ctx, s, &in), MR_OK);
	for (size_t i = 0; i < NODES; i++)
		f[i] = in.bit[i / N] >> i % N & 1 ? -fabsf(f[i]) : fabsf(f[i]);
}

/* Random insides of all densities; without any points one part stays, and what it encloses is filled. */
static void
random_volumes_have_the_parts_that_floods_find(void **state)
{
	mr_random r = { 1 };
	size_t parts, cavities, all_parts = 0, all_cavities = 0;
	mr_volume_cloud none = { .n = 0, .spacing = 1 };

	(void)state;
	for (int share = 1; share < 20; share++) {
		bool *in = MR_NEW_ZERO(&ctx, NODES, bool), *outside = MR_NEW_ZERO(&ctx, NODES, bool);
		float *f, *before = MR_NEW(&ctx, NODES, float);
		size_t kept = 0;
		bool *left = MR_NEW_ZERO(&ctx, NODES, bool);
		for (size_t i = 0; i < NODES; i++) {
			size_t x = i % N, y = i / N % N, z = i / (N * N);
			bool inner = x % (N - 1) && y % (N - 1) && z % (N - 1);
			in[i] = inner && mr_random_real(&r) < 0.05 * share;
		}
		f = field_from(in, &r);
		memcpy(before, f, NODES * sizeof *f);
		count(in, &parts, &cavities);
		clean(&none, f);
		all_parts += parts;
		all_cavities += cavities;
		for (size_t i = 0; i < NODES; i++) {
			assert_true(fabsf(f[i]) == fabsf(before[i]));
			left[i] = f[i] < 0;
		}
		count(left, &parts, &cavities);
		assert_int_equal(parts, 1);
		assert_int_equal(cavities, 0);
		/* it is one part of the inside, with what cannot be left for the outside but through it */
		while (!left[kept] || !in[kept])
			kept++;
		flood(in, true, false, kept, outside);
		for (size_t i = 0; i < NODES; i++)
			in[i] = outside[i]; /* the part alone */
		memset(outside, 0, NODES * sizeof *outside);
		flood(in, false, true, 0, outside);
		for (size_t i = 0; i < NODES; i++)
			assert_int_equal(left[i], !outside[i]);
		mr_ctx_free(&ctx);
	}
	assert_true(all_parts > 1000 && all_cavities > 100);
}

/* Points of a lattice on the faces of a box, its spacing `step`. */
static size_t
box_points(mr_v3 low, mr_v3 high, double step, mr_v3 *p)
{
	size_t n = 0;

	for (double z = low.z; z < high.z + step / 2; z += step)
		for (double y = low.y; y < high.y + step / 2; y += step)
			for (double x = low.x; x < high.x + step / 2; x += step)
				if (x < low.x + step / 2 || x > high.x - step / 2 || y < low.y + step / 2 ||
				    y > high.y - step / 2 || z < low.z + step / 2 || z > high.z - step / 2)
					p[n++] = mr_vec(x, y, z);
	return n;
}

/* Each of n points has a square of side `step` to itself. */
static double *
areas(size_t n, double step)
{
	double *area = MR_NEW(&ctx, n, double);

	assert_non_null(area);
	for (size_t i = 0; i < n; i++)
		area[i] = step * step;
	return area;
}

static bool
is_between(size_t i, double low, double high)
{
	double x = (double)(i % N), y = (double)(i / N % N), z = (double)(i / (N * N));

	return x > low && x < high && y > low && y < high && z > low && z < high;
}

/* A box with a cavity, and a small box in that: they stay where points are on their walls, and go where there
 * are none. */
static void
walls_without_points_go(void **state)
{
	static const double wall[3][2] = { { 1.5, 15.5 }, { 4.5, 12.5 }, { 6.5, 9.5 } };

	(void)state;
	for (unsigned walls = 0; walls < 4;
	     walls++) { /* bit 0: the cavity's have points, bit 1: the small box's */
		bool cavity = walls & 1, small = walls & 2;
		mr_v3 *p = MR_NEW(&ctx, 10000, mr_v3);
		bool *in = MR_NEW(&ctx, NODES, bool);
		mr_volume_cloud s = { .p = p, .spacing = 0.5 };
		mr_random r = { 2 };
		float *f;
		for (int k = 0; k < 3; k++)
			if (k == 0 || walls >> (k - 1) & 1)
				s.n += box_points(mr_vec(wall[k][0], wall[k][0], wall[k][0]),
				    mr_vec(wall[k][1], wall[k][1], wall[k][1]), s.spacing, p + s.n);
		s.plane.area = areas(s.n, s.spacing);
		for (size_t i = 0; i < NODES; i++)
			in[i] = is_between(i, wall[0][0], wall[0][1]) &&
			        (!is_between(i, wall[1][0], wall[1][1]) ||
				    is_between(i, wall[2][0], wall[2][1]));
		f = field_from(in, &r);
		clean(&s, f);
		/* points on the small box bound the cavity too, whose walls are eight times as large */
		for (size_t i = 0; i < NODES; i++) {
			bool want = is_between(i, wall[0][0], wall[0][1]);
			if (cavity && is_between(i, wall[1][0], wall[1][1]))
				want = small && is_between(i, wall[2][0], wall[2][1]);
			assert_int_equal(f[i] < 0, want);
		}
	}
}

/* Two boxes side by side, one without points: it goes, whichever is larger. */
static void
a_part_without_points_goes(void **state)
{
	for (int right = 0; right < 2; right++) {
		mr_v3 *p = MR_NEW(&ctx, 10000, mr_v3);
		bool *in = MR_NEW(&ctx, NODES, bool);
		mr_volume_cloud s = { .p = p, .spacing = 0.5 };
		mr_random r = { 3 };
		float *f;
		(void)state;
		s.n = right ? box_points(mr_vec(11.5, 3.5, 3.5), mr_vec(15.5, 8.5, 8.5), 0.5, p)
		            : box_points(mr_vec(1.5, 1.5, 1.5), mr_vec(9.5, 14.5, 14.5), 0.5, p);
		s.plane.area = areas(s.n, s.spacing);
		for (size_t i = 0; i < NODES; i++) {
			double x = (double)(i % N), y = (double)(i / N % N), z = (double)(i / (N * N));
			in[i] = (x > 1.5 && x < 9.5 && y > 1.5 && y < 14.5 && z > 1.5 && z < 14.5) ||
			        (x > 11.5 && x < 15.5 && y > 3.5 && y < 8.5 && z > 3.5 && z < 8.5);
		}
		f = field_from(in, &r);
		clean(&s, f);
		for (size_t i = 0; i < NODES; i++)
			assert_int_equal(f[i] < 0, in[i] && (i % N > 10) == right);
	}
}

/* A box whose points are far sparser than most stays if they are many, and goes if they are few, for these
 * may be strewn. */
static void
sparse_walls_are_walls(void **state)
{
	for (int many = 0; many < 2; many++) {
		const double step = many ? 1.2 : 2.1, high = many ? 9.5 : 5.5;
		mr_v3 *p = MR_NEW(&ctx, 10000, mr_v3);
		bool *in = MR_NEW(&ctx, NODES, bool);
		mr_volume_cloud s = { .p = p, .spacing = 0.3 };
		mr_random r = { 4 };
		size_t dense, sparse;
		double *area;
		float *f;
		(void)state;
		dense = box_points(mr_vec(11.5, 1.5, 1.5), mr_vec(15.5, 14.5, 14.5), s.spacing, p);
		sparse = box_points(mr_vec(1.5, 1.5, 1.5), mr_vec(high, high, high), step, p + dense);
		assert_true((sparse > 100) == many && sparse > 12);
		s.n = dense + sparse;
		s.plane.area = area = areas(s.n, s.spacing);
		for (size_t i = dense; i < s.n; i++)
			area[i] = step * step;
		for (size_t i = 0; i < NODES; i++) {
			size_t x = i % N, y = i / N % N, z = i / (N * N);
			in[i] = is_between(i, 1.5, high) ||
			        (x > 11 && x < 16 && y > 1 && y < 15 && z > 1 && z < 15);
		}
		f = field_from(in, &r);
		clean(&s, f);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(
		    random_volumes_have_the_parts_that_floods_find, setup, teardown),
		cmocka_unit_test_setup_teardown(walls_without_points_go, setup, teardown),
		cmocka_unit_test_setup_teardown(a_part_without_points_goes, setup, teardown),
		cmocka_unit_test_setup_teardown(sparse_walls_are_walls, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
