/* Feet on a Phong surface: of points made from them, and by closed forms. */
#include "edit/phong.h"
#include "shapes.h"

typedef struct scene {
	mr_mesh m;
	mr_incidence inc;
	mr_topology topo;
	mr_foot_ground g;
	double edge;
} scene;

static void
set_up(scene *x, mr_mesh m)
{
	mr_v3 *normal = MR_NEW(&ctx, m.nv, mr_v3);

	assert_non_null(normal);
	x->m = m;
	x->edge = mr_mesh_edge_scale(&ctx, &m);
	mr_incidence_build(&ctx, &x->m, &x->inc);
	assert_int_equal(mr_topology_build(&ctx, &x->m, &x->topo), MR_OK);
	mr_vertex_normals(&x->m, normal);
	x->g = (mr_foot_ground){ { &x->m, normal }, &x->inc, 1e-13 * mr_mesh_diagonal(&x->m) };
}

static mr_v3
random_bary(mr_random *r)
{
	double u = mr_random_real(r), v = mr_random_real(r);

	return u + v > 1 ? mr_vec(u + v - 1, 1 - u, 1 - v) : mr_vec(1 - u - v, u, v);
}

static uint32_t
random_face(const scene *x, mr_random *r)
{
	return (uint32_t)(mr_random_bits(r) % x->m.nf);
}

/* b + h n(b) */
static mr_v3
raised(const scene *x, uint32_t face, mr_v3 bary, double h)
{
	return mr_axpy(h, mr_phong_normal(&x->g.surface, (mr_place){ face, bary }),
	    mr_phong_point(&x->g.surface, (mr_place){ face, bary }));
}

static void
assert_is_foot(const scene *x, const mr_foot *f, mr_v3 p)
{
	assert_true(f->at.bary.x > -2e-9 && f->at.bary.y > -2e-9 && f->at.bary.z > -2e-9);
	assert_true(fabs(f->at.bary.x + f->at.bary.y + f->at.bary.z - 1) < 1e-12);
	assert_true(mr_dist(raised(x, f->at.face, f->at.bary, f->height), p) <= x->g.tolerance);
}

/* A face some steps away over edges. */
static uint32_t
nearby(const scene *x, uint32_t face, int steps, mr_random *r)
{
	while (steps-- > 0) {
		uint32_t g = x->topo.twin[3 * face + (uint32_t)(mr_random_bits(r) % 3)];
		face = g == MR_NONE ? face : g / 3;
	}
	return face;
}

/* From their own face and from around it, on both sides. */
static void
a_point_over_the_surface_finds_its_foot(void **state)
{
	static const mr_solid solids[] = { MR_SPHERE, MR_TORUS, MR_KNOT, MR_CYLINDER };
	mr_random r = { 1 };

	(void)state;
	for (size_t i = 0; i < 4; i++) {
		scene x;
		size_t lost = 0, crossed = 0;
		set_up(&x, shape(solids[i], 1500));
		for (int k = 0; k < 3000; k++) {
			uint32_t face = random_face(&x, &r), from = nearby(&x, face, k % 4, &r);
			mr_v3 bary = random_bary(&r), centre = mr_vec(1.0 / 3, 1.0 / 3, 1.0 / 3);
			double h = 0.6 * x.edge * (2 * mr_random_real(&r) - 1);
			mr_v3 p = raised(&x, face, bary, h);
			mr_foot foot = { 0 };
			if (!mr_foot_walk(&x.g, p, (mr_place){ from, centre }, 2 * x.edge, &foot)) {
				lost++;
				continue;
			}
			assert_is_foot(&x, &foot, p);
			crossed += foot.at.face != from;
			lost += fabs(foot.height - h) > 1e-9; /* another one */
		}
		assert_true(lost < 30);
		assert_true(crossed > 1000);
	}
}

/* Over the flat square the foot is below the point; beside it there is none. */
static void
over_a_square_the_foot_is_below(void **state)
{
	mr_random r = { 2 };
	scene x;

	(void)state;
	set_up(&x, shape(MR_PLANE, 300));
	for (int k = 0; k < 2000; k++) {
		mr_v3 p = mr_mul(3, random_vector(&r));
		bool over = fabs(p.x) < 1 && fabs(p.y) < 1;
		mr_foot foot = { { 77, { 0, 0, 0 } }, 0 };
		bool walked = mr_foot_walk(
		    &x.g, p, (mr_place){ random_face(&x, &r), mr_vec(1.0 / 3, 1.0 / 3, 1.0 / 3) }, 2, &foot);
		assert_int_equal(walked, over);
		if (over) {
			assert_is_foot(&x, &foot, p);
			assert_true(fabs(foot.height - p.z) < 1e-13);
		} else {
			assert_int_equal(foot.at.face, 77);
		}
	}
}

static void
a_foot_is_not_higher_than_its_limit(void **state)
{
	mr_random r = { 3 };
	scene x;

	(void)state;
	set_up(&x, shape(MR_TORUS, 600));
	for (int k = 0; k < 500; k++) {
		uint32_t face = random_face(&x, &r);
		mr_v3 bary = random_bary(&r);
		double h = (k % 2 ? -0.1 : 0.1) * (0.2 + mr_random_real(&r));
		mr_v3 p = raised(&x, face, bary, h);
		mr_foot foot = { { 77, { 0, 0, 0 } }, 0 };
		assert_false(mr_foot_walk(&x.g, p, (mr_place){ face, bary }, 0.99 * fabs(h), &foot));
		assert_int_equal(foot.at.face, 77);
		assert_true(mr_foot_walk(&x.g, p, (mr_place){ face, bary }, 1.01 * fabs(h), &foot));
		assert_is_foot(&x, &foot, p);
	}
}

/* Inside of a tube: never beyond its axis, from wherever the walk begins. */
static void
no_foot_is_beyond_the_axis(void **state)
{
	mr_make_opts o = MR_MAKE_DEFAULTS;
	mr_random r = { 4 };
	size_t found = 0;
	mr_mesh m;
	scene x;

	(void)state;
	o.solid = MR_CYLINDER;
	o.vertices = 600;
	o.open = true;
	assert_int_equal(mr_solid_make(&ctx, &o, &m), MR_OK);
	set_up(&x, m);
	for (int k = 0; k < 1000; k++) {
		mr_v3 p = raised(&x, random_face(&x, &r), random_bary(&r), -0.9 * mr_random_real(&r));
		mr_foot foot;
		if (mr_foot_walk(&x.g, p,
			(mr_place){ random_face(&x, &r), mr_vec(1.0 / 3, 1.0 / 3, 1.0 / 3) }, 10, &foot)) {
			assert_is_foot(&x, &foot, p);
			assert_true(foot.height > -1.01);
			found++;
		}
	}
	assert_true(found > 300 && found < 1000);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(a_point_over_the_surface_finds_its_foot, setup, teardown),
		cmocka_unit_test_setup_teardown(over_a_square_the_foot_is_below, setup, teardown),
		cmocka_unit_test_setup_teardown(a_foot_is_not_higher_than_its_limit, setup, teardown),
		cmocka_unit_test_setup_teardown(no_foot_is_beyond_the_axis, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
