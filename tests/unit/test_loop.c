/* Loop subdivision against its rules, its limit against many steps, and its laws. */
#include "base/random.h"
#include "shapes.h"
#include "subdivide/loop.h"

static void
assert_near(double a, double b, double tolerance)
{
	if (!(fabs(a - b) <= tolerance))
		fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

static void
assert_near_v3(mr_v3 a, mr_v3 b, double tolerance)
{
	if (!(mr_dist(a, b) <= tolerance))
		fail_msg("%.17g %.17g %.17g is not %.17g %.17g %.17g within %g", a.x, a.y, a.z, b.x, b.y, b.z,
		    tolerance);
}

static mr_loop *
levels(const mr_mesh *m, double crease, size_t n)
{
	mr_loop *level = MR_NEW(&ctx, n + 1, mr_loop);

	assert_int_equal(mr_loop_levels(&ctx, m, crease, NULL, n, level), MR_OK);
	return level;
}

/* Positions on level n; m: of level 0. */
static const mr_v3 *
refined(const mr_mesh *m, const mr_loop *level, size_t n)
{
	const mr_v3 *p = m->p;

	for (size_t i = 0; i < n; i++) {
		mr_v3 *next = MR_NEW(&ctx, level[i + 1].nv, mr_v3);
		mr_loop_subdivide(&ctx, &level[i], &level[i + 1], 3, (const double *)p, (double *)next);
		p = next;
	}
	return p;
}

/* The half-edges that are written down are those found by sorting, and the counts those of the formula. */
static void
test_levels_are_meshes(void **state)
{
	static const mr_solid solids[] = { MR_SPHERE, MR_TORUS, MR_PLANE, MR_CUBE };

	(void)state;
	for (size_t s = 0; s < 4; s++)
		for (int crease = 0; crease < 2; crease++) {
			mr_mesh m = shape(solids[s], 60);
			mr_loop *level = levels(&m, crease ? 30 : 180, 3);
			for (size_t i = 0; i <= 3; i++) {
				const mr_loop *l = &level[i];
				mr_mesh fine = { "fine", NULL, l->t, l->nv, l->nf };
				mr_topology topo;
				assert_int_equal(mr_topology_build(&ctx, &fine, &topo), MR_OK);
				assert_memory_equal(topo.twin, l->topo.twin, 3 * l->nf * sizeof *topo.twin);
				for (uint32_t v = 0; v < l->nv; v++) {
					assert_int_equal(mr_he_from(&fine, l->topo.out[v]), v);
					assert_int_equal(l->topo.twin[l->topo.out[v]] == MR_NONE,
					    topo.twin[topo.out[v]] == MR_NONE);
				}
				assert_int_equal(l->nf, m.nf << (2 * i));
				assert_int_equal(
				    l->nv, mr_loop_count(m.nv, m.nf, mr_loop_boundary(level), i));
				assert_int_equal(l->coarse_nv, i ? level[i - 1].nv : m.nv);
				assert_true(crease || !l->crease);
				assert_true(l->crease || solids[s] != MR_CUBE || !crease);
			}
		}
	assert_int_equal(mr_loop_count(12, 20, 0, 14), SIZE_MAX);
}

/* Odd vertices come one an edge, by the lower half-edge; the children of a face stand in the order said. */
static void
test_numbers_of_vertices_and_faces(void **state)
{
	mr_mesh m = shape(MR_PLANE, 16);
	mr_loop *level = levels(&m, 180, 1);
	size_t n = 0;

	(void)state;
	for (uint32_t h = 0; h < 3 * m.nf; h++)
		if (level[0].topo.twin[h] > h)
			assert_int_equal(level[1].edge[n++], h);
	assert_int_equal(level[1].nv, m.nv + n);
	for (size_t f = 0; f < m.nf; f++) {
		const mr_tri *t = level[1].t + 4 * f;
		const uint32_t *odd = t[3].v;
		mr_tri expected[3] = { { { m.t[f].v[0], odd[0], odd[2] } },
			{ { odd[0], m.t[f].v[1], odd[1] } }, { { odd[2], odd[1], m.t[f].v[2] } } };
		assert_memory_equal(t, expected, sizeof expected);
		for (uint32_t i = 0; i < 3; i++) {
			uint32_t h = level[1].edge[odd[i] - m.nv], e = (uint32_t)(3 * f) + i;
			assert_true(h == e || h == level[0].topo.twin[e]);
		}
	}
}

/* A fan of n faces around vertex 0, closed or open, with creases along the spokes of `sharp`. */
typedef struct fan {
	unsigned n, ring;
	mr_v3 p[64];
	mr_tri t[64];
	bool sharp[64], crease[3 * 64];
} fan;

static fan
fan_make(unsigned n, bool open, uint64_t seed)
{
	fan f = { .n = n, .ring = open ? n + 1 : n };
	mr_random r = { seed };

	f.p[0] = mr_vec(0.3, 0.2, 0.5);
	for (unsigned j = 0; j < f.ring; j++) {
		double a = open ? 3 * (j + 0.3 * mr_random_real(&r)) / n
		                : 2 * MR_PI * (j + 0.4 * mr_random_real(&r)) / n;
		double size = 0.8 + 0.4 * mr_random_real(&r);
		f.p[1 + j] = mr_vec(size * cos(a), size * sin(a), 0.5 * mr_random_real(&r));
	}
	for (unsigned j = 0; j < n; j++)
		f.t[j] = (mr_tri){ { 0, 1 + j, 1 + (j + 1) % f.ring } };
	return f;
}

static mr_loop
fan_level(fan *f, mr_mesh *m)
{
	mr_loop l;
	bool any = false;

	*m = (mr_mesh){ "fan", f->p, f->t, f->ring + 1, f->n };
	assert_int_equal(mr_loop_control(&ctx, m, 180, NULL, &l), MR_OK);
	for (unsigned j = 0; j < f->ring; j++) {
		any |= f->sharp[j];
		if (j < f->n)
			f->crease[3 * j] = f->sharp[j];
		f->crease[3 * ((j + f->n - 1) % f->n) + 2] |= f->sharp[j];
	}
	if (any)
		l.crease = f->crease;
	return l;
}

/* One step around vertex 0: its neighbours are the odd vertices of the spokes. */
static void
fan_step(fan *f)
{
	mr_mesh m;
	mr_loop l = fan_level(f, &m), fine;
	mr_v3 next[64], *p;

	assert_int_equal(mr_loop_refine(&ctx, &l, &fine), MR_OK);
	p = MR_NEW(&ctx, fine.nv, mr_v3);
	mr_loop_subdivide(&ctx, &l, &fine, 3, (const double *)f->p, (double *)p);
	next[0] = p[0];
	for (unsigned j = 0; j < f->ring; j++)
		next[1 + j] = j < f->n ? p[fine.t[4 * j].v[1]] : p[fine.t[4 * j - 4].v[2]];
	memcpy(f->p, next, sizeof next);
}

static mr_v3
fan_limit(fan *f, mr_v3 *normal)
{
	mr_mesh m;
	mr_loop l = fan_level(f, &m);
	mr_v3 limit[64], normals[64];

	mr_loop_limit(&ctx, &l, f->p, limit, normals);
	*normal = normals[0];
	return limit[0];
}

/* The unit sum of the unit normals of the sectors between sharp spokes (`turn`: from a sharp one). */
static mr_v3
fan_normal(const fan *f, bool open)
{
	mr_v3 sum = { 0, 0, 0 }, part = sum;
	unsigned start = 0;

	for (unsigned j = 0; j < f->ring && !open; j++)
		if (f->sharp[j])
			start = j;
	for (unsigned i = 0; i < f->n; i++) {
		unsigned j = (start + i) % f->ring;
		if (i && f->sharp[j]) {
			sum = mr_add(sum, mr_unit(part));
			part = mr_vec(0, 0, 0);
		}
		part = mr_add(part,
		    mr_cross(mr_sub(f->p[1 + j], f->p[0]), mr_sub(f->p[1 + (j + 1) % f->ring], f->p[0])));
	}
	return mr_unit(mr_add(sum, mr_unit(part)));
}

static void
check_fan(fan f, bool open, int steps, double tolerance)
{
	mr_v3 normal, limit = fan_limit(&f, &normal), again;
	mr_mark mark = mr_mark_take(&ctx);
	fan g = f;

	assert_near(mr_norm(normal), 1, 1e-14);
	for (int i = 0; i < 100; i++)
		fan_step(&f);
	assert_near_v3(f.p[0], limit, 1e-13);
	/* The same about the origin and blown up again, so that directions keep their digits; not for too
	 * long, since the second tangent shrinks beside the first. */
	for (unsigned j = 0; j <= f.ring; j++)
		g.p[j] = mr_sub(g.p[j], limit);
	for (int i = 0; i < steps; i++) {
		mr_v3 origin;
		double size = 0;
		mr_mark_release(&ctx, mark);
		fan_step(&g);
		origin = fan_limit(&g, &again);
		for (unsigned j = 0; j <= g.ring; j++) {
			g.p[j] = mr_sub(g.p[j], origin);
			size = fmax(size, mr_norm(g.p[j]));
		}
		for (unsigned j = 0; j <= g.ring; j++)
			g.p[j] = mr_mul(1 / size, g.p[j]);
	}
	mr_mark_release(&ctx, mark);
	if (steps)
		assert_near_v3(fan_normal(&g, open), normal, tolerance);
}

static void
test_limit_of_smooth_vertices(void **state)
{
	(void)state;
	for (unsigned n = 3; n <= 12; n++)
		check_fan(fan_make(n, false, n), false, 100, 1e-9);
}

static void
test_limit_on_the_boundary(void **state)
{
	(void)state;
	for (unsigned n = 1; n <= 12; n++) {
		/* six faces: a double eigenvalue, and normals that turn as 1 / steps */
		int steps = n == 1 ? 20 : n <= 3 ? 40 : n == 6 ? 0 : 120;
		check_fan(fan_make(n, true, n), true, steps, 1e-3);
	}
}

static void
test_limit_on_creases(void **state)
{
	(void)state;
	for (unsigned n = 4; n <= 6; n++) { /* sectors of two and three faces; the boundary has the rest */
		fan f = fan_make(n, false, n);
		f.sharp[1] = f.sharp[1 + n / 2] = true;
		check_fan(f, false, 40, 1e-3);
	}
}

static void
test_limit_at_corners(void **state)
{
	(void)state;
	for (unsigned n = 3; n <= 6; n++) {
		fan f = fan_make(n, false, n);
		for (unsigned j = 0; j < n; j += n < 6 ? 1 : 2)
			f.sharp[j] = true;
		check_fan(f, false, 40, 1e-4);
	}
	fan f = fan_make(4, true, 3); /* a crease that ends on a boundary */
	f.sharp[2] = true;
	check_fan(f, true, 40, 1e-4);
}

/* Where every neighbour is 1 and the rest 0, and the reverse. */
static void
test_stencils(void **state)
{
	fan f = fan_make(6, false, 1);
	double value[64] = { 1 }, *out;
	mr_mesh m;
	mr_loop l = fan_level(&f, &m), fine;

	(void)state;
	assert_int_equal(mr_loop_refine(&ctx, &l, &fine), MR_OK);
	out = MR_NEW(&ctx, fine.nv, double);
	mr_loop_subdivide(&ctx, &l, &fine, 1, value, out);
	assert_near(out[0], 0.625, 1e-16);
	for (size_t i = 0; i < fine.nv - l.nv; i++)
		assert_near(out[l.nv + i], fine.edge[i] % 3 == 1 ? 0 : 0.375, 0); /* the rim is a curve */
	value[0] = 0;
	value[1] = 1;
	mr_loop_subdivide(&ctx, &l, &fine, 1, value, out);
	assert_near(out[0], 0.0625, 1e-16);
	assert_near(out[1], 0.75, 0);
	assert_near(out[2], 0.125, 0);
	assert_near(out[fine.t[4].v[1]], 0.125, 0); /* on spoke 1, whose face has vertex 1 opposite */
	assert_near(out[fine.t[0].v[1]], 0.375, 0);
	assert_near(out[fine.t[3].v[1]], 0.5, 0);
	double *odd = MR_NEW(&ctx, fine.nv, double);
	mr_loop_predict(&ctx, &l, &fine, 1, value, odd);
	assert_memory_equal(odd, out + l.nv, (fine.nv - l.nv) * sizeof *odd);
}

static mr_v3
mapped(mr_v3 p)
{
	static const mr_affine t = { { 1, 2, 0.3, 4, -0.5, 1, 0.2, 5, 0.1, 0.7, 3, -6 } };
	return mr_apply(&t, p);
}

static void
test_affine_invariance(void **state)
{
	mr_mesh m = shape(MR_CUBE, 60), moved = m;
	mr_loop *level = levels(&m, 30, 3);
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3), *a, *b;
	const mr_v3 *fine, *fine_moved;

	(void)state;
	for (size_t v = 0; v < m.nv; v++)
		p[v] = mapped(m.p[v]);
	moved.p = p;
	fine = refined(&m, level, 3);
	fine_moved = refined(&moved, level, 3);
	a = MR_NEW(&ctx, level[3].nv, mr_v3);
	b = MR_NEW(&ctx, level[3].nv, mr_v3);
	mr_loop_limit(&ctx, &level[3], fine, a, NULL);
	mr_loop_limit(&ctx, &level[3], fine_moved, b, NULL);
	for (size_t v = 0; v < level[3].nv; v++) {
		assert_near_v3(mapped(fine[v]), fine_moved[v], 1e-14);
		assert_near_v3(mapped(a[v]), b[v], 1e-14);
	}
}

/* A cube whose edges are creases: its sides stay plane, its corners stay. */
static void
test_a_cube_with_creases_is_a_cube(void **state)
{
	mr_mesh m = shape(MR_CUBE, 26);
	mr_loop *level = levels(&m, 45, 3);
	mr_v3 *limit = MR_NEW(&ctx, level[3].nv, mr_v3), *normal = MR_NEW(&ctx, level[3].nv, mr_v3);

	(void)state;
	mr_loop_limit(&ctx, &level[3], refined(&m, level, 3), limit, normal);
	for (size_t v = 0; v < level[3].nv; v++) {
		mr_v3 a = { fabs(limit[v].x), fabs(limit[v].y), fabs(limit[v].z) };
		assert_near(fmax(a.x, fmax(a.y, a.z)), 1, 1e-15);
		assert_true(mr_dot(normal[v], limit[v]) >= 1 - 1e-12);
	}
}

/* A vertex has the same limit on every level. */
static void
test_limits_do_not_depend_on_the_level(void **state)
{
	static const mr_solid solids[] = { MR_SPHERE, MR_TORUS, MR_PLANE, MR_CUBE };

	(void)state;
	for (size_t s = 0; s < 4; s++) {
		mr_mesh m = shape(solids[s], 60);
		mr_loop *level = levels(&m, s == 3 ? 30 : 180, 4);
		mr_v3 *a = MR_NEW(&ctx, level[4].nv, mr_v3), *b = MR_NEW(&ctx, level[4].nv, mr_v3);
		mr_v3 *na = MR_NEW(&ctx, level[4].nv, mr_v3), *nb = MR_NEW(&ctx, level[4].nv, mr_v3);
		mr_loop_limit(&ctx, &level[1], refined(&m, level, 1), a, na);
		mr_loop_limit(&ctx, &level[4], refined(&m, level, 4), b, nb);
		for (size_t v = 0; v < level[1].nv; v++) {
			assert_near_v3(a[v], b[v], 1e-14);
			assert_near_v3(na[v], nb[v], 1e-12);
		}
	}
}

static void
test_normals_point_outward(void **state)
{
	mr_mesh sphere = shape(MR_SPHERE, 42), torus = shape(MR_TORUS, 200);
	mr_loop *level = levels(&sphere, 180, 3);
	mr_v3 *limit = MR_NEW(&ctx, 8 * level[3].nv, mr_v3), *normal = MR_NEW(&ctx, 8 * level[3].nv, mr_v3);

	(void)state;
	mr_loop_limit(&ctx, &level[3], refined(&sphere, level, 3), limit, normal);
	for (size_t v = 0; v < level[3].nv; v++)
		assert_true(mr_dot(mr_unit(limit[v]), normal[v]) > 0.99);
	level = levels(&torus, 180, 2);
	mr_loop_limit(&ctx, &level[2], refined(&torus, level, 2), limit, normal);
	for (size_t v = 0; v < level[2].nv; v++) {
		mr_v3 core = mr_unit(mr_vec(limit[v].x, limit[v].y, 0));
		assert_true(mr_dot(mr_unit(mr_sub(limit[v], core)), normal[v]) > 0.97);
	}
}

static void
check_matrix(const mr_mesh *m, double crease, size_t n)
{
	mr_loop *level = levels(m, crease, n);
	mr_v3 *limit = MR_NEW(&ctx, level[n].nv, mr_v3);
	mr_sparse s;

	mr_loop_limit(&ctx, &level[n], refined(m, level, n), limit, NULL);
	assert_int_equal(mr_loop_limit_matrix(&ctx, level, n, &s), MR_OK);
	assert_int_equal(s.n, level[n].nv);
	for (size_t i = 0; i < level[n].nv; i++) {
		mr_v3 sum = { 0, 0, 0 };
		double total = 0;
		for (int e = s.start[i]; e < s.start[i + 1]; e++) {
			assert_in_range(s.index[e], 0, m->nv - 1);
			assert_true(e == s.start[i] || s.index[e] > s.index[e - 1]);
			sum = mr_axpy(s.value[e], m->p[s.index[e]], sum);
			total += s.value[e];
		}
		assert_near(total, 1, 1e-14);
		assert_near_v3(sum, limit[i], 1e-14);
	}
}

static void
test_limit_matrix(void **state)
{
	mr_mesh m;
	fan f = fan_make(5, false, 2);

	(void)state;
	for (size_t n = 0; n <= 3; n++) {
		check_matrix((m = shape(MR_SPHERE, 42), &m), 180, n);
		check_matrix((m = shape(MR_PLANE, 42), &m), 180, n);
		check_matrix((m = shape(MR_CUBE, 26), &m), 45, n);
		check_matrix((m = shape(MR_BUMPY, 5000), &m), 40, n % 2); /* creases that end: darts */
		fan_level(&f, &m);
		check_matrix(&m, 180, n);
	}
}

/* A scalar, and any other number of values, go as the coordinates do. */
static void
test_widths_agree(void **state)
{
	mr_mesh m = shape(MR_CUBE, 60);
	mr_loop *level = levels(&m, 30, 1);
	size_t fine = level[1].nv;
	double *five = MR_NEW(&ctx, 5 * m.nv, double), *out = MR_NEW(&ctx, 5 * fine, double);
	const mr_v3 *p = refined(&m, level, 1);

	(void)state;
	for (size_t v = 0; v < m.nv; v++)
		for (int k = 0; k < 5; k++)
			five[5 * v + (size_t)k] = k == 2 ? m.p[v].y : k == 4 ? m.p[v].x : m.p[v].z;
	mr_loop_subdivide(&ctx, &level[0], &level[1], 5, five, out);
	for (size_t v = 0; v < fine; v++)
		assert_true(out[5 * v + 2] == p[v].y && out[5 * v + 4] == p[v].x && out[5 * v] == p[v].z);
}

static void
test_isolated_vertices_stay(void **state)
{
	mr_v3 p[5] = { { 7, 8, 9 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { -3, -2, 1 } };
	mr_tri t[1] = { { { 1, 2, 3 } } };
	mr_mesh m = { "mesh", p, t, 5, 1 };
	mr_loop *level = levels(&m, 180, 2);
	const mr_v3 *fine = refined(&m, level, 2);
	mr_v3 *limit = MR_NEW(&ctx, level[2].nv, mr_v3), *normal = MR_NEW(&ctx, level[2].nv, mr_v3);

	(void)state;
	mr_loop_limit(&ctx, &level[2], fine, limit, normal);
	assert_int_equal(level[2].nv, 5 + 3 + 9);
	for (size_t v = 0; v < 5; v += 4) {
		assert_memory_equal(&fine[v], &p[v], sizeof *p);
		assert_memory_equal(&limit[v], &p[v], sizeof *p);
		assert_true(mr_norm(normal[v]) == 0);
	}
	assert_near_v3(normal[1], mr_vec(0, 0, 1), 1e-15);
	check_matrix(&m, 180, 2);
}

static void
test_refusals(void **state)
{
	mr_v3 p[5] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, -1, 0 } };
	mr_tri t[3] = { { { 0, 1, 2 } }, { { 1, 0, 3 } }, { { 0, 1, 4 } } };
	mr_mesh m = { "mesh", p, t, 5, 3 };
	mr_loop l;

	(void)state;
	assert_int_equal(mr_loop_control(&ctx, &m, 180, NULL, &l), MR_EMESH);
	assert_non_null(strstr(ctx.error, "edge 0-1 has 3 faces"));
	m.nf = 1;
	assert_int_equal(mr_loop_control(&ctx, &m, 180, NULL, &l), MR_OK);
	assert_int_equal(mr_loop_levels(&ctx, &m, 180, NULL, 16, &l), MR_ERANGE);
	l.nv = MR_NONE - 2; /* three more are too many */
	assert_int_equal(mr_loop_refine(&ctx, &l, &l), MR_ERANGE);
}

static void
test_threads(void **state)
{
	mr_mesh m = shape(MR_CUBE, 6000);
	mr_loop *two = levels(&m, 30, 2), one[3];
	const mr_v3 *p = refined(&m, two, 2), *q;

	(void)state;
	ctx.threads = 1;
	assert_int_equal(mr_loop_levels(&ctx, &m, 30, NULL, 2, one), MR_OK);
	assert_memory_equal(one[2].t, two[2].t, one[2].nf * sizeof *one[2].t);
	assert_memory_equal(one[2].topo.twin, two[2].topo.twin, 3 * one[2].nf * sizeof(uint32_t));
	q = refined(&m, one, 2);
	assert_memory_equal(p, q, one[2].nv * sizeof *p);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_levels_are_meshes, setup, teardown),
		cmocka_unit_test_setup_teardown(test_numbers_of_vertices_and_faces, setup, teardown),
		cmocka_unit_test_setup_teardown(test_stencils, setup, teardown),
		cmocka_unit_test_setup_teardown(test_limit_of_smooth_vertices, setup, teardown),
		cmocka_unit_test_setup_teardown(test_limit_on_the_boundary, setup, teardown),
		cmocka_unit_test_setup_teardown(test_limit_on_creases, setup, teardown),
		cmocka_unit_test_setup_teardown(test_limit_at_corners, setup, teardown),
		cmocka_unit_test_setup_teardown(test_affine_invariance, setup, teardown),
		cmocka_unit_test_setup_teardown(test_a_cube_with_creases_is_a_cube, setup, teardown),
		cmocka_unit_test_setup_teardown(test_limits_do_not_depend_on_the_level, setup, teardown),
		cmocka_unit_test_setup_teardown(test_normals_point_outward, setup, teardown),
		cmocka_unit_test_setup_teardown(test_limit_matrix, setup, teardown),
		cmocka_unit_test_setup_teardown(test_widths_agree, setup, teardown),
		cmocka_unit_test_setup_teardown(test_isolated_vertices_stay, setup, teardown),
		cmocka_unit_test_setup_teardown(test_refusals, setup, teardown),
		cmocka_unit_test_setup_teardown(test_threads, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
