/* Holes are filled by what was cut out of them, nearly; loops are found, and spanned by their least area. */
#include "edit/fill.h"

#include "mesh/loops.h"
#include "shapes.h"
#include "space/bvh.h"

/* m without the faces that have a corner within `radius` of one of n places. */
static mr_mesh
without(const mr_mesh *m, const mr_v3 *place, size_t n, double radius)
{
	mr_tri *t = MR_NEW(&ctx, m->nf, mr_tri);
	mr_mesh out = { m->name, m->p, t, m->nv, 0 };

	for (size_t f = 0; f < m->nf; f++) {
		bool cut = false;
		for (size_t i = 0; i < 3 * n; i++)
			cut |= mr_dist(m->p[m->t[f].v[i % 3]], place[i / 3]) < radius;
		if (!cut)
			t[out.nf++] = m->t[f];
	}
	return out;
}

static mr_patches
filled(const mr_mesh *m, size_t order, size_t loops)
{
	mr_fill_opts o = MR_FILL_DEFAULTS;
	mr_fill_result r;
	mr_patches s;
	mr_census c;

	o.order = order;
	assert_int_equal(mr_fill(&ctx, m, &o, &s, &r), MR_OK);
	assert_int_equal(r.loops, loops);
	assert_int_equal(r.filled, loops);
	assert_int_equal(r.faces, s.all.nf - m->nf);
	assert_int_equal(r.vertices, s.all.nv - m->nv);
	assert_memory_equal(s.all.p, m->p, m->nv * sizeof *m->p);
	assert_memory_equal(s.all.t, m->t, m->nf * sizeof *m->t);
	c = census_of(&s.all);
	assert_true(c.manifold && c.oriented);
	assert_int_equal(c.boundary_edges, 0);
	assert_int_equal(c.folded_edges, 0);
	return s;
}

/* The largest distance of a new vertex from the surface that was there. */
static double
farthest(const mr_patches *s, const mr_mesh *truth)
{
	double far = 0;
	mr_bvh *bvh;

	mr_bvh_build(&ctx, truth, &bvh);
	for (size_t v = s->rim; v < s->m.nv; v++)
		far = fmax(far, sqrt(mr_bvh_closest(bvh, s->m.p[v]).dist2));
	return far;
}

/* The cap is 0.13 high. */
static void
test_cap(void **state)
{
	const mr_v3 up = { 0, 0.6, 0.8 };
	mr_mesh ball = shape(MR_SPHERE, 3000), open = without(&ball, &up, 1, 0.52);
	double far[4];

	(void)state;
	for (size_t k = 1; k <= 3; k++) {
		mr_patches s = filled(&open, k, 1);
		far[k] = farthest(&s, &ball);
	}
	assert_true(far[1] > 0.1 && far[2] < 0.02 && far[3] < 0.02);
}

static void
test_torus(void **state)
{
	const mr_v3 place[] = { { 0.8 * 1.4, 0.6 * 1.4, 0 }, { -0.6, 0.8, 0.4 } };
	mr_mesh torus = shape(MR_TORUS, 6000), open = without(&torus, place, 2, 0.3);
	mr_patches s;

	(void)state;
	s = filled(&open, 2, 2);
	assert_int_equal(census_of(&s.all).euler, 0);
	assert_true(farthest(&s, &torus) < 0.02);
}

/* Five holes in a surface with detail: as far off as that, and no farther. */
static void
test_bumpy(void **state)
{
	mr_mesh bumpy = shape(MR_BUMPY, 20000), open;
	mr_v3 place[5];
	mr_patches s;

	(void)state;
	mr_at_strides(bumpy.p, bumpy.nv, 5, place);
	open = without(&bumpy, place, 5, 0.1);
	s = filled(&open, 2, census_of(&open).boundary_loops);
	assert_true(farthest(&s, &bumpy) < 0.05);
}

/* m without the faces that are within `outer` of a place, but for those within `inner` of one. */
static mr_mesh
with_islands(const mr_mesh *m, const mr_v3 *place, size_t n, double outer, double inner)
{
	mr_mesh out = without(m, place, n, outer);
	mr_tri *t = MR_NEW(&ctx, m->nf, mr_tri);

	memcpy(t, out.t, out.nf * sizeof *t);
	for (size_t f = 0; f < m->nf; f++)
		for (size_t i = 0, near = 0; i < 3 * n; i++) {
			near = i % 3 == 0 ? 0 : near;
			near += mr_dist(m->p[m->t[f].v[i % 3]], place[i / 3]) < inner;
			if (near == 3)
				t[out.nf++] = m->t[f];
		}
	out.t = t;
	return out;
}

/* The cap that a band parts from a sphere; two pieces in one hole; each in its own of two holes. */
static void
test_islands(void **state)
{
	const mr_v3 places[] = { { 0.2, 0.9797958971132712, 0 }, { -0.2, 0.9797958971132712, 0 },
		{ 0, -1, 0 } };
	mr_mesh ball = shape(MR_SPHERE, 6000);
	mr_patches s;
	mr_mesh open;

	(void)state;
	for (size_t n = 1; n <= 3; n++) {
		open = with_islands(&ball, places, n, 0.4, n == 1 ? 0.25 : 0.13);
		s = filled(&open, 2, n == 3 ? 5 : n + 1);
		assert_true(farthest(&s, &ball) < 0.02);
		assert_true(fabs(mr_mesh_volume(&ctx, &s.all) / mr_mesh_volume(&ctx, &ball) - 1) < 0.002);
	}
}

/* The area of a plane comes back. */
static void
test_island_in_plane(void **state)
{
	const mr_v3 middle = { 0, 0, 0 };
	mr_mesh plane = shape(MR_PLANE, 3000), open = with_islands(&plane, &middle, 1, 0.4, 0.2);
	mr_fill_opts o = MR_FILL_DEFAULTS;
	mr_fill_result r;
	mr_patches s;

	(void)state;
	assert_int_equal(mr_fill(&ctx, &open, &o, &s, &r), MR_OK);
	assert_int_equal(r.filled, 2);
	assert_int_equal(census_of(&s.all).boundary_loops, 1);
	assert_true(fabs(mr_mesh_area(&ctx, &s.all) - 4) < 1e-9);
}

static bool
free_edge(const void *arg, uint32_t i, uint32_t j)
{
	(void)arg;
	(void)i;
	(void)j;
	return false;
}

/* A long loop, not convex, in a plane: its triangles cover it once. */
static void
test_span(void **state)
{
	enum { N = 1000 };
	mr_v3 *p = MR_NEW(&ctx, N, mr_v3), *beside = MR_NEW_ZERO(&ctx, N, mr_v3);
	mr_tri *t = MR_NEW(&ctx, N - 2, mr_tri);
	mr_mesh m = { "span", p, t, N, N - 2 };
	mr_topology topo;
	double area = 0;

	(void)state;
	for (size_t i = 0; i < N; i++) {
		double a = 2 * MR_PI * (double)i / N, r = 2 + cos(3 * a), b = 2 * MR_PI * (double)(i + 1) / N;
		p[i] = mr_vec(r * cos(a), r * sin(a), 0);
		area -= r * (2 + cos(3 * b)) * sin(b - a) / 2;
	}
	mr_span(&ctx, p, beside, N, free_edge, NULL, t);
	assert_int_equal(mr_topology_build(&ctx, &m, &topo), MR_OK);
	for (size_t f = 0; f < m.nf; f++)
		area += mr_norm(mr_face_cross(&m, f)) / 2;
	assert_true(fabs(area) < 0.01);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_cap, setup, teardown),
		cmocka_unit_test_setup_teardown(test_torus, setup, teardown),
		cmocka_unit_test_setup_teardown(test_bumpy, setup, teardown),
		cmocka_unit_test_setup_teardown(test_islands, setup, teardown),
		cmocka_unit_test_setup_teardown(test_island_in_plane, setup, teardown),
		cmocka_unit_test_setup_teardown(test_span, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
