/* The table of half-edges on curves is a map: against an array, by random changes. */
#include "base/random.h"
#include "mesh/feature_curves.h"
#include "unit.h"

enum { KEYS = 3000 };

static uint32_t
below(mr_random *r, uint32_t n)
{
	return (uint32_t)(mr_random_bits(r) % n);
}

static void
assert_same(const mr_curves *c, const uint32_t want[KEYS])
{
	size_t count = 0;

	for (uint32_t h = 0; h < KEYS; h++) {
		assert_int_equal(mr_curves_get(c, h), want[h]);
		count += want[h] != MR_NONE;
	}
	assert_int_equal(c->count, count);
}

static void
nothing_is_in_an_empty_table(void **state)
{
	mr_curves c = { 0 }, copy;

	(void)state;
	assert_int_equal(mr_curves_get(&c, 7), MR_NONE);
	mr_curves_set(&c, 7, MR_NONE);
	assert_int_equal(c.count, 0);
	mr_curves_copy(&ctx, &c, &copy);
	mr_curves_renumber(&ctx, &c, NULL);
	assert_int_equal(mr_curves_get(&copy, 7), MR_NONE);
}

/* What is taken out leaves no gap in the way of another, at any load up to three quarters. */
static void
random_changes_are_those_of_an_array(void **state)
{
	static uint32_t want[KEYS];
	mr_random r = { 5 };

	(void)state;
	for (uint32_t keys = 20; keys <= KEYS; keys *= 5) {
		mr_curves c = { 0 };
		memset(want, 0xff, sizeof want);
		for (int step = 0; step < 20000; step++) {
			uint32_t h = below(&r, keys), source = below(&r, 3) ? below(&r, 1000000) : MR_NONE;
			if (step / 2000 % 2)
				source = below(&r, 3) ? MR_NONE : source; /* now it shrinks */
			assert_int_equal(mr_curves_reserve(&ctx, &c, 1), MR_OK);
			mr_curves_set(&c, h, source);
			want[h] = source;
			if (step % 500 == 0)
				assert_same(&c, want);
		}
		assert_same(&c, want);
	}
}

/* Half-edges whose first slots are the last ones of the table go on at its begin, and come back. */
static void
rows_of_slots_go_around_the_end(void **state)
{
	uint32_t key[12], n = 0;
	mr_curves c = { 0 };

	(void)state;
	assert_int_equal(mr_curves_reserve(&ctx, &c, 12), MR_OK);
	for (uint32_t h = 0; n < 12; h++)
		if (mr_curves_home(&c, h) >= (1u << c.bits) - 3)
			key[n++] = h;
	for (uint32_t out = 0; out < 12; out++) {
		for (uint32_t i = 0; i < 12; i++)
			mr_curves_set(&c, key[i], i);
		mr_curves_set(&c, key[out], MR_NONE);
		for (uint32_t i = 0; i < 12; i++)
			assert_int_equal(mr_curves_get(&c, key[i]), i == out ? MR_NONE : i);
	}
}

static void
reserved_room_is_enough(void **state)
{
	mr_curves c = { 0 };
	size_t bits;

	(void)state;
	for (size_t more = 1; more < 100000; more *= 7) {
		assert_int_equal(mr_curves_reserve(&ctx, &c, more), MR_OK);
		assert_true(4 * (c.count + more) <= (size_t)3 << c.bits);
		bits = c.bits;
		for (size_t i = 0; i < more; i++)
			mr_curves_set(&c, (uint32_t)(more * 10 + i), 1);
		assert_int_equal(c.bits, bits);
	}
	assert_int_equal(mr_curves_reserve(&ctx, &c, UINT32_MAX), MR_ERANGE);
}

static void
renumbered_faces_take_their_curves_along(void **state)
{
	static uint32_t want[KEYS], after[KEYS];
	uint32_t face[KEYS / 3];
	mr_random r = { 9 };
	mr_curves c = { 0 }, before;

	(void)state;
	memset(want, 0xff, sizeof want);
	memset(after, 0xff, sizeof after);
	for (uint32_t f = 0; f < KEYS / 3; f++)
		face[f] = f;
	for (uint32_t f = KEYS / 3; f-- > 1;) { /* shuffled */
		uint32_t g = below(&r, f + 1), x = face[f];
		face[f] = face[g];
		face[g] = x;
	}
	assert_int_equal(mr_curves_reserve(&ctx, &c, KEYS), MR_OK);
	for (int i = 0; i < 800; i++) {
		uint32_t h = below(&r, KEYS);
		want[h] = below(&r, KEYS);
		mr_curves_set(&c, h, want[h]);
	}
	mr_curves_copy(&ctx, &c, &before);
	mr_curves_renumber(&ctx, &c, face);
	for (uint32_t h = 0; h < KEYS; h++)
		after[3 * face[h / 3] + h % 3] = want[h];
	assert_same(&c, after);
	assert_same(&before, want); /* a copy is another table */
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(nothing_is_in_an_empty_table, setup, teardown),
		cmocka_unit_test_setup_teardown(random_changes_are_those_of_an_array, setup, teardown),
		cmocka_unit_test_setup_teardown(rows_of_slots_go_around_the_end, setup, teardown),
		cmocka_unit_test_setup_teardown(reserved_room_is_enough, setup, teardown),
		cmocka_unit_test_setup_teardown(renumbered_faces_take_their_curves_along, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
