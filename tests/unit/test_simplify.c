/* Laws of simplification: the queue, the quadrics, what became of each vertex. */
#include "base/random.h"
#include "op/quadric.h"
#include "shape/shape.h"
#include "simplify/bucket_queue.h"
#include "simplify/creases.h"
#include "simplify/simplify.h"
#include "space/bvh.h"
#include "space/self_intersect.h"
#include "subdivide/loop.h"
#include "unit.h"

static void
queue_serves_the_lowest_bucket(void **state)
{
	enum { N = 3000 };
	mr_random random = { 1 };
	uint32_t bucket_of[N], last = 0, bucket, item;
	size_t left = N, taken = 0;
	mr_buckets *b;

	(void)state;
	mr_buckets_new(&ctx, N, &b);
	for (uint32_t i = 0; i < N; i++) {
		bucket_of[i] = mr_bucket_of((float)exp(40 * mr_random_real(&random) - 20));
		mr_buckets_put(b, i, bucket_of[i]);
	}
	for (uint32_t i = 0; i < N; i += 3, left--) {
		mr_buckets_remove(b, i);
		mr_buckets_remove(b, i);
		assert_false(mr_buckets_has(b, i));
	}
	while ((item = mr_buckets_take(b, &bucket)) != MR_NONE) {
		assert_int_equal(bucket, bucket_of[item]);
		assert_true(bucket >= last && item % 3 != 0);
		assert_false(mr_buckets_has(b, item));
		last = bucket;
		taken++;
	}
	assert_int_equal(taken, left);
	assert_true(mr_bucket_of(0) == 0 && mr_bucket_of(INFINITY) < MR_BUCKETS);
	assert_true(mr_bucket_of(1.0f) < mr_bucket_of(1.01f));
}

static void
quadric_is_the_squared_distance(void **state)
{
	mr_v3 n[3] = { { 1, 0, 0 }, { 0, 0.6, 0.8 }, { 0.36, -0.8, 0.48 } }, at[3], x,
	      corner = { 0.3, -2, 5 };
	mr_quadric sum = { 0 };
	mr_quadric_factor factor;

	(void)state;
	for (int i = 0; i < 3; i++) { /* planes through the corner, each about another origin */
		mr_quadric q = { 0 };
		at[i] = mr_add(corner, mr_cross(n[i], mr_vec(1, 2, 3)));
		mr_quadric_add_plane(&q, n[i], i + 1);
		q = mr_quadric_moved(&q, mr_mul(-1, at[i]));
		sum = mr_quadric_sum(&sum, &q);
	}
	x = mr_vec(7, 1, -1);
	double expected = 0;
	for (int i = 0; i < 3; i++) {
		double distance = mr_dot(n[i], mr_sub(x, at[i]));
		expected += (i + 1) * distance * distance;
	}
	assert_true(fabs(mr_quadric_at(&sum, x) - expected) < 1e-12 * expected);
	factor = mr_quadric_factor_of(&sum, 1e-5);
	for (int i = 0; i < 3; i++)
		x = mr_sub(x, mr_quadric_solve(&factor, mr_add(mr_quadric_apply(&sum, x), sum.b)));
	assert_true(mr_dist(x, corner) < 1e-12);
}

static void
vertices_lie_where_they_were_merged(void **state)
{
	mr_make_opts solid = MR_MAKE_DEFAULTS;
	mr_simplify_opts o = MR_SIMPLIFY_DEFAULTS;
	mr_places map;
	uint32_t *onto;
	mr_mesh m, out;

	(void)state;
	solid.vertices = 4000;
	assert_int_equal(mr_solid_make(&ctx, &solid, &m), MR_OK);
	o.faces = 400;
	onto = MR_NEW(&ctx, m.nv, uint32_t);
	assert_int_equal(mr_simplify(&ctx, &m, &o, NULL, &out, onto, NULL), MR_OK);
	assert_int_equal(out.nf, 400);
	assert_int_equal(out.nv, 202);
	assert_int_equal(mr_simplify_map(&ctx, &m, &out, onto, &map), MR_OK);
	for (size_t v = 0; v < m.nv; v++)
		assert_true(onto[v] < out.nv);
	for (size_t v = 0; v < out.nv; v++)
		assert_true(mr_dist(mr_place_point(&m, mr_places_at(&map, v)), out.p[v]) < 0.05);
}

/* The length of the sharp edges that are marked in a control mesh of a solid. */
static double
sharp_length(mr_solid solid, size_t vertices, size_t faces)
{
	mr_make_opts shape = MR_MAKE_DEFAULTS;
	mr_simplify_opts o = MR_SIMPLIFY_DEFAULTS;
	double length = 0;
	uint8_t *sharp = NULL;
	uint32_t *onto;
	mr_mesh m, out;

	shape.solid = solid;
	shape.vertices = vertices;
	assert_int_equal(mr_solid_make(&ctx, &shape, &m), MR_OK);
	o.faces = faces;
	onto = MR_NEW(&ctx, m.nv, uint32_t);
	assert_int_equal(
	    mr_simplify(&ctx, &m, &o, &(mr_simplify_ties){ .sharp = &sharp }, &out, onto, NULL), MR_OK);
	for (uint32_t h = 0; sharp && h < 3 * out.nf; h++)
		if (sharp[h])
			length += mr_dist(out.p[mr_he_from(&out, h)], out.p[mr_he_to(&out, h)]) / 2;
	return length;
}

static void
sharp_edges_of_a_mesh_are_kept(void **state)
{
	static const size_t faces[] = { 100, 300, 1000, 5000 };

	(void)state;
	for (int i = 0; i < 4; i++) {
		double rims = sharp_length(MR_CYLINDER, 6000, faces[i]);
		assert_true(fabs(sharp_length(MR_CUBE, 6000, faces[i]) - 24) < 1e-9);
		assert_true(fabs(rims - 4 * MR_PI) < 0.2 * MR_PI);
		assert_true(sharp_length(MR_SPHERE, 6000, faces[i]) == 0);
	}
}

/* An angle bracket: where its corners have few faces around three quarters of a turn, the limit surface turns
 * over. */
static void
limit_surfaces_do_not_turn_over(void **state)
{
	static const mr_v3 outline[] = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 },
		{ 0, 2, 0 } };
	static const mr_tri lid[] = { { { 0, 1, 2 } }, { { 0, 2, 3 } }, { { 0, 3, 5 } }, { { 3, 4, 5 } } };
	enum { N = 6, LID = 4, LEVEL = 3 };
	mr_v3 p[2 * N], *fine, *limit;
	mr_tri t[2 * (N + LID)];
	mr_mesh m = { "mesh", p, t, 2 * N, 2 * (N + LID) }, out;
	mr_simplify_opts o = MR_SIMPLIFY_DEFAULTS;
	uint8_t *sharp = NULL;
	uint32_t onto[2 * N];
	mr_loop level[LEVEL + 1];
	size_t crossings;

	(void)state;
	for (uint32_t i = 0; i < N; i++) {
		uint32_t next = (i + 1) % N;
		p[i] = outline[i];
		p[N + i] = mr_add(outline[i], mr_vec(0, 0, 1));
		t[2 * i] = (mr_tri){ { i, next, N + next } };
		t[2 * i + 1] = (mr_tri){ { i, N + next, N + i } };
	}
	for (uint32_t i = 0; i < LID; i++) {
		const uint32_t *v = lid[i].v;
		t[2 * N + i] = (mr_tri){ { v[0], v[2], v[1] } };
		t[2 * N + LID + i] = (mr_tri){ { N + v[0], N + v[1], N + v[2] } };
	}
	o.faces = m.nf;
	assert_int_equal(
	    mr_simplify(&ctx, &m, &o, &(mr_simplify_ties){ .sharp = &sharp }, &out, onto, NULL), MR_OK);
	assert_int_equal(out.nf, m.nf + 4);
	assert_int_equal(mr_loop_levels(&ctx, &out, 180, sharp, LEVEL, level), MR_OK);
	fine = MR_NEW(&ctx, level[LEVEL].nv, mr_v3);
	limit = MR_NEW(&ctx, level[LEVEL].nv, mr_v3);
	mr_loop_values(&ctx, level, LEVEL, 3, &out.p->x, &fine->x);
	mr_loop_limit(&ctx, &level[LEVEL], fine, limit, NULL);
	mr_self_intersections(&ctx, NULL,
	    &(mr_mesh){ "limit", limit, level[LEVEL].t, level[LEVEL].nv, level[LEVEL].nf }, NULL, &crossings);
	assert_int_equal(crossings, 0);
}

/* Simplifies the solid, its height scaled and a bowl added, to `faces` and maps it. */
static void
map_of(mr_solid solid, double height, double bowl, size_t faces, mr_mesh *m, mr_mesh *out, mr_places *map)
{
	mr_make_opts shape = MR_MAKE_DEFAULTS;
	mr_simplify_opts o = MR_SIMPLIFY_DEFAULTS;
	uint32_t *onto;
	mr_v3 *p;

	shape.solid = solid;
	shape.vertices = 6000;
	assert_int_equal(mr_solid_make(&ctx, &shape, m), MR_OK);
	p = MR_NEW(&ctx, m->nv, mr_v3);
	for (size_t v = 0; v < m->nv; v++) {
		double x = m->p[v].x, y = m->p[v].y;
		p[v] = mr_vec(x, y, height * m->p[v].z + bowl * (x * x + y * y));
	}
	m->p = p;
	o.faces = faces;
	onto = MR_NEW(&ctx, m->nv, uint32_t);
	assert_int_equal(mr_simplify(&ctx, m, &o, NULL, out, onto, NULL), MR_OK);
	assert_int_equal(mr_simplify_map(&ctx, m, out, onto, map), MR_OK);
}

/* What is flat keeps its place, whatever faces a walk would get stuck on. */
static void
places_are_the_nearest(void **state)
{
	mr_places map;
	mr_mesh m, out;

	(void)state;
	map_of(MR_BOXES, 1, 0, 500, &m, &out, &map);
	for (size_t v = 0; v < out.nv; v++)
		assert_true(mr_dist(mr_place_point(&m, mr_places_at(&map, v)), out.p[v]) < 1e-9);
}

/* In a thin bowl the nearest face is often one of the other side. */
static void
places_stay_on_their_side(void **state)
{
	size_t across = 0, strayed = 0;
	mr_places map;
	mr_v3 *normal;
	mr_mesh m, out;
	mr_bvh *bvh;

	(void)state;
	map_of(MR_SPHERE, 0.001, 0.5, 1000, &m, &out, &map);
	normal = MR_NEW(&ctx, out.nv, mr_v3);
	mr_vertex_normals(&out, normal);
	mr_bvh_build(&ctx, &m, &bvh);
	for (size_t v = 0; v < out.nv; v++) {
		if (hypot(out.p[v].x, out.p[v].y) > 0.8) /* at the rim */
			continue;
		strayed += mr_dot(mr_face_cross(&m, map.face[v]), normal[v]) <= 0;
		across += mr_dot(mr_face_cross(&m, mr_bvh_closest(bvh, out.p[v]).at.face), normal[v]) <= 0;
	}
	assert_true(across > 50);
	assert_int_equal(strayed, 0);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(queue_serves_the_lowest_bucket, setup, teardown),
		cmocka_unit_test_setup_teardown(quadric_is_the_squared_distance, setup, teardown),
		cmocka_unit_test_setup_teardown(vertices_lie_where_they_were_merged, setup, teardown),
		cmocka_unit_test_setup_teardown(sharp_edges_of_a_mesh_are_kept, setup, teardown),
		cmocka_unit_test_setup_teardown(limit_surfaces_do_not_turn_over, setup, teardown),
		cmocka_unit_test_setup_teardown(places_are_the_nearest, setup, teardown),
		cmocka_unit_test_setup_teardown(places_stay_on_their_side, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
