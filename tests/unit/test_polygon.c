/* Polygons into triangles: every edge once, no triangle turned over, the area kept; convex, concave,
 * straight, degenerate. */
#include "base/random.h"
#include "mesh/polygon.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static mr_v3
lifted(double x, double y, int plane)
{
	switch (plane) {
	case 0:
		return mr_vec(x, y, 1);
	case 1:
		return mr_vec(x, -2, y);
	case 2:
		return mr_vec(3, x, y);
	default:
		return mr_vec(x + 1e3, 0.3 * x - y, 0.2 * x + 0.7 * y);
	}
}

static mr_v3
vector_area(const mr_v3 *p, const uint32_t *c, size_t n)
{
	mr_v3 sum = { 0, 0, 0 };

	for (size_t i = 1; i + 1 < n; i++)
		sum = mr_add(sum, mr_cross(mr_sub(p[c[i]], p[c[0]]), mr_sub(p[c[i + 1]], p[c[0]])));
	return sum;
}

/* Each edge of the polygon is in one triangle, in its direction; every other edge in two, once in each. */
static void
check_edges(size_t n, const mr_tri *t)
{
	enum { MOST = 512 };
	static signed char used[MOST][MOST];

	if (n > MOST)
		return;
	memset(used, 0, sizeof used);
	for (size_t f = 0; f + 2 < n; f++)
		for (int k = 0; k < 3; k++)
			used[t[f].v[k]][t[f].v[(k + 1) % 3]]++;
	for (size_t i = 0; i < n; i++)
		for (size_t j = 0; j < n; j++) {
			bool forward = j == (i + 1) % n, backward = i == (j + 1) % n;
			assert_true(used[i][j] <= 1);
			if (forward)
				assert_int_equal(used[i][j], 1);
			else if (backward)
				assert_int_equal(used[i][j], 0);
			else
				assert_int_equal(used[i][j], used[j][i]);
		}
}

/* Corners x, y in order; a simple polygon gives triangles of positive area along its normal that add up to
 * its own. */
static void
check(const double (*xy)[2], size_t n, bool simple)
{
	mr_ctx ctx;

	mr_ctx_init(&ctx, 1);
	for (int plane = 0; plane < 8; plane++) {
		mr_v3 *p = MR_NEW(&ctx, n, mr_v3), normal;
		uint32_t *c = MR_NEW(&ctx, n, uint32_t);
		mr_tri *t = MR_NEW(&ctx, n - 2, mr_tri);
		double area = 0, whole;
		assert_true(p && c && t);
		for (size_t i = 0; i < n; i++) {
			size_t j = plane < 4 ? i : n - 1 - i; /* the other way round */
			p[i] = lifted(xy[j][0], xy[j][1], plane % 4);
			c[i] = (uint32_t)i;
		}
		mr_polygon_triangulate(&ctx, p, c, n, t);
		check_edges(n, t);
		normal = vector_area(p, c, n);
		whole = mr_norm(normal);
		for (size_t f = 0; simple && f < n - 2; f++) {
			double part = mr_dot(vector_area(p, t[f].v, 3), normal) / whole;
			assert_true(part > 0);
			area += part;
		}
		if (simple)
			assert_true(fabs(area - whole) <= 1e-9 * whole);
		mr_ctx_free(&ctx);
	}
}

#define CHECK(simple, ...)                                                                                   \
	do {                                                                                                 \
		const double xy[][2] = { __VA_ARGS__ };                                                      \
		check(xy, sizeof xy / sizeof *xy, simple);                                                   \
	} while (0)

static void
small(void **state)
{
	(void)state;
	CHECK(true, { 0, 0 }, { 1, 0 }, { 0, 1 });
	CHECK(true, { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 });
	CHECK(true, { 0, 0 }, { 4, 0 }, { 1, 1 }, { 0, 4 }); /* a dart */
	CHECK(true, { 1, 1 }, { 0, 4 }, { 0, 0 }, { 4, 0 }); /* from its reflex corner */
	CHECK(true, { 0, 4 }, { 0, 0 }, { 4, 0 }, { 1, 1 });
	CHECK(true, { 0, 0 }, { 1, 0 }, { 2, 0 }, { 0, 2 }); /* a straight corner */
	CHECK(true, { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 1 }, { 2, 2 }, { 1, 2 }, { 0, 2 },
	    { 0, 1 }); /* on every side */
	CHECK(true, { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2, 3 }, { 2, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 }); /* a U */
	CHECK(true, { 0, 0 }, { 5, 0 }, { 5, 3 }, { 4, 3 }, { 4, 1 }, { 3, 1 }, { 3, 3 }, { 2, 3 }, { 2, 1 },
	    { 1, 1 }, { 1, 3 }, { 0, 3 });
	CHECK(true, { 0, 0 }, { 10, 0 }, { 10, 10 }, { 0, 10 }, { 0, 1 }, { 9, 9 }, { 9, 1 }, { 0.5, 0.6 });
}

static void
not_simple(void **state)
{
	(void)state;
	CHECK(false, { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 }); /* a bow tie */
	CHECK(false, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 });
	CHECK(false, { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 1.5, 0 });   /* a line */
	CHECK(false, { 0, 3 }, { 2, -3 }, { -3, 1 }, { 3, 1 }, { -2, -3 }); /* a pentagram */
	CHECK(false, { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 0 }, { -2, 0 }, { -2, -2 });
}

enum { MOST = 400 };
static double xy[MOST][2];

/* Around a centre, at any distance: as concave as can be. */
static void
stars(void **state)
{
	mr_random r = { 5 };

	(void)state;
	for (int i = 0; i < 300; i++) {
		size_t n = 3 + mr_random_bits(&r) % (MOST - 3);
		for (size_t k = 0; k < n; k++) {
			double a = 2 * MR_PI * (double)k / (double)n,
			       d = n < 5 ? 1 : 0.1 + mr_random_real(&r);
			xy[k][0] = d * cos(a);
			xy[k][1] = d * sin(a);
		}
		check((const double(*)[2])xy, n, true);
	}
}

/* A strip wound up: half of its corners are reflex, and ears are few. */
static void
spiral(void **state)
{
	size_t half = MOST / 2;

	(void)state;
	for (size_t k = 0; k < half; k++) {
		double a = 0.2 * (double)k, d = 1 + 0.1 * a;
		xy[k][0] = d * cos(a);
		xy[k][1] = d * sin(a);
		xy[MOST - 1 - k][0] = (d + 0.3) * cos(a);
		xy[MOST - 1 - k][1] = (d + 0.3) * sin(a);
	}
	check((const double(*)[2])xy, MOST, true);
}

static double big[8000][2];

/* Many corners: combs with teeth, in reasonable time; and many that cross, which must end, too. */
static void
many(void **state)
{
	size_t n = sizeof big / sizeof *big;
	mr_random r = { 6 };

	(void)state;
	for (size_t k = 0; k + 2 < n; k++) {
		big[k][0] = (double)(n - k) / 1000;
		big[k][1] = k % 2 ? 0.5 + mr_random_real(&r) : 50;
	}
	big[n - 2][0] = 0, big[n - 2][1] = 0;
	big[n - 1][0] = (double)n / 1000, big[n - 1][1] = 0;
	check((const double(*)[2])big, n, true);
	for (size_t k = 0; k < n / 10; k++) {
		big[k][0] = mr_random_real(&r);
		big[k][1] = mr_random_real(&r);
	}
	check((const double(*)[2])big, n / 10, false);
}

/* The polygons of faces of so many corners each, numbered as they come; checks that they are found again. */
static void
check_found(const mr_v3 *p, const uint32_t *corner, const size_t *size, size_t faces)
{
	mr_polygons found;
	uint32_t number[256];
	mr_tri t[256], *at = t;
	const uint32_t *c = corner;
	mr_ctx ctx;

	mr_ctx_init(&ctx, 1);
	for (size_t f = 0; f < faces; c += size[f++]) {
		mr_polygon_triangulate(&ctx, p, c, size[f], at);
		for (size_t i = 0; i < size[f] - 2; i++, at++) {
			number[at - t] = (uint32_t)f;
			for (int k = 0; k < 3; k++)
				at->v[k] = c[at->v[k]];
		}
	}
	mr_polygons_find(&ctx, t, (size_t)(at - t), number, &found);
	assert_int_equal(found.count, faces);
	assert_int_equal(found.broken, 0);
	for (size_t f = 0, first = 0; f < faces; first += size[f++]) {
		assert_int_equal(mr_polygon_begin(&found, f), first);
		for (size_t i = first; i < first + size[f]; i++)
			assert_int_equal(
			    t[mr_polygon_corner(&found, i) / 3].v[mr_polygon_corner(&found, i) % 3],
			    corner[i]);
	}
	mr_ctx_free(&ctx);
}

/* Polygons come back from their triangles: from each corner on, concave, beside each other. */
static void
found_again(void **state)
{
	static const mr_v3 p[] = { { 0, 0, 0 }, { 9, 0, 0 }, { 9, 9, 0 }, { 0, 9, 0 }, { 3, 3, 0 },
		{ 3, 6, 0 }, { 6, 6, 0 }, { 6, 3, 0 } };
	static const uint32_t dart[] = { 0, 1, 7, 2 };
	static const size_t sizes[] = { 4, 3, 4 };
	uint32_t c[32];

	(void)state;
	for (size_t from = 0; from < 4; from++) {
		for (size_t i = 0; i < 4; i++)
			c[i] = dart[(from + i) % 4];
		check_found(p, c, &sizes[0], 1);
		memcpy(c + 4, (uint32_t[]){ 4, 5, 6, 0, 7, 1, 2 }, 7 * sizeof *c);
		check_found(p, c, sizes, 3);
	}
}

/* What is a polygon no more comes as triangles: one with a vertex inside, one in two parts. */
static void
broken_ones(void **state)
{
	static const mr_tri t[] = { { { 0, 1, 4 } }, { { 1, 2, 4 } }, { { 2, 3, 4 } }, { { 3, 0, 4 } },
		{ { 0, 1, 2 } }, { { 5, 6, 7 } }, { { 0, 1, 2 } }, { { 0, 2, 3 } } };
	static const uint32_t number[] = { 9, 9, 9, 9, 3, 3, 4, 4 };
	mr_polygons found;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_polygons_find(&ctx, t, 8, number, &found);
	assert_int_equal(found.count, 7);
	assert_int_equal(found.broken, 2);
	assert_int_equal(found.most, 4);
	assert_int_equal(mr_polygon_begin(&found, 7) - mr_polygon_begin(&found, 6), 4);
	mr_polygons_find(&ctx, t, 8, NULL, &found);
	assert_int_equal(found.count, 8);
	assert_int_equal(mr_polygon_corner(&found, 23), 23);
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(small), cmocka_unit_test(not_simple),
		cmocka_unit_test(stars), cmocka_unit_test(spiral), cmocka_unit_test(many),
		cmocka_unit_test(found_again), cmocka_unit_test(broken_ones) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
