/* Exact signs against integer arithmetic, and triangles against another way to find what they share. */
#include "base/random.h"
#include "space/predicates.h"
#include "space/self_intersect.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

__extension__ typedef __int128 wide;

static double
digit(mr_random *r, uint64_t n)
{
	return (double)(mr_random_bits(r) % n);
}

static mr_v3
lattice(mr_random *r, uint64_t n)
{
	return mr_vec(digit(r, n), digit(r, n), digit(r, n));
}

static int
sign_by_integers(mr_v3 a, mr_v3 b, mr_v3 c, mr_v3 d)
{
	wide ux = (wide)a.x - (wide)d.x, uy = (wide)a.y - (wide)d.y, uz = (wide)a.z - (wide)d.z;
	wide vx = (wide)b.x - (wide)d.x, vy = (wide)b.y - (wide)d.y, vz = (wide)b.z - (wide)d.z;
	wide wx = (wide)c.x - (wide)d.x, wy = (wide)c.y - (wide)d.y, wz = (wide)c.z - (wide)d.z;
	wide det = uz * (vx * wy - wx * vy) + vz * (wx * uy - ux * wy) + wz * (ux * vy - vx * uy);

	return (det < 0) - (det > 0);
}

/* Points that lie in a plane, or one unit off it, in coordinates of forty bits. */
static void
signs_are_exact(void **state)
{
	const uint64_t most = (uint64_t)1 << 38;
	mr_random r = { 42 };
	size_t zeros = 0;

	(void)state;
	for (int k = 0; k < 200000; k++) {
		mr_v3 a = lattice(&r, most), u = lattice(&r, most >> 9), v = lattice(&r, most >> 9);
		mr_v3 b = mr_add(a, u), c = mr_add(a, v);
		mr_v3 d = mr_axpy(digit(&r, 200), u, mr_axpy(digit(&r, 200), v, a));
		if (k % 3 == 1)
			d.z += 1;
		if (k % 3 == 2)
			d = lattice(&r, most);
		int s = mr_orient3d(a, b, c, d);
		zeros += s == 0;
		assert_int_equal(s, sign_by_integers(a, b, c, d));
		assert_int_equal(s, -mr_orient3d(b, a, c, d));
		assert_int_equal(s, -mr_orient3d(a, b, d, c));
		mr_v3 flat[4] = { a, b, c, d };
		for (int i = 0; i < 4; i++)
			flat[i].z = 0;
		mr_v3 apex = mr_vec(0, 0, 1);
		assert_int_equal(
		    mr_orient2d(flat[0], flat[1], flat[3], 2), mr_orient3d(flat[0], flat[1], flat[3], apex));
	}
	assert_true(zeros > 60000);
}

/* Fractions, whose differences are not exact: a plane through multiples, a tenth of a unit in the last place
 * off it. */
static void
signs_are_exact_with_tails(void **state)
{
	mr_random r = { 7 };

	(void)state;
	for (int k = 0; k < 20000; k++) {
		double x = mr_random_real(&r), y = mr_random_real(&r), z = 1e-20 * mr_random_real(&r);
		mr_v3 a = { 0, 0, 1 }, b = { 1, 0, 1 }, c = { 0, 1, 1 }, d = { x, y, 1 };
		assert_int_equal(mr_orient3d(a, b, c, d), 0);
		d.z = nextafter(1, 2);
		assert_int_equal(mr_orient3d(a, b, c, d), 1);
		/* the plane z = 0 through points far apart in scale */
		mr_v3 e = { x, y, 0 }, f = { 1e20 * y, x, 0 }, g = { x, 1e-20, 0 }, h = { y, x, z };
		int turn = mr_orient2d(e, f, g, 2);
		assert_int_equal(mr_orient3d(e, f, g, h), z > 0 ? turn : 0);
		/* diagonal plane x = y */
		mr_v3 p = { x, x, y }, q = { 1e10 * y, 1e10 * y, x }, s = { z, z, 1 },
		      t = { x / 3, x / 3, y };
		assert_int_equal(mr_orient3d(p, q, s, t), 0);
		t.y = nextafter(t.y, 2);
		assert_int_equal(mr_orient3d(p, q, s, t), -mr_orient3d(q, p, s, t));
		assert_int_not_equal(mr_orient3d(p, q, s, t), 0);
	}
}

static const double NEAR = 1e-9; /* lattice points of a few units are farther apart */

static double
distance(mr_v3 q, const mr_v3 t[3])
{
	return sqrt(mr_triangle_closest(q, t[0], t[1], t[2]).dist2);
}

/* The corners that p and q share, the last repeated to make a (degenerate) triangle of them. */
static int
shared_corners(const mr_v3 p[3], const mr_v3 q[3], mr_v3 out[3])
{
	int n = 0;

	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			if (mr_dist(p[i], q[j]) == 0)
				out[n++] = p[i];
	for (int i = n; i > 0 && i < 3; i++)
		out[i] = out[n - 1];
	return n;
}

/* Where x lies in both triangles and not in what they share. */
static bool
proves(mr_v3 x, const mr_v3 p[3], const mr_v3 q[3], int n, const mr_v3 shared[3])
{
	return distance(x, p) < NEAR && distance(x, q) < NEAR && (n == 0 || distance(x, shared) > NEAR);
}

/* Nearest point of the line a b to the line c d; false where they are parallel. */
static bool
line_crossing(mr_v3 a, mr_v3 b, mr_v3 c, mr_v3 d, mr_v3 *x)
{
	mr_v3 u = mr_sub(b, a), v = mr_sub(d, c), w = mr_sub(a, c);
	double uu = mr_norm2(u), uv = mr_dot(u, v), vv = mr_norm2(v), det = uu * vv - uv * uv;

	if (det < NEAR)
		return false;
	*x = mr_axpy((uv * mr_dot(v, w) - vv * mr_dot(u, w)) / det, u, a);
	return true;
}

/* The common part is convex: its corners are corners, crossings of edges, or crossings of an edge and a face.
 */
static bool
intersect_by_points(const mr_v3 p[3], const mr_v3 q[3])
{
	mr_v3 shared[3], x;
	int n = shared_corners(p, q, shared);

	if (n == 3)
		return true;
	for (int i = 0; i < 3; i++) {
		if (proves(p[i], p, q, n, shared) || proves(q[i], p, q, n, shared))
			return true;
		for (int j = 0; j < 3; j++)
			if (line_crossing(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3], &x) &&
			    proves(x, p, q, n, shared))
				return true;
		for (int side = 0; side < 2; side++) {
			const mr_v3 *s = side ? q : p, *t = side ? p : q;
			mr_v3 normal = mr_cross(mr_sub(t[1], t[0]), mr_sub(t[2], t[0]));
			mr_v3 d = mr_sub(s[(i + 1) % 3], s[i]);
			double along = mr_dot(normal, d);
			if (fabs(along) < NEAR)
				continue;
			x = mr_axpy(mr_dot(normal, mr_sub(t[0], s[i])) / along, d, s[i]);
			if (proves(x, p, q, n, shared))
				return true;
		}
	}
	return false;
}

static bool
flat(const mr_v3 t[3])
{
	return mr_norm(mr_cross(mr_sub(t[1], t[0]), mr_sub(t[2], t[0]))) == 0;
}

static void
triangles_equal_a_search(void **state)
{
	mr_random r = { 17 };
	size_t yes[4] = { 0 }, no[4] = { 0 };

	(void)state;
	for (int k = 0; k < 300000; k++) {
		mr_v3 p[3], q[3], shared[3];
		uint64_t n = 2 + mr_random_bits(&r) % 4;
		for (int i = 0; i < 3; i++) {
			p[i] = lattice(&r, n);
			q[i] = lattice(&r, n);
			if (k % 3 == 0)
				p[i].z = q[i].z = 0;
		}
		for (uint64_t i = 0; i < mr_random_bits(&r) % 4; i++)
			q[i] = p[(i + n) % 3];
		if (flat(p) || flat(q))
			continue;
		bool expected = intersect_by_points(p, q);
		(expected ? yes : no)[shared_corners(p, q, shared)]++;
		assert_int_equal(mr_triangles_intersect(p, q), expected);
		assert_int_equal(mr_triangles_intersect(q, p), expected);
	}
	for (int n = 0; n < 3; n++)
		assert_true(yes[n] > 1000 && no[n] > 1000);
}

/* All pairs of a surface against a loop over all pairs. */
static void
count_equals_a_loop(void **state)
{
	mr_ctx ctx;
	mr_random r = { 23 };
	enum { N = 400, V = 300 };
	mr_v3 p[V];
	mr_tri t[N];

	(void)state;
	mr_ctx_init(&ctx, 2);
	for (int round = 0; round < 7; round++) {
		for (int i = 0; i < V; i++)
			p[i] = lattice(&r, round % 2 ? 5 : 1000);
		for (int f = 0; f < N; f++)
			for (int i = 0; i < 3; i++)
				t[f].v[i] = (uint32_t)(mr_random_bits(&r) % V);
		for (int f = 0; round > 4 && f < N; f++) /* fans of all, or around two vertices */
			t[f].v[f % 3] = (uint32_t)(round == 6 && f % 4 == 0);
		for (int f = 20; round > 2 && f < N; f += 3) { /* some many times, turned */
			mr_tri a = t[f % 2];
			t[f] = (mr_tri){ { a.v[f % 5 % 3], a.v[(f % 5 + 1) % 3], a.v[(f % 5 + 2) % 3] } };
		}
		mr_mesh m = { "mesh", p, t, V, N };
		mr_bvh *bvh;
		size_t count, again, expected = 0;
		bool crosses[N] = { false }, found[N];
		for (size_t f = 0; f < N; f++)
			for (size_t g = f + 1; g < N; g++) {
				mr_v3 a[3] = { p[t[f].v[0]], p[t[f].v[1]], p[t[f].v[2]] };
				mr_v3 b[3] = { p[t[g].v[0]], p[t[g].v[1]], p[t[g].v[2]] };
				if (flat(a) || flat(b) || !mr_triangles_intersect(a, b))
					continue;
				expected++;
				crosses[f] = crosses[g] = true;
			}
		mr_bvh_build(&ctx, &m, &bvh);
		mr_self_intersections(&ctx, bvh, &m, NULL, &count);
		mr_self_intersections(&ctx, bvh, &m, found, &again);
		assert_int_equal(count, expected);
		assert_int_equal(again, expected);
		assert_memory_equal(found, crosses, sizeof found);
		assert_true(count > 100);
	}
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(signs_are_exact),
		cmocka_unit_test(signs_are_exact_with_tails),
		cmocka_unit_test(triangles_equal_a_search),
		cmocka_unit_test(count_equals_a_loop),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
