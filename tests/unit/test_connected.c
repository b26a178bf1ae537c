/* Parts of clouds and surfaces, against all pairs of their points; layers cut down to parts, and appended
 * again. */
#include "base/disjoint_sets.h"
#include "base/random.h"
#include "mesh/append.h"
#include "mesh/subset.h"
#include "shape/shape.h"
#include "space/connected.h"
#include "unit.h"

enum { N = 700 };

static mr_v3 point[N];
static double reach[N];

/* Clumps of points of many densities, and some at one place. */
static void
strew(mr_random *r)
{
	for (size_t i = 0; i < N; i++) {
		double side = (double)(1 + i % 7) / 7;
		mr_v3 middle = mr_vec((double)(i % 7), (double)(i % 3), 0);
		mr_v3 q = mr_vec(mr_random_real(r), mr_random_real(r), mr_random_real(r));
		point[i] = i % 50 == 49 ? point[i - 1] : mr_axpy(side, q, middle);
		reach[i] = side * (0.15 + 0.3 * mr_random_real(r));
	}
}

static void
check_numbers(const mr_connected *c, uint32_t *parent, const size_t *renamed)
{
	size_t first = 0;

	for (size_t i = 0; i < N; i++)
		for (size_t j = 0; j < i; j++)
			assert_int_equal(c->part[renamed[i]] == c->part[renamed[j]],
			    mr_sets_root(parent, (uint32_t)i) == mr_sets_root(parent, (uint32_t)j));
	for (size_t k = 0; k < c->parts; k++) {
		size_t size = 0, lowest = N;
		for (size_t i = N; i-- > 0;)
			if (c->part[i] == k) {
				lowest = i;
				size++;
			}
		assert_int_equal(size, c->size[k]);
		assert_true(k == 0 || size < c->size[k - 1] || (size == c->size[k - 1] && lowest > first));
		first = lowest;
	}
}

static void
parts_are_those_of_all_pairs(void **state)
{
	uint32_t *parent = mr_sets_new(&ctx, N);
	mr_random r = { 1 };
	size_t same[N], turned[N];
	mr_v3 p[N];
	double d[N];
	mr_connected c;

	(void)state;
	strew(&r);
	assert_non_null(parent);
	for (uint32_t i = 0; i < N; i++)
		for (uint32_t j = 0; j < i; j++)
			if (mr_dist(point[i], point[j]) <= fmin(reach[i], reach[j]))
				mr_sets_join(parent, i, j);
	for (size_t i = 0; i < N; i++) {
		same[i] = i;
		turned[i] = N - 1 - i;
		p[N - 1 - i] = point[i];
		d[N - 1 - i] = reach[i];
	}
	mr_connected_by_reach(&ctx, point, N, reach, &c);
	assert_in_range(c.parts, 20, N / 2);
	check_numbers(&c, parent, same);
	mr_connected_by_reach(&ctx, p, N, d, &c);
	check_numbers(&c, parent, turned);
	mr_connected_by_reach(&ctx, point, 1, reach, &c);
	assert_int_equal(c.parts, 1);
	mr_connected_by_reach(&ctx, point, 0, reach, &c);
	assert_int_equal(c.parts, 0);
}

/* Dense clumps out of each other's reach cost no more than their boxes tell. */
static void
gaps_cost_little(void **state)
{
	enum { MANY = 200000 };
	mr_v3 *p = MR_NEW(&ctx, MANY, mr_v3);
	double *d = MR_NEW(&ctx, MANY, double), start = mr_seconds();
	mr_random r = { 2 };
	mr_connected c;

	(void)state;
	for (size_t i = 0; i < MANY; i++) {
		p[i] = mr_vec(
		    mr_random_real(&r) + 2.001 * (double)(i % 2), mr_random_real(&r), mr_random_real(&r));
		d[i] = 1;
	}
	mr_connected_by_reach(&ctx, p, MANY, d, &c);
	assert_int_equal(c.parts, 2);
	assert_int_equal(c.size[0], MANY / 2);
	assert_true(mr_seconds() - start < 30);
}

/* A frame with a plane of quads that have properties of vertices and faces. */
static mr_frame *
plane(const char *name, size_t n)
{
	mr_frame *f;
	mr_mesh m;
	double *number;
	uint32_t *polygon, *group;

	assert_int_equal(mr_solid_make(&ctx, &(mr_make_opts){ .solid = MR_PLANE, .vertices = n }, &m), MR_OK);
	assert_int_equal(mr_frame_new(&ctx, name, &f), MR_OK);
	assert_int_equal(mr_layer_put_mesh(&ctx, f, "mesh", &m), MR_OK);
	number = MR_NEW(&ctx, m.nv, double);
	polygon = MR_NEW(&ctx, m.nf, uint32_t);
	group = MR_NEW(&ctx, m.nf, uint32_t);
	for (size_t i = 0; i < m.nv; i++)
		number[i] = (double)i;
	for (size_t i = 0; i < m.nf; i++) {
		polygon[i] = (uint32_t)i / 2;
		group[i] = (uint32_t)(i % 2);
	}
	assert_int_equal(
	    mr_frame_put(&ctx, f, "mesh", "quality", (mr_shape){ 'v', 'd', 1 }, number, m.nv), MR_OK);
	assert_int_equal(mr_layer_put(&ctx, f, "mesh", "polygon", polygon, m.nf), MR_OK);
	assert_int_equal(mr_layer_put(&ctx, f, "mesh", "group", group, m.nf), MR_OK);
	return f;
}

static void
put_names(mr_frame *f, const char *names)
{
	assert_int_equal(mr_layer_put(&ctx, f, "mesh", "groups", names, strlen(names)), MR_OK);
}

static void
polygons_are_kept_whole(void **state)
{
	mr_frame *f = plane("plane", 9);
	const void *quality, *polygon;
	mr_subset s;
	mr_mesh m;
	bool keep[9];
	size_t n;

	(void)state;
	assert_int_equal(mr_layer_mesh(&ctx, f, "mesh", &m), MR_OK);
	for (size_t v = 0; v < 9; v++)
		keep[v] = v != 0; /* at the corner of one quad, and of one or both of its triangles */
	assert_int_equal(mr_subset_find(&ctx, f, &m, keep, &s), MR_OK);
	assert_int_equal(mr_layer_keep(&ctx, f, "mesh", &s), MR_OK);
	assert_int_equal(mr_layer_mesh(&ctx, f, "mesh", &m), MR_OK);
	assert_int_equal(m.nf, 6);
	assert_int_equal(m.nv, 8);
	assert_int_equal(
	    mr_frame_get(&ctx, f, "mesh", "quality", (mr_shape){ 'v', 'd', 1 }, &quality, &n), MR_OK);
	assert_int_equal(mr_layer_get_rows(&ctx, f, "mesh", "polygon", 6, &polygon), MR_OK);
	for (size_t v = 0; v < 8; v++)
		assert_true(((const double *)quality)[v] == (double)(v + 1));
	for (size_t v = 0; v < 8; v++)
		keep[v] = v < 3; /* no quad is left, so no vertex is */
	assert_int_equal(mr_subset_find(&ctx, f, &m, keep, &s), MR_OK);
	assert_int_equal(s.nf, 0);
	assert_int_equal(s.nv, 0);
}

static void
appended_names_and_numbers_follow(void **state)
{
	mr_frame *f[3] = { plane("a", 9), plane("b", 4), plane("c", 4) }, *all;
	const void *group, *polygon, *names, *quality;
	const uint32_t first[] = { 0, 0, 1, 1, 2, 2, 3, 3, 8, 8, 10, 10 };
	const uint32_t numbers[] = { 0, 1, 0, 1, 0, 1, 0, 1, 1, 2, 2, 0 };
	mr_mesh m;
	size_t n;

	(void)state;
	put_names(f[0], "left\nright");
	put_names(f[1], "right\n");
	put_names(f[2], "\nleft");
	assert_int_equal(mr_frames_append(&ctx, f, 3, &all), MR_OK);
	assert_int_equal(mr_layer_mesh(&ctx, all, "mesh", &m), MR_OK);
	assert_int_equal(m.nv, 17);
	assert_int_equal(m.nf, 12);
	assert_true(m.t[8].v[0] >= 9 && m.t[8].v[0] < 13 && m.t[11].v[2] >= 13);
	assert_int_equal(mr_layer_get_rows(&ctx, all, "mesh", "polygon", 12, &polygon), MR_OK);
	assert_memory_equal(polygon, first, sizeof first);
	assert_int_equal(mr_layer_get_rows(&ctx, all, "mesh", "group", 12, &group), MR_OK);
	assert_memory_equal(group, numbers, sizeof numbers);
	assert_int_equal(mr_layer_get(&ctx, all, "mesh", "groups", &names, &n), MR_OK);
	assert_int_equal(n, 11);
	assert_memory_equal(names, "left\nright\n", 11);
	mr_frame_drop(f[1], "mesh", "quality", 0);
	assert_int_equal(mr_frames_append(&ctx, f, 3, &all), MR_OK);
	assert_int_equal(
	    mr_frame_get(&ctx, all, "mesh", "quality", (mr_shape){ 'v', 'd', 1 }, &quality, &n), MR_OK);
	assert_int_equal(n, 17);
	for (size_t v = 0; v < n; v++)
		assert_true(isnan(((const double *)quality)[v]) == (v >= 9 && v < 13));
	put_names(f[2], "one");
	assert_int_equal(mr_frames_append(&ctx, f, 3, &all), MR_ERANGE);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(parts_are_those_of_all_pairs, setup, teardown),
		cmocka_unit_test_setup_teardown(gaps_cost_little, setup, teardown),
		cmocka_unit_test_setup_teardown(polygons_are_kept_whole, setup, teardown),
		cmocka_unit_test_setup_teardown(appended_names_and_numbers_follow, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
