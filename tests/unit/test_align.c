/* The motion that moved a surface is found, by any rotation, of parts, with scale, and not where there is
 * none. */
#include "align/align.h"

#include "base/rotation.h"
#include "heard.h"
#include "shapes.h"

static mr_affine
motion(mr_v3 turn, double scale, mr_v3 by)
{
	mr_mat3 r = mr_rotation_exp(turn);
	const double *m = r.m, s = scale;

	return (mr_affine){ { s * m[0], s * m[1], s * m[2], by.x, s * m[3], s * m[4], s * m[5], by.y,
	    s * m[6], s * m[7], s * m[8], by.z } };
}

static mr_mesh
moved(const mr_mesh *m, const mr_affine *map)
{
	mr_v3 *p = MR_NEW(&ctx, m->nv, mr_v3);

	for (size_t i = 0; i < m->nv; i++)
		p[i] = mr_apply(map, m->p[i]);
	return (mr_mesh){ m->name, p, m->t, m->nv, m->nf };
}

/* Those faces of m, some first ones or last ones. */
static mr_mesh
part(const mr_mesh *m, size_t first, size_t n)
{
	mr_tri *t = MR_NEW(&ctx, n, mr_tri);
	mr_v3 *p = MR_NEW(&ctx, 3 * n, mr_v3);

	for (uint32_t f = 0; f < n; f++)
		for (uint32_t k = 0; k < 3; k++) {
			t[f].v[k] = 3 * f + k;
			p[3 * f + k] = m->p[m->t[first + f].v[k]];
		}
	return (mr_mesh){ m->name, p, t, 3 * n, n };
}

static mr_align_result
aligned(const mr_mesh *a, const mr_mesh *b, bool scale)
{
	mr_align_result r;

	assert_int_equal(
	    mr_align(&ctx, (mr_align_side){ a, NULL }, (mr_align_side){ b, NULL }, scale, &r), MR_OK);
	return r;
}

/* How far the points of m are from where they were, moved and moved back. */
static double
error(const mr_mesh *m, const mr_affine *map, const mr_align_result *r)
{
	double most = 0;
	mr_affine back;

	memcpy(back.m, r->map, sizeof back.m);
	for (size_t i = 0; i < m->nv; i++)
		most = fmax(most, mr_dist(m->p[i], mr_apply(&back, mr_apply(map, m->p[i]))));
	return most;
}

static void
test_rotations(void **state)
{
	mr_mesh m = shape(MR_BUMPY, 3000);

	(void)state;
	for (int i = 0; i < 8; i++) {
		mr_affine map = motion(mr_vec(sin(i) * i / 2, cos(i) * i / 2, 0.3 * i), i < 4 ? 1 : 0.01 * i,
		    mr_vec(10 * i, -i, 3));
		mr_mesh a = moved(&m, &map);
		mr_align_result r = aligned(&a, &m, i >= 4);
		assert_true(r.found);
		assert_true(error(&m, &map, &r) < 1e-9);
	}
}

static void
test_far_away(void **state)
{
	mr_mesh m = shape(MR_BUMPY, 3000);
	mr_affine map = motion(mr_vec(1, 1, 1), 1, mr_vec(4e6, 1e6, 5e6));
	mr_mesh a = moved(&m, &map);
	mr_align_result r = aligned(&a, &m, false);

	(void)state;
	assert_true(r.found);
	assert_true(error(&m, &map, &r) < 1e-6);
}

static void
test_parts(void **state)
{
	mr_mesh m = shape(MR_BUMPY, 6000), a = part(&m, 0, m.nf * 2 / 3),
		b = part(&m, m.nf / 3, m.nf * 2 / 3);
	mr_affine map = motion(mr_vec(0.2, -0.3, 0.2), 1, mr_vec(0.6, 0.5, 0.4));
	mr_mesh away = moved(&a, &map);
	mr_align_result r = aligned(&away, &b, false);

	(void)state;
	assert_true(r.found);
	assert_true(error(&a, &map, &r) < 0.002 * mr_mesh_diagonal(&m));
	assert_true(r.overlap > 0.3 && r.overlap < 0.6);
}

static void
test_none(void **state)
{
	mr_mesh a = shape(MR_BUMPY, 3000), b = shape(MR_KNOT, 3000), three = part(&a, 0, 1),
		none = { .name = "none" };
	mr_comparison c = { .diagonal = 1, .both.mean = 1 };
	mr_align_result r = aligned(&a, &b, false);

	(void)state;
	assert_false(r.found);
	listen_to(&ctx);
	assert_int_equal(mr_align_judge(&ctx, &a, &b, &c), MR_OK);
	three.nf = 0;
	assert_int_equal(
	    mr_align(&ctx, (mr_align_side){ &three, NULL }, (mr_align_side){ &a, NULL }, false, &r),
	    MR_EMESH);
	assert_int_equal(mr_align_judge(&ctx, &three, &a, &c), MR_OK);
	assert_string_equal(heard, "");
	assert_int_equal(
	    mr_align(&ctx, (mr_align_side){ &a, NULL }, (mr_align_side){ &none, NULL }, false, &r), MR_EMESH);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_rotations, setup, teardown),
		cmocka_unit_test_setup_teardown(test_far_away, setup, teardown),
		cmocka_unit_test_setup_teardown(test_parts, setup, teardown),
		cmocka_unit_test_setup_teardown(test_none, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
