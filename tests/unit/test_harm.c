/* Folds and intersections that a motion makes, and those that it does not. */
#include "judge/judge.h"
#include "judge/mend.h"
#include "shapes.h"

static mr_harm
harm_of(const mr_mesh *m, const mr_v3 *after)
{
	mr_motion motion = mr_motion_of(&ctx, m, after);
	mr_harm harm;

	mr_harm_find(&ctx, &motion, NULL, &harm);
	return harm;
}

static mr_v3 *
copy_of(const mr_mesh *m)
{
	mr_v3 *p = MR_NEW(&ctx, m->nv, mr_v3);

	memcpy(p, m->p, m->nv * sizeof *p);
	return p;
}

static void
test_rigid_motion_is_none(void **state)
{
	mr_mesh m = shape(MR_KNOT, 2000);
	mr_v3 *p = copy_of(&m);
	mr_harm h;

	(void)state;
	for (size_t v = 0; v < m.nv; v++)
		p[v] = mr_vec(3 - m.p[v].y, m.p[v].x, m.p[v].z + 7);
	h = harm_of(&m, p);
	assert_true(h.folds == 0 && h.pairs == 0 && h.vertex == MR_NONE);
}

/* A vertex of a lattice that goes beyond its far neighbour: the faces behind it turn over. */
static void
test_fold(void **state)
{
	mr_mesh m = lattice(6);
	const uint32_t v = 7 * 3 + 3;
	mr_v3 *p = copy_of(&m);
	mr_harm h;

	(void)state;
	p[v].x += 1.5;
	h = harm_of(&m, p);
	assert_true(h.folds > 0 && h.pairs > 0);
	assert_true(h.vertex != MR_NONE && mr_dist(m.p[h.vertex], m.p[v]) < 3);
	m.p = p; /* what was there before is no harm */
	h = harm_of(&m, p);
	assert_true(h.folds == 0 && h.pairs == 0 && h.vertex == MR_NONE);
}

/* Two far ends of a strip that pass through each other are none; near faces are, and are looked for only
 * where they are asked for. */
static void
test_near(void **state)
{
	mr_mesh m = lattice(40);
	mr_v3 *p = copy_of(&m);
	mr_harm h;

	(void)state;
	for (size_t v = 0; v < m.nv; v++) { /* rolled up by more than a turn, into itself */
		double a = 2 * MR_PI * m.p[v].y / 30, r = 30 / (2 * MR_PI);
		p[v] = mr_vec(m.p[v].x, r * sin(a) + 1e-3 * m.p[v].y, r * cos(a));
	}
	h = harm_of(&m, p);
	assert_true(h.folds == 0 && h.pairs == 0 && h.far == 0); /* it rubs */
	for (size_t v = 0; v < m.nv; v++) {                      /* the same, of a few rows */
		double a = 2 * MR_PI * m.p[v].y / 4, r = 4 / (2 * MR_PI);
		p[v] = mr_vec(m.p[v].x, r * sin(a) + 0.1 * m.p[v].y, r * cos(a));
	}
	h = harm_of(&m, p);
	assert_true(h.folds == 0 && h.pairs > 100);
}

/* Two sheets, `apart`, of which one bulges by `by`. */
static mr_harm
harm_of_bulge(double apart, double by)
{
	mr_mesh one = lattice(20), m = both(&one, &one, mr_vec(0.1, 0.05, apart));
	mr_v3 *p = copy_of(&m);

	for (size_t v = 0; v < one.nv; v++)
		p[v].z = by * exp(-mr_norm2(mr_sub(m.p[v], mr_vec(15, 8.7, 0))) / 20);
	return harm_of(&m, p);
}

/* One that bulges through the other is told; where they touched, by less than that it is not. */
static void
test_sheets(void **state)
{
	mr_mesh one = lattice(20);
	mr_harm h = harm_of_bulge(0.2, 3);

	(void)state;
	assert_true(h.folds == 0 && h.pairs == 0 && h.far > 20);
	assert_true(h.far_vertex < one.nv && mr_dist(one.p[h.far_vertex], mr_vec(15, 8.7, 0)) < 10);
	h = harm_of_bulge(0.2, 0.19);
	assert_true(h.folds == 0 && h.pairs == 0 && h.far == 0);
	h = harm_of_bulge(0.01, 0.03);
	assert_true(h.folds == 0 && h.pairs == 0 && h.far == 0);
}

/* What intersects already may do so elsewhere: a sheet that slides through another one. */
static void
test_no_more_than_before(void **state)
{
	mr_mesh one = lattice(20), m;
	mr_v3 *upright = copy_of(&one), *p;
	mr_mesh other = one;
	mr_harm h;

	(void)state;
	for (size_t v = 0; v < one.nv; v++)
		upright[v] = mr_vec(upright[v].x, 6.3, upright[v].y - 9.1);
	other.p = upright;
	m = both(&one, &other, mr_vec(0, 0, 0));
	p = copy_of(&m);
	for (size_t v = one.nv; v < m.nv; v++)
		p[v].y += 5 * sqrt(0.75);
	h = harm_of(&m, p);
	assert_true(h.folds == 0 && h.pairs == 0 && h.far <= 5);
}

/* Faces in one plane that touch: as they are rounded they intersect or not, which is no harm. */
static void
test_touching(void **state)
{
	mr_mesh one = lattice(12), m = both(&one, &one, mr_vec(0.37, 12 * sqrt(0.75), 0));
	mr_v3 *p = copy_of(&m), turn = mr_unit(mr_vec(1, 2, 3));
	mr_harm h;

	(void)state;
	for (size_t v = 0; v < m.nv; v++) { /* and a corner that bends, so that not all is rigid */
		mr_v3 q = m.p[v], along = mr_mul(mr_dot(turn, q), turn), across = mr_sub(q, along);
		p[v] = mr_add(along, mr_axpy(sin(1), mr_cross(turn, q), mr_mul(cos(1), across)));
	}
	p[0] = mr_add(p[0], mr_vec(0, 0, 0.5));
	h = harm_of(&m, p);
	assert_true(h.folds == 0 && h.pairs == 0 && h.far == 0);
}

/* Bends a lattice along x by a radian every 20 edges. */
static mr_v3
bent(mr_v3 p)
{
	return mr_vec(20 * sin(p.x / 20), p.y, 20 - (20 + p.z) * cos(p.x / 20));
}

/* Vertices that a bend has brought beyond their far neighbours come back to where it has them. */
static void
test_mended(void **state)
{
	mr_mesh m = lattice(24);
	const uint32_t v = 25 * 12 + 12;
	mr_v3 *p = copy_of(&m), *was;
	mr_harm h;

	(void)state;
	for (size_t i = 0; i < m.nv; i++)
		p[i] = bent(m.p[i]);
	for (uint32_t i = v; i < v + 3; i += 2)
		p[i] = bent(mr_add(m.p[i], mr_vec(1.5, 0, 0)));
	assert_true(harm_of(&m, p).folds > 5);
	was = MR_NEW(&ctx, m.nv, mr_v3);
	memcpy(was, p, m.nv * sizeof *p);
	mr_mend(&ctx, &m, NULL, p);
	h = harm_of(&m, p);
	assert_true(h.folds == 0 && h.pairs == 0);
	assert_true(memcmp(p, was, m.nv * sizeof *p) != 0);
	for (size_t i = 0; i < m.nv; i++) {
		assert_true(mr_dist(p[i], bent(m.p[i])) < 0.5); /* as a patch of 9 edges across is bent */
		if (mr_dist(m.p[i], m.p[v]) > 10)
			assert_memory_equal(&p[i], &was[i], sizeof *p);
	}
}

/* Rigid motions are followed to rounding. */
static void
test_mended_rigidly(void **state)
{
	mr_mesh m = lattice(16);
	const uint32_t v = 17 * 8 + 8;
	mr_v3 *p = copy_of(&m);

	(void)state;
	for (size_t i = 0; i < m.nv; i++)
		p[i] = mr_vec(3 - m.p[i].y, m.p[i].x, m.p[i].z + 7);
	p[v].y += 1.5;
	mr_mend(&ctx, &m, NULL, p);
	for (size_t i = 0; i < m.nv; i++)
		assert_true(mr_dist(p[i], mr_vec(3 - m.p[i].y, m.p[i].x, m.p[i].z + 7)) < 1e-12 * 24);
}

/* What is held stays, and nothing moves where that leaves the harm. */
static void
test_held_is_not_mended(void **state)
{
	mr_mesh m = lattice(16);
	const uint32_t v = 17 * 8 + 8;
	mr_v3 *p = copy_of(&m);
	bool *held = MR_NEW_ZERO(&ctx, m.nv, bool);

	(void)state;
	held[v] = true;
	p[v].x += 1.5;
	mr_mend(&ctx, &m, held, p);
	assert_true(p[v].x == m.p[v].x + 1.5);
	memset(held, 1, m.nv);
	memcpy(p, m.p, m.nv * sizeof *p);
	p[v].x += 1.5;
	mr_mend(&ctx, &m, held, p);
	assert_true(p[v].x == m.p[v].x + 1.5 && p[v - 1].x == m.p[v - 1].x);
}

/* Parts that meet may be meant: a sheet stuck through another one stays. */
static void
test_far_is_not_mended(void **state)
{
	mr_mesh sheet = lattice(20), m = both(&sheet, &sheet, mr_vec(0, 0, 30));
	mr_v3 *p = copy_of(&m), *was;

	(void)state;
	for (size_t v = sheet.nv; v < m.nv; v++)
		p[v] = mr_vec(m.p[v].x, 8.3, m.p[v].y - 8.1);
	was = MR_NEW(&ctx, m.nv, mr_v3);
	memcpy(was, p, m.nv * sizeof *p);
	assert_true(harm_of(&m, p).far > 20);
	mr_mend(&ctx, &m, NULL, p);
	assert_memory_equal(p, was, m.nv * sizeof *p);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_rigid_motion_is_none, setup, teardown),
		cmocka_unit_test_setup_teardown(test_fold, setup, teardown),
		cmocka_unit_test_setup_teardown(test_near, setup, teardown),
		cmocka_unit_test_setup_teardown(test_sheets, setup, teardown),
		cmocka_unit_test_setup_teardown(test_no_more_than_before, setup, teardown),
		cmocka_unit_test_setup_teardown(test_touching, setup, teardown),
		cmocka_unit_test_setup_teardown(test_mended, setup, teardown),
		cmocka_unit_test_setup_teardown(test_mended_rigidly, setup, teardown),
		cmocka_unit_test_setup_teardown(test_held_is_not_mended, setup, teardown),
		cmocka_unit_test_setup_teardown(test_far_is_not_mended, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
