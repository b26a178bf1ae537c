/* Points to nodes and back, by brute force and by duality: what a cloud spreads is what it sees of any
 * function. */
#include "shapes.h"
#include "volume/parts.h"

enum { POINTS = 500, NX = 14, NY = 11, NZ = 17, NODES = NX * NY * NZ };

static const mr_grid GRID = { { -1, 2, 0.5 }, 0.25, { NX, NY, NZ } };

/* Points well inside of the grid, of random areas, normals and depths. */
static mr_volume_cloud
random_samples(uint64_t seed)
{
	mr_random r = { seed };
	mr_volume_cloud s = { .n = POINTS,
		.p = MR_NEW(&ctx, POINTS, mr_v3),
		.depth = MR_NEW(&ctx, POINTS, uint8_t),
		.plane = { .normal = MR_NEW(&ctx, POINTS, mr_v3), .area = MR_NEW(&ctx, POINTS, double) } };

	assert_true(s.p && s.depth && s.plane.normal && s.plane.area);
	for (size_t i = 0; i < POINTS; i++) {
		mr_v3 in = mr_add(random_vector(&r), mr_vec(0.5, 0.5, 0.5));
		in = mr_vec(1 + (NX - 4) * in.x, 1 + (NY - 4) * in.y, 1 + (NZ - 4) * in.z);
		s.p[i] = mr_axpy(GRID.step, in, GRID.origin);
		s.plane.normal[i] = mr_unit(random_vector(&r));
		s.plane.area[i] = mr_random_real(&r);
		s.depth[i] = (uint8_t)(mr_random_bits(&r) % DEPTHS);
	}
	return s;
}

static mr_grid_points
field_of(const mr_volume_cloud *s, unsigned depth)
{
	mr_grid_points f;

	mr_volume_field(&ctx, s, &GRID, depth, &f);
	return f;
}

static float *
random_floats(uint64_t seed)
{
	float *u = MR_NEW(&ctx, NODES, float);
	mr_random r = { seed };

	assert_non_null(u);
	for (size_t i = 0; i < NODES; i++)
		u[i] = (float)(mr_random_real(&r) - 0.5);
	return u;
}

/* 1 at x = 0, 0 beyond 1. */
static double
hat(double x)
{
	return fmax(0, 1 - fabs(x));
}

/* What a node is to a point, `shift` steps off along an axis. */
static double
weight(size_t x, size_t y, size_t z, mr_v3 p, int axis)
{
	mr_v3 d = mr_mul(1 / GRID.step, mr_sub(p, mr_grid_place(&GRID, x, y, z)));

	return hat(d.x - (axis == 0 ? 0.5 : 0)) * hat(d.y - (axis == 1 ? 0.5 : 0)) *
	       hat(d.z - (axis == 2 ? 0.5 : 0));
}

static double
value_at(const float *u, mr_v3 p)
{
	double sum = 0;

	for (size_t z = 0; z < NZ; z++)
		for (size_t y = 0; y < NY; y++)
			for (size_t x = 0; x < NX; x++)
				sum += weight(x, y, z, p, -1) * (double)u[mr_grid_index(&GRID, x, y, z)];
	return sum;
}

static double
inner_product(const float *a, const float *b)
{
	double sum = 0;

	for (size_t i = 0; i < NODES; i++)
		sum += (double)a[i] * (double)b[i];
	return sum;
}

/* Each point of the depth once, in its layer of cells. */
static void
points_are_listed_by_layer(void **state)
{
	mr_volume_cloud s = random_samples(1);

	(void)state;
	for (unsigned depth = 0; depth <= DEPTHS; depth++) {
		mr_grid_points f = field_of(&s, depth);
		uint8_t seen[POINTS] = { 0 };
		size_t count = 0;
		for (size_t z = 0; z + 1 < NZ; z++)
			for (size_t i = f.first[z]; i < f.first[z + 1]; i++) {
				double at = (s.p[f.order[i]].z - GRID.origin.z) / GRID.step;
				assert_true(at >= (double)z && at < (double)z + 1);
				assert_int_equal(seen[f.order[i]]++, 0);
				count++;
			}
		for (size_t i = 0; i < POINTS; i++)
			count -= depth == DEPTHS || s.depth[i] == depth;
		assert_int_equal(count, 0);
	}
}

static void
values_are_linear_between_nodes(void **state)
{
	mr_volume_cloud s = random_samples(2);
	float *u = random_floats(3);

	(void)state;
	for (size_t i = 0; i < POINTS; i++)
		assert_true(fabs(mr_volume_at(&GRID, u, s.p[i]) - value_at(u, s.p[i])) < 1e-12);
	for (size_t z = 0; z + 1 < NZ; z++) /* at a node it is the node's */
		for (size_t x = 0; x + 1 < NX; x++)
			assert_true(fabs(mr_volume_at(&GRID, u, mr_grid_place(&GRID, x, NY / 2, z)) -
					 (double)u[mr_grid_index(&GRID, x, NY / 2, z)]) < 1e-12);
}

/* A node gets what points give it by their hats; nothing is left of what was there. */
static void
spread_values_are_sums_of_hats(void **state)
{
	mr_volume_cloud s = random_samples(4);
	float *to = random_floats(5);
	double value[POINTS];
	mr_random r = { 6 };

	(void)state;
	for (size_t i = 0; i < POINTS; i++)
		value[i] = mr_random_real(&r);
	for (unsigned depth = 0; depth <= DEPTHS; depth++) {
		mr_grid_points f = field_of(&s, depth);
		const double *v = depth % 2 ? value : NULL;
		mr_volume_spread(&ctx, &s, &f, v, to);
		for (size_t z = 0; z < NZ; z++)
			for (size_t y = 0; y < NY; y++)
				for (size_t x = 0; x < NX; x++) {
					double want = 0;
					for (size_t i = 0; i < POINTS; i++)
						if (depth == DEPTHS || s.depth[i] == depth)
							want += s.plane.area[i] / (GRID.step * GRID.step) *
							        (v ? v[i] : 1) * weight(x, y, z, s.p[i], -1);
					assert_true(
					    fabs((double)to[mr_grid_index(&GRID, x, y, z)] - want) < 1e-4);
				}
	}
}

/* The sum over nodes of what is spread times any u is the sum over points of u at them. */
static void
spreading_is_the_transpose_of_looking(void **state)
{
	mr_volume_cloud s = random_samples(7);
	mr_grid_points f = field_of(&s, DEPTHS);
	float *u = random_floats(8), *to = random_floats(9);
	double want = 0;

	(void)state;
	mr_volume_spread(&ctx, &s, &f, NULL, to);
	for (size_t i = 0; i < POINTS; i++)
		want += s.plane.area[i] / (GRID.step * GRID.step) * mr_volume_at(&GRID, u, s.p[i]);
	assert_true(fabs(inner_product(to, u) - want) < 1e-2);
}

/* The divergence times any u is minus the flow of the normals along the differences of u, each between its
 * nodes. */
static void
divergence_is_the_transpose_of_differences(void **state)
{
	mr_volume_cloud s = random_samples(10);
	mr_grid_points f = field_of(&s, DEPTHS);
	float *u = random_floats(11), *to = random_floats(12);
	const size_t stride[3] = { 1, NX, NX * NY }, n[3] = { NX, NY, NZ };
	double want = 0, sum = 0;

	(void)state;
	mr_volume_divergence(&ctx, &s, &f, to);
	for (size_t i = 0; i < POINTS; i++)
		for (int k = 0; k < 3; k++)
			for (size_t z = 0; z < NZ; z++)
				for (size_t y = 0; y < NY; y++)
					for (size_t x = 0; x < NX; x++) {
						const size_t at[3] = { x, y, z };
						size_t node = mr_grid_index(&GRID, x, y, z);
						if (at[k] + 1 < n[k])
							want += s.plane.area[i] / (GRID.step * GRID.step) *
							        mr_coordinate(s.plane.normal[i], k) *
							        weight(x, y, z, s.p[i], k) *
							        ((double)u[node] -
								    (double)u[node + stride[k]]);
					}
	assert_true(fabs(inner_product(to, u) - want) < 1e-2);
	for (size_t i = 0; i < NODES; i++)
		sum += (double)to[i];
	assert_true(fabs(sum) < 1e-2); /* nothing comes from nowhere */
}

/* Of a linear u the differences are its slope: the flow is known. */
static void
divergence_of_a_linear_function_is_known(void **state)
{
	mr_volume_cloud s = random_samples(13);
	mr_grid_points f = field_of(&s, DEPTHS);
	float *u = random_floats(14), *to = random_floats(15);
	mr_v3 slope = mr_vec(0.5, -0.25, 0.125);
	double want = 0;

	(void)state;
	for (size_t z = 0; z < NZ; z++)
		for (size_t y = 0; y < NY; y++)
			for (size_t x = 0; x < NX; x++)
				u[mr_grid_index(&GRID, x, y, z)] = (float)mr_dot(
				    slope, mr_vec((double)x, (double)y, (double)z));
	mr_volume_divergence(&ctx, &s, &f, to);
	for (size_t i = 0; i < POINTS; i++)
		want -= s.plane.area[i] / (GRID.step * GRID.step) * mr_dot(s.plane.normal[i], slope);
	assert_true(fabs(inner_product(to, u) - want) < 1e-2);
}

static void
threads_do_not_matter(void **state)
{
	mr_volume_cloud s = random_samples(16);
	mr_grid_points f = field_of(&s, DEPTHS);
	float *to[2][4];

	(void)state;
	for (unsigned threads = 1; threads < 4; threads++) {
		ctx.threads = threads;
		for (int k = 0; k < 2; k++)
			to[k][threads] = MR_NEW(&ctx, NODES, float);
		mr_volume_spread(&ctx, &s, &f, NULL, to[0][threads]);
		mr_volume_divergence(&ctx, &s, &f, to[1][threads]);
		for (int k = 0; k < 2; k++)
			assert_memory_equal(to[k][threads], to[k][1], NODES * sizeof(float));
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(points_are_listed_by_layer, setup, teardown),
		cmocka_unit_test_setup_teardown(values_are_linear_between_nodes, setup, teardown),
		cmocka_unit_test_setup_teardown(spread_values_are_sums_of_hats, setup, teardown),
		cmocka_unit_test_setup_teardown(spreading_is_the_transpose_of_looking, setup, teardown),
		cmocka_unit_test_setup_teardown(divergence_is_the_transpose_of_differences, setup, teardown),
		cmocka_unit_test_setup_teardown(divergence_of_a_linear_function_is_known, setup, teardown),
		cmocka_unit_test_setup_teardown(threads_do_not_matter, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
