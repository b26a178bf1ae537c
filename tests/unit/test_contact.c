/* Contacts of components against a search of all their faces. */
#include "shapes.h"
#include "space/bvh.h"
#include "space/contact.h"

/* Two spheres a little apart and a torus through both: within reach of other components the nearest place on
 * each. */
static void
test_is_the_nearest_of_each(void **state)
{
	mr_mesh a = shape(MR_SPHERE, 600), b = shape(MR_KNOT, 700);
	mr_mesh two = both(&a, &a, mr_vec(2.05, 0, 0)), m = both(&two, &b, mr_vec(1, 0.2, 0));
	size_t end[] = { 0, a.nf, 2 * a.nf, m.nf }, vertices[] = { 0, a.nv, 2 * a.nv, m.nv }, twice = 0;
	const double reach = 0.1;
	mr_contacts c;

	(void)state;
	mr_contacts_find(&ctx, &m, reach, &c);
	for (int part = 0; part < 3; part++)
		for (size_t v = vertices[part]; v < vertices[part + 1]; v++) {
			size_t next = c.start[v];
			double last = 0;
			for (int other = 0; other < 3; other++) {
				mr_closest best = { .dist2 = INFINITY };
				size_t i = c.start[v];
				for (uint32_t f = (uint32_t)end[other]; f < end[other + 1]; f++) {
					mr_closest at = mr_face_closest(&m, f, m.p[v]);
					if (at.dist2 < best.dist2)
						best = at;
				}
				if (other == part || best.dist2 > reach * reach)
					continue;
				while (i < c.start[v + 1] && c.at[i].face != best.at.face)
					i++;
				assert_true(i < c.start[v + 1]);
				assert_memory_equal(&c.at[i].bary, &best.at.bary, sizeof best.at.bary);
				next++;
			}
			assert_int_equal(next, c.start[v + 1]);
			for (size_t i = c.start[v]; i < c.start[v + 1]; i++) {
				double far = mr_face_closest(&m, c.at[i].face, m.p[v]).dist2;
				assert_true(far >= last);
				last = far;
			}
			twice += c.start[v + 1] == c.start[v] + 2;
		}
	assert_true(c.vertices > 50);
	assert_true(twice > 0);
}

/* Boxes side by side: one inside touches 26 others, and at a corner seven. */
static void
test_holds_to_all_neighbours(void **state)
{
	mr_mesh box = shape(MR_CUBE, 8), m = box;
	mr_v3 size = mr_sub(mr_box_of(box.p, box.nv).max, mr_box_of(box.p, box.nv).min);
	bool met[27] = { false };
	mr_contacts c;

	(void)state;
	for (int i = 1; i < 27; i++)
		m = both(&m, &box, mr_vec(i % 3 * size.x, i / 3 % 3 * size.y, i / 9 * size.z));
	mr_contacts_find(&ctx, &m, 1e-6, &c);
	assert_int_equal(box.nv, 8);
	assert_int_equal(c.vertices, 27 * box.nv - 8);
	for (size_t v = 13 * box.nv; v < 14 * box.nv; v++)
		for (size_t i = c.start[v]; i < c.start[v + 1]; i++)
			met[c.at[i].face / box.nf] = true;
	for (int i = 0; i < 27; i++)
		assert_int_equal(met[i], i != 13);
}

/* Half of the triangles are small and half reach over all of them: the mean edge does too.  Every vertex has
 * all others within reach; by a look at each 40,000 take two minutes. */
static void
test_takes_no_square_of_time(void **state)
{
	enum { N = 40000 };
	mr_v3 *p = MR_NEW(&ctx, 3 * N, mr_v3);
	mr_tri *t = MR_NEW(&ctx, N, mr_tri);
	mr_mesh m = { "huge", p, t, 3 * N, N };
	mr_random r = { 1 };
	double started = mr_seconds();
	mr_contacts c;

	(void)state;
	assert_true(p && t);
	for (uint32_t f = 0; f < N; f++) {
		mr_v3 at = random_vector(&r);
		bool small = f % 2;
		at.z = small ? 0 : (f + 1.0) / N;
		p[3 * f] = small ? at : mr_vec(-0.5, -0.5, at.z);
		p[3 * f + 1] = mr_add(p[3 * f], mr_vec(small ? 1e-3 : 1, 0, 0));
		p[3 * f + 2] = mr_add(p[3 * f], mr_vec(0, small ? 1e-3 : 1, 0));
		t[f] = (mr_tri){ { 3 * f, 3 * f + 1, 3 * f + 2 } };
	}
	mr_contacts_find(&ctx, &m, mr_mesh_edge_scale(&ctx, &m), &c);
	assert_int_equal(c.start[m.nv], MR_CONTACTS * m.nv);
	assert_true(mr_seconds() - started < 30);
}

/* A lattice that is slit: three vertices are two each, of half the faces around them, so far apart. */
static mr_mesh
slit_lattice(mr_v3 apart)
{
	mr_mesh one = lattice(8), m = one;
	mr_v3 *p = MR_NEW(&ctx, one.nv + 3, mr_v3);
	mr_tri *t = MR_NEW(&ctx, one.nf, mr_tri);

	assert_true(p && t);
	memcpy(p, one.p, one.nv * sizeof *p);
	memcpy(t, one.t, one.nf * sizeof *t);
	for (uint32_t i = 0; i < 3; i++) { /* vertices 3 to 5 of row 4: the faces above them get others */
		uint32_t v = 9 * 4 + 3 + i;
		p[one.nv + i] = mr_add(p[v], apart);
		for (size_t f = 2 * 8 * 4; f < one.nf; f++)
			for (int k = 0; k < 3; k++)
				t[f].v[k] = t[f].v[k] == v ? (uint32_t)one.nv + i : t[f].v[k];
	}
	m.p = p;
	m.t = t;
	m.nv += 3;
	return m;
}

static void
test_slits_are_contacts(void **state)
{
	mr_mesh one = lattice(8), m = slit_lattice(mr_vec(0, 0, 0));
	mr_contacts c;

	(void)state;
	mr_contacts_find(&ctx, &m, 1e-9, &c);
	assert_int_equal(c.vertices, 6);
	assert_int_equal(c.start[m.nv], 6);
	for (uint32_t v = 0; v < m.nv; v++)
		for (size_t i = c.start[v]; i < c.start[v + 1]; i++) {
			assert_true(v >= one.nv || (v >= 9 * 4 + 3 && v < 9 * 4 + 6));
			assert_true(mr_dist(mr_place_point(&m, c.at[i]), m.p[v]) < 1e-12);
			for (int k = 0; k < 3; k++)
				assert_true(m.t[c.at[i].face].v[k] != v);
		}
}

/* Whichever way the sides were rounded, and wherever the lattice is; further apart they are two places. */
static void
test_slits_that_are_rounded(void **state)
{
	(void)state;
	for (int i = 0; i < 27; i++) {
		mr_v3 way = mr_vec(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
		mr_mesh m = slit_lattice(mr_mul(2e-7, way)), wide = slit_lattice(mr_vec(0, 0, 1e-4));
		mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
		mr_contacts c;
		assert_non_null(p);
		for (size_t v = 0; v < m.nv; v++)
			p[v] = mr_add(m.p[v], mr_vec(i / 7.0, 100.0 * i, -i / 3.0));
		m.p = p;
		mr_contacts_find(&ctx, &m, 1e-9, &c);
		assert_int_equal(c.start[m.nv], 6);
		mr_contacts_find(&ctx, &wide, 1e-9, &c);
		assert_int_equal(c.vertices, 0);
	}
}

static void
test_one_component_has_none(void **state)
{
	mr_mesh m = shape(MR_KNOT, 2000);
	mr_contacts c;

	(void)state;
	mr_contacts_find(&ctx, &m, 10, &c);
	assert_int_equal(c.vertices, 0);
}

/* Of two squares on each other one goes away: by less than asked, by more; what was open before does not
 * count. */
static void
test_opens(void **state)
{
	mr_mesh a = lattice(4), m = both(&a, &a, mr_vec(0, 0, 0.01));
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	mr_contacts c;
	uint32_t widest;

	(void)state;
	mr_contacts_find(&ctx, &m, 0.02, &c);
	assert_int_equal(c.vertices, m.nv);
	memcpy(p, m.p, m.nv * sizeof *p);
	for (size_t v = 0; v < a.nv; v++)
		p[v].z = -0.03;
	assert_int_equal(mr_contacts_open(&c, &m, p, 0.05, &widest), 0);
	assert_int_equal(widest, MR_NONE);
	p[7].z = -1;
	assert_true(mr_contacts_open(&c, &m, p, 0.05, &widest) >= 2);
	assert_true(widest == 7 || widest == a.nv + 7);
	m.p = p;
	assert_int_equal(mr_contacts_open(&c, &m, p, 0.05, &widest), 0);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_is_the_nearest_of_each, setup, teardown),
		cmocka_unit_test_setup_teardown(test_holds_to_all_neighbours, setup, teardown),
		cmocka_unit_test_setup_teardown(test_takes_no_square_of_time, setup, teardown),
		cmocka_unit_test_setup_teardown(test_slits_are_contacts, setup, teardown),
		cmocka_unit_test_setup_teardown(test_slits_that_are_rounded, setup, teardown),
		cmocka_unit_test_setup_teardown(test_one_component_has_none, setup, teardown),
		cmocka_unit_test_setup_teardown(test_opens, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
