/* Welding and repairing: exact and within a distance; whatever the triangles, an oriented manifold comes out.
 */
#include "base/random.h"
#include "mesh/repair.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

typedef struct repaired {
	mr_mesh m;
	const uint32_t *vertex_of, *face_of;
	mr_repair_report r;
} repaired;

/* Repairs, and checks what every result must be. */
static repaired
repair(mr_ctx *ctx, const mr_v3 *p, size_t nv, const mr_tri *t, size_t nf)
{
	mr_mesh m = { .name = "test", .p = p, .t = t, .nv = nv, .nf = nf };
	repaired out;
	mr_topology topo;

	assert_int_equal(mr_repair(ctx, &m, &out.m, &out.vertex_of, &out.face_of, &out.r), MR_OK);
	if (mr_topology_build(ctx, &out.m, &topo) != MR_OK)
		print_message("# %s\n", ctx->error);
	assert_int_equal(mr_topology_build(ctx, &out.m, &topo), MR_OK);
	assert_int_equal(out.m.nf, nf - out.r.degenerate - out.r.duplicate);
	assert_int_equal(out.m.nv, nv - out.r.isolated + out.r.split_vertices);
	for (size_t f = 0; f < out.m.nf; f++) {
		mr_tri was = t[out.face_of[f]];
		for (int k = 0; k < 3; k++) {
			uint32_t v = out.m.t[f].v[k], of = out.vertex_of[v];
			assert_true(v < out.m.nv);
			assert_memory_equal(&out.m.p[v], &p[of], sizeof(mr_v3));
			assert_true(of == was.v[0] || of == was.v[1] || of == was.v[2]);
		}
		assert_true(f == 0 || out.face_of[f] > out.face_of[f - 1]);
	}
	return out;
}

static size_t
border(mr_ctx *ctx, const mr_mesh *m)
{
	mr_topology topo;
	size_t n = 0;

	assert_int_equal(mr_topology_build(ctx, m, &topo), MR_OK);
	for (size_t h = 0; h < 3 * m->nf; h++)
		n += topo.twin[h] == MR_NONE;
	return n;
}

static double
volume(const mr_mesh *m)
{
	double v = 0;

	for (size_t f = 0; f < m->nf; f++)
		v += mr_dot(m->p[m->t[f].v[0]], mr_cross(m->p[m->t[f].v[1]], m->p[m->t[f].v[2]])) / 6;
	return v;
}

static const mr_v3 corners[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
static const mr_tri tetrahedron[] = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 1, 2, 3 } }, { { 0, 3, 2 } } };

static void
nothing_to_do(void **state)
{
	mr_ctx ctx;
	repaired r;

	(void)state;
	mr_ctx_init(&ctx, 1);
	r = repair(&ctx, corners, 4, tetrahedron, 4);
	assert_memory_equal(r.m.t, tetrahedron, sizeof tetrahedron);
	assert_memory_equal(r.m.p, corners, sizeof corners);
	assert_int_equal(r.r.flipped + r.r.cut_edges + r.r.split_edges + r.r.split_vertices, 0);
	mr_ctx_free(&ctx);
}

/* Every choice of turned faces, also inside out as a whole: the solid comes out; all inside out is consistent
 * and stays. */
static void
turned_over(void **state)
{
	(void)state;
	for (unsigned turn = 0; turn < 16; turn++) {
		mr_ctx ctx;
		mr_tri t[4];
		repaired r;
		mr_ctx_init(&ctx, 1);
		for (unsigned f = 0; f < 4; f++) {
			t[f] = tetrahedron[f];
			if (turn >> f & 1)
				t[f] = (mr_tri){ { t[f].v[0], t[f].v[2], t[f].v[1] } };
		}
		r = repair(&ctx, corners, 4, t, 4);
		assert_int_equal(border(&ctx, &r.m), 0);
		assert_true(turn == 15 ? volume(&r.m) < 0 : volume(&r.m) > 0.16);
		mr_ctx_free(&ctx);
	}
}

static void
dropped(void **state)
{
	static const mr_v3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 2, 0, 0 }, { 5, 5, 5 } };
	static const mr_tri t[] = { { { 0, 1, 2 } }, { { 1, 2, 0 } }, { { 0, 2, 1 } }, { { 0, 0, 1 } },
		{ { 0, 1, 3 } } };
	static const mr_tri none[] = { { { 0, 0, 1 } } };
	mr_mesh m = { .name = "test", .p = p, .t = none, .nv = 5, .nf = 1 };
	mr_ctx ctx;
	repaired r;

	(void)state;
	mr_ctx_init(&ctx, 1);
	r = repair(&ctx, p, 5, t, 5);
	assert_int_equal(r.r.duplicate, 2);
	assert_int_equal(r.r.degenerate, 2);
	assert_int_equal(r.r.isolated, 2);
	assert_int_equal(r.m.nf, 1);
	assert_int_equal(mr_repair(&ctx, &m, &r.m, &r.vertex_of, &r.face_of, &r.r), MR_EMESH);
	mr_ctx_free(&ctx);
}

/* Two tetrahedra that share a vertex, or an edge: two closed solids again. */
static void
touching(void **state)
{
	static const mr_v3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 0, 0 },
		{ 0, -1, 0 }, { 0, 0, -1 } };
	static const mr_tri by_vertex[] = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 1, 2, 3 } },
		{ { 0, 3, 2 } }, { { 0, 4, 5 } }, { { 0, 6, 4 } }, { { 4, 6, 5 } }, { { 0, 5, 6 } } };
	static const mr_tri by_edge[] = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 1, 2, 3 } }, { { 0, 3, 2 } },
		{ { 0, 5, 4 } }, { { 0, 3, 5 } }, { { 0, 4, 3 } }, { { 4, 5, 3 } } };
	mr_ctx ctx;
	repaired r;

	(void)state;
	mr_ctx_init(&ctx, 1);
	r = repair(&ctx, p, 7, by_vertex, 8);
	assert_int_equal(r.r.split_vertices, 1);
	assert_int_equal(border(&ctx, &r.m), 0);
	r = repair(&ctx, p, 6, by_edge, 8);
	assert_int_equal(r.r.split_edges, 1);
	assert_int_equal(r.r.split_vertices, 2);
	assert_int_equal(border(&ctx, &r.m), 0);
	assert_true(volume(&r.m) > 0.3);
	mr_ctx_free(&ctx);
}

/* A strip with a half turn is one-sided: it is cut across, and two-sided then. */
static void
moebius(void **state)
{
	enum { N = 12 };
	mr_v3 p[2 * N];
	mr_tri t[2 * N];
	mr_ctx ctx;
	repaired r;

	(void)state;
	for (uint32_t i = 0; i < N; i++) {
		double a = 2 * MR_PI * i / N;
		uint32_t j = (i + 1) % N, low = 2 * i, high = low + 1, next = 2 * j, above = next + 1;
		for (int side = 0; side < 2; side++) {
			double w = side ? 0.2 : -0.2;
			p[2 * i + (uint32_t)side] = mr_vec(
			    (1 + w * cos(a / 2)) * cos(a), (1 + w * cos(a / 2)) * sin(a), w * sin(a / 2));
		}
		if (j == 0) {
			next = 1;
			above = 0;
		}
		t[2 * i] = (mr_tri){ { low, next, high } };
		t[2 * i + 1] = (mr_tri){ { high, next, above } };
	}
	mr_ctx_init(&ctx, 1);
	r = repair(&ctx, p, 2 * N, t, 2 * N);
	assert_int_equal(r.r.cut_edges, 1);
	assert_int_equal(r.r.split_vertices, 2);
	assert_int_equal(border(&ctx, &r.m), 2 * N + 2);
	mr_ctx_free(&ctx);
}

/* Any triangles at all. */
static void
soup(void **state)
{
	mr_random r = { 8 };

	(void)state;
	for (int round = 0; round < 400; round++) {
		mr_ctx ctx;
		size_t nv = 4 + mr_random_bits(&r) % 12, nf = 1 + mr_random_bits(&r) % 60, proper = 0;
		mr_v3 p[16];
		mr_tri t[60];
		for (size_t i = 0; i < nv; i++)
			p[i] = mr_vec(mr_random_real(&r), mr_random_real(&r), mr_random_real(&r));
		for (size_t f = 0; f < nf; f++) {
			for (int k = 0; k < 3; k++)
				t[f].v[k] = (uint32_t)(mr_random_bits(&r) % nv);
			proper += t[f].v[0] != t[f].v[1] && t[f].v[1] != t[f].v[2] && t[f].v[2] != t[f].v[0];
		}
		if (proper == 0)
			continue;
		mr_ctx_init(&ctx, 1);
		repair(&ctx, p, nv, t, nf);
		mr_ctx_free(&ctx);
	}
}

static void
weld_equal(void **state)
{
	static const mr_v3 p[] = { { 1, 2, 3 }, { 0.0, 0, 0 }, { 1, 2, 3 }, { -0.0, 0, -0.0 },
		{ 1, 2, 3.0000000000000004 } };
	static const uint32_t expected[] = { 0, 1, 0, 1, 2 };
	uint32_t map[5];
	size_t n;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_weld(&ctx, p, 5, 0, map, &n);
	assert_int_equal(n, 3);
	assert_memory_equal(map, expected, sizeof map);
	mr_weld(&ctx, p, 0, 0, map, &n);
	assert_int_equal(n, 0);
	mr_ctx_free(&ctx);
}

/* The same as trying all pairs, in order. */
static void
weld_within(void **state)
{
	enum { N = 600 };
	static mr_v3 p[N];
	static uint32_t map[N], expected[N];
	mr_random r = { 9 };

	(void)state;
	for (int round = 0; round < 60; round++) {
		double eps = round % 3 == 0 ? 0.3 : round % 3 == 1 ? 0.05 : 0.01;
		size_t count = 0, n;
		mr_ctx ctx;
		for (size_t i = 0; i < N; i++) {
			uint32_t best = MR_NONE;
			p[i] = mr_vec(mr_random_real(&r) - 0.5, mr_random_real(&r) - 0.5,
			    round < 30 ? 0 : mr_random_real(&r) - 0.5);
			for (size_t j = 0; j < i && best == MR_NONE; j++) {
				bool first = true; /* of its number: it stands for itself */
				for (size_t k = 0; k < j; k++)
					first &= expected[k] != expected[j];
				if (first && mr_norm2(mr_sub(p[j], p[i])) <= eps * eps)
					best = (uint32_t)j;
			}
			expected[i] = best == MR_NONE ? (uint32_t)count++ : expected[best];
		}
		mr_ctx_init(&ctx, 1);
		mr_weld(&ctx, p, N, eps, map, &n);
		assert_int_equal(n, count);
		assert_memory_equal(map, expected, sizeof map);
		mr_ctx_free(&ctx);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(nothing_to_do), cmocka_unit_test(turned_over),
		cmocka_unit_test(dropped), cmocka_unit_test(touching), cmocka_unit_test(moebius),
		cmocka_unit_test(soup), cmocka_unit_test(weld_equal), cmocka_unit_test(weld_within) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
