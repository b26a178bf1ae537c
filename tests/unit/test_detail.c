/* Detail over a base: nothing is lost, heights are true, the detail follows the base. */
#include "base/random.h"
#include "edit/correspondence.h"
#include "edit/detail.h"
#include "shape/shape.h"
#include "space/bvh.h"

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

/* The mesh with other positions. */
static mr_mesh
with_positions(mr_mesh m, const mr_v3 *p, const char *name)
{
	m.p = p;
	m.name = name;
	return m;
}

/* The umbrella smoothing of m, half a step at a time. */
static mr_mesh
smoothed(mr_ctx *ctx, mr_mesh m, int passes)
{
	mr_v3 *p = MR_NEW(ctx, m.nv, mr_v3), *q = MR_NEW(ctx, m.nv, mr_v3);
	mr_adjacency a;

	mr_adjacency_build(ctx, &m, &a);
	memcpy(p, m.p, m.nv * sizeof *p);
	for (int i = 0; i < passes; i++) {
		for (size_t v = 0; v < m.nv; v++) {
			mr_v3 sum = { 0, 0, 0 };
			for (size_t k = a.start[v]; k < a.start[v + 1]; k++)
				sum = mr_add(sum, p[a.adj[k]]);
			q[v] = mr_lerp(0.5, p[v], mr_mul(1 / (double)(a.start[v + 1] - a.start[v]), sum));
		}
		memcpy(p, q, m.nv * sizeof *p);
	}
	return with_positions(m, p, "base");
}

/* The source map of a base with the mesh's own numbering. */
static mr_places
identity_map(mr_ctx *ctx, mr_mesh m)
{
	uint32_t *face = MR_NEW(ctx, m.nv, uint32_t);
	mr_v3 *bary = MR_NEW(ctx, m.nv, mr_v3);

	for (uint32_t f = 0; f < m.nf; f++)
		for (int k = 0; k < 3; k++) {
			face[m.t[f].v[k]] = f;
			bary[m.t[f].v[k]] = mr_vec(k == 0, k == 1, k == 2);
		}
	return (mr_places){ face, bary };
}

/* The source map of any base: the mesh's nearest points. */
static mr_places
nearest_map(mr_ctx *ctx, mr_mesh mesh, mr_mesh base)
{
	uint32_t *face = MR_NEW(ctx, base.nv, uint32_t);
	mr_v3 *bary = MR_NEW(ctx, base.nv, mr_v3);
	mr_bvh *bvh;

	mr_bvh_build(ctx, &mesh, &bvh);
	for (size_t i = 0; i < base.nv; i++) {
		mr_closest c = mr_bvh_closest(bvh, base.p[i]);
		face[i] = c.at.face;
		bary[i] = c.at.bary;
	}
	return (mr_places){ face, bary };
}

static const mr_v3 *
decoded(mr_ctx *ctx, mr_mesh base, const mr_detail *d, double gain)
{
	mr_v3 *p = MR_NEW(ctx, d->n, mr_v3);

	assert_int_equal(mr_decode(ctx, &base, d, gain, p), MR_OK);
	return p;
}

static double
farthest(const mr_v3 *a, const mr_v3 *b, size_t n)
{
	double most = 0;

	for (size_t i = 0; i < n; i++)
		most = fmax(most, mr_dist(a[i], b[i]));
	return most;
}

/* All but so many vertices have a height, on a point of a face, and all come back. */
static void
check_heights(mr_ctx *ctx, mr_mesh mesh, mr_mesh base, const mr_places *source, size_t offsets)
{
	double diagonal = mr_mesh_diagonal(&mesh);
	mr_encode_result found;
	mr_detail d;

	assert_int_equal(mr_encode(ctx, &mesh, &base, source, &d, &found), MR_OK);
	assert_int_equal(mr_detail_check(ctx, &d, &base), MR_OK);
	assert_true(found.offsets <= offsets && found.heights + found.offsets == mesh.nv);
	assert_true(found.residual_max < 1e-14);
	for (size_t i = 0; i < d.n; i++) {
		mr_v3 w = d.at.bary[i];
		assert_true(fmin(w.x, fmin(w.y, w.z)) > -1e-8 && fabs(w.x + w.y + w.z - 1) < 1e-14);
	}
	assert_true(farthest(decoded(ctx, base, &d, 1), mesh.p, mesh.nv) < 1e-14 * diagonal);
}

/* Orthonormal to within rounding even where the triangle's first edge lies all but along the normal. */
static void
frames_are_orthonormal(void **state)
{
	const mr_tri t = { { 0, 1, 2 } };
	mr_v3 n = mr_unit(mr_vec(1, 2, 3));

	(void)state;
	for (double off = 1; off > 1e-12; off /= 10) {
		mr_v3 p[3] = { { 0, 0, 0 }, mr_axpy(off, mr_vec(0.3, -0.5, 0.7), mr_mul(0.7, n)),
			{ 1, 0, 0 } };
		mr_v3 normal[3] = { n, n, n };
		mr_mesh m = { .p = p, .nv = 3, .t = &t, .nf = 1 };
		mr_tangent_frame f = mr_phong_frame(
		    &(mr_phong){ &m, normal }, (mr_place){ 0, mr_vec(0.2, 0.3, 0.5) });
		assert_true(fabs(mr_dot(f.t1, f.n)) < 1e-15 && fabs(mr_dot(f.t2, f.n)) < 1e-15);
		assert_true(fabs(mr_dot(f.t1, f.t2)) < 1e-15);
		assert_true(fabs(mr_norm(f.t1) - 1) < 1e-15 && fabs(mr_norm(f.t2) - 1) < 1e-15);
	}
}

static void
normals_are_weighted_by_angle(void **state)
{
	mr_ctx ctx;
	mr_mesh m;

	(void)state;
	mr_ctx_init(&ctx, 2);
	m = solid(&ctx, MR_BUMPY, 3000);
	mr_v3 *a = MR_NEW(&ctx, m.nv, mr_v3), *sum = MR_NEW_ZERO(&ctx, m.nv, mr_v3);
	for (size_t f = 0; f < m.nf; f++)
		for (int k = 0; k < 3; k++) {
			const uint32_t *v = m.t[f].v;
			mr_v3 p = m.p[v[k]], to = mr_sub(m.p[v[(k + 1) % 3]], p),
			      from = mr_sub(m.p[v[(k + 2) % 3]], p);
			sum[v[k]] = mr_axpy(mr_angle(to, from), mr_unit(mr_face_cross(&m, f)), sum[v[k]]);
		}
	for (size_t v = 0; v < m.nv; v++)
		sum[v] = mr_unit(sum[v]);
	mr_vertex_normals(&m, a);
	assert_true(farthest(a, sum, m.nv) < 1e-14);
	mr_ctx_free(&ctx);
}

static void
nothing_is_lost(void **state)
{
	const mr_solid solids[] = { MR_SPHERE, MR_TORUS, MR_KNOT, MR_BUMPY };

	(void)state;
	for (size_t i = 0; i < sizeof solids / sizeof *solids; i++) {
		mr_ctx ctx;
		mr_ctx_init(&ctx, 2);
		mr_mesh m = solid(&ctx, solids[i], 4000), base = smoothed(&ctx, m, 15);
		mr_places map = identity_map(&ctx, m);
		assert_int_equal(mr_source_map_check(&ctx, &m, base.nv, &map), MR_OK);
		check_heights(&ctx, m, base, &map, solids[i] == MR_BUMPY ? m.nv / 30 : 0);
		check_heights(&ctx, m, base, NULL, solids[i] == MR_BUMPY ? m.nv / 30 : 0);
		mr_ctx_free(&ctx);
	}
}

static void
the_base_may_have_other_vertices(void **state)
{
	mr_ctx ctx;
	mr_random r = { 5 };

	(void)state;
	mr_ctx_init(&ctx, 2);
	for (size_t n = 200; n <= 20000; n *= 10) {
		mr_mesh m = solid(&ctx, MR_SPHERE, 3000), base = solid(&ctx, MR_SPHERE, n);
		mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
		for (size_t i = 0; i < m.nv; i++)
			p[i] = mr_mul(1 + 0.1 * mr_random_real(&r), m.p[i]);
		m = with_positions(m, p, "mesh");
		mr_places map = nearest_map(&ctx, m, base);
		check_heights(&ctx, m, base, &map, 0);
		check_heights(&ctx, m, base, NULL, 0);
	}
	mr_ctx_free(&ctx);
}

/* Two copies of a plane, the second `apart` above the first, both moved up by `lift`. */
static mr_mesh
two_sheets(mr_ctx *ctx, double apart, double lift, const char *name)
{
	mr_mesh one = solid(ctx, MR_PLANE, 400);
	mr_v3 *p = MR_NEW(ctx, 2 * one.nv, mr_v3);
	mr_tri *t = MR_NEW(ctx, 2 * one.nf, mr_tri);

	for (size_t i = 0; i < 2 * one.nv; i++)
		p[i] = mr_add(one.p[i % one.nv], mr_vec(0, 0, lift + (i < one.nv ? 0 : apart)));
	for (size_t i = 0; i < 2 * one.nf; i++)
		for (int k = 0; k < 3; k++)
			t[i].v[k] = one.t[i % one.nf].v[k] + (i < one.nf ? 0 : (uint32_t)one.nv);
	return (mr_mesh){ name, p, t, 2 * one.nv, 2 * one.nf };
}

static void
a_vertex_stays_on_its_sheet(void **state)
{
	mr_ctx ctx;
	mr_detail d;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_mesh m = two_sheets(&ctx, 0.05, 0, "mesh"), base = two_sheets(&ctx, 0.05, 0.08, "base");
	mr_places map = identity_map(&ctx, m);
	assert_int_equal(mr_encode(&ctx, &m, &base, &map, &d, NULL), MR_OK);
	for (size_t i = 0; i < d.n; i++) {
		assert_int_equal(d.at.face[i] < base.nf / 2, i < m.nv / 2);
		assert_true(fabs(d.height[i] + (d.offset ? d.offset[i].z : 0) + 0.08) < 1e-15);
	}
	assert_int_equal(mr_encode(&ctx, &m, &base, NULL, &d, NULL), MR_OK); /* by nearness alone it cannot */
	assert_true(d.at.face[m.nv / 2] < base.nf / 2);
	mr_ctx_free(&ctx);
}

/* A plate of n by n squares on both sides, 2 t thick. */
static mr_mesh
plate(mr_ctx *ctx, uint32_t n, double t, const char *name)
{
	uint32_t side = (n + 1) * (n + 1), k = 0;
	mr_v3 *p = MR_NEW(ctx, 2 * side, mr_v3);
	mr_tri *f = MR_NEW(ctx, 4 * n * n + 8 * n, mr_tri);

	for (uint32_t i = 0; i < 2 * side; i++)
		p[i] = mr_vec(
		    i % side % (n + 1) / (double)n, i % side / (n + 1) / (double)n, i < side ? t : -t);
	for (uint32_t y = 0; y < n; y++)
		for (uint32_t x = 0; x < n; x++) {
			uint32_t a = y * (n + 1) + x, b = a + 1, c = b + n + 1, d = c - 1;
			f[k++] = (mr_tri){ { a, b, c } };
			f[k++] = (mr_tri){ { a, c, d } };
			f[k++] = (mr_tri){ { side + a, side + c, side + b } };
			f[k++] = (mr_tri){ { side + a, side + d, side + c } };
		}
	for (uint32_t i = 0; i < n; i++) {
		const uint32_t from[4] = { i, i * (n + 1) + n, side - 1 - i, (n - i) * (n + 1) };
		const uint32_t to[4] = { i + 1, from[1] + n + 1, from[2] - 1, from[3] - n - 1 };
		for (int j = 0; j < 4; j++) {
			f[k++] = (mr_tri){ { from[j], side + from[j], side + to[j] } };
			f[k++] = (mr_tri){ { from[j], side + to[j], to[j] } };
		}
	}
	return (mr_mesh){ .name = name, .p = p, .t = f, .nv = 2 * side, .nf = k };
}

/* The walks of many vertices begin on the other side of the plate. */
static void
vertices_stay_on_their_side_of_a_plate(void **state)
{
	const double t = 0.01;
	mr_ctx ctx;
	size_t astray = 0;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_mesh m = plate(&ctx, 60, t, "mesh"), base = plate(&ctx, 7, t, "base");
	mr_places map = nearest_map(&ctx, m, base);
	mr_incidence inc;
	mr_correspondence c;
	uint32_t *face = MR_NEW(&ctx, m.nv, uint32_t);
	mr_v3 *bary = MR_NEW(&ctx, m.nv, mr_v3);
	bool *none = MR_NEW_ZERO(&ctx, m.nv, bool);
	mr_incidence_build(&ctx, &base, &inc);
	mr_correspond(&ctx, &m, &base, &inc, &map, &c);
	mr_correspond_rest(&ctx, &c, none, face, bary);
	for (size_t i = 0; i < m.nv; i++)
		astray += mr_dist(mr_place_point(&base, (mr_place){ face[i], bary[i] }), m.p[i]) > t;
	assert_int_equal(astray, 0);
	mr_ctx_free(&ctx);
}

static void
beyond_the_boundary_offsets_serve(void **state)
{
	mr_encode_result found;
	mr_ctx ctx;
	mr_detail d;
	size_t offsets = 0;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_mesh base = solid(&ctx, MR_PLANE, 900), m = base;
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	for (size_t i = 0; i < m.nv; i++) /* a wavy plane that reaches beyond the base on every side */
		p[i] = mr_vec(1.2 * m.p[i].x, 1.2 * m.p[i].y, 0.1 * sin(5 * m.p[i].x));
	m = with_positions(m, p, "mesh");
	mr_places map = identity_map(&ctx, m);
	assert_int_equal(mr_encode(&ctx, &m, &base, &map, &d, &found), MR_OK);
	assert_non_null(d.offset);
	for (size_t i = 0; i < d.n; i++) {
		bool out = fmax(fabs(p[i].x), fabs(p[i].y)) > 1 + 1e-12, has = mr_norm(d.offset[i]) > 0;
		assert_int_equal(has, out);
		assert_true(!has || d.height[i] == 0);
		offsets += has;
	}
	assert_int_equal(found.offsets, offsets);
	assert_true(farthest(decoded(&ctx, base, &d, 1), p, m.nv) < 1e-14);
	mr_ctx_free(&ctx);
}

static void
the_detail_follows_the_base(void **state)
{
	const double c = cos(0.7), s = sin(0.7);
	const mr_affine turn = { { c, -s, 0, 3, s, c, 0, -2, 0, 0, 1, 5 } };
	mr_ctx ctx;
	mr_detail d;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_mesh m = solid(&ctx, MR_BUMPY, 3000), base = smoothed(&ctx, m, 30), moved;
	mr_places map = identity_map(&ctx, m);
	assert_int_equal(mr_encode(&ctx, &m, &base, &map, &d, NULL), MR_OK);
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3), *q = MR_NEW(&ctx, m.nv, mr_v3);
	mr_v3 *offset = MR_NEW_ZERO(&ctx, m.nv, mr_v3);
	d.offset = offset; /* some of which serve beside the heights: the frame must turn, too */
	for (size_t i = 0; i < m.nv; i += 3)
		offset[i] = mr_vec(0.1, 0.2, 0.3);
	for (size_t i = 0; i < base.nv; i++)
		p[i] = mr_apply(&turn, base.p[i]);
	moved = with_positions(base, p, "base");
	const mr_v3 *plain = decoded(&ctx, base, &d, 1);
	for (size_t i = 0; i < m.nv; i++)
		q[i] = mr_apply(&turn, plain[i]);
	assert_true(farthest(decoded(&ctx, moved, &d, 1), q, m.nv) < 1e-7); /* floats turn normals */

	const mr_v3 *none = decoded(&ctx, base, &d, 0), *twice = decoded(&ctx, base, &d, 2);
	for (size_t i = 0; i < m.nv; i++)
		q[i] = mr_lerp(2, none[i], plain[i]);
	assert_true(farthest(twice, q, m.nv) < 1e-14);
	assert_true(mr_norm(offset[1]) == 0 && fabs(mr_dist(plain[1], none[1]) - fabs(d.height[1])) < 1e-14);
	mr_ctx_free(&ctx);
}

/* How far a sphere's vertices are from straight above those of a base that has been crumpled by a fifth of an
 * edge, in all. */
static double
crumpling(mr_ctx *ctx, mr_mesh m, mr_mesh base, mr_detail d)
{
	mr_random r = { 5 };
	mr_v3 *p = MR_NEW(ctx, base.nv, mr_v3);
	const mr_v3 *q;
	double sum = 0;

	for (size_t i = 0; i < base.nv; i++)
		p[i] = mr_mul(1 + 0.2 * 0.1 * mr_random_real(&r), base.p[i]);
	q = decoded(ctx, with_positions(base, p, "base"), &d, 1);
	for (size_t i = 0; i < m.nv; i++)
		sum += mr_dist(mr_sub(q[i], p[i]), mr_sub(m.p[i], base.p[i]));
	return sum;
}

static void
a_crumpled_base_turns_the_detail_little(void **state)
{
	mr_ctx ctx;
	mr_detail d;

	(void)state;
	mr_ctx_init(&ctx, 2);
	mr_mesh m = solid(&ctx, MR_SPHERE, 1200), base = solid(&ctx, MR_SPHERE, 1200);
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	for (size_t i = 0; i < m.nv; i++)
		p[i] = mr_mul(1.3, m.p[i]);
	m = with_positions(m, p, "mesh");
	assert_int_equal(mr_encode(&ctx, &m, &base, NULL, &d, NULL), MR_OK);
	assert_true(crumpling(&ctx, m, base, d) < 0.004 * (double)m.nv);
	mr_ctx_free(&ctx);
}

static void
threads_do_not_matter(void **state)
{
	mr_ctx one, four;
	mr_detail a, b;

	(void)state;
	mr_ctx_init(&one, 1);
	mr_ctx_init(&four, 4);
	mr_mesh m = solid(&one, MR_BUMPY, 6000), base = smoothed(&one, m, 60);
	mr_places map = identity_map(&one, m);
	assert_int_equal(mr_encode(&one, &m, &base, &map, &a, NULL), MR_OK);
	assert_int_equal(mr_encode(&four, &m, &base, &map, &b, NULL), MR_OK);
	assert_memory_equal(a.at.face, b.at.face, a.n * sizeof *a.at.face);
	assert_memory_equal(a.at.bary, b.at.bary, a.n * sizeof *a.at.bary);
	assert_memory_equal(a.height, b.height, a.n * sizeof *a.height);
	assert_memory_equal(decoded(&one, base, &a, 1), decoded(&four, base, &b, 1), a.n * sizeof(mr_v3));
	mr_ctx_free(&one);
	mr_ctx_free(&four);
}

static void
degenerate_bases_lose_nothing_either(void **state)
{
	mr_ctx ctx;
	mr_detail d;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = solid(&ctx, MR_TORUS, 300);
	mr_v3 *flat = MR_NEW(&ctx, m.nv, mr_v3), *point = MR_NEW_ZERO(&ctx, m.nv, mr_v3);
	for (size_t i = 0; i < m.nv; i++)
		flat[i] = mr_vec(m.p[i].x, m.p[i].y, 0); /* two layers, folded at their rims */
	mr_mesh bases[] = { with_positions(m, flat, "base"), with_positions(m, point, "base") };
	mr_places map = identity_map(&ctx, m);
	for (size_t i = 0; i < 2; i++) {
		assert_int_equal(mr_encode(&ctx, &m, &bases[i], &map, &d, NULL), MR_OK);
		assert_int_equal(mr_detail_check(&ctx, &d, &bases[i]), MR_OK);
		assert_true(farthest(decoded(&ctx, bases[i], &d, 1), m.p, m.nv) < 1e-14);
	}
	mr_ctx_free(&ctx);
}

static void
bad_columns_are_refused(void **state)
{
	mr_ctx ctx;
	uint32_t face[4] = { 0, 1, 0, 9 };
	mr_v3 bary[4] = { { 1, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 } };
	double height[4] = { 0, 0, NAN, 0 };
	mr_mesh m;

	(void)state;
	mr_ctx_init(&ctx, 1);
	m = solid(&ctx, MR_PLANE, 4);
	m.name = "base";
	mr_detail d = { 4, { face, bary }, height, NULL, m.p, NULL };
	assert_int_equal(mr_detail_check(&ctx, &d, &m), MR_ERANGE);
	assert_string_equal(ctx.error, "mesh: detail_height 2 (nan) is not finite");
	height[2] = 0;
	assert_int_equal(mr_detail_check(&ctx, &d, &m), MR_ERANGE);
	assert_string_equal(ctx.error, "mesh: detail_face 3 is 9, but base has 2 faces");
	face[3] = 1;
	bary[1] = mr_vec(1.5, -0.5, 0);
	assert_int_equal(mr_detail_check(&ctx, &d, &m), MR_ERANGE);
	assert_string_equal(ctx.error, "mesh: detail_bary 1 (1.5 -0.5 0) is no place within a face of base");
	bary[1] = mr_vec(1, 0, 0);
	assert_int_equal(mr_detail_check(&ctx, &d, &m), MR_OK);
	face[3] = 9;
	mr_places map = { face, bary };
	assert_int_equal(mr_source_map_check(&ctx, &m, m.nv, &map), MR_ERANGE);
	assert_string_equal(ctx.error, "base: vertex 3 lies on face 9 of base, which has 2");
	face[3] = 1;
	bary[2] = mr_vec(1e200, -1e200, 1);
	assert_int_equal(mr_source_map_check(&ctx, &m, m.nv, &map), MR_ERANGE);
	assert_string_equal(
	    ctx.error, "base: source_bary 2 (1e+200 -1e+200 1) is no place within a face of base");
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(normals_are_weighted_by_angle),
		cmocka_unit_test(frames_are_orthonormal),
		cmocka_unit_test(nothing_is_lost),
		cmocka_unit_test(the_base_may_have_other_vertices),
		cmocka_unit_test(a_vertex_stays_on_its_sheet),
		cmocka_unit_test(vertices_stay_on_their_side_of_a_plate),
		cmocka_unit_test(beyond_the_boundary_offsets_serve),
		cmocka_unit_test(the_detail_follows_the_base),
		cmocka_unit_test(a_crumpled_base_turns_the_detail_little),
		cmocka_unit_test(threads_do_not_matter),
		cmocka_unit_test(degenerate_bases_lose_nothing_either),
		cmocka_unit_test(bad_columns_are_refused),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
