/* Long edges divided: none is left, the surface and what is linear on it stay, it stays closed, work is
 * bounded. */
#include "subdivide/longest.h"

#include "shapes.h"

static double
longest_edge(const mr_mesh *m)
{
	double most = 0;

	for (uint32_t h = 0; h < 3 * m->nf; h++)
		most = fmax(most, mr_dist(m->p[mr_he_from(m, h)], m->p[mr_he_to(m, h)]));
	return most;
}

/* The fine corners are where their places on the old triangles say, and these are turned as those were. */
static void
check_places(const mr_refined *r)
{
	double scale = mr_mesh_diagonal(&r->m);

	for (size_t f = 0; f < r->fine.nf; f++) {
		mr_v3 old = mr_face_cross(&r->m, r->face[f]), new = mr_face_cross(&r->fine, f);
		assert_true(mr_norm(old) == 0 || mr_dot(old, new) > 0);
		for (size_t k = 0; k < 3; k++) {
			mr_place at = { r->face[f], r->bary[3 * f + k] };
			assert_true(at.bary.x >= 0 && at.bary.y >= 0 && at.bary.z >= 0);
			assert_true(
			    mr_dist(mr_place_point(&r->m, at), r->fine.p[r->fine.t[f].v[k]]) < 1e-14 * scale);
		}
	}
}

static mr_refined
divided(const mr_mesh *m, double length)
{
	mr_census before, after;
	mr_refined r;

	assert_int_equal(mr_divide_longest(&ctx, m, length, &r), MR_OK);
	assert_true(longest_edge(&r.fine) <= length * (1 + 1e-8));
	assert_memory_equal(r.fine.p, m->p, m->nv * sizeof *m->p);
	check_places(&r);
	before = census_of(m);
	after = census_of(&r.fine);
	assert_int_equal(after.euler, before.euler);
	assert_int_equal(after.boundary_loops, before.boundary_loops);
	assert_int_equal(after.isolated_vertices, before.isolated_vertices);
	assert_int_equal(after.oriented, before.oriented);
	assert_int_equal(after.manifold, before.manifold);
	assert_true(!before.degenerate_faces == !after.degenerate_faces);
	assert_true(
	    fabs(mr_mesh_area(&ctx, &r.fine) - mr_mesh_area(&ctx, m)) <= 1e-12 * mr_mesh_area(&ctx, m));
	return r;
}

static void
test_solids(void **state)
{
	static const mr_solid solids[] = { MR_CUBE, MR_PLANE, MR_CYLINDER, MR_SPHERE, MR_BUMPY };

	(void)state;
	for (size_t i = 0; i < sizeof solids / sizeof *solids; i++) {
		mr_mesh m = shape(solids[i], 60);
		for (double share = 1.5; share > 0.05; share *= 0.6)
			divided(&m, share * longest_edge(&m));
	}
}

/* Triangles of any shape, their edges in any ratio. */
static void
test_any_triangle(void **state)
{
	mr_random random = { 1 };

	(void)state;
	for (int i = 0; i < 400; i++) {
		const mr_v3 p[] = { { 0, 0, 0 },
			mr_mul(exp(6 * mr_random_real(&random)), random_vector(&random)),
			mr_mul(exp(6 * mr_random_real(&random)), random_vector(&random)),
			mr_mul(exp(6 * mr_random_real(&random)), random_vector(&random)) };
		static const mr_tri t[] = { { { 0, 1, 2 } }, { { 1, 0, 3 } }, { { 2, 1, 3 } } };
		const mr_mesh m = { "some", p, t, 4, 3 };
		divided(&m, longest_edge(&m) / (1 + 20 * mr_random_real(&random)));
	}
}

/* A sliver takes two triangles a piece of its long edges, four where their diagonals are too long; halving
 * them would take 3^k of 2^k pieces. */
static void
test_slivers(void **state)
{
	static const mr_v3 p[] = { { 0, 0, 0 }, { 1024, 0, 0 }, { 1024, 0.1, 0 } };
	static const mr_tri t[] = { { { 0, 1, 2 } } };
	const mr_mesh m = { "sliver", p, t, 3, 1 };

	(void)state;
	assert_in_range(divided(&m, 1.01).fine.nf, 1024, 4096);
}

/* Three faces at an edge, and two that run along it in the same direction, are divided as one. */
static void
test_not_manifold(void **state)
{
	static const mr_v3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 } };
	static const mr_tri t[] = { { { 0, 1, 2 } }, { { 0, 1, 3 } }, { { 1, 0, 4 } } };
	const mr_mesh m = { "fan", p, t, 5, 3 };

	(void)state;
	divided(&m, 0.23);
}

/* All that goes along is where it was: columns that are linear in the positions stay so. */
static void
test_columns(void **state)
{
	mr_mesh m = shape(MR_CUBE, 26);
	double *uv = MR_NEW(&ctx, 6 * m.nf, double), *linear = MR_NEW(&ctx, m.nv, double);
	uint32_t *material = MR_NEW(&ctx, m.nf, uint32_t), *label = MR_NEW(&ctx, m.nv, uint32_t);
	const void *fine;
	mr_carried *c;
	mr_refined r;
	mr_frame *f;
	size_t n;

	(void)state;
	for (size_t i = 0; i < 3 * m.nf; i++) { /* another map on every face */
		mr_v3 x = m.p[m.t[i / 3].v[i % 3]];
		uv[2 * i] = x.x + 2 * x.y + (double)(i / 3);
		uv[2 * i + 1] = i / 3 == 5 ? NAN : x.z - x.y * (double)(i / 3);
		material[i / 3] = (uint32_t)(i / 3);
	}
	for (size_t v = 0; v < m.nv; v++) {
		linear[v] = 0.25 + m.p[v].x - m.p[v].z; /* whole numbers would be labels */
		label[v] = (uint32_t)v;
	}
	assert_int_equal(mr_frame_new(&ctx, "test", &f), MR_OK);
	assert_int_equal(mr_layer_put_mesh(&ctx, f, "mesh", &m), MR_OK);
	assert_int_equal(mr_layer_put(&ctx, f, "mesh", "corner_texcoord", uv, m.nf), MR_OK);
	assert_int_equal(mr_layer_put(&ctx, f, "mesh", "material", material, m.nf), MR_OK);
	assert_int_equal(
	    mr_frame_put(&ctx, f, "mesh", "quality", (mr_shape){ 'v', 'd', 1 }, linear, m.nv), MR_OK);
	assert_int_equal(
	    mr_frame_put(&ctx, f, "mesh", "label", (mr_shape){ 'v', 'u', 1 }, label, m.nv), MR_OK);
	r = divided(&m, 0.3 * longest_edge(&m));
	assert_int_equal(mr_refine_columns(&ctx, f, "mesh", &r, &c, &n), MR_OK);
	assert_int_equal(n, 4);
	for (size_t i = 0; i < n; i++) {
		fine = c[i].to;
		assert_int_equal(c[i].rows, c[i].shape.element == 'f' ? r.fine.nf : r.fine.nv);
		for (size_t k = 0; !strcmp(c[i].name, "corner_texcoord") && k < 3 * r.fine.nf; k++) {
			mr_v3 x = r.fine.p[r.fine.t[k / 3].v[k % 3]];
			double face = r.face[k / 3];
			const double *at = (const double *)fine + 2 * k;
			assert_true(fabs(at[0] - (x.x + 2 * x.y + face)) < 1e-12);
			assert_true(face == 5 ? isnan(at[1]) : fabs(at[1] - (x.z - x.y * face)) < 1e-12);
		}
		for (size_t k = 0; !strcmp(c[i].name, "material") && k < r.fine.nf; k++)
			assert_int_equal(((const uint32_t *)fine)[k], r.face[k]);
		for (size_t v = 0; !strcmp(c[i].name, "quality") && v < r.fine.nv; v++)
			assert_true(
			    fabs(((const double *)fine)[v] - (0.25 + r.fine.p[v].x - r.fine.p[v].z)) < 1e-14);
		for (size_t v = 0; !strcmp(c[i].name, "label") && v < r.fine.nv; v++)
			assert_true(v >= m.nv ? ((const uint32_t *)fine)[v] < m.nv
					      : ((const uint32_t *)fine)[v] == v);
	}
}

/* Midpoints of an edge may be one of its ends: refused, not divided for ever. */
static void
test_no_finer(void **state)
{
	const mr_v3 p[] = { { 1e15, 0, 0 }, { 1e15 + 0.125, 0, 0 }, { 1e15, 0.1, 0 } };
	const mr_mesh m = { "mesh", p, (const mr_tri[]){ { { 0, 1, 2 } } }, 3, 1 };
	mr_refined r;

	(void)state;
	assert_int_equal(mr_divide_longest(&ctx, &m, 0.05, &r), MR_ERANGE);
	assert_non_null(strstr(ctx.error, "no finer"));
	assert_int_equal(mr_divide_longest(&ctx, &m, 0.2, &r), MR_OK);
	assert_false(mr_divides(mr_lerp(0.5, p[0], p[1]), p[0], p[1]));
	assert_true(mr_divides(mr_lerp(0.5, p[0], p[2]), p[0], p[2]));
}

/* Too many triangles are refused before any work, with a length that is not. */
static void
test_refusals(void **state)
{
	mr_mesh m = shape(MR_CUBE, 26);
	const char *said;
	double length;
	mr_refined r;

	(void)state;
	assert_int_equal(mr_divide_longest(&ctx, &m, 1e-6, &r), MR_ERANGE);
	said = strstr(ctx.error, "a length of ");
	assert_non_null(said);
	length = strtod(said + 12, NULL);
	assert_true(length > 1e-4 && length < 4e-3);
	assert_int_equal(mr_divide_longest(&ctx, &m, 1e-300, &r), MR_ERANGE);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_solids, setup, teardown),
		cmocka_unit_test_setup_teardown(test_any_triangle, setup, teardown),
		cmocka_unit_test_setup_teardown(test_slivers, setup, teardown),
		cmocka_unit_test_setup_teardown(test_not_manifold, setup, teardown),
		cmocka_unit_test_setup_teardown(test_columns, setup, teardown),
		cmocka_unit_test_setup_teardown(test_no_finer, setup, teardown),
		cmocka_unit_test_setup_teardown(test_refusals, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
