/* Walks to the nearest place: on convex surfaces the nearest of all, elsewhere a local one on the sheet begun
 * on. */
#include "mesh/dynmesh.h"
#include "shapes.h"
#include "space/surface_walk.h"

static const double EPS = 1e-13;

static mr_v3
random_point(mr_random *r, double size)
{
	return mr_mul(2 * size, random_vector(r));
}

static mr_topology
topology(const mr_mesh *m)
{
	mr_topology topo;

	assert_int_equal(mr_topology_build(&ctx, m, &topo), MR_OK);
	return topo;
}

/* The place is one, and as far from q as it says. */
static void
assert_place(const mr_mesh *m, mr_closest c, mr_v3 q)
{
	const uint32_t *v = m->t[c.at.face].v;

	assert_true(c.at.bary.x >= 0 && c.at.bary.y >= 0 && c.at.bary.z >= 0);
	assert_true(fabs(c.at.bary.x + c.at.bary.y + c.at.bary.z - 1) < EPS);
	assert_true(mr_dist(mr_bary_point(c.at.bary, m->p[v[0]], m->p[v[1]], m->p[v[2]]), c.point) < EPS);
	assert_true(fabs(mr_norm2(mr_sub(q, c.point)) - c.dist2) < EPS);
}

/*
 * From any face of a convex surface that is seen from a point outside to the nearest place of all, as the
 * tree finds it: the foot on a face of the far side is a local one.
 */
static void
a_convex_surface_has_one_nearest_place(void **state)
{
	static const mr_solid solids[] = { MR_SPHERE, MR_CUBE, MR_CYLINDER };
	mr_random r = { 1 };

	(void)state;
	for (size_t i = 0; i < 3; i++) {
		mr_mesh m = shape(solids[i], 600);
		mr_topology topo = topology(&m);
		mr_bvh *bvh;
		int seen = 0;
		mr_bvh_build(&ctx, &m, &bvh);
		for (int k = 0; k < 1000; k++) {
			mr_v3 q = random_point(&r, 6);
			uint32_t f = (uint32_t)(mr_random_bits(&r) % m.nf);
			mr_closest c;
			if (mr_dot(mr_face_cross(&m, f), mr_sub(q, m.p[m.t[f].v[0]])) <= 0)
				continue;
			seen++;
			c = mr_project_walk(&m, &topo, f, q);
			assert_place(&m, c, q);
			assert_true(c.dist2 <= mr_bvh_closest(bvh, q).dist2 + EPS);
		}
		assert_true(seen > 300);
	}
}

/* Over the flat square [-1, 1]^2 with its boundary the nearest place is known. */
static void
a_square_is_left_at_its_sides(void **state)
{
	mr_mesh m = shape(MR_PLANE, 400);
	mr_topology topo = topology(&m);
	mr_random r = { 2 };

	(void)state;
	for (int k = 0; k < 1000; k++) {
		mr_v3 q = random_point(&r, 2);
		mr_v3 want = mr_vec(fmin(fmax(q.x, -1), 1), fmin(fmax(q.y, -1), 1), 0);
		mr_closest c = mr_project_walk(&m, &topo, (uint32_t)(mr_random_bits(&r) % m.nf), q);
		assert_place(&m, c, q);
		assert_true(mr_dist(c.point, want) < EPS);
	}
}

/* On any surface: no farther than the face begun on, and no face at the place is nearer. */
static void
a_walk_ends_where_all_around_is_farther(void **state)
{
	mr_mesh m = shape(MR_BUMPY, 5000);
	mr_topology topo = topology(&m);
	mr_incidence inc;
	mr_random r = { 3 };

	(void)state;
	mr_incidence_build(&ctx, &m, &inc);
	for (int k = 0; k < 2000; k++) {
		uint32_t f = (uint32_t)(mr_random_bits(&r) % m.nf);
		const uint32_t *v = m.t[f].v;
		mr_v3 q = mr_add(m.p[v[0]], random_point(&r, 0.3));
		mr_closest c = mr_project_walk(&m, &topo, f, q);
		assert_place(&m, c, q);
		assert_true(c.dist2 <= mr_triangle_closest(q, m.p[v[0]], m.p[v[1]], m.p[v[2]]).dist2);
		v = m.t[c.at.face].v;
		for (int i = 0; i < 3; i++)
			for (size_t j = inc.start[v[i]]; j < inc.start[v[i] + 1]; j++) {
				const uint32_t *u = m.t[inc.face[j]].v;
				mr_closest at = mr_triangle_closest(c.point, m.p[u[0]], m.p[u[1]], m.p[u[2]]);
				mr_closest x = mr_triangle_closest(q, m.p[u[0]], m.p[u[1]], m.p[u[2]]);
				assert_true(at.dist2 > EPS * EPS || x.dist2 >= c.dist2 - EPS);
			}
	}
}

/* Of two squares, one over the other, the far one where the walk begins there. */
static void
a_walk_stays_on_its_sheet(void **state)
{
	mr_mesh one = shape(MR_PLANE, 100), m = both(&one, &one, mr_vec(0, 0, 0.01));
	mr_topology topo = topology(&m);
	mr_random r = { 4 };

	(void)state;
	for (uint32_t f = 0; f < m.nf; f++) {
		mr_v3 q = random_point(&r, 0.9);
		mr_closest c = mr_project_walk(&m, &topo, f, q);
		assert_true((c.at.face < one.nf) == (f < one.nf));
		assert_true(mr_dist(c.point, mr_vec(q.x, q.y, f < one.nf ? 0 : 0.01)) < EPS);
	}
}

static mr_dyn
with_curves(const mr_mesh *m, const mr_topology *topo, double feature)
{
	mr_dyn d;

	assert_int_equal(mr_dyn_build(&ctx, m, topo, NULL, feature, &d), MR_OK);
	return d;
}

static void
assert_on(const mr_mesh *m, const uint32_t *curve, mr_closest c, uint32_t on)
{
	uint32_t k = on % 3;

	assert_int_equal(on / 3, c.at.face);
	assert_true(mr_coordinate(c.at.bary, (int)(k + 2) % 3) == 0); /* on that side */
	assert_true(curve[on] != MR_NONE);
	assert_true(on < 3 * m->nf);
}

/* Along an edge of a cube, and not around its ends, where three meet. */
static void
an_edge_of_a_cube_ends_at_its_corners(void **state)
{
	mr_mesh m = shape(MR_CUBE, 150);
	mr_topology topo = topology(&m);
	mr_dyn d = with_curves(&m, &topo, 40);
	mr_random r = { 5 };
	size_t curves = 0;

	(void)state;
	for (uint32_t h = 0; h < 3 * m.nf; h++) {
		mr_v3 a, b, q, want;
		uint32_t on;
		mr_closest c;
		if (d.curve[h] == MR_NONE)
			continue;
		curves++;
		a = m.p[mr_he_from(&m, h)];
		b = m.p[mr_he_to(&m, h)];
		q = random_point(&r, 2);
		/* the coordinate in which the edge runs is free, the others are -1 or 1 */
		want = mr_vec(a.x == b.x ? a.x : fmin(fmax(q.x, -1), 1),
		    a.y == b.y ? a.y : fmin(fmax(q.y, -1), 1), a.z == b.z ? a.z : fmin(fmax(q.z, -1), 1));
		c = mr_project_curve(&m, &topo, d.curve, h, q, &on);
		assert_place(&m, c, q);
		assert_on(&m, d.curve, c, on);
		assert_true(mr_dist(c.point, want) < EPS);
	}
	assert_int_equal(curves, 2 * 12 * (size_t)lround(sqrt((double)(m.nv - 2) / 6)));
}

/* Around a rim, from any edge of it that is seen from a point outside of its circle, to the nearest place. */
static void
a_rim_is_walked_around(void **state)
{
	mr_make_opts o = MR_MAKE_DEFAULTS;
	mr_random r = { 6 };
	mr_mesh m;
	mr_topology topo;
	mr_dyn d;

	(void)state;
	o.solid = MR_CYLINDER;
	o.vertices = 500;
	o.open = true;
	assert_int_equal(mr_solid_make(&ctx, &o, &m), MR_OK);
	topo = topology(&m);
	d = with_curves(&m, &topo, 180);
	for (uint32_t h = 0; h < 3 * m.nf; h++) {
		double a = 2 * MR_PI * mr_random_real(&r), z = m.p[mr_he_from(&m, h)].z, best = INFINITY;
		mr_v3 q = mr_vec(3 * cos(a), 3 * sin(a), 6 * mr_random_real(&r) - 3);
		uint32_t on;
		mr_closest c;
		mr_v3 rim = mr_lerp(0.5, m.p[mr_he_from(&m, h)], m.p[mr_he_to(&m, h)]);
		if (topo.twin[h] != MR_NONE || mr_dot(mr_vec(rim.x, rim.y, 0), mr_sub(q, rim)) <= 0)
			continue;
		c = mr_project_curve(&m, &topo, d.curve, h, q, &on);
		assert_place(&m, c, q);
		assert_on(&m, d.curve, c, on);
		assert_true(topo.twin[on] == MR_NONE);
		for (uint32_t g = 0; g < 3 * m.nf; g++)
			if (topo.twin[g] == MR_NONE && m.p[mr_he_from(&m, g)].z == z) {
				mr_v3 b = m.p[mr_he_from(&m, g)], e = m.p[mr_he_to(&m, g)];
				best = fmin(best, mr_triangle_closest(q, b, e, e).dist2);
			}
		assert_true(c.dist2 <= best + EPS);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(a_convex_surface_has_one_nearest_place, setup, teardown),
		cmocka_unit_test_setup_teardown(a_square_is_left_at_its_sides, setup, teardown),
		cmocka_unit_test_setup_teardown(a_walk_ends_where_all_around_is_farther, setup, teardown),
		cmocka_unit_test_setup_teardown(a_walk_stays_on_its_sheet, setup, teardown),
		cmocka_unit_test_setup_teardown(an_edge_of_a_cube_ends_at_its_corners, setup, teardown),
		cmocka_unit_test_setup_teardown(a_rim_is_walked_around, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
