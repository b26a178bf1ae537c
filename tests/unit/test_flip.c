/* Flips: which are good, what they leave, and dislocations that glide until they meet. */
#include "remesh/blocks.h"
#include "remesh/flip.h"
#include "remesh_scene.h"

static int
excess(const mr_dyn *d, uint32_t v)
{
	return (int)mr_dyn_valence(d, v, MR_NONE) - (mr_dyn_on_boundary(d, v) ? 4 : 6);
}

static long
sum_of_squares(const mr_dyn *d)
{
	long sum = 0;

	for (uint32_t v = 0; v < d->nv; v++)
		sum += excess(d, v) * excess(d, v);
	return sum;
}

/* By how much the flip of h would lower the sum, counted from what it would be. */
static long
gain(const mr_dyn *d, uint32_t h)
{
	uint32_t v[4] = { d->v[h], mr_dyn_to(d, h), mr_dyn_apex(d, h), mr_dyn_apex(d, d->twin[h]) };
	long sum = 0;

	for (int i = 0; i < 4; i++) {
		int before = excess(d, v[i]), after = before + (i < 2 ? -1 : 1);
		sum += before * before - after * after;
	}
	return sum;
}

static bool
may_flip(const scene *x, uint32_t h)
{
	return x->d.twin[h] != MR_NONE && mr_dyn_can_flip(&x->d, h) && mr_flip_is_good(&x->d, h);
}

static mr_v3
area_vector(const mr_dyn *d)
{
	mr_v3 sum = { 0, 0, 0 };

	for (size_t f = 0; f < d->nf; f++)
		sum = mr_add(sum, mr_dyn_cross(d, d->p, f));
	return sum;
}

/* Two triangles at the edge from (-w, 0, 0) to (w, 0, 0), with these apexes. */
static bool
is_good(double w, mr_v3 c, mr_v3 e)
{
	mr_v3 p[4] = { { -w, 0, 0 }, { w, 0, 0 }, c, e };
	mr_tri t[2] = { { { 0, 1, 2 } }, { { 1, 0, 3 } } };
	scene x;

	set_up(&x, (mr_mesh){ "roof", p, t, 4, 2 }, 180);
	return mr_flip_is_good(&x.d, 0);
}

/* In the plane: where the quadrangle is convex, and its new halves are no needles. */
static void
a_flip_stays_in_its_quadrangle(void **state)
{
	mr_random r = { 1 };
	int good = 0, bad = 0;

	(void)state;
	for (int k = 0; k < 2000; k++) {
		mr_v3 u = random_vector(&r), v = random_vector(&r);
		mr_v3 c = mr_vec(6 * u.x, 3 * u.y + 1.6, 0), e = mr_vec(6 * v.x, 3 * v.y - 1.6, 0);
		mr_v3 a = mr_vec(-1, 0, 0), b = mr_vec(1, 0, 0);
		double at = c.x -
		            c.y * (e.x - c.x) / (e.y - c.y); /* where the new edge meets the old one's line */
		double worst = fmin(mr_dyn_shape(a, e, c), mr_dyn_shape(b, c, e));
		bool want = fabs(at) < 1 && worst > MR_NEEDLE;
		if (fabs(fabs(at) - 1) < 1e-9)
			continue;
		assert_int_equal(is_good(1, c, e), want);
		good += want;
		bad += !want;
	}
	assert_true(good > 300 && bad > 300);
}

/* Over a roof of half width w and pitch t the new faces are steep by atan(sin t / w): 60 degrees at most. */
static void
a_flip_over_a_roof_is_not_too_steep(void **state)
{
	(void)state;
	for (int k = 1; k < 60; k++) {
		double pitch = k * MR_PI / 120, w = 0.5, steep = atan2(sin(pitch), w) * 180 / MR_PI;
		mr_v3 c = mr_vec(0, cos(pitch), -sin(pitch)), e = mr_vec(0, -cos(pitch), -sin(pitch));
		if (fabs(steep - 60) > 0.1)
			assert_int_equal(is_good(w, c, e), steep < 60);
	}
}

/* Two triangles whose flip would fold one of the new ones onto the face beside it, at any of their four
 * sides. */
static void
a_flip_does_not_fold_what_is_beside(void **state)
{
	static const uint32_t side[4][2] = { { 2, 1 }, { 0, 2 }, { 3, 0 }, { 1, 3 } };

	(void)state;
	for (int k = 0; k < 4; k++)
		for (int folded = 0; folded < 2; folded++) {
			mr_v3 p[5] = { { -1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 } };
			mr_tri t[3] = { { { 0, 1, 2 } }, { { 1, 0, 3 } }, { { side[k][0], side[k][1], 4 } } };
			mr_v3 way = mr_add(p[side[k][0]], p[side[k][1]]); /* out of the square */
			scene x;
			p[4] = mr_axpy(folded ? 0.4 : 1, way, mr_vec(0, 0, 0.005));
			set_up(&x, (mr_mesh){ "flap", p, t, 5, 3 }, 180);
			assert_int_equal(mr_flip_is_good(&x.d, 0), !folded);
		}
}

/* Random good flips, then all that gain: nothing is left that would, and the surface is what it was. */
static void
what_gains_is_flipped(void **state)
{
	static const mr_solid solids[] = { MR_PLANE, MR_SPHERE, MR_TORUS, MR_BUMPY };

	(void)state;
	for (uint64_t seed = 1; seed < 9; seed++) {
		mr_random r = { seed };
		mr_v3 before;
		size_t flips, rounds = 0;
		scene x;
		set_up(&x, shape(solids[seed % 4], 1000), 180);
		for (int k = 0; k < 3000; k++) {
			uint32_t h = (uint32_t)(mr_random_bits(&r) % (3 * x.d.nf));
			if (may_flip(&x, h))
				mr_dyn_flip(&x.d, h);
		}
		before = area_vector(&x.d);
		do {
			long sum = sum_of_squares(&x.d);
			mr_regularize(&ctx, &x.d, 0, &flips);
			assert_true(sum_of_squares(&x.d) <= sum - 2 * (long)flips);
			assert_true(flips > 0 || sum_of_squares(&x.d) == sum);
			assert_true(++rounds < 50);
		} while (flips > 0);
		assert_true(rounds > 1);
		do { /* glides keep the sum but for their last flip */
			long sum = sum_of_squares(&x.d);
			mr_regularize(&ctx, &x.d, 8, &flips);
			assert_true(flips > 0 ? sum_of_squares(&x.d) < sum : sum_of_squares(&x.d) == sum);
		} while (flips > 0);
		for (uint32_t h = 0; h < 3 * x.d.nf; h++)
			assert_true(!may_flip(&x, h) || gain(&x.d, h) <= 0);
		assert_true(mr_dist(area_vector(&x.d), before) < 1e-10);
		assert_memory_equal(x.d.p, x.m.p, x.m.nv * sizeof *x.m.p);
		for (size_t f = 0; f < x.d.nf && seed % 4 == 0; f++)
			assert_true(mr_dyn_cross(&x.d, x.d.p, f).z > 0);
	}
}

/* In blocks, and between them: the same on any number of threads, and nearly all that gains. */
static void
blocks_are_flipped_alike_on_all_threads(void **state)
{
	uint32_t *first = NULL;

	(void)state;
	for (unsigned threads = 1; threads <= 4; threads++) {
		mr_random r = { 1 };
		size_t flips, left = 0;
		scene x;
		set_up(&x, shape(MR_SPHERE, 60000), 180);
		ctx.threads = threads;
		assert_int_equal(mr_blocks_divide(&ctx, &x.d), MR_OK);
		for (int k = 0; k < 100000; k++) {
			uint32_t h = (uint32_t)(mr_random_bits(&r) % (3 * x.d.nf));
			if (may_flip(&x, h))
				mr_dyn_flip(&x.d, h);
		}
		mr_regularize(&ctx, &x.d, 3, &flips);
		for (uint32_t h = 0; h < 3 * x.d.nf; h++)
			left += may_flip(&x, h) && gain(&x.d, h) > 0;
		assert_true(left < flips / 20);
		if (!first)
			first = test_malloc(3 * x.d.nf * sizeof *first);
		if (threads == 1)
			memcpy(first, x.d.v, 3 * x.d.nf * sizeof *first);
		assert_memory_equal(first, x.d.v, 3 * x.d.nf * sizeof *first);
		mr_ctx_free(&ctx);
		mr_ctx_init(&ctx, 1);
	}
	test_free(first);
}

enum { N = 16, ROW = N / 2 };

/* A lattice of squares, all with the same diagonals, which are both good; or its mirror image. */
static mr_mesh
squares(bool mirrored)
{
	mr_mesh m = lattice(N);
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	mr_tri *t = MR_NEW(&ctx, m.nf, mr_tri);

	assert_true(p && t);
	for (uint32_t v = 0; v < m.nv; v++) {
		p[v] = mr_vec(m.p[v].x - 0.5 * (v / (N + 1)), m.p[v].y, 0);
		p[v].x *= mirrored ? -1 : 1;
	}
	for (size_t f = 0; f < m.nf; f++)
		t[f] = mirrored ? (mr_tri){ { m.t[f].v[0], m.t[f].v[2], m.t[f].v[1] } } : m.t[f];
	m.p = p;
	m.t = t;
	return m;
}

/* The diagonal of rhomb i in the middle row of a lattice. */
static uint32_t
diagonal(const mr_dyn *d, uint32_t i)
{
	uint32_t a = (N + 1) * ROW + i + 1, b = (N + 1) * (ROW + 1) + i;

	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (d->v[h] == a && mr_dyn_to(d, h) == b)
			return h;
	fail();
	return MR_NONE;
}

/*
 * Flipped diagonals of a row leave a dislocation at either end: no flip gains but where they are next to one
 * another, and one glides to the other if its reach allows, which leaves the lattice.
 */
static void
dislocations_glide_until_they_meet(void **state)
{
	(void)state;
	for (uint32_t apart = 1; apart <= 6; apart++)
		for (unsigned reach = 0; reach <= 8; reach++) {
			long regular, sum;
			size_t flips;
			scene x;
			set_up(&x, squares(apart % 2), 180);
			regular = sum_of_squares(&x.d);
			for (uint32_t i = 0; i < apart; i++) {
				uint32_t h = diagonal(&x.d, 5 + i);
				assert_true(may_flip(&x, h));
				mr_dyn_flip(&x.d, h);
			}
			sum = sum_of_squares(&x.d);
			assert_int_equal(sum, regular + 4);
			mr_regularize(&ctx, &x.d, reach, &flips);
			if (apart == 1 || reach >= apart) {
				assert_int_equal(flips, apart);
				assert_int_equal(sum_of_squares(&x.d), regular);
			} else {
				assert_int_equal(flips, 0);
				assert_int_equal(sum_of_squares(&x.d), sum);
			}
			mr_ctx_free(&ctx);
		}
}

/* One that came in from the rim glides back there, from either side. */
static void
a_dislocation_leaves_where_it_came_in(void **state)
{
	(void)state;
	for (int side = 0; side < 4; side++)
		for (uint32_t in = 2; in <= 6; in++) {
			long regular;
			size_t flips;
			scene x;
			set_up(&x, squares(side / 2), 180);
			regular = sum_of_squares(&x.d);
			for (uint32_t i = 0; i < in; i++)
				mr_dyn_flip(&x.d, diagonal(&x.d, side % 2 ? N - 1 - i : i));
			assert_true(sum_of_squares(&x.d) > regular);
			mr_regularize(&ctx, &x.d, in, &flips);
			assert_int_equal(flips, in);
			assert_int_equal(sum_of_squares(&x.d), regular);
			mr_ctx_free(&ctx);
		}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(a_flip_stays_in_its_quadrangle, setup, teardown),
		cmocka_unit_test_setup_teardown(a_flip_over_a_roof_is_not_too_steep, setup, teardown),
		cmocka_unit_test_setup_teardown(a_flip_does_not_fold_what_is_beside, setup, teardown),
		cmocka_unit_test_setup_teardown(what_gains_is_flipped, setup, teardown),
		cmocka_unit_test_setup_teardown(blocks_are_flipped_alike_on_all_threads, setup, teardown),
		cmocka_unit_test_setup_teardown(dislocations_glide_until_they_meet, setup, teardown),
		cmocka_unit_test_setup_teardown(a_dislocation_leaves_where_it_came_in, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
