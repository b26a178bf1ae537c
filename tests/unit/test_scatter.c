/* Counts at vertices against a plain loop, of orders of the vertices with few and with many borders. */
#include "mesh/scatter.h"
#include "shapes.h"

/* How often each vertex is a corner. */
static void
count(void *arg, const mr_tri *t, size_t n)
{
	uint32_t *corners = arg;

	for (size_t f = 0; f < n; f++)
		for (int k = 0; k < 3; k++)
			corners[t[f].v[k]]++;
}

static void
assert_counts(const mr_mesh *m)
{
	uint32_t *made = MR_NEW_ZERO(&ctx, m->nv, uint32_t), *expected = MR_NEW_ZERO(&ctx, m->nv, uint32_t);
	mr_scatter s = mr_scatter_make(&ctx, m);

	assert_int_equal(s.start[s.blocks], m->nf);
	mr_scatter_run(&ctx, &s, count, made);
	count(expected, m->t, m->nf);
	assert_memory_equal(made, expected, m->nv * sizeof *made);
}

static void
each_face_gives_once(void **state)
{
	mr_mesh m = shape(MR_SPHERE, 20000);
	mr_tri *mixed = MR_NEW(&ctx, m.nf, mr_tri);

	(void)state;
	assert_counts(&m);
	for (size_t i = 0; i < 3 * m.nf; i++) /* 7919 is prime */
		mixed[i / 3].v[i % 3] = (uint32_t)(m.t[i / 3].v[i % 3] * (uint64_t)7919 % m.nv);
	m.t = mixed;
	assert_counts(&m);
	m.nf = 0;
	assert_counts(&m);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(each_face_gives_once, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
