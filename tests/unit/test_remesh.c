/* Laws of remeshing: topology, regularity, the source map, and the operations it is made of. */
#include "op/voronoi_area.h"
#include "remesh/remesh.h"
#include "remesh_scene.h"

typedef struct census {
	long euler;
	size_t boundary, valence6, inner;
	double area_error, angle_error, smallest_angle;
	size_t folds;
} census;

static double
angle(mr_v3 a, mr_v3 b, mr_v3 c)
{
	mr_v3 x = mr_sub(b, a), y = mr_sub(c, a);
	return atan2(mr_norm(mr_cross(x, y)), mr_dot(x, y)) * 180 / MR_PI;
}

static census
count(const mr_mesh *m)
{
	census c = { .smallest_angle = 180 };
	mr_topology topo;
	double *area = MR_NEW(&ctx, m->nv, double), sum = 0;

	assert_int_equal(mr_topology_build(&ctx, m, &topo), MR_OK);
	mr_voronoi_areas(&ctx, m, area);
	size_t half = 0;
	for (uint32_t h = 0; h < 3 * m->nf; h++) {
		uint32_t g = topo.twin[h];
		half += g == MR_NONE ? 2 : 1;
		c.boundary += g == MR_NONE;
		if (g != MR_NONE && h < g)
			c.folds += mr_dot(mr_unit(mr_face_cross(m, h / 3)),
				       mr_unit(mr_face_cross(m, g / 3))) < -0.5;
	}
	c.euler = (long)m->nv - (long)half / 2 + (long)m->nf;
	for (uint32_t v = 0; v < m->nv; v++) {
		uint32_t h = topo.out[v];
		unsigned n = 0;
		do {
			n++;
			h = mr_he_ccw(&topo, h);
		} while (h != MR_NONE && h != topo.out[v]);
		if (h == MR_NONE)
			continue;
		c.inner++;
		c.valence6 += n == 6;
		sum += area[v];
	}
	for (uint32_t v = 0; v < m->nv; v++)
		if (topo.twin[topo.out[v]] != MR_NONE)
			c.area_error += fabs(area[v] * (double)c.inner / sum - 1) / (double)c.inner;
	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++) {
			const uint32_t *v = m->t[f].v;
			double x = angle(m->p[v[k]], m->p[v[(k + 1) % 3]], m->p[v[(k + 2) % 3]]);
			c.angle_error += fabs(x - 60) / (3 * (double)m->nf);
			if (x < c.smallest_angle)
				c.smallest_angle = x;
		}
	return c;
}

static mr_mesh
remeshed(const mr_mesh *m, const mr_remesh_opts *o, mr_places *map)
{
	mr_mesh out;

	assert_int_equal(mr_remesh(&ctx, m, o, NULL, &out, map, NULL), MR_OK);
	return out;
}

static void
closed_shapes_keep_their_topology_and_become_regular(void **state)
{
	static const struct {
		mr_solid solid;
		long euler;
		double area_error, angle_error;
	} shapes[] = {
		{ MR_SPHERE, 2, 0.08, 1.5 }, /* its facets were of several sizes, and regular: they stay so */
		{ MR_TORUS, 0, 0.05, 5.3 }, { MR_KNOT, 0, 0.05, 5.3 },
		{ MR_BUMPY, 2, 0.055, 5.5 }, /* as it is, not smoothed */
	};
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_places map;

	(void)state;
	for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
		mr_mesh m = shape(shapes[i].solid, 22000), r = remeshed(&m, &o, &map);
		census c = count(&r);
		assert_int_equal(c.euler, shapes[i].euler);
		assert_int_equal(c.boundary, 0);
		assert_int_equal(c.folds, 0);
		assert_true(c.area_error < shapes[i].area_error);
		assert_true(c.angle_error < shapes[i].angle_error);
		assert_true((double)c.valence6 > 0.8 * (double)c.inner);
		assert_true(c.smallest_angle > 3);
		mr_ctx_free(&ctx);
	}
}

static void
source_map_points_at_the_vertices(void **state)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_mesh m = shape(MR_TORUS, 5000), r;
	mr_places map;

	(void)state;
	r = remeshed(&m, &o, &map);
	for (size_t v = 0; v < r.nv; v++) {
		const uint32_t *t = m.t[map.face[v]].v;
		mr_v3 w = map.bary[v];
		assert_true(map.face[v] < m.nf);
		assert_true(w.x >= 0 && w.y >= 0 && w.z >= 0 && fabs(w.x + w.y + w.z - 1) < 1e-12);
		assert_true(mr_dist(mr_bary_point(w, m.p[t[0]], m.p[t[1]], m.p[t[2]]), r.p[v]) < 1e-12);
	}
}

/* The boundary of the unit square keeps its four corners and its straight sides. */
static void
boundary_stays_where_it_is(void **state)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_mesh m = shape(MR_PLANE, 3000), r;
	mr_topology topo;
	mr_places map;
	mr_box before = mr_box_of(m.p, m.nv), after;

	(void)state;
	r = remeshed(&m, &o, &map);
	after = mr_box_of(r.p, r.nv);
	assert_true(mr_dist(before.min, after.min) < 1e-12 && mr_dist(before.max, after.max) < 1e-12);
	assert_true(fabs(mr_mesh_area(&ctx, &r) - mr_mesh_area(&ctx, &m)) < 1e-10);
	assert_int_equal(mr_topology_build(&ctx, &r, &topo), MR_OK);
	assert_int_equal(count(&r).euler, 1);
}

/* The edges of a cube survive with --feature: volume and area are the cube's. */
static void
features_survive(void **state)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_mesh m = shape(MR_CUBE, 3000), r;
	mr_places map;

	(void)state;
	o.feature = 40;
	r = remeshed(&m, &o, &map);
	assert_true(fabs(mr_mesh_area(&ctx, &r) / mr_mesh_area(&ctx, &m) - 1) < 1e-9);
	assert_int_equal(count(&r).euler, 2);
}

static void
lengths_adapt_to_curvature(void **state)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_mesh m = shape(MR_BUMPY, 20000), coarse, fine;
	mr_places map;

	(void)state;
	o.adaptive = 0.002 * mr_mesh_diagonal(&m);
	coarse = remeshed(&m, &o, &map);
	o.adaptive /= 4;
	fine = remeshed(&m, &o, &map);
	assert_int_equal(count(&coarse).euler, 2);
	assert_true(
	    fine.nv > 2 * coarse.nv && fine.nv < 8 * coarse.nv); /* lengths go with the root of the error */
}

static void
threads_and_runs_do_not_change_a_byte(void **state)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_mesh m = shape(MR_KNOT, 8000), a, b;
	mr_places map;

	(void)state;
	a = remeshed(&m, &o, &map);
	ctx.threads = 1;
	b = remeshed(&m, &o, &map);
	assert_int_equal(a.nv, b.nv);
	assert_memory_equal(a.p, b.p, a.nv * sizeof *a.p);
	assert_memory_equal(a.t, b.t, a.nf * sizeof *a.t);
}

static void
random_operations_keep_a_manifold(void **state)
{
	static const mr_solid solids[] = { MR_TORUS, MR_PLANE };
	mr_random random = { 7 };

	(void)state;
	for (size_t i = 0; i < 2; i++) {
		mr_mesh m = shape(solids[i], 200), r;
		mr_topology topo;
		mr_dyn d;
		assert_int_equal(mr_topology_build(&ctx, &m, &topo), MR_OK);
		assert_int_equal(mr_dyn_build(&ctx, &m, &topo, NULL, 180, &d), MR_OK);
		operate(&d, 6000, &random);
		assert_valid(&d);
		long before = count(&m).euler;
		assert_int_equal(mr_dyn_compact(&ctx, &d), MR_OK);
		assert_valid(&d);
		r = mr_dyn_view(&d, "dyn");
		assert_int_equal(count(&r).euler, before);
	}
}

static void
what_is_no_manifold_is_refused_by_name(void **state)
{
	static const mr_v3 p[5] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 } };
	static const mr_tri t[3] = { { { 0, 1, 2 } }, { { 1, 0, 3 } }, { { 0, 1, 4 } } };
	mr_mesh m = { "base", p, t, 5, 3 }, r;
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_places map;

	(void)state;
	assert_int_equal(mr_remesh(&ctx, &m, &o, NULL, &r, &map, NULL), MR_EMESH);
	assert_string_equal(ctx.error, "base: edge 0-1 has 3 faces");
}

/* A block, 6 by 6 by 6, whose upright edges are rounded by a radius of 0.5 in 12 steps. */
static mr_mesh
rounded_block(void)
{
	enum { STEPS = 12, N = 4 * (STEPS + 1) };
	mr_v3 *p = MR_NEW(&ctx, 2 * N + 2, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 4 * N, mr_tri);

	for (uint32_t i = 0; i < N; i++) {
		uint32_t next = (i + 1) % N, corner = i / (STEPS + 1);
		double turn = MR_PI / 2 * (corner + (double)(i % (STEPS + 1)) / STEPS);
		double x = corner == 0 || corner == 3 ? 2.5 : -2.5, y = corner < 2 ? 2.5 : -2.5;
		p[i] = mr_vec(x + 0.5 * cos(turn), y + 0.5 * sin(turn), -3);
		p[N + i] = mr_add(p[i], mr_vec(0, 0, 6));
		t[4 * i] = (mr_tri){ { i, next, N + next } };
		t[4 * i + 1] = (mr_tri){ { i, N + next, N + i } };
		t[4 * i + 2] = (mr_tri){ { next, i, 2 * N } };
		t[4 * i + 3] = (mr_tri){ { N + i, N + next, 2 * N + 1 } };
	}
	p[2 * N] = mr_vec(0, 0, -3);
	p[2 * N + 1] = mr_vec(0, 0, 3);
	return (mr_mesh){ "block", p, t, 2 * N + 2, 4 * N };
}

/* Roundings smaller than an edge are followed, and edges are as long as ever elsewhere. */
static void
curves_are_followed_around_small_roundings(void **state)
{
	(void)state;
	for (double length = 0.7; length < 1.5; length += 0.2) {
		mr_remesh_opts o = MR_REMESH_DEFAULTS;
		mr_mesh m = rounded_block(), out;
		mr_places map;
		o.length = length;
		o.feature = 40;
		assert_int_equal(mr_remesh(&ctx, &m, &o, NULL, &out, &map, NULL), MR_OK);
		assert_true((double)out.nf < 10 * mr_mesh_area(&ctx, &m) / (length * length));
		mr_ctx_free(&ctx);
	}
}

/* Within 5 %, of closed and open surfaces, with one length or adapted ones. */
static void
as_many_as_are_wanted(void **state)
{
	static const mr_solid solids[] = { MR_BUMPY, MR_KNOT, MR_PLANE };

	(void)state;
	for (size_t i = 0; i < 3; i++)
		for (size_t n = 4000; n <= 8000; n *= 2)
			for (int k = 0; k < 4; k++) {
				mr_remesh_opts o = MR_REMESH_DEFAULTS;
				mr_mesh m = shape(solids[i], 4000), r;
				mr_places map;
				o.adaptive = k < 2 ? 0 : 0.002 * mr_mesh_diagonal(&m);
				*(k % 2 ? &o.vertices : &o.faces) = n;
				r = remeshed(&m, &o, &map);
				assert_true(fabs((double)(k % 2 ? r.nv : r.nf) / (double)n - 1) < 0.05);
				mr_ctx_free(&ctx);
			}
}

/* A square with a round hole of n edges in its middle. */
static mr_mesh
plate_with_hole(uint32_t n, double radius)
{
	mr_v3 *p = MR_NEW(&ctx, 2 * n, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * n, mr_tri);

	for (uint32_t i = 0; i < n; i++) {
		double a = 2 * MR_PI * i / n, x = cos(a), y = sin(a), far = fmax(fabs(x), fabs(y));
		uint32_t j = (i + 1) % n;
		p[i] = mr_vec(radius * x, radius * y, 0);
		p[n + i] = mr_vec(x / far, y / far, 0);
		t[2 * i] = (mr_tri){ { i, n + i, n + j } };
		t[2 * i + 1] = (mr_tri){ { i, n + j, j } };
	}
	return (mr_mesh){ "plate", p, t, 2 * n, 2 * n };
}

static double
boundary_length(const mr_mesh *m)
{
	mr_topology topo;
	double sum = 0;

	assert_int_equal(mr_topology_build(&ctx, m, &topo), MR_OK);
	for (uint32_t h = 0; h < 3 * m->nf; h++)
		if (topo.twin[h] == MR_NONE)
			sum += mr_dist(m->p[mr_he_from(m, h)], m->p[mr_he_to(m, h)]);
	return sum;
}

/* A hole that is smaller than an edge stays a round hole. */
static void
boundary_loops_are_not_crushed(void **state)
{
	(void)state;
	for (int adaptive = 0; adaptive < 2; adaptive++)
		for (double radius = 0.02; radius < 0.5; radius *= 2) {
			mr_remesh_opts o = MR_REMESH_DEFAULTS;
			mr_mesh m = plate_with_hole(128, radius), r;
			double round = 2 * MR_PI * radius, kept;
			mr_places map;
			o.length = 0.3;
			o.adaptive = adaptive * 0.001;
			r = remeshed(&m, &o, &map);
			kept = (boundary_length(&r) - 8) / round;
			assert_true(kept > 0.96 && kept < 1);
			assert_int_equal(count(&r).euler, 0);
			mr_ctx_free(&ctx);
		}
}

/* Along the edges of a cube nothing is curved, but where they are not kept all is. */
static void
creases_are_as_curved_as_they_are_along_them(void **state)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_mesh m = shape(MR_CUBE, 3000), r;
	mr_places map;
	size_t rounded;

	(void)state;
	o.length = 0.1;
	o.adaptive = 0.001;
	rounded = remeshed(&m, &o, &map).nf;
	o.feature = 40;
	r = remeshed(&m, &o, &map);
	assert_true(r.nf < 400 && rounded > 4000);
	assert_true(fabs(mr_mesh_area(&ctx, &r) / mr_mesh_area(&ctx, &m) - 1) < 1e-9);
}

/* The side of a cylinder, of n facets as long as it is. */
static mr_mesh
slivers(uint32_t n, double radius)
{
	mr_v3 *p = MR_NEW(&ctx, 2 * n, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * n, mr_tri);

	for (uint32_t i = 0; i < n; i++) {
		double a = 2 * MR_PI * i / n;
		uint32_t j = (i + 1) % n;
		p[i] = mr_vec(radius * cos(a), radius * sin(a), 0);
		p[n + i] = mr_vec(radius * cos(a), radius * sin(a), 1);
		t[2 * i] = (mr_tri){ { i, j, n + j } };
		t[2 * i + 1] = (mr_tri){ { i, n + j, n + i } };
	}
	return (mr_mesh){ "slivers", p, t, 2 * n, 2 * n };
}

/* Bisecting slivers by their lengths would take a million faces here, and 17 million at 3000. */
static void
slivers_take_no_more_faces_than_their_area(void **state)
{
	(void)state;
	for (uint32_t n = 750; n <= 3000; n *= 2) {
		mr_remesh_opts o = MR_REMESH_DEFAULTS;
		mr_mesh m = slivers(n, 0.05), r;
		mr_remesh_result result;
		mr_places map;
		double area = mr_mesh_area(&ctx, &m);
		o.length = 0.02;
		assert_int_equal(mr_remesh(&ctx, &m, &o, NULL, &r, &map, &result), MR_OK);
		assert_true((double)result.splits < 10 * area / (sqrt(3) / 4 * o.length * o.length));
		assert_true(fabs(mr_mesh_area(&ctx, &r) / area - 1) < 0.03);
		assert_int_equal(result.flipped + result.folded, 0);
		assert_int_equal(count(&r).euler, 0);
		mr_ctx_free(&ctx);
	}
}

static void
what_would_take_too_much_is_refused_with_the_length_to_take(void **state)
{
	static const mr_v3 thin[3] = { { 0, 0, 0 }, { 1e7, 0, 0 }, { 0, 1e-7, 0 } };
	static const mr_tri one = { { 0, 1, 2 } };
	mr_mesh shapes[2] = { { "needle", thin, &one, 3, 1 }, shape(MR_SPHERE, 500) };

	(void)state;
	for (int i = 0; i < 2; i++) {
		mr_remesh_opts o = MR_REMESH_DEFAULTS;
		mr_places map;
		mr_mesh r;
		const char *take;
		o.length = i * 1e-9;
		assert_int_equal(mr_remesh(&ctx, &shapes[i], &o, NULL, &r, &map, NULL), MR_ERANGE);
		take = strstr(ctx.error, "take a length of ");
		assert_non_null(take);
		o.length = strtod(take + strlen("take a length of "), NULL) *
		           (i == 0 ? 1 : 500); /* in no time */
		assert_int_equal(mr_remesh(&ctx, &shapes[i], &o, NULL, &r, &map, NULL), MR_OK);
	}
}

/* Far from 1 in size, where products of areas overflow or vanish: the same mesh, bit for bit. */
static void
size_makes_no_difference(void **state)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_mesh m = shape(MR_BUMPY, 500), at_one, r;
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	mr_places map;

	(void)state;
	assert_int_equal(mr_remesh(&ctx, &m, &o, NULL, &at_one, &map, NULL), MR_OK);
	for (int exponent = -96; exponent <= 96; exponent += 192) {
		mr_mesh far = m;
		for (size_t v = 0; v < m.nv; v++)
			p[v] = mr_vec(
			    ldexp(m.p[v].x, exponent), ldexp(m.p[v].y, exponent), ldexp(m.p[v].z, exponent));
		far.p = p;
		assert_int_equal(mr_remesh(&ctx, &far, &o, NULL, &r, &map, NULL), MR_OK);
		assert_int_equal(r.nv, at_one.nv);
		assert_memory_equal(r.t, at_one.t, r.nf * sizeof *r.t);
		for (size_t v = 0; v < r.nv; v++)
			assert_true(r.p[v].x == ldexp(at_one.p[v].x, exponent));
	}
}

/* Two triangles on one another, which have no other mesh with their three vertices. */
static void
a_pillow_stays(void **state)
{
	static const mr_v3 p[3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
	static const mr_tri t[2] = { { { 0, 1, 2 } }, { { 0, 2, 1 } } };
	mr_mesh m = { "pillow", p, t, 3, 2 }, r;
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_places map;

	(void)state;
	for (int i = 0; i < 2; i++) {
		assert_int_equal(mr_remesh(&ctx, &m, &o, NULL, &r, &map, NULL), MR_OK);
		assert_int_equal(r.nf, 2);
		o.length = 0.1;
	}
}

/* It is thinner than its edges all the way: half of all faces are flawed, round after round, and the last
 * resort would take more faces than may be. */
static void
a_long_spike_ends(void **state)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_mesh m = shape(MR_SPHERE, 162), r;
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	mr_places map;

	(void)state;
	memcpy(p, m.p, m.nv * sizeof *p);
	p[5].y = 1000;
	m.p = p;
	assert_int_equal(mr_remesh(&ctx, &m, &o, NULL, &r, &map, NULL), MR_OK);
	assert_true(r.nf < 40000);
}

/* So far from the origin that an edge of the length has no number between its ends. */
static void
what_cannot_be_halved_stays(void **state)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_mesh m = shape(MR_SPHERE, 500), r;
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	mr_places map;

	(void)state;
	for (size_t v = 0; v < m.nv; v++)
		p[v] = mr_add(m.p[v], mr_vec(1e15, 1e15, 1e15));
	m.p = p;
	o.length = 0.05;
	assert_int_equal(mr_remesh(&ctx, &m, &o, NULL, &r, &map, NULL), MR_OK);
	assert_int_equal(count(&r).euler, 2);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(
		    closed_shapes_keep_their_topology_and_become_regular, setup, teardown),
		cmocka_unit_test_setup_teardown(source_map_points_at_the_vertices, setup, teardown),
		cmocka_unit_test_setup_teardown(boundary_stays_where_it_is, setup, teardown),
		cmocka_unit_test_setup_teardown(features_survive, setup, teardown),
		cmocka_unit_test_setup_teardown(lengths_adapt_to_curvature, setup, teardown),
		cmocka_unit_test_setup_teardown(threads_and_runs_do_not_change_a_byte, setup, teardown),
		cmocka_unit_test_setup_teardown(random_operations_keep_a_manifold, setup, teardown),
		cmocka_unit_test_setup_teardown(what_is_no_manifold_is_refused_by_name, setup, teardown),
		cmocka_unit_test_setup_teardown(curves_are_followed_around_small_roundings, setup, teardown),
		cmocka_unit_test_setup_teardown(as_many_as_are_wanted, setup, teardown),
		cmocka_unit_test_setup_teardown(boundary_loops_are_not_crushed, setup, teardown),
		cmocka_unit_test_setup_teardown(
		    creases_are_as_curved_as_they_are_along_them, setup, teardown),
		cmocka_unit_test_setup_teardown(slivers_take_no_more_faces_than_their_area, setup, teardown),
		cmocka_unit_test_setup_teardown(
		    what_would_take_too_much_is_refused_with_the_length_to_take, setup, teardown),
		cmocka_unit_test_setup_teardown(size_makes_no_difference, setup, teardown),
		cmocka_unit_test_setup_teardown(a_pillow_stays, setup, teardown),
		cmocka_unit_test_setup_teardown(a_long_spike_ends, setup, teardown),
		cmocka_unit_test_setup_teardown(what_cannot_be_halved_stays, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
