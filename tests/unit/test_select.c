/* Predicates and rules on surfaces where the answer is known; distances over surfaces. */
#include "base/text_file.h"
#include "edit/select.h"
#include "mesh/layers.h"
#include "shape/shape.h"
#include "space/geodesic.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static mr_mesh
solid(mr_ctx *ctx, mr_solid what, size_t n)
{
	mr_mesh m;

	assert_int_equal(mr_solid_make(ctx, &(mr_make_opts){ .solid = what, .vertices = n }, &m), MR_OK);
	return m;
}

/* Applies one rule to regions. */
static mr_status
apply(mr_ctx *ctx, const mr_mesh *m, uint32_t value, const char *predicate, uint32_t *region)
{
	static const uint32_t group[] = { 0, 2, 0, 1, 1, 1, 1, 1 };
	static const uint32_t material[] = { 0, 0, 0, 0, 2, 2, 2, 2 };
	const mr_groups groups[MR_NAMINGS] = { { m->nf == 8 ? group : NULL, "left\nright\ntop", 14 }, { 0 },
		{ m->nf == 8 ? material : NULL, "\ntop\nred", 8 } };
	mr_selection s = { 0 };

	MR_TRY(mr_selection_add(ctx, &s, value, "--free ", predicate));
	return mr_select(ctx, NULL, m, groups, &s, region, NULL);
}

/* How many vertices the predicate selects; they are of region 1, the rest 0. */
static size_t
count(mr_ctx *ctx, const mr_mesh *m, const char *predicate, uint32_t *region)
{
	size_t n = 0;

	memset(region, 0, m->nv * sizeof *region);
	if (apply(ctx, m, MR_REGION_FREE, predicate, region) != MR_OK)
		fail_msg("%s: %s", predicate, ctx->error);
	for (size_t i = 0; i < m->nv; i++)
		n += region[i] == MR_REGION_FREE;
	return n;
}

/* A plane of 11 x 11 vertices at distances of 0.2. */
static void
predicates_hold_where_they_should(void **state)
{
	const struct {
		const char *predicate;
		size_t n;
	} cases[] = {
		{ "all", 121 },
		{ "sphere:0,0,0,0.21", 5 },
		{ "sphere:0,0,0,0", 1 },
		{ "sphere:0,0,0,7.1%", 5 }, /* of sqrt(8) */
		{ "box:-0.3,-0.5,-1,0.3,0.5,1", 15 },
		{ "halfspace:1,0,0,0.3", 44 },
		{ "halfspace:-1,0,0,0.3", 44 },
		{ "above:x,0.75", 33 },
		{ "above:y,1", 11 },
		{ "below:x,0", 11 },
		{ "below:z,0", 121 },
		{ "not:below:x,0", 110 },
		{ "not:not:below:x,0", 11 },
		{ "above:x,0.75+below:y,0", 3 },
		{ "above:x,0.75+not:below:y,0", 30 },
		{ "sphere:0,0,0,2.1e-1+not:sphere:0,0,0,1e-1+all", 4 },
		{ "sphere:+0,0,0,2e+1", 121 },
		{ "boundary", 40 },
		{ "not:boundary", 81 },
		{ "component:5,5,5", 121 },
		{ "geodesic:0,0,0,0.21", 5 },
		{ "geodesic:0,0,3,1.01", 81 },
		{ "rings:0,0", 1 },
		{ "rings:60,1", 7 },
		{ "rings:60,1000000", 121 },
	};
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = solid(&ctx, MR_PLANE, 121);
	uint32_t *region = MR_NEW(&ctx, m.nv, uint32_t);
	assert_int_equal(m.nv, 121);
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		size_t n = count(&ctx, &m, cases[i].predicate, region);
		if (n != cases[i].n)
			fail_msg("%s selects %zu vertices, not %zu", cases[i].predicate, n, cases[i].n);
	}
	mr_ctx_free(&ctx);
}

static void
groups_are_found_by_name(void **state)
{
	mr_ctx ctx;
	uint32_t region[9];

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = solid(&ctx, MR_PLANE, 9);
	assert_int_equal(m.nf, 8);
	assert_int_equal(count(&ctx, &m, "group:top", region), 3);
	for (int k = 0; k < 3; k++)
		assert_int_equal(region[m.t[1].v[k]], MR_REGION_FREE);
	count(&ctx, &m, "group:red", region); /* a material: no group has the name */
	for (size_t i = 0; i < 24; i++)
		assert_true(i / 3 < 4 || region[m.t[i / 3].v[i % 3]] == MR_REGION_FREE);
	assert_int_equal(count(&ctx, &m, "not:group:red", region), 9 - count(&ctx, &m, "group:red", region));
	assert_int_equal(apply(&ctx, &m, 1, "group:to", region), MR_EMISSING);
	assert_string_equal(ctx.error, "--free group:to: no group, object or material of plane is called to");
	mr_ctx_free(&ctx);
}

static void
rules_apply_in_order(void **state)
{
	mr_ctx ctx;
	mr_selection s = { 0 };
	const mr_groups none[MR_NAMINGS] = { 0 };
	uint32_t region[121], expected[121];

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = solid(&ctx, MR_PLANE, 121);
	for (size_t i = 0; i < 121; i++)
		region[i] = 7; /* the regions there are stay where no rule says otherwise */
	assert_int_equal(mr_selection_add(&ctx, &s, 1, "--free ", "above:x,0.3"), MR_OK);
	assert_int_equal(mr_selection_add(&ctx, &s, 0, "--fixed ", "above:x,0.6"), MR_OK);
	assert_int_equal(mr_selection_add(&ctx, &s, 4, "--handle 2=", "above:x,0.9"), MR_OK);
	assert_int_equal(mr_select(&ctx, NULL, &m, none, &s, region, NULL), MR_OK);
	for (size_t i = 0; i < 121; i++) {
		double x = (m.p[i].x + 1) / 2;
		expected[i] = x >= 0.9 - 1e-9 ? 4 : x >= 0.6 - 1e-9 ? 0 : x >= 0.3 - 1e-9 ? 1 : 7;
	}
	assert_memory_equal(region, expected, sizeof region);
	mr_ctx_free(&ctx);
}

static void
growing_stays_in_fixed_vertices(void **state)
{
	mr_ctx ctx;
	uint32_t region[121] = { 0 };
	size_t n[3] = { 0 };

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = solid(&ctx, MR_PLANE, 121);
	assert_int_equal(apply(&ctx, &m, 1, "below:x,0", region), MR_OK);
	assert_int_equal(apply(&ctx, &m, 2, "box:-0.7,-2,-1,-0.5,2,1", region), MR_OK); /* the third column */
	assert_int_equal(apply(&ctx, &m, 1, "grow:5", region), MR_OK);
	for (size_t i = 0; i < 121; i++)
		n[region[i]]++;
	assert_int_equal(n[0], 88);
	assert_int_equal(n[1], 22); /* grown by one column, up to the handle */
	assert_int_equal(n[2], 11);
	mr_ctx_free(&ctx);
}

static void
a_file_may_list_the_vertices(void **state)
{
	mr_ctx ctx;
	uint32_t region[121];
	char path[] = "/tmp/mr-test-XXXXXX", predicate[64];
	FILE *out = NULL;
	int fd;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = solid(&ctx, MR_PLANE, 121);
	fd = mkstemp(path);
	assert_true(fd >= 0 && (out = fdopen(fd, "w")));
	fputs("# corners\n0\n\n 120 # the last\r\n0\n", out);
	fclose(out);
	snprintf(predicate, sizeof predicate, "vertices:%s+all", path);
	assert_int_equal(count(&ctx, &m, predicate, region), 2);
	assert_true(region[0] == 1 && region[120] == 1);
	assert_non_null(out = fopen(path, "a"));
	fputs("121", out);
	fclose(out);
	assert_int_equal(apply(&ctx, &m, 1, predicate, region), MR_ERANGE);
	assert_non_null(strstr(ctx.error, "has vertex 121, plane has 121"));
	assert_non_null(out = fopen(path, "a"));
	fputs("\n1,2\n", out);
	fclose(out);
	assert_int_equal(apply(&ctx, &m, 1, predicate, region), MR_EFORMAT);
	assert_non_null(strstr(ctx.error, ":7: '1,2' is not a vertex"));
	remove(path);
	assert_int_equal(apply(&ctx, &m, 1, predicate, region), MR_EIO);
	mr_ctx_free(&ctx);
}

static void
wrong_words_are_refused(void **state)
{
	static const char *const wrong[] = { "", "al", "alll", "all:", "all:1", "all+", "+all",
		"not:", "sphere", "sphere:", "sphere:1,2,3", "sphere:1,2,3,4,5", "sphere:1,2,3,-1",
		"sphere:1,2,3,x", "sphere:1,2,nan,1", "sphere:1,2,inf,1", "sphere: 1,2,3,1",
		"sphere:1,2,3,1 ", "box:0,0,0,1,1", "box:0,0,0,1,1,1%", "above:w,0.5", "above:x",
		"above:x,1.5", "above:x,-0.1", "rings:1", "rings:-1,2", "rings:1.5,2", "grow:", "grow:x",
		"group:", "vertices:", "component:1,2", "above:x,0.5+nothing", "sphere:1,2,3,4+5" };
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		mr_selection s = { 0 };
		mr_status status = mr_selection_add(&ctx, &s, 1, "--free ", wrong[i]);
		if (status != MR_EUSAGE || s.n != 0)
			fail_msg("'%s' gives %d", wrong[i], status);
	}
	mr_ctx_free(&ctx);
}

static void
a_rule_must_select_something(void **state)
{
	mr_ctx ctx;
	uint32_t region[121] = { 3, 4 };

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = solid(&ctx, MR_PLANE, 121);
	assert_int_equal(apply(&ctx, &m, 1, "sphere:9,9,9,1", region), MR_EMESH);
	assert_string_equal(
	    ctx.error, "--free sphere:9,9,9,1 selects no vertex of plane, whose box is -1 -1 0 to 1 1 0");
	assert_int_equal(apply(&ctx, &m, 1, "rings:121,1", region), MR_ERANGE);
	assert_int_equal(apply(&ctx, &m, 1, "group:x", region), MR_EMISSING);
	assert_true(region[0] == 3 && region[1] == 4);
	mr_ctx_free(&ctx);
}

static void
components_are_whole(void **state)
{
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh one = solid(&ctx, MR_SPHERE, 300);
	mr_v3 *p = MR_NEW(&ctx, 2 * one.nv, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * one.nf, mr_tri);
	for (size_t i = 0; i < 2 * one.nv; i++)
		p[i] = mr_add(one.p[i % one.nv], mr_vec(i < one.nv ? 0 : 3, 0, 0));
	for (size_t i = 0; i < 2 * one.nf; i++)
		for (int k = 0; k < 3; k++)
			t[i].v[k] = one.t[i % one.nf].v[k] + (i < one.nf ? 0 : (uint32_t)one.nv);
	mr_mesh two = { "mesh", p, t, 2 * one.nv, 2 * one.nf };
	uint32_t *region = MR_NEW(&ctx, two.nv, uint32_t);
	assert_int_equal(count(&ctx, &two, "component:2,0,0", region), one.nv);
	assert_int_equal(region[one.nv], MR_REGION_FREE);
	assert_int_equal(
	    count(&ctx, &two, "geodesic:1,0,0,50", region), one.nv); /* the gap cannot be crossed */
	assert_int_equal(region[0], MR_REGION_FREE);
	mr_ctx_free(&ctx);
}

/* On the plane distances are straight. */
static void
distances_on_the_plane_are_straight(void **state)
{
	const mr_v3 q = { 0.123, -0.456, 0 };
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = solid(&ctx, MR_PLANE, 2000);
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	double *d = MR_NEW(&ctx, m.nv, double);
	for (size_t i = 0; i < m.nv; i++) /* sheared until the triangles are obtuse, distances along */
		p[i] = mr_vec(m.p[i].x + 1.5 * m.p[i].y, m.p[i].y, 0);
	m.p = p;
	mr_geodesic_distances(&ctx, &m, q, INFINITY, d);
	for (size_t i = 0; i < m.nv; i++)
		assert_true(fabs(d[i] - mr_dist(p[i], q)) <= 1e-4 * mr_dist(p[i], q) + 1e-12);
	mr_geodesic_distances(&ctx, &m, q, 0.5, d);
	for (size_t i = 0; i < m.nv; i++)
		assert_true(isfinite(d[i]) ? d[i] <= 0.5 : mr_dist(p[i], q) > 0.4999);
	mr_ctx_free(&ctx);
}

static void
distances_on_the_sphere_are_near(void **state)
{
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = solid(&ctx, MR_SPHERE, 10000);
	double *d = MR_NEW(&ctx, m.nv, double);
	mr_v3 q = mr_unit(mr_vec(0.3, 0.4, 0.5));
	mr_geodesic_distances(&ctx, &m, q, INFINITY, d);
	for (size_t i = 0; i < m.nv; i++) {
		double arc = atan2(mr_norm(mr_cross(q, m.p[i])), mr_dot(q, m.p[i]));
		if (fabs(d[i] - arc) > 0.01 * arc + 1e-4)
			fail_msg("vertex %zu: %g, not %g", i, d[i], arc);
	}
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(predicates_hold_where_they_should),
		cmocka_unit_test(groups_are_found_by_name),
		cmocka_unit_test(rules_apply_in_order),
		cmocka_unit_test(growing_stays_in_fixed_vertices),
		cmocka_unit_test(a_file_may_list_the_vertices),
		cmocka_unit_test(wrong_words_are_refused),
		cmocka_unit_test(a_rule_must_select_something),
		cmocka_unit_test(components_are_whole),
		cmocka_unit_test(distances_on_the_plane_are_straight),
		cmocka_unit_test(distances_on_the_sphere_are_near),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
