/* The hierarchy of triangles against loops over all faces, bit for bit. */
#include "base/random.h"
#include "space/bvh.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static double
uniform(mr_random *r)
{
	return 2 * mr_random_real(r) - 1;
}

static mr_v3
random_point(mr_random *r, double size)
{
	return mr_vec(size * uniform(r), size * uniform(r), size * uniform(r));
}

/* A soup of n triangles of every kind: fair, thin, flat to a line, to a point, doubled, at `offset`. */
static mr_mesh
soup(mr_ctx *ctx, size_t n, double size, mr_v3 offset, uint64_t seed)
{
	mr_random r = { seed };
	mr_v3 *p = MR_NEW(ctx, 3 * n, mr_v3);
	mr_tri *t = MR_NEW(ctx, n, mr_tri);

	assert_non_null(p);
	assert_non_null(t);
	for (size_t f = 0; f < n; f++) {
		mr_v3 c = random_point(&r, 10 * size);
		for (size_t i = 0; i < 3; i++) {
			p[3 * f + i] = mr_add(offset, mr_add(c, random_point(&r, size)));
			t[f].v[i] = (uint32_t)(3 * f + i);
		}
		if (f % 7 == 1)
			p[3 * f + 2] = mr_lerp(0.3, p[3 * f], p[3 * f + 1]);
		if (f % 7 == 2)
			p[3 * f + 2] = mr_axpy(
			    1e-9, random_point(&r, size), mr_lerp(0.3, p[3 * f], p[3 * f + 1]));
		if (f % 7 == 3)
			p[3 * f + 1] = p[3 * f + 2] = p[3 * f];
		if (f % 7 == 4)
			t[f] = t[f - 4];
	}
	return (mr_mesh){ "soup", p, t, 3 * n, n };
}

/* A grid over the unit square, all vertices shared. */
static mr_mesh
grid(mr_ctx *ctx, uint32_t n)
{
	size_t row = n + 1u;
	mr_v3 *p = MR_NEW(ctx, row * row, mr_v3);
	mr_tri *t = MR_NEW(ctx, 2 * (size_t)n * n, mr_tri);
	size_t f = 0;

	assert_non_null(p);
	assert_non_null(t);
	for (uint32_t j = 0; j <= n; j++)
		for (uint32_t i = 0; i <= n; i++)
			p[j * row + i] = mr_vec(
			    (double)i / n, (double)j / n, 0.01 * (double)((7 * i + 3 * j) % 5));
	for (uint32_t j = 0; j < n; j++)
		for (uint32_t i = 0; i < n; i++) {
			uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
			t[f++] = (mr_tri){ { a, b, d } };
			t[f++] = (mr_tri){ { a, d, c } };
		}
	return (mr_mesh){ "grid", p, t, row * row, f };
}

static mr_closest
closest_by_loop(const mr_mesh *m, mr_v3 q)
{
	mr_closest best = { .at.face = MR_NONE, .dist2 = INFINITY };

	for (uint32_t f = 0; f < m->nf; f++) {
		mr_closest c = mr_face_closest(m, f, q);
		if (c.dist2 < best.dist2)
			best = c;
	}
	return best;
}

static void
check_queries(mr_ctx *ctx, const mr_mesh *m, double size, mr_v3 offset, size_t count)
{
	mr_random r = { 99 };
	mr_bvh *bvh;

	mr_bvh_build(ctx, m, &bvh);
	for (size_t i = 0; i < count; i++) {
		mr_v3 q = i % 3 == 0 ? m->p[mr_random_bits(&r) % m->nv]
		                     : mr_add(offset, random_point(&r, (i % 3 == 1 ? 12 : 1e9) * size));
		mr_closest a = closest_by_loop(m, q), b = mr_bvh_closest(bvh, q);
		assert_int_equal(a.at.face, b.at.face);
		assert_memory_equal(&a.dist2, &b.dist2, sizeof a.dist2);
		assert_memory_equal(&a.point, &b.point, sizeof a.point);
		assert_int_equal(mr_bvh_closest_within(bvh, q, a.dist2).at.face, MR_NONE);
		if (a.dist2 > 0)
			assert_int_equal(
			    mr_bvh_closest_within(bvh, q, nextafter(a.dist2, INFINITY)).at.face, a.at.face);
	}
}

static void
closest_equals_a_loop(void **state)
{
	static const double sizes[] = { 1, 1e-30, 1e30, 1 };
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 2);
	for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
		mr_v3 offset = k == 3 ? mr_vec(4e6, -7e6, 1e3) : mr_vec(0, 0, 0);
		for (size_t n = 1; n < 4000; n = 3 * n + 1) {
			mr_mesh m = soup(&ctx, n, sizes[k], offset, n);
			check_queries(&ctx, &m, sizes[k], offset, 200);
			((mr_v3 *)m.p)[0].x = 1e12 * sizes[k]; /* one astray */
			check_queries(&ctx, &m, sizes[k], offset, 200);
		}
	}
	mr_mesh g = grid(&ctx, 30);
	check_queries(&ctx, &g, 0.1, mr_vec(0.5, 0.5, 0), 2000);
	mr_ctx_free(&ctx);
}

/* All faces in one place: the tree cannot split by position, and must not go deep. */
static void
equal_faces_are_found(void **state)
{
	mr_ctx ctx;
	mr_v3 p[3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
	mr_bvh *bvh;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_tri *t = MR_NEW(&ctx, 20000, mr_tri);
	for (size_t f = 0; f < 20000; f++)
		t[f] = (mr_tri){ { 0, 1, 2 } };
	mr_mesh m = { "same", p, t, 3, 20000 };
	mr_bvh_build(&ctx, &m, &bvh);
	mr_closest c = mr_bvh_closest(bvh, mr_vec(0.25, 0.25, 2));
	assert_int_equal(c.at.face, 0);
	assert_true(c.dist2 == 4);
	mr_mesh none = { "none", p, t, 3, 0 };
	mr_bvh_build(&ctx, &none, &bvh);
	assert_int_equal(mr_bvh_closest(bvh, p[0]).at.face, MR_NONE);
	mr_ctx_free(&ctx);
}

/* Faces whose corners are all at one place win nowhere against the first of them. */
static void
points_are_not_looked_at_each(void **state)
{
	enum { N = 3000 };
	mr_ctx ctx;
	mr_bvh *bvh;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_v3 *p = MR_NEW_ZERO(&ctx, N + 2, mr_v3);
	mr_tri *t = MR_NEW(&ctx, N, mr_tri);
	for (uint32_t f = 0; f < N; f++)
		t[f] = (mr_tri){ { f, f + 1, f + 2 } };
	mr_mesh m = { "points", p, t, N + 2, N };
	mr_bvh_build(&ctx, &m, &bvh);
	assert_int_equal(mr_bvh_closest(bvh, mr_vec(1, 2, 2)).at.face, 0);
	assert_true(mr_bvh_closest(bvh, mr_vec(1, 2, 2)).dist2 == 9);
	mr_ctx_free(&ctx);
}

/* From afar some face that is about as near as the nearest; near one of 1e29 sizes the nearest all the same.
 */
static void
all_sizes_have_a_nearest(void **state)
{
	mr_ctx ctx;
	mr_bvh *bvh;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = soup(&ctx, 2000, 0.2, mr_vec(0, 0, 0), 9);
	mr_bvh_build(&ctx, &m, &bvh);
	for (double far = 1e6; far < 1e30; far *= 1e3) {
		mr_v3 q = mr_mul(far, mr_vec(0.6, 0, -0.8));
		assert_true(fabs(sqrt(mr_bvh_closest(bvh, q).dist2) / far - 1) < 4 / far + 0x1p-35);
		assert_int_not_equal(mr_bvh_closest_within(bvh, q, 4 * far * far).at.face, MR_NONE);
		assert_int_equal(mr_bvh_closest_within(bvh, q, far * far / 4).at.face, MR_NONE);
	}
	((mr_v3 *)m.p)[m.t[0].v[0]] = mr_vec(1e29, 0, 0);
	check_queries(&ctx, &m, 4, mr_vec(0, 0, 0), 100);
	mr_ctx_free(&ctx);
}

/* The nearest point of a triangle: no point of a fine sampling is nearer, and it is where its coordinates
 * say. */
static void
triangle_closest_is_least(void **state)
{
	enum { FINE = 60 };
	mr_random r = { 5 };

	(void)state;
	for (int k = 0; k < 2000; k++) {
		mr_v3 a = random_point(&r, 1), b = random_point(&r, 1), c = random_point(&r, 1);
		mr_v3 q = random_point(&r, 2);
		if (k % 5 == 1)
			c = mr_lerp(uniform(&r), a, b);
		if (k % 5 == 2)
			c = mr_axpy(1e-7, c, mr_lerp(uniform(&r), a, b));
		if (k % 5 == 3)
			c = b;
		mr_closest best = mr_triangle_closest(q, a, b, c);
		assert_true(mr_dist(best.point, mr_bary_point(best.at.bary, a, b, c)) < 1e-14);
		assert_true(fabs(best.at.bary.x + best.at.bary.y + best.at.bary.z - 1) < 1e-14);
		assert_true(best.at.bary.x > -1e-12 && best.at.bary.y > -1e-12 && best.at.bary.z > -1e-12);
		for (int i = 0; i <= FINE; i++)
			for (int j = 0; i + j <= FINE; j++) {
				mr_v3 w = mr_vec(
				    (double)i / FINE, (double)j / FINE, (double)(FINE - i - j) / FINE);
				double d2 = mr_norm2(mr_sub(q, mr_bary_point(w, a, b, c)));
				assert_true(best.dist2 <= d2 + 1e-13);
			}
	}
}

/* Moeller, Trumbore 1997, in doubles: another way to the same hit. */
static double
hit_by_loop(const mr_mesh *m, mr_v3 o, mr_v3 d, uint32_t *face)
{
	double best = INFINITY;

	for (size_t f = 0; f < m->nf; f++) {
		mr_v3 a = m->p[m->t[f].v[0]], e1 = mr_sub(m->p[m->t[f].v[1]], a),
		      e2 = mr_sub(m->p[m->t[f].v[2]], a);
		mr_v3 h = mr_cross(d, e2), s = mr_sub(o, a), q = mr_cross(s, e1);
		double det = mr_dot(e1, h), u = mr_dot(s, h) / det, v = mr_dot(d, q) / det,
		       t = mr_dot(e2, q) / det;
		if (fabs(det) > 1e-9 && u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t < best) {
			best = t;
			*face = (uint32_t)f;
		}
	}
	return best;
}

static void
rays_equal_a_loop(void **state)
{
	mr_ctx ctx;
	mr_random r = { 3 };
	mr_bvh *bvh;
	size_t hits = 0;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = soup(&ctx, 1500, 1, mr_vec(0, 0, 0), 8);
	mr_bvh_build(&ctx, &m, &bvh);
	for (int k = 0; k < 3000; k++) {
		mr_v3 o = random_point(&r, 10), d = random_point(&r, 1);
		if (k % 4 == 0)
			d = k % 8 ? mr_vec(0, 0, -1) : mr_vec(1, 0, 0);
		mr_ray_hit hit;
		uint32_t face = MR_NONE;
		double t = hit_by_loop(&m, o, d, &face);
		bool found = mr_bvh_ray(bvh, o, d, 0, INFINITY, &hit);
		assert_int_equal(found, face != MR_NONE);
		if (!found)
			continue;
		hits++;
		assert_int_equal(hit.at.face, face);
		assert_true(fabs(hit.t - t) <= 1e-9 * fabs(t));
		assert_false(mr_bvh_ray(bvh, o, d, 0, 0.999 * t, &hit));
		assert_true(!mr_bvh_ray(bvh, o, d, 1.001 * t, INFINITY, &hit) || hit.t >= 1.001 * t);
	}
	assert_true(hits > 200);
	mr_ctx_free(&ctx);
}

/* Rays through the vertices and edge midpoints of a grid never slip through. */
static void
rays_do_not_slip_through(void **state)
{
	mr_ctx ctx;
	mr_random r = { 11 };
	mr_bvh *bvh;
	mr_ray_hit hit;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = grid(&ctx, 24);
	mr_bvh_build(&ctx, &m, &bvh);
	for (int k = 0; k < 20000; k++) {
		const uint32_t *v = m.t[mr_random_bits(&r) % m.nf].v;
		mr_v3 at = k % 2 ? m.p[v[0]] : mr_lerp(mr_random_real(&r), m.p[v[0]], m.p[v[1]]);
		mr_v3 o = mr_vec(0.5 + 0.4 * uniform(&r), 0.5 + 0.4 * uniform(&r), 5);
		if (at.x < 0.01 || at.x > 0.99 || at.y < 0.01 || at.y > 0.99)
			continue;
		assert_true(mr_bvh_ray(bvh, o, mr_sub(at, o), 0, INFINITY, &hit));
		assert_true(fabs(hit.t - 1) < 1e-9);
	}
	mr_ctx_free(&ctx);
}

static bool
count_face(void *arg, uint32_t face)
{
	size_t *sums = arg;

	sums[0]++;
	sums[1] += face;
	return true;
}

static mr_box
face_box(const mr_mesh *m, size_t f)
{
	mr_box b = mr_box_empty();

	for (int i = 0; i < 3; i++)
		mr_box_add(&b, m->p[m->t[f].v[i]]);
	return b;
}

static void
overlap_equals_a_loop(void **state)
{
	mr_ctx ctx;
	mr_random r = { 4 };
	mr_bvh *bvh;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_mesh m = soup(&ctx, 2000, 1, mr_vec(1e5, 0, 0), 21);
	mr_bvh_build(&ctx, &m, &bvh);
	for (int k = 0; k < 500; k++) {
		mr_box b = mr_box_empty();
		size_t loop[2] = { 0, 0 }, tree[2] = { 0, 0 };
		mr_box_add(&b, m.p[mr_random_bits(&r) % m.nv]);
		mr_box_add(&b, mr_add(b.min, random_point(&r, 4)));
		for (size_t f = 0; f < m.nf; f++) {
			mr_box c = face_box(&m, f);
			if (c.min.x <= b.max.x && c.max.x >= b.min.x && c.min.y <= b.max.y &&
			    c.max.y >= b.min.y && c.min.z <= b.max.z && c.max.z >= b.min.z)
				count_face(loop, (uint32_t)f);
		}
		assert_true(mr_bvh_overlap(bvh, b, count_face, tree));
		assert_memory_equal(loop, tree, sizeof loop);
	}
	mr_ctx_free(&ctx);
}

/* Large enough for several tasks: the answers do not depend on the number of threads. */
static void
threads_do_not_matter(void **state)
{
	mr_ctx one, four;
	mr_random r = { 12 };
	mr_bvh *a, *b;

	(void)state;
	mr_ctx_init(&one, 1);
	mr_ctx_init(&four, 4);
	mr_mesh m = soup(&one, 30000, 0.1, mr_vec(0, 0, 0), 77);
	mr_bvh_build(&one, &m, &a);
	mr_bvh_build(&four, &m, &b);
	for (int k = 0; k < 300; k++) {
		mr_v3 q = random_point(&r, 1);
		mr_closest x = mr_bvh_closest(a, q), y = mr_bvh_closest(b, q);
		assert_int_equal(x.at.face, y.at.face);
		assert_memory_equal(&x.point, &y.point, sizeof x.point);
	}
	mr_ctx_free(&one);
	mr_ctx_free(&four);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(closest_equals_a_loop),
		cmocka_unit_test(equal_faces_are_found),
		cmocka_unit_test(points_are_not_looked_at_each),
		cmocka_unit_test(all_sizes_have_a_nearest),
		cmocka_unit_test(triangle_closest_is_least),
		cmocka_unit_test(rays_equal_a_loop),
		cmocka_unit_test(rays_do_not_slip_through),
		cmocka_unit_test(overlap_equals_a_loop),
		cmocka_unit_test(threads_do_not_matter),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
