/* Relaxation: areas, where one pass puts a vertex, what holds it back. */
#include "op/voronoi_area.h"
#include "remesh_scene.h"

static mr_v3 *
copy_of(const mr_v3 *p, size_t n)
{
	mr_v3 *q = MR_NEW(&ctx, n, mr_v3);

	assert_non_null(q);
	memcpy(q, p, n * sizeof *q);
	return q;
}

/* Moves inner vertices by random ways, where no face turns over: z is 0 all over. */
static void
stir(scene *x, double way, uint64_t seed)
{
	mr_random r = { seed };
	mr_dyn *d = &x->d;

	for (uint32_t v = 0; v < d->nv; v++) {
		mr_v3 old = d->p[v];
		uint32_t h = d->out[v];
		bool bad = false;
		if (d->kind[v] != MR_SMOOTH)
			continue;
		d->p[v].x += way * (2 * mr_random_real(&r) - 1);
		d->p[v].y += way * (2 * mr_random_real(&r) - 1);
		do {
			bad |= mr_dyn_cross(d, d->p, h / 3).z <= 0;
			h = mr_dyn_ccw(d, h);
		} while (h != MR_NONE && h != d->out[v]);
		if (bad)
			d->p[v] = old;
	}
}

static void
assert_no_face_is_turned(const mr_dyn *d)
{
	for (size_t f = 0; f < d->nf; f++)
		assert_true(mr_dyn_face_dead(d, f) || mr_dyn_cross(d, d->p, f).z > 0);
}

/* The same as those of a mesh that does not change, and what is dead has none. */
static void
areas_are_those_of_the_mesh(void **state)
{
	mr_mesh m;
	scene x;
	double *area, *want;
	uint8_t *mark;
	mr_random r = { 1 };

	(void)state;
	set_up(&x, shape(MR_BUMPY, 5000), 180);
	mark = MR_NEW_ZERO(&ctx, x.d.nv, uint8_t);
	area = MR_NEW(&ctx, x.d.nv, double);
	want = MR_NEW(&ctx, x.d.nv, double);
	for (int round = 0; round < 2; round++) {
		double sum = 0;
		mr_dyn_areas(&ctx, &x.d, 0.5, area);
		for (uint32_t v = 0; v < x.d.nv; v++) {
			assert_true(x.d.kind[v] != MR_DEAD || area[v] == 0);
			sum += area[v] / 4;
		}
		assert_int_equal(mr_dyn_compact(&ctx, &x.d), MR_OK);
		mr_dyn_areas(&ctx, &x.d, 0.5, area);
		m = mr_dyn_view(&x.d, "view");
		mr_voronoi_areas(&ctx, &m, want);
		for (uint32_t v = 0; v < x.d.nv; v++)
			assert_true(fabs(area[v] / 4 / want[v] - 1) < 1e-6);
		assert_true(fabs(sum / mr_mesh_area(&ctx, &m) - 1) < 1e-7);
		for (int k = 0; k < 2000; k++) {
			uint32_t h = (uint32_t)(mr_random_bits(&r) % (3 * x.d.nf));
			if (!mr_dyn_face_dead(&x.d, h / 3) && mr_dyn_can_collapse(&x.d, h, mark))
				mr_dyn_collapse(&x.d, h, x.d.p[mr_dyn_to(&x.d, h)]);
		}
	}
}

/* Where the formula of the paper puts a vertex: p + lambda (I - n n^T)(g - p). */
static mr_v3
formula(const scene *x, const mr_adjacency *adj, const double *mass, uint32_t v, double damping)
{
	const mr_v3 *p = x->m.p;
	mr_v3 g = { 0, 0, 0 }, n = { 0, 0, 0 };
	double sum = 0;
	mr_v3 way;

	for (size_t i = adj->start[v]; i < adj->start[v + 1]; i++) {
		g = mr_axpy(mass[adj->adj[i]], p[adj->adj[i]], g);
		sum += mass[adj->adj[i]];
	}
	for (size_t f = 0; f < x->m.nf; f++)
		for (int k = 0; k < 3; k++)
			if (x->m.t[f].v[k] == v)
				n = mr_add(n, mr_face_cross(&x->m, f));
	n = mr_unit(n);
	way = mr_sub(mr_mul(1 / sum, g), p[v]);
	return mr_axpy(damping, mr_axpy(-mr_dot(way, n), n, way), p[v]);
}

static void
a_pass_is_the_formula(void **state)
{
	static const double gravity[] = { 0, 1, 1.5, 2 };
	mr_adjacency adj;
	scene x;
	double *area, *mass;

	(void)state;
	for (size_t i = 0; i < 4; i++) {
		mr_relax_opts o = { .damping = 0.5, .gravity = gravity[i], .passes = 1, .project = false };
		set_up(&x, shape(MR_KNOT, 2000), 180);
		area = MR_NEW(&ctx, x.m.nv, double);
		mass = MR_NEW(&ctx, x.m.nv, double);
		mr_adjacency_build(&ctx, &x.m, &adj);
		mr_voronoi_areas(&ctx, &x.m, area);
		for (size_t v = 0; v < x.m.nv; v++)
			mass[v] = pow(area[v], gravity[i]);
		assert_int_equal(mr_relax(&ctx, &x.d, &x.s, &o), MR_OK);
		for (uint32_t v = 0; v < x.m.nv; v++)
			assert_true(mr_dist(x.d.p[v], formula(&x, &adj, mass, v, o.damping)) < 1e-7);
	}
}

/* A vertex of the boundary, of half an area, counts twice; without a change of place nothing else does. */
static void
boundary_vertices_count_twice(void **state)
{
	mr_relax_opts o = { .damping = 1, .gravity = 1, .passes = 1, .project = false };
	mr_adjacency adj;
	scene x;
	double *mass;
	size_t beside = 0;

	(void)state;
	set_up(&x, shape(MR_PLANE, 100), 180);
	stir(&x, 0.1, 3);
	x.m.p = copy_of(x.d.p, x.d.nv); /* the same surface, with the vertices elsewhere */
	mass = MR_NEW(&ctx, x.m.nv, double);
	mr_adjacency_build(&ctx, &x.m, &adj);
	mr_voronoi_areas(&ctx, &x.m, mass);
	for (uint32_t v = 0; v < x.m.nv; v++)
		mass[v] *= x.d.kind[v] == MR_SMOOTH ? 1 : 2;
	assert_int_equal(mr_relax(&ctx, &x.d, &x.s, &o), MR_OK);
	for (uint32_t v = 0; v < x.m.nv; v++) {
		if (x.d.kind[v] != MR_SMOOTH)
			continue;
		assert_true(mr_dist(x.d.p[v], formula(&x, &adj, mass, v, 1)) < 1e-7);
		for (size_t i = adj.start[v]; i < adj.start[v + 1]; i++)
			beside += x.d.kind[adj.adj[i]] != MR_SMOOTH;
	}
	assert_true(beside > 20);
}

/* Projected, all vertices lie on the source, in the face that they say, and corners are where they were. */
static void
projected_vertices_lie_on_the_surface(void **state)
{
	static const mr_solid solids[] = { MR_BUMPY, MR_TORUS, MR_CUBE };
	mr_relax_opts o = { .damping = 1, .gravity = 1.5, .passes = 1, .project = true };

	(void)state;
	for (size_t i = 0; i < 3; i++) {
		scene x;
		double moved = 0;
		set_up(&x, shape(solids[i], 3000), 40);
		for (int pass = 0; pass < 5; pass++)
			assert_int_equal(mr_relax(&ctx, &x.d, &x.s, &o), MR_OK);
		for (uint32_t v = 0; v < x.d.nv; v++) {
			const uint32_t *t = x.m.t[mr_dyn_place(&x.d, v)].v;
			assert_true(
			    mr_triangle_closest(x.d.p[v], x.m.p[t[0]], x.m.p[t[1]], x.m.p[t[2]]).dist2 <
			    1e-28);
			assert_true(x.d.kind[v] != MR_CORNER || mr_dist(x.d.p[v], x.m.p[v]) == 0);
			moved = fmax(moved, mr_dist(x.d.p[v], x.m.p[v]));
		}
		assert_true(moved > 0);
	}
}

/* The sides of a square and the edges of a cube stay straight, their vertices become even. */
static void
curves_stay_and_become_even(void **state)
{
	static const mr_solid solids[] = { MR_PLANE, MR_CUBE };
	mr_relax_opts o = { .damping = 1, .gravity = 0, .passes = 1, .project = true };

	(void)state;
	for (size_t i = 0; i < 2; i++) {
		scene x;
		double longest = 0, shortest = INFINITY;
		set_up(&x, shape(solids[i], 300), 40);
		for (uint32_t v = 0; v < x.d.nv; v++)
			if (x.d.kind[v] == MR_CURVE) { /* off the middle, along its curve */
				mr_v3 p = x.d.p[v];
				double t = 0.3 * mr_mesh_edge_scale(&ctx, &x.m);
				x.d.p[v] = fabs(p.x) < 1   ? mr_vec(p.x + t, p.y, p.z)
				           : fabs(p.y) < 1 ? mr_vec(p.x, p.y + t, p.z)
				                           : mr_vec(p.x, p.y, p.z + t);
			}
		for (int pass = 0; pass < 300; pass++)
			assert_int_equal(mr_relax(&ctx, &x.d, &x.s, &o), MR_OK);
		for (uint32_t h = 0; h < 3 * x.d.nf; h++)
			if (mr_dyn_on_curve(&x.d, h)) {
				mr_v3 a = x.d.p[x.d.v[h]], b = x.d.p[mr_dyn_to(&x.d, h)];
				double l = mr_dist(a, b);
				assert_int_equal((fabs(b.x - a.x) > 1e-12) + (fabs(b.y - a.y) > 1e-12) +
						     (fabs(b.z - a.z) > 1e-12),
				    1);
				longest = fmax(longest, l);
				shortest = fmin(shortest, l);
			}
		assert_true(longest / shortest < 1.01);
	}
}

/* Full steps on a mesh all but tangled, with any gravity: no face turns over, and the mesh becomes a good
 * one. */
static void
no_face_turns_over(void **state)
{
	for (uint64_t seed = 1; seed < 20; seed++) {
		mr_relax_opts o = {
			.damping = 1, .gravity = (double)(seed % 4), .passes = 1, .project = seed % 2
		};
		double worst = 1;
		scene x;
		(void)state;
		set_up(&x, shape(MR_PLANE, 400), 180);
		for (int k = 0; k < 20; k++)
			stir(&x, 0.3, seed + 1000 * (uint64_t)k);
		assert_no_face_is_turned(&x.d);
		for (size_t f = 0; f < x.d.nf; f++) {
			const uint32_t *v = &x.d.v[3 * f];
			worst = fmin(worst, mr_dyn_shape(x.d.p[v[0]], x.d.p[v[1]], x.d.p[v[2]]));
		}
		assert_true(worst < MR_NEEDLE);
		for (int pass = 0; pass < 40; pass++) {
			assert_int_equal(mr_relax(&ctx, &x.d, &x.s, &o), MR_OK);
			assert_no_face_is_turned(&x.d);
		}
		mr_ctx_free(&ctx);
	}
}

/* A lattice of equal triangles is at rest, but for what comes in from its rim: a row in a pass. */
static void
a_lattice_is_at_rest(void **state)
{
	enum { N = 24, PASSES = 5 };
	mr_relax_opts o = { .damping = 1, .gravity = 1.5, .passes = 1, .project = true };
	scene x;

	(void)state;
	set_up(&x, lattice(N), 180);
	for (int pass = 0; pass < PASSES; pass++)
		assert_int_equal(mr_relax(&ctx, &x.d, &x.s, &o), MR_OK);
	for (uint32_t j = 2 * PASSES; j <= N - 2 * PASSES; j++)
		for (uint32_t i = 2 * PASSES; i <= N - 2 * PASSES; i++) {
			uint32_t v = (N + 1) * j + i;
			assert_true(mr_dist(x.d.p[v], x.m.p[v]) < 1e-13);
		}
}

static void
lengths_are_those_of_a_face(void **state)
{
	double *mean;
	scene x;

	(void)state;
	set_up(&x, shape(MR_TORUS, 200), 180);
	assert_true(mr_remesh_length(&x.s, &x.d, 7) == x.s.uniform);
	mean = MR_NEW(&ctx, x.m.nf, double);
	for (size_t f = 0; f < x.m.nf; f++)
		mean[f] = 1 + (double)f;
	x.s.length = x.s.mean = mean;
	for (uint32_t v = 0; v < x.d.nv; v++)
		assert_true(mr_remesh_length(&x.s, &x.d, v) == 1 + x.d.at[v]);
}

/* Between two sheets that look away from one another a place is on that which looks the way of the normal. */
static void
a_place_is_on_the_side_of_the_normal(void **state)
{
	mr_mesh top = shape(MR_PLANE, 200), m = both(&top, &top, mr_vec(0, 0, -0.05));
	mr_tri *t = MR_NEW(&ctx, m.nf, mr_tri);
	scene x;

	(void)state;
	memcpy(t, m.t, m.nf * sizeof *t);
	for (size_t f = top.nf; f < m.nf; f++) /* the lower one looks down */
		t[f] = (mr_tri){ { m.t[f].v[0], m.t[f].v[2], m.t[f].v[1] } };
	m.t = t;
	set_up(&x, m, 180);
	for (uint32_t v = 0; v < x.d.nv; v++) {
		double side = v < top.nv ? 1 : -1;
		mr_closest c = mr_remesh_place(&x.s, &x.d, v,
		    mr_vec(x.d.p[v].x, x.d.p[v].y, side > 0 ? -0.04 : -0.01), mr_vec(0, 0, side));
		assert_true(mr_dist(c.point, x.d.p[v]) < 1e-14);
		assert_true((c.at.face < top.nf) == (side > 0));
	}
	assert_true(mr_remesh_against(&x.s, &x.d, x.d.at, x.m.t[0].v, mr_vec(0, 0, -1)));
	assert_false(mr_remesh_against(&x.s, &x.d, x.d.at, x.m.t[0].v, mr_vec(0, 0, 1)));
	assert_false(mr_remesh_against(
	    &x.s, &x.d, x.d.at, (uint32_t[]){ 0, 1, (uint32_t)top.nv + 1 }, mr_vec(0, 0, -1)));
}

/* A vertex that has lost its place finds it from its neighbours': where its own is far, or looks the other
 * way. */
static void
a_lost_place_is_found_from_the_neighbours(void **state)
{
	mr_mesh top = shape(MR_PLANE, 200);

	(void)state;
	for (int away = 0; away < 2; away++) {
		mr_mesh m = both(&top, &top, mr_vec(0, 0, -0.05));
		mr_tri *t = MR_NEW(&ctx, m.nf, mr_tri);
		scene x;
		memcpy(t, m.t, m.nf * sizeof *t);
		for (size_t f = top.nf; f < m.nf && away; f++)
			t[f] = (mr_tri){ { m.t[f].v[0], m.t[f].v[2], m.t[f].v[1] } };
		m.t = t;
		set_up(&x, m, 180);
		for (uint32_t v = 0; v < top.nv; v++) {
			uint32_t own = x.d.at[v];
			mr_v3 q = x.d.p[v];
			mr_closest c;
			if (x.d.kind[v] != MR_SMOOTH)
				continue;
			q.z = away ? -0.04 : -0.01;
			x.d.at[v] += (uint32_t)top.nf; /* the face below */
			c = mr_remesh_place(&x.s, &x.d, v, q, mr_vec(0, 0, 1));
			assert_true(c.at.face < top.nf && mr_dist(c.point, x.d.p[v]) < 1e-14);
			x.d.at[v] = own;
		}
	}
}

static void
threads_do_not_matter(void **state)
{
	mr_relax_opts o = { .damping = 1, .gravity = 1.5, .passes = 1, .project = true };
	scene x[2];

	(void)state;
	for (unsigned i = 0; i < 2; i++) {
		ctx.threads = i + 1;
		set_up(&x[i], shape(MR_BUMPY, 6000), 180);
		for (int pass = 0; pass < 3; pass++)
			assert_int_equal(mr_relax(&ctx, &x[i].d, &x[i].s, &o), MR_OK);
	}
	assert_memory_equal(x[0].d.p, x[1].d.p, x[0].d.nv * sizeof *x[0].d.p);
	assert_memory_equal(x[0].d.at, x[1].d.at, x[0].d.nv * sizeof *x[0].d.at);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(areas_are_those_of_the_mesh, setup, teardown),
		cmocka_unit_test_setup_teardown(a_pass_is_the_formula, setup, teardown),
		cmocka_unit_test_setup_teardown(boundary_vertices_count_twice, setup, teardown),
		cmocka_unit_test_setup_teardown(projected_vertices_lie_on_the_surface, setup, teardown),
		cmocka_unit_test_setup_teardown(curves_stay_and_become_even, setup, teardown),
		cmocka_unit_test_setup_teardown(no_face_turns_over, setup, teardown),
		cmocka_unit_test_setup_teardown(a_lattice_is_at_rest, setup, teardown),
		cmocka_unit_test_setup_teardown(lengths_are_those_of_a_face, setup, teardown),
		cmocka_unit_test_setup_teardown(a_place_is_on_the_side_of_the_normal, setup, teardown),
		cmocka_unit_test_setup_teardown(a_lost_place_is_found_from_the_neighbours, setup, teardown),
		cmocka_unit_test_setup_teardown(threads_do_not_matter, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
