/* Contacts of components against a search of all their faces. */
#include "shapes.h"
#include "space/bvh.h"
#include "space/contact.h"

/* Two spheres a little apart and a torus through both: within reach of another component the nearest place on
 * one. */
static void
test_is_the_nearest_of_others(void **state)
{
	mr_mesh a = shape(MR_SPHERE, 600), b = shape(MR_KNOT, 700);
	mr_mesh two = both(&a, &a, mr_vec(2.05, 0, 0)), m = both(&two, &b, mr_vec(1, 0.2, 0));
	size_t end[] = { 0, a.nf, 2 * a.nf, m.nf }, vertices[] = { 0, a.nv, 2 * a.nv, m.nv };
	const double reach = 0.1;
	mr_contacts c;
	size_t next = 0;

	(void)state;
	assert_int_equal(mr_contacts_find(&ctx, &m, reach, &c), MR_OK);
	for (int part = 0; part < 3; part++)
		for (size_t v = vertices[part]; v < vertices[part + 1]; v++) {
			mr_closest best = { .dist2 = INFINITY };
			for (uint32_t f = 0; f < m.nf; f++) {
				mr_closest at = mr_face_closest(&m, f, m.p[v]);
				if ((f < end[part] || f >= end[part + 1]) && at.dist2 < best.dist2)
					best = at;
			}
			if (best.dist2 > reach * reach)
				continue;
			assert_true(next < c.n);
			assert_int_equal(c.vertex[next], v);
			assert_memory_equal(&c.at[next], &best.at, sizeof best.at);
			next++;
		}
	assert_true(next > 50);
	assert_int_equal(next, c.n);
}

/* A vertex that is two, each of half the faces around it: where a lattice is slit. */
static void
test_slits_are_contacts(void **state)
{
	mr_mesh one = lattice(8), m = one;
	mr_v3 *p = MR_NEW(&ctx, one.nv + 3, mr_v3);
	mr_tri *t = MR_NEW(&ctx, one.nf, mr_tri);
	mr_contacts c;

	(void)state;
	memcpy(p, one.p, one.nv * sizeof *p);
	memcpy(t, one.t, one.nf * sizeof *t);
	for (uint32_t i = 0; i < 3; i++) { /* vertices 3 to 5 of row 4: the faces above them get others */
		uint32_t v = 9 * 4 + 3 + i;
		p[one.nv + i] = p[v];
		for (size_t f = 2 * 8 * 4; f < one.nf; f++)
			for (int k = 0; k < 3; k++)
				t[f].v[k] = t[f].v[k] == v ? (uint32_t)one.nv + i : t[f].v[k];
	}
	m.p = p;
	m.t = t;
	m.nv += 3;
	assert_int_equal(mr_contacts_find(&ctx, &m, 1e-9, &c), MR_OK);
	assert_int_equal(c.n, 6);
	for (size_t i = 0; i < 6; i++) {
		mr_v3 at = mr_place_point(&m, c.at[i].face == MR_NONE ? (mr_place){ 0 } : c.at[i]);
		assert_int_equal(c.vertex[i], i < 3 ? 9 * 4 + 3 + i : one.nv + i - 3);
		assert_true(mr_dist(at, m.p[c.vertex[i]]) < 1e-12);
		for (int k = 0; k < 3; k++)
			assert_true(m.t[c.at[i].face].v[k] != c.vertex[i]);
	}
}

static void
test_one_component_has_none(void **state)
{
	mr_mesh m = shape(MR_KNOT, 2000);
	mr_contacts c;

	(void)state;
	assert_int_equal(mr_contacts_find(&ctx, &m, 10, &c), MR_OK);
	assert_int_equal(c.n, 0);
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
	assert_int_equal(mr_contacts_find(&ctx, &m, 0.02, &c), MR_OK);
	assert_int_equal(c.n, m.nv);
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
		cmocka_unit_test_setup_teardown(test_is_the_nearest_of_others, setup, teardown),
		cmocka_unit_test_setup_teardown(test_slits_are_contacts, setup, teardown),
		cmocka_unit_test_setup_teardown(test_one_component_has_none, setup, teardown),
		cmocka_unit_test_setup_teardown(test_opens, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
