/* Flaws of a mesh that is remeshed, counted by brute force in the plane, and their repair. */
#include "remesh/flaws.h"
#include "remesh_scene.h"

/* Moves a share of the inner vertices, by as much as `way`, within z = const. */
static void
stir(scene *x, double share, double way, mr_random *r)
{
	for (uint32_t v = 0; v < x->d.nv; v++)
		if (x->d.kind[v] == MR_SMOOTH && mr_random_real(r) < share) {
			x->d.p[v].x += way * (2 * mr_random_real(r) - 1);
			x->d.p[v].y += way * (2 * mr_random_real(r) - 1);
		}
}

/* In the plane, by signs alone. */
static bool
flipped(const mr_dyn *d, uint32_t f)
{
	return !mr_dyn_face_dead(d, f) && mr_dyn_cross(d, d->p, f).z < 0;
}

static bool
folded(const mr_dyn *d, uint32_t h)
{
	uint32_t g = d->twin[h];

	return g != MR_NONE && mr_dyn_cross(d, d->p, h / 3).z * mr_dyn_cross(d, d->p, g / 3).z < 0;
}

static size_t
count(const scene *x)
{
	mr_flaws n = mr_flaws_count(&ctx, &x->d, &x->s);

	return n.flipped + n.folded;
}

static void
sound_surfaces_have_none(void **state)
{
	static const mr_solid solids[] = { MR_SPHERE, MR_TORUS, MR_CUBE, MR_PLANE, MR_CYLINDER, MR_KNOT,
		MR_BOXES };

	(void)state;
	for (size_t i = 0; i < sizeof solids / sizeof *solids; i++) {
		scene x;
		set_up(&x, shape(solids[i], 1000), 180);
		assert_int_equal(count(&x), 0);
	}
}

/* Flipped faces and folded edges. */
static unsigned
total(const mr_dyn *d)
{
	unsigned n = 0;

	for (uint32_t f = 0; f < d->nf; f++)
		n += flipped(d, f);
	for (uint32_t h = 0; h < 3 * d->nf; h++)
		n += !mr_dyn_face_dead(d, h / 3) && h < d->twin[h] && folded(d, h);
	return n;
}

/* A face against the plane is flipped, an edge between two of other sides folded: whatever counts them. */
static void
flaws_in_the_plane_are_those_of_signs(void **state)
{
	mr_random r = { 1 };
	size_t all = 0;

	(void)state;
	for (int k = 0; k < 12; k++) {
		scene x;
		set_up(&x, lattice(12), 180);
		stir(&x, 0.05 * (k + 1), 1.5, &r);
		assert_int_equal(count(&x), total(&x.d));
		all += total(&x.d);
	}
	assert_true(all > 1000);
}

typedef struct census {
	long euler;
	size_t boundary, flawed;
} census;

static census
count_all(scene *x)
{
	long vertices = 0, faces = 0, halves = 0;
	census c = { 0 };

	c.flawed = count(x);
	for (size_t v = 0; v < x->d.nv; v++)
		vertices += x->d.kind[v] != MR_DEAD;
	for (uint32_t h = 0; h < 3 * x->d.nf; h++) {
		if (mr_dyn_face_dead(&x->d, h / 3))
			continue;
		faces += h % 3 == 0;
		halves += x->d.twin[h] == MR_NONE ? 2 : 1;
		c.boundary += x->d.twin[h] == MR_NONE;
		assert_true(x->d.twin[h] == MR_NONE || x->d.twin[x->d.twin[h]] == h);
	}
	c.euler = vertices - halves / 2 + faces;
	return c;
}

/* Vertices thrown over their neighbours come back: few flaws are left, in the end none; rim and topology are
 * what they were. */
static void
what_is_tangled_is_mended(void **state)
{
	(void)state;
	for (uint64_t seed = 1; seed <= 16; seed++) {
		bool plane = seed % 2;
		mr_random r = { seed };
		census before, after;
		size_t tangled;
		scene x;
		set_up(&x, plane ? lattice(20) : shape(MR_TORUS, 800), 180);
		before = count_all(&x);
		assert_int_equal(before.flawed, 0);
		for (uint32_t v = 0; v < x.d.nv; v++)
			if (x.d.kind[v] == MR_SMOOTH && mr_random_real(&r) < 0.1) {
				mr_v3 way = random_vector(&r);
				mr_closest c;
				way.z *= plane ? 0 : 1;
				c = mr_remesh_place(&x.s, &x.d, v, mr_axpy(4 * x.s.uniform, way, x.d.p[v]),
				    mr_dyn_normal_around(&x.d, v));
				x.d.p[v] = c.point;
				x.d.at[v] = c.at.face;
			}
		tangled = count_all(&x).flawed;
		assert_true(tangled > 20);
		mr_mend_flaws(&ctx, &x.d, &x.s);
		after = count_all(&x);
		assert_int_equal(after.flawed, 0);
		assert_int_equal(after.euler, before.euler);
		assert_int_equal(after.boundary, before.boundary);
		for (uint32_t f = 0; f < x.d.nf && plane; f++)
			assert_true(mr_dyn_face_dead(&x.d, f) || mr_dyn_cross(&x.d, x.d.p, f).z >= 0);
		mr_ctx_free(&ctx);
	}
}

/* A tip that is where it should not be gives way. */
static void
a_tip_gives_way(void **state)
{
	enum { N = 10, V = (N + 1) * 5 + 5 };
	scene x;

	(void)state;
	set_up(&x, lattice(N), 180);
	x.d.kind[V] = MR_CORNER;
	x.d.at[V] = x.d.out[V];
	x.d.p[V].x += 3.3;
	mr_mend_flaws(&ctx, &x.d, &x.s);
	assert_int_equal(count(&x), 0);
}

/* A sound mesh is left alone, bit for bit. */
static void
what_is_sound_stays(void **state)
{
	scene x;

	(void)state;
	set_up(&x, shape(MR_KNOT, 1500), 180);
	mr_mend_flaws(&ctx, &x.d, &x.s);
	assert_memory_equal(x.d.p, x.m.p, x.m.nv * sizeof *x.m.p);
	assert_memory_equal(x.d.v, x.m.t, x.m.nf * sizeof *x.m.t);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(sound_surfaces_have_none, setup, teardown),
		cmocka_unit_test_setup_teardown(flaws_in_the_plane_are_those_of_signs, setup, teardown),
		cmocka_unit_test_setup_teardown(what_is_tangled_is_mended, setup, teardown),
		cmocka_unit_test_setup_teardown(a_tip_gives_way, setup, teardown),
		cmocka_unit_test_setup_teardown(what_is_sound_stays, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
