/* Crossings by the tree of subdivision against all pairs of triangles, and what moved against all of it. */
#include "base/random.h"
#include "domain.h"
#include "shape/shape.h"
#include "space/self_intersect.h"
#include "subdivide/displaced.h"
#include "subdivide/loop_self_intersect.h"
#include "unit.h"

enum { LEVEL = 2 };

/* A sphere of so many vertices, that level of it, and its positions. */
static mr_domain
sphere(size_t n)
{
	mr_make_opts o = { .solid = MR_SPHERE, .vertices = n };
	mr_mesh control;

	assert_int_equal(mr_solid_make(&ctx, &o, &control), MR_OK);
	return domain(&control, LEVEL);
}

static bool
touch(mr_tri a, mr_tri b)
{
	for (int i = 0; i < 9; i++)
		if (a.v[i / 3] == b.v[i % 3])
			return true;
	return false;
}

static void
corners(const mr_mesh *m, size_t f, mr_v3 p[3])
{
	for (int k = 0; k < 3; k++)
		p[k] = m->p[m->t[f].v[k]];
}

static bool
intersect(const mr_mesh *m, size_t f, size_t g)
{
	mr_v3 p[3], q[3];

	corners(m, f, p);
	corners(m, g, q);
	return mr_triangles_intersect(p, q);
}

/* Every crossing of triangles that do not touch is found, and nothing is said to cross that does not. */
static size_t
check_all_pairs(const mr_mesh *m, const bool *crosses)
{
	size_t count = 0;

	for (size_t f = 0; f < m->nf; f++) {
		bool apart = false, any = false;
		for (size_t g = 0; g < m->nf && !apart; g++)
			if (g != f && intersect(m, f, g)) {
				any = true;
				apart = !touch(m->t[f], m->t[g]);
			}
		assert_true(crosses[f] || !apart);
		assert_true(any || !crosses[f]);
		count += crosses[f];
	}
	return count;
}

static void
smooth_surfaces_have_none(void **state)
{
	mr_domain d = sphere(42);
	bool *crosses = MR_NEW(&ctx, d.m.nf, bool);

	(void)state;
	mr_find_crossings(&ctx, mr_loop_tree_new(&ctx, d.level, LEVEL), d.m.p, NULL, crosses);
	assert_int_equal(check_all_pairs(&d.m, crosses), 0);
}

/* Far from the origin and in any unit. */
static void
dents_that_reach_through(void **state)
{
	static const double unit[] = { 1, 0x1p-100, 0x1p100 }, offset[] = { 0, 0, 0x1p104 };

	(void)state;
	for (int k = 0; k < 3; k++) {
		mr_domain d = sphere(100);
		mr_v3 *p = MR_NEW(&ctx, d.m.nv, mr_v3);
		bool *crosses = MR_NEW(&ctx, d.m.nf, bool);
		double most = mr_box_of(d.m.p, d.m.nv).max.x;
		for (size_t v = 0; v < d.m.nv; v++) {
			mr_v3 q = mr_mul(1 / most, d.m.p[v]);
			double push = q.x > 0.8 ? fmin(15 * (q.x - 0.8), 2.2) : 0;
			p[v] = mr_vec(unit[k] * (q.x - push) + offset[k], unit[k] * q.y, unit[k] * q.z);
		}
		d.m.p = p;
		mr_find_crossings(&ctx, mr_loop_tree_new(&ctx, d.level, LEVEL), p, NULL, crosses);
		assert_true(check_all_pairs(&d.m, crosses) > 20);
	}
}

/* Steps that each move a few vertices: looked at near these, and anew, with one thread and with two. */
static void
what_moved_is_enough(void **state)
{
	mr_domain d = sphere(66);
	mr_random r = { 5 };
	size_t roots = d.level[0].nf, parts = d.m.nf / roots, most = 0;
	mr_v3 *p = MR_NEW(&ctx, d.m.nv, mr_v3);
	bool *crosses = MR_NEW(&ctx, d.m.nf, bool), *all = MR_NEW(&ctx, d.m.nf, bool);
	mr_loop_tree *tree = mr_loop_tree_new(&ctx, d.level, LEVEL);
	bool *moved = MR_NEW(&ctx, roots, bool);

	(void)state;
	memcpy(p, d.m.p, d.m.nv * sizeof *p);
	mr_find_crossings(&ctx, tree, p, NULL, crosses);
	for (int step = 0; step < 12; step++) {
		size_t count = 0;
		memset(moved, 0, roots * sizeof *moved);
		for (size_t f = 0; f < d.m.nf; f++) {
			uint32_t v = d.m.t[f].v[f % 3];
			if (mr_random_real(&r) > 0.003)
				continue;
			p[v] = step < 6 ? mr_mul(4 * mr_random_real(&r) - 2, d.m.p[v]) : d.m.p[v];
			for (size_t g = 0; g < d.m.nf; g++)
				for (int k = 0; k < 3; k++)
					moved[g / parts] |= d.m.t[g].v[k] == v;
		}
		ctx.threads = step % 2 ? 1 : 2;
		mr_find_crossings(&ctx, tree, p, moved, crosses);
		mr_find_crossings(&ctx, mr_loop_tree_new(&ctx, d.level, LEVEL), p, NULL, all);
		assert_memory_equal(crosses, all, d.m.nf * sizeof *all);
		for (size_t f = 0; f < d.m.nf; f++)
			count += all[f];
		most = count > most ? count : most;
	}
	assert_true(most > 20);
}

/* All at one place every part meets every other: without a look at what has no normal that is 10^11 tests. */
static void
what_shrank_to_a_point_is_soon_told(void **state)
{
	mr_domain d = sphere(10000);
	const mr_loop *l = &d.level[LEVEL];
	mr_v3 *p = MR_NEW_ZERO(&ctx, l->nv, mr_v3);
	bool *crosses = MR_NEW(&ctx, l->nf, bool);

	(void)state;
	mr_find_crossings(&ctx, mr_loop_tree_new(&ctx, d.level, LEVEL), p, NULL, crosses);
	for (size_t f = 0; f < l->nf; f++)
		assert_false(crosses[f]);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(smooth_surfaces_have_none, setup, teardown),
		cmocka_unit_test_setup_teardown(dents_that_reach_through, setup, teardown),
		cmocka_unit_test_setup_teardown(what_moved_is_enough, setup, teardown),
		cmocka_unit_test_setup_teardown(what_shrank_to_a_point_is_soon_told, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
