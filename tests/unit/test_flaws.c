/* Flaws of a mesh that is remeshed, counted by brute force in the plane, and their repair. */
#include "remesh/flaws.h"
#include "remesh/local_length.h"
#include "remesh/repair_flaws.h"
#include "remesh_scene.h"

#include <limits.h>

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

static bool
flawed(const mr_dyn *d, uint32_t f)
{
	return !mr_dyn_face_dead(d, f) &&
	       (flipped(d, f) || folded(d, 3 * f) || folded(d, 3 * f + 1) || folded(d, 3 * f + 2));
}

static bool
edge_at(const mr_dyn *d, uint32_t h, uint32_t v)
{
	return mr_dyn_has(d, h / 3, v) || (d->twin[h] != MR_NONE && mr_dyn_has(d, d->twin[h] / 3, v));
}

/* The flaws around v or u that are not around `but`. */
static unsigned
around(const mr_dyn *d, uint32_t v, uint32_t u, uint32_t but)
{
	unsigned n = 0;

	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (!mr_dyn_face_dead(d, h / 3) && d->twin[h] != MR_NONE && h < d->twin[h] && folded(d, h))
			n += (edge_at(d, h, v) || edge_at(d, h, u)) && !edge_at(d, h, but);
	for (uint32_t f = 0; f < d->nf; f++)
		n += flipped(d, f) && (mr_dyn_has(d, f, v) || mr_dyn_has(d, f, u)) && !mr_dyn_has(d, f, but);
	return n;
}

static mr_flaws
find(const scene *x, bool sure, size_t *count)
{
	mr_flaws w;

	mr_flaws_find(&ctx, &x->d, &x->s, sure, &w, count);
	return w;
}

static void
sound_surfaces_have_none(void **state)
{
	static const mr_solid solids[] = { MR_SPHERE, MR_TORUS, MR_CUBE, MR_PLANE, MR_CYLINDER, MR_KNOT,
		MR_BOXES };

	(void)state;
	for (size_t i = 0; i < sizeof solids / sizeof *solids; i++)
		for (int sure = 0; sure < 2; sure++) {
			size_t count = 99;
			scene x;
			set_up(&x, shape(solids[i], 1000), 180);
			find(&x, sure, &count);
			assert_int_equal(count, 0);
		}
}

/* A face against the plane is flipped, an edge between two of other sides folded: whatever counts them. */
static void
flaws_in_the_plane_are_those_of_signs(void **state)
{
	mr_random r = { 1 };
	size_t all = 0;

	(void)state;
	for (int k = 0; k < 12; k++) {
		bool sure = k % 2;
		size_t count, want = 0;
		mr_flaws w;
		scene x;
		set_up(&x, lattice(12), 180);
		stir(&x, 0.05 * (k + 1), 1.5, &r);
		w = find(&x, sure, &count);
		for (uint32_t f = 0; f < x.d.nf; f++) {
			assert_int_equal(mr_is_flawed(&w, f), flawed(&x.d, f));
			assert_int_equal(w.state[f], flawed(&x.d, f) ? MR_SUSPECT : MR_SOUND);
			want += flawed(&x.d, f);
		}
		assert_int_equal(count, want);
		all += want;
		for (uint32_t h = 0; h < 3 * x.d.nf; h += 5) {
			uint32_t a = x.d.v[h], b = mr_dyn_to(&x.d, h), g = x.d.twin[h];
			unsigned beside = 0;
			assert_int_equal(
			    mr_flaws_around(&w, a, MR_NONE, UINT_MAX), around(&x.d, a, a, MR_NONE));
			assert_int_equal(mr_flaws_around(&w, a, b, UINT_MAX), around(&x.d, a, a, b));
			for (unsigned most = 0; most < 4; most++) {
				unsigned n = around(&x.d, a, a, b);
				assert_int_equal(mr_flaws_around(&w, a, b, most), n < most ? n : most);
			}
			if (g == MR_NONE)
				continue;
			for (uint32_t e = 0; e < 3 * x.d.nf; e++)
				beside += x.d.twin[e] != MR_NONE && e < x.d.twin[e] && folded(&x.d, e) &&
				          (e / 3 == h / 3 || e / 3 == g / 3 || x.d.twin[e] / 3 == h / 3 ||
					      x.d.twin[e] / 3 == g / 3);
			beside += flipped(&x.d, h / 3);
			beside += flipped(&x.d, g / 3);
			assert_int_equal(mr_flaws_beside(&w, h), beside);
		}
	}
	assert_true(all > 1000);
}

/* Two ends count as what they are; at one spot, as the vertex that they become. */
static void
a_pair_counts_as_what_it_is_merged_into(void **state)
{
	mr_random r = { 2 };
	unsigned all = 0, merged = 0;

	(void)state;
	for (int k = 0; k < 300; k++) {
		uint32_t h, a, b;
		unsigned n;
		size_t count;
		uint8_t *mark;
		mr_flaws w;
		scene x;
		set_up(&x, lattice(7), 180);
		mark = MR_NEW_ZERO(&ctx, x.d.nv, uint8_t);
		stir(&x, 0.3, 1.2, &r);
		h = (uint32_t)(mr_random_bits(&r) % (3 * x.d.nf));
		a = x.d.v[h];
		b = mr_dyn_to(&x.d, h);
		if (x.d.kind[a] != MR_SMOOTH || x.d.kind[b] != MR_SMOOTH ||
		    !mr_dyn_can_collapse(&x.d, h, mark))
			continue;
		w = find(&x, true, &count);
		assert_int_equal(mr_flaws_of_pair(&w, h, UINT_MAX), around(&x.d, a, b, MR_NONE));
		x.d.p[a] = x.d.p[b];
		n = mr_flaws_of_pair(&w, h, UINT_MAX);
		assert_true(n < 2 ? mr_flaws_of_pair(&w, h, 2) == n : mr_flaws_of_pair(&w, h, 2) >= 2);
		mr_dyn_collapse(&x.d, h, x.d.p[b]);
		assert_int_equal(n, around(&x.d, b, b, MR_NONE));
		all += n;
		merged++;
		mr_ctx_free(&ctx);
	}
	assert_true(merged > 100 && all > 300);
}

/* Those around a vertex and around its neighbours, and the faces beside these. */
static void
a_change_makes_suspects(void **state)
{
	enum { N = 12 };
	size_t count;
	mr_flaws w;
	scene x;

	(void)state;
	set_up(&x, lattice(N), 180);
	w = find(&x, true, &count);
	for (uint32_t v = 0; v < x.d.nv; v += 7) {
		bool *near = MR_NEW_ZERO(&ctx, x.d.nf, bool);
		memset(w.state, MR_STUCK, x.d.nf);
		mr_flaws_suspect(&w, v);
		for (uint32_t f = 0; f < x.d.nf; f++) /* those around its neighbours */
			for (uint32_t g = 0; g < x.d.nf && mr_dyn_has(&x.d, f, v); g++)
				for (uint32_t k = 3 * f; k < 3 * f + 3; k++)
					near[g] |= mr_dyn_has(&x.d, g, x.d.v[k]);
		for (uint32_t h = 0; h < 3 * x.d.nf; h++) {
			bool want = near[h / 3] || (x.d.twin[h] != MR_NONE && near[x.d.twin[h] / 3]);
			if (want)
				assert_int_equal(w.state[h / 3], MR_SUSPECT);
		}
		for (uint32_t f = 0; f < x.d.nf; f++)
			assert_true(w.state[f] != MR_SUSPECT || mr_dist(x.d.p[x.d.v[3 * f]], x.d.p[v]) < 3.1);
	}
}

/* What looks right is not looked at closely: fewer flaws, not more, are found so. */
static void
a_quick_look_finds_no_others(void **state)
{
	mr_random r = { 3 };
	size_t quick, sure;
	mr_flaws a, b;
	scene x;

	(void)state;
	set_up(&x, shape(MR_KNOT, 2000), 180);
	for (uint32_t v = 0; v < x.d.nv; v += 3)
		x.d.p[v] = mr_add(x.d.p[v], mr_mul(2 * x.s.uniform, random_vector(&r)));
	a = find(&x, false, &quick);
	b = find(&x, true, &sure);
	assert_true(quick > 100 && quick <= sure);
	for (size_t f = 0; f < x.d.nf; f++)
		assert_true(a.state[f] == MR_SOUND || b.state[f] == MR_SUSPECT);
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

	find(x, true, &c.flawed);
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
		mr_mend_flaws(&ctx, &x.d, &x.s, false);
		assert_true(10 * count_all(&x).flawed < tangled);
		mr_mend_flaws(&ctx, &x.d, &x.s, true);
		after = count_all(&x);
		assert_int_equal(after.flawed, 0);
		assert_int_equal(after.euler, before.euler);
		assert_int_equal(after.boundary, before.boundary);
		for (uint32_t f = 0; f < x.d.nf && plane; f++)
			assert_true(mr_dyn_face_dead(&x.d, f) || mr_dyn_cross(&x.d, x.d.p, f).z >= 0);
		mr_ctx_free(&ctx);
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

/* Only what leaves fewer flaws is done: if there are as many as before and no two vertices were merged,
 * nothing was. */
static void
what_does_not_help_is_not_done(void **state)
{
	mr_random r = { 7 };
	int vain = 0, partly = 0;

	(void)state;
	for (int k = 0; k < 1500; k++) {
		bool few = k % 4 > 0, merged = false; /* few are free, the others are tips */
		unsigned before, after;
		mr_v3 *p;
		scene x;
		set_up(&x, lattice(4 + (uint32_t)k % 3), 180);
		stir(&x, 1, 0.3 + 0.2 * (k % 10), &r);
		for (uint32_t v = 0; v < x.d.nv && k % 2; v++) /* the rim too, which stays as it is */
			x.d.p[v].x += x.d.kind[v] == MR_SMOOTH ? 0 : 3 * mr_random_real(&r);
		for (uint32_t v = 0; v < x.d.nv && few; v++)
			if (x.d.kind[v] == MR_SMOOTH && mr_random_bits(&r) % 8) {
				x.d.kind[v] = MR_CORNER;
				x.d.at[v] = x.d.out[v];
			}
		before = total(&x.d);
		p = MR_NEW(&ctx, x.d.nv, mr_v3);
		memcpy(p, x.d.p, x.d.nv * sizeof *p);
		mr_mend_flaws(&ctx, &x.d, &x.s, false);
		after = total(&x.d);
		assert_true(after <= before);
		partly += after > 0 && after < before;
		for (uint32_t v = 0; v < x.d.nv; v++)
			merged |= x.d.kind[v] == MR_DEAD;
		for (uint32_t v = 0; v < x.d.nv; v++) {
			if (after == before && !merged)
				assert_true(mr_dist(x.d.p[v], p[v]) == 0);
			if (x.d.kind[v] == MR_CORNER)
				assert_true(mr_dist(x.d.p[v], p[v]) == 0);
		}
		vain += after == before && before > 0 && !merged;
		mr_ctx_free(&ctx);
	}
	assert_true(vain > 5 && partly > 100);
}

/* A tetrahedron turned inside out, of which one vertex is free and no edge can be flipped or merged. */
static void
what_is_tried_in_vain_is_taken_back(void **state)
{
	static const mr_tri t[4] = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 1, 2, 3 } }, { { 2, 0, 3 } } };
	mr_random r = { 9 };
	int vain = 0;

	(void)state;
	for (int k = 0; k < 200; k++) {
		mr_v3 p[4] = { { 1, 1, 1 }, { -1, -1, 1 }, { -1, 1, -1 }, { 1, -1, -1 } }, inside[4];
		size_t before, after;
		scene x;
		set_up(&x, (mr_mesh){ "tetrahedron", p, t, 4, 4 }, 180);
		for (int i = 0; i < 4; i++)
			x.d.p[i] = inside[i] = mr_mul(-0.5 - mr_random_real(&r), p[i]);
		for (uint32_t v = 0; v < 3; v++) {
			x.d.kind[v] = MR_CORNER;
			x.d.at[v] = x.d.out[v];
		}
		find(&x, false, &before);
		assert_true(before > 0);
		mr_mend_flaws(&ctx, &x.d, &x.s, false);
		find(&x, false, &after);
		for (int i = 0; i < 4 && before == after; i++)
			assert_true(mr_dist(x.d.p[i], inside[i]) == 0);
		vain += before == after;
		mr_ctx_free(&ctx);
	}
	assert_true(vain > 10);
}

/* Where no vertex may move, a flip takes back what a flip has done, or mostly. */
static void
an_edge_is_flipped_back(void **state)
{
	mr_random r = { 8 };
	int made = 0, undone = 0;

	(void)state;
	for (int k = 0; k < 2000; k++) {
		uint32_t h;
		unsigned flaws;
		scene x;
		set_up(&x, lattice(4), 180);
		stir(&x, 1, 0.45, &r);
		if (total(&x.d) > 0)
			continue;
		for (uint32_t v = 0; v < x.d.nv; v++)
			if (x.d.kind[v] == MR_SMOOTH) {
				x.d.kind[v] = MR_CORNER;
				x.d.at[v] = x.d.out[v];
			}
		h = (uint32_t)(mr_random_bits(&r) % (3 * x.d.nf));
		if (!mr_dyn_can_flip(&x.d, h))
			continue;
		mr_dyn_flip(&x.d, h);
		flaws = total(&x.d);
		mr_mend_flaws(&ctx, &x.d, &x.s, false);
		assert_true(total(&x.d) <= flaws);
		made += flaws > 0;
		undone += flaws > 0 && total(&x.d) == 0;
		mr_ctx_free(&ctx);
	}
	assert_true(made > 20 && 10 * undone >= 8 * made);
}

/* A tip that is where it should not be stays there, until the last resort. */
static void
a_tip_gives_way_as_the_last_resort(void **state)
{
	enum { N = 10, V = (N + 1) * 5 + 5 };
	size_t count;
	scene x;

	(void)state;
	set_up(&x, lattice(N), 180);
	x.d.kind[V] = MR_CORNER;
	x.d.at[V] = x.d.out[V];
	x.d.p[V].x += 3.3;
	mr_mend_flaws(&ctx, &x.d, &x.s, false);
	assert_int_equal(x.d.kind[V], MR_CORNER);
	assert_true(x.d.p[V].x == x.m.p[V].x + 3.3);
	set_up(&x, lattice(N), 180);
	x.d.kind[V] = MR_CORNER;
	x.d.at[V] = x.d.out[V];
	x.d.p[V].x += 3.3;
	mr_mend_flaws(&ctx, &x.d, &x.s, true);
	find(&x, true, &count);
	assert_int_equal(count, 0);
	assert_true(x.d.kind[V] == MR_DEAD || x.d.kind[V] == MR_SMOOTH);
}

/* A sound mesh is left alone, bit for bit. */
static void
what_is_sound_stays(void **state)
{
	scene x;

	(void)state;
	for (int last = 0; last < 2; last++) {
		set_up(&x, shape(MR_KNOT, 1500), 180);
		mr_mend_flaws(&ctx, &x.d, &x.s, last);
		assert_memory_equal(x.d.p, x.m.p, x.m.nv * sizeof *x.m.p);
		assert_memory_equal(x.d.v, x.m.t, x.m.nf * sizeof *x.m.t);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(sound_surfaces_have_none, setup, teardown),
		cmocka_unit_test_setup_teardown(flaws_in_the_plane_are_those_of_signs, setup, teardown),
		cmocka_unit_test_setup_teardown(a_pair_counts_as_what_it_is_merged_into, setup, teardown),
		cmocka_unit_test_setup_teardown(a_change_makes_suspects, setup, teardown),
		cmocka_unit_test_setup_teardown(a_quick_look_finds_no_others, setup, teardown),
		cmocka_unit_test_setup_teardown(what_is_tangled_is_mended, setup, teardown),
		cmocka_unit_test_setup_teardown(what_does_not_help_is_not_done, setup, teardown),
		cmocka_unit_test_setup_teardown(what_is_tried_in_vain_is_taken_back, setup, teardown),
		cmocka_unit_test_setup_teardown(an_edge_is_flipped_back, setup, teardown),
		cmocka_unit_test_setup_teardown(a_tip_gives_way_as_the_last_resort, setup, teardown),
		cmocka_unit_test_setup_teardown(what_is_sound_stays, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
