/* Normals that turn with a surface: with a rigid motion, with each side of a crease, not at all at rest. */
#include "mesh/normals.h"

#include "shapes.h"

/* A rotation by 70 degrees about a skew axis. */
static mr_v3
rotated(mr_v3 a)
{
	const mr_v3 k = mr_unit(mr_vec(1, -2, 0.5));
	double c = cos(70 * MR_PI / 180), s = sin(70 * MR_PI / 180);

	return mr_add(mr_axpy(c, a, mr_mul(s, mr_cross(k, a))), mr_mul((1 - c) * mr_dot(k, a), k));
}

static mr_v3 *
moved(const mr_mesh *m, mr_v3 (*move)(mr_v3))
{
	mr_v3 *p = MR_NEW(&ctx, m->nv, mr_v3);

	assert_non_null(p);
	for (size_t i = 0; i < m->nv; i++)
		p[i] = move(m->p[i]);
	return p;
}

static mr_v3 *
random_normals(size_t n, uint64_t seed)
{
	mr_v3 *x = MR_NEW(&ctx, n, mr_v3);
	mr_random r = { seed };

	assert_non_null(x);
	for (size_t i = 0; i < n; i++)
		x[i] = random_vector(&r);
	return x;
}

static mr_v3 *
copy(const mr_v3 *x, size_t n)
{
	mr_v3 *y = MR_NEW(&ctx, n, mr_v3);

	assert_non_null(y);
	memcpy(y, x, n * sizeof *y);
	return y;
}

/* Any normals, also none that the surface has: of vertices and of corners, all different. */
static void
test_rigid_motions(void **state)
{
	mr_mesh m = shape(MR_BUMPY, 800);
	const mr_v3 *p = moved(&m, rotated), *vertex = random_normals(m.nv, 1),
		    *corner = random_normals(3 * m.nf, 2);
	mr_v3 *v = copy(vertex, m.nv), *c = copy(corner, 3 * m.nf);

	(void)state;
	mr_turn_normals(&ctx, &m, p, v, c);
	for (size_t i = 0; i < m.nv; i++)
		assert_true(mr_dist(v[i], rotated(vertex[i])) < 1e-12);
	for (size_t i = 0; i < 3 * m.nf; i++)
		assert_true(mr_dist(c[i], rotated(corner[i])) < 1e-12);
}

/* Where nothing moved every bit stays; one vertex moves those around it alone. */
static void
test_rest(void **state)
{
	mr_mesh m = shape(MR_TORUS, 500);
	const mr_v3 *vertex = random_normals(m.nv, 3), *corner = random_normals(3 * m.nf, 4);
	mr_v3 *v = copy(vertex, m.nv), *c = copy(corner, 3 * m.nf), *p = copy(m.p, m.nv);
	bool *near = MR_NEW_ZERO(&ctx, m.nv, bool);

	(void)state;
	mr_turn_normals(&ctx, &m, p, v, c);
	assert_memory_equal(v, vertex, m.nv * sizeof *v);
	assert_memory_equal(c, corner, 3 * m.nf * sizeof *c);
	p[7].x += 0.1;
	mr_turn_normals(&ctx, &m, p, v, c);
	for (size_t f = 0; f < m.nf; f++) {
		const uint32_t *t = m.t[f].v;
		bool at = t[0] == 7 || t[1] == 7 || t[2] == 7;
		for (size_t k = 0; k < 3; k++) {
			near[t[k]] |= at;
			assert_int_equal(!memcmp(&c[3 * f + k], &corner[3 * f + k], sizeof *c), !at);
		}
	}
	for (size_t i = 0; i < m.nv; i++)
		assert_int_equal(!memcmp(&v[i], &vertex[i], sizeof *v), !near[i]);
}

/* Two squares that meet at an edge, one of which is folded up: a crease stays one, a smooth edge goes half
 * way. */
static void
test_creases(void **state)
{
	static const mr_v3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 2, 0, 0 },
		{ 2, 1, 0 } };
	static const mr_tri t[] = { { { 0, 1, 2 } }, { { 0, 2, 3 } }, { { 1, 4, 5 } }, { { 1, 5, 2 } } };
	static const mr_v3 folded[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 1, 0, 1 },
		{ 1, 1, 1 } };
	const mr_mesh m = { "folder", p, t, 6, 4 };
	const double half = sqrt(0.5);
	mr_v3 smooth[12], sharp[12];

	(void)state;
	for (int i = 0; i < 12; i++) {
		smooth[i] = mr_vec(0, 0, 2);
		sharp[i] = i < 6 ? mr_vec(0, 0, 2) : mr_vec(0, 0, 1);
	}
	smooth[0] = mr_vec(0, 0, 0); /* a corner without */
	mr_turn_normals(&ctx, &m, folded, NULL, smooth);
	mr_turn_normals(&ctx, &m, folded, NULL, sharp);
	assert_true(mr_norm(smooth[0]) == 0);
	assert_true(mr_dist(smooth[3], mr_vec(0, 0, 2)) < 1e-14);  /* at 0 */
	assert_true(mr_dist(smooth[7], mr_vec(-2, 0, 0)) < 1e-14); /* at 4 */
	/* At 2, one triangle of the one square and two of the other, or the other way round. */
	assert_true(fabs(mr_norm(smooth[11]) - 2) < 1e-14);
	assert_true(mr_dist(smooth[11], smooth[2]) == 0 && smooth[2].x < -half && smooth[2].z > half);
	for (int i = 0; i < 12; i++)
		assert_true(mr_dist(sharp[i], i < 6 ? mr_vec(0, 0, 2) : mr_vec(-1, 0, 0)) < 1e-14);
}

/* What a triangle without area says counts for nothing, before and after. */
static void
test_no_area(void **state)
{
	static const mr_v3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 2, 0, 0 } };
	static const mr_tri t[] = { { { 0, 1, 2 } }, { { 0, 1, 3 } }, { { 0, 0, 1 } } };
	static const mr_v3 flat[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 0, 5, 0 } };
	const mr_mesh m = { "flat", p, t, 4, 3 };
	mr_v3 normal[] = { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 }, { 1, 2, 3 } };
	const mr_v3 before[] = { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 }, { 1, 2, 3 } };

	(void)state;
	mr_turn_normals(&ctx, &m, flat, normal, NULL);
	assert_memory_equal(normal, before, sizeof normal);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_rigid_motions, setup, teardown),
		cmocka_unit_test_setup_teardown(test_rest, setup, teardown),
		cmocka_unit_test_setup_teardown(test_creases, setup, teardown),
		cmocka_unit_test_setup_teardown(test_no_area, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
