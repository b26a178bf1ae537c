/* A patch that is cut out, changed at random and put back leaves a manifold, and the rest as it was. */
#include "mesh/dynmesh_patch.h"
#include "remesh_scene.h"

static const mr_solid solids[] = { MR_TORUS, MR_PLANE, MR_CUBE, MR_SPHERE };

static long
euler(const mr_dyn *d, size_t *boundary, size_t *curves)
{
	long vertices = 0, faces = 0, halves = 0;

	*boundary = *curves = 0;
	for (size_t v = 0; v < d->nv; v++)
		vertices += d->kind[v] != MR_DEAD;
	for (uint32_t h = 0; h < 3 * d->nf; h++) {
		if (mr_dyn_face_dead(d, h / 3))
			continue;
		faces += h % 3 == 0;
		halves += d->twin[h] == MR_NONE ? 2 : 1;
		*boundary += d->twin[h] == MR_NONE;
		*curves += mr_dyn_on_curve(d, h);
	}
	return vertices - halves / 2 + faces;
}

/* As a set of positions each face has at most one like it: sums tell them apart. */
static double
sum_of_corners(const mr_dyn *d, uint32_t f)
{
	double sum = 0;

	for (uint32_t k = 3 * f; k < 3 * f + 3; k++)
		sum += d->p[d->v[k]].x + 3 * d->p[d->v[k]].y + 7 * d->p[d->v[k]].z;
	return sum;
}

static void
patches_come_back_as_part_of_a_manifold(void **state)
{
	mr_random r = { 3 };
	size_t changed = 0;

	(void)state;
	for (int k = 0; k < 200; k++) {
		mr_patch patch;
		uint32_t some[3];
		unsigned rings = 1 + (unsigned)k % 5;
		size_t boundary[2], curves[2];
		long before;
		mr_dyn old;
		bool *cut;
		scene x;
		set_up(&x, shape(solids[k % 4], 300), 40);
		for (int i = 0; i < 3; i++)
			some[i] = (uint32_t)(mr_random_bits(&r) % x.d.nv);
		before = euler(&x.d, &boundary[0], &curves[0]);
		mr_dyn_copy(&ctx, &x.d, &old);
		assert_int_equal(mr_patch_cut(&ctx, &x.d, some, 3, rings, &patch), MR_OK);
		assert_valid(&patch.d);
		operate(&patch.d, 300, &r);
		assert_valid(&patch.d);
		assert_int_equal(mr_patch_paste(&ctx, &x.d, &patch), MR_OK);
		assert_valid(&x.d);
		assert_int_equal(euler(&x.d, &boundary[1], &curves[1]), before);
		if (k % 4 != 1)
			assert_int_equal(boundary[0], boundary[1]);
		cut = MR_NEW_ZERO(&ctx, old.nf, bool);
		for (size_t i = 0; i < patch.nf; i++)
			cut[patch.face[i]] = true;
		for (uint32_t f = 0; f < old.nf; f++)
			if (!cut[f])
				assert_true(sum_of_corners(&x.d, f) == sum_of_corners(&old, f));
			else
				changed += mr_dyn_face_dead(&x.d, f) ||
				           sum_of_corners(&x.d, f) != sum_of_corners(&old, f);
		mr_ctx_free(&ctx);
	}
	assert_true(changed > 1000);
}

/* What was not changed is put back as it was, with its curves, kinds and factors of the length. */
static void
what_is_as_it_was_comes_back_so(void **state)
{
	(void)state;
	for (int k = 0; k < 40; k++) {
		uint32_t v = (uint32_t)(17 * k);
		size_t boundary[2], curves[2];
		mr_patch patch;
		mr_dyn old;
		scene x;
		set_up(&x, shape(solids[k % 4], 800), 40);
		x.d.scale = MR_NEW(&ctx, x.d.room_v, float);
		for (size_t i = 0; i < x.d.nv; i++)
			x.d.scale[i] = (float)i;
		euler(&x.d, &boundary[0], &curves[0]);
		mr_dyn_copy(&ctx, &x.d, &old);
		assert_int_equal(mr_patch_cut(&ctx, &x.d, &v, 1, 2, &patch), MR_OK);
		assert_true(patch.nf > 10 && patch.nf < 200);
		assert_int_equal(mr_patch_paste(&ctx, &x.d, &patch), MR_OK);
		assert_valid(&x.d);
		euler(&x.d, &boundary[1], &curves[1]);
		assert_memory_equal(boundary, boundary + 1, sizeof *boundary);
		assert_memory_equal(curves, curves + 1, sizeof *curves);
		for (uint32_t i = 0; i < x.d.nv; i++) { /* numbers within the patch may be others */
			uint32_t j = (uint32_t)x.d.scale[i];
			assert_true(mr_dist(x.d.p[i], old.p[j]) == 0);
			assert_int_equal(x.d.kind[i], old.kind[j]);
			assert_int_equal(x.d.at[i], old.at[j]);
			assert_int_equal(mr_dyn_valence(&x.d, i, MR_NONE), mr_dyn_valence(&old, j, MR_NONE));
		}
		mr_ctx_free(&ctx);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(patches_come_back_as_part_of_a_manifold, setup, teardown),
		cmocka_unit_test_setup_teardown(what_is_as_it_was_comes_back_so, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
