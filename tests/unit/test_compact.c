/* Packed surfaces: what is written is what is read, bit by bit, mesh by mesh, and every beginning is a
 * surface. */
#include "base/random.h"
#include "compact/lifting.h"
#include "compact/packed.h"
#include "shapes.h"

enum { LEVELS = 3 };

static void
test_bits_come_back(void **state)
{
	(void)state;
	for (uint64_t seed = 0; seed < 200; seed++) {
		mr_random r = { seed };
		size_t n = (size_t)(3000 * mr_random_real(&r));
		double ones = mr_random_real(&r);
		bool *bit = MR_NEW(&ctx, n + 1, bool);
		mr_odds odds = { 0 };
		mr_coder c;
		mr_coder_write(&ctx, &c);
		for (size_t i = 0; i < n; i++)
			mr_code_bit(&c, &odds, bit[i] = mr_random_real(&r) < ones);
		mr_coder_finish(&c);
		mr_coder_read(c.byte, c.count, &c);
		odds = (mr_odds){ 0 };
		for (size_t i = 0; i < n; i++)
			assert_int_equal(mr_code_bit(&c, &odds, false), bit[i]);
		assert_false(c.ended);
	}
}

/* Random bits of one in a hundred take about their entropy, 0.0808 bits each. */
static void
test_bits_are_few(void **state)
{
	mr_random r = { 3 };
	mr_odds odds = { 0 };
	mr_coder c;

	(void)state;
	mr_coder_write(&ctx, &c);
	for (int i = 0; i < 100000; i++)
		mr_code_bit(&c, &odds, mr_random_real(&r) < 0.01);
	mr_coder_finish(&c);
	assert_in_range(c.count, 950, 1080);
}

static void
test_numbers_come_back(void **state)
{
	static const int32_t numbers[] = { 0, 1, -1, 2, 3, -4, 5, 100, -1000, 65536, -12345678, INT32_MAX,
		-INT32_MAX };
	enum { N = sizeof numbers / sizeof *numbers };
	mr_number_odds *odds = MR_NEW_ZERO(&ctx, 2, mr_number_odds);
	mr_coder c;

	(void)state;
	mr_coder_write(&ctx, &c);
	for (size_t i = 0; i < N; i++)
		mr_code_number(&c, &odds[0], numbers[i]);
	mr_coder_finish(&c);
	mr_coder_read(c.byte, c.count, &c);
	for (size_t i = 0; i < N; i++)
		assert_int_equal(mr_code_number(&c, &odds[1], 0), numbers[i]);
}

/* A mesh on a grid of a thousandth. */
static mr_grid_mesh
on_grid(const mr_mesh *m)
{
	mr_grid_mesh g = { m->nv, m->nf, MR_NEW(&ctx, m->nv, mr_grid_point), (mr_tri *)m->t, NULL };

	for (size_t v = 0; v < m->nv; v++)
		g.p[v] = (mr_grid_point){ { (int32_t)(1000 * m->p[v].x), (int32_t)(1000 * m->p[v].y),
		    (int32_t)(1000 * m->p[v].z) } };
	return g;
}

/* Every half-edge of what is read is one of what was written, between the same vertices, each once. */
static void
assert_same_mesh(const mr_grid_mesh *was, const mr_grid_mesh *is, const mr_control_order *order)
{
	bool *half = MR_NEW_ZERO(&ctx, 3 * was->nf, bool), *vertex = MR_NEW_ZERO(&ctx, was->nv, bool);

	for (size_t v = 0; v < is->nv; v++) {
		assert_false(vertex[order->vertex[v]]);
		vertex[order->vertex[v]] = true;
		assert_memory_equal(&is->p[v], &was->p[order->vertex[v]], sizeof *is->p);
	}
	for (size_t h = 0; h < 3 * is->nf; h++) {
		uint32_t old = order->half[h];
		assert_false(half[old]);
		half[old] = true;
		assert_int_equal(order->vertex[is->t[h / 3].v[h % 3]], was->t[old / 3].v[old % 3]);
		if (is->crease)
			assert_int_equal(is->crease[h], was->crease[old]);
	}
}

static void
assert_control_comes_back(const mr_mesh *m, bool creased)
{
	mr_grid_mesh g = on_grid(m), read = { m->nv, m->nf, NULL, NULL, NULL };
	mr_control_order order;
	mr_topology topo;
	mr_coder c;

	assert_int_equal(mr_topology_build(&ctx, m, &topo), MR_OK);
	if (creased) {
		read.crease = g.crease = MR_NEW_ZERO(&ctx, 3 * m->nf, uint8_t);
		for (uint32_t h = 0; h < 3 * m->nf; h += 7)
			if (topo.twin[h] != MR_NONE)
				g.crease[h] = g.crease[topo.twin[h]] = 1;
	}
	mr_coder_write(&ctx, &c);
	mr_control_write(&ctx, &c, &g, &topo, &order);
	mr_coder_finish(&c);
	mr_coder_read(c.byte, c.count, &c);
	assert_int_equal(mr_control_read(&ctx, &c, &read), MR_OK);
	assert_same_mesh(&g, &read, &order);
}

static void
test_control_meshes_come_back(void **state)
{
	mr_mesh sphere = shape(MR_SPHERE, 300), plane = shape(MR_PLANE, 100), two, three;

	(void)state;
	for (int i = 0; i < MR_BOXES; i++) {
		mr_mesh m = shape((mr_solid)i, 400);
		assert_control_comes_back(&m, i % 2);
	}
	two = both(&sphere, &plane, mr_vec(3, 0, 0));
	three = both(&two, &sphere, mr_vec(-3, 0, 0));
	three.nf = two.nf;
	assert_control_comes_back(&two, true);
	assert_control_comes_back(&three, false); /* the vertices of the second sphere are isolated */
}

static void
test_lifting_is_exact(void **state)
{
	static const mr_solid solids[] = { MR_SPHERE, MR_PLANE, MR_KNOT };

	(void)state;
	for (int i = 0; i < 3; i++) {
		mr_mesh m = shape(solids[i], 200);
		mr_loop level[LEVELS + 1];
		mr_random r = { 5 };
		assert_int_equal(mr_loop_levels(&ctx, &m, 180, NULL, LEVELS, level), MR_OK);
		size_t n = level[LEVELS].nv;
		int32_t *x = MR_NEW(&ctx, n, int32_t), *y = MR_NEW(&ctx, n, int32_t);
		for (size_t v = 0; v < n; v++)
			x[v] = y[v] = (int32_t)(2e7 * (mr_random_real(&r) - 0.5));
		mr_lifting_analyse(&ctx, level, LEVELS, y);
		mr_lifting_synthesize(&ctx, level, LEVELS, y);
		assert_memory_equal(x, y, n * sizeof *x);
	}
}

/* A packed sphere with a wave on it. */
static mr_packed_bytes
pack_wave(mr_packed *p, double *height, mr_packed_bytes *file)
{
	mr_mesh m = shape(MR_SPHERE, 60);
	mr_grid_mesh g = on_grid(&m);
	mr_control_order order;
	mr_packed_bytes bits;
	mr_topology topo;
	size_t least;
	mr_coder c;

	assert_int_equal(mr_topology_build(&ctx, &m, &topo), MR_OK);
	mr_coder_write(&ctx, &c);
	mr_control_write(&ctx, &c, &g, &topo, &order);
	mr_coder_finish(&c);
	*p = (mr_packed){
		.name = "wave", .control = order.m, .step = -10, .n = LEVELS, .unit = -12, .fields = 1
	};
	assert_int_equal(mr_packed_levels(&ctx, p, true), MR_OK);
	for (size_t v = 0; v < p->level[LEVELS].nv; v++)
		height[v] = 0.2 * sin(0.37 * (double)v) + 0.1;
	assert_int_equal(mr_packed_put_heights(&ctx, p, height), MR_OK);
	assert_int_equal(mr_packed_write_fields(&ctx, p, &bits, &least), MR_OK);
	*file = mr_packed_file(&ctx, p, &c, bits);
	return bits;
}

/* The more bytes, the nearer the heights; all give them to the unit. */
static void
test_prefixes_come_near(void **state)
{
	double height[8192], given[8192], last = INFINITY;
	mr_packed_bytes file, bits;
	mr_packed p, q;
	size_t missing;

	(void)state;
	bits = pack_wave(&p, height, &file);
	for (size_t size = file.size - bits.size; size <= file.size; size += (bits.size - 1) / 5 + 1) {
		double most = 0;
		mr_packed_bytes there;
		assert_int_equal(
		    mr_packed_open(&ctx, (mr_packed_bytes){ file.byte, size }, &q, &there, &missing), MR_OK);
		assert_int_equal(missing > 0, there.size < bits.size);
		assert_int_equal(mr_packed_levels(&ctx, &q, false), MR_OK);
		mr_packed_read_fields(&ctx, &q, there, LEVELS);
		mr_packed_heights(&q, LEVELS, given);
		for (size_t v = 0; v < q.level[LEVELS].nv; v++)
			most = fmax(most, fabs(given[v] - height[v]));
		assert_true(most <= 1.5 * last);
		last = most;
	}
	assert_int_equal(mr_packed_open(&ctx, file, &q, &bits, &missing), MR_OK);
	assert_int_equal(mr_packed_levels(&ctx, &q, false), MR_OK);
	mr_packed_read_fields(&ctx, &q, bits, LEVELS);
	mr_packed_heights(&q, LEVELS, given);
	for (size_t v = 0; v < q.level[LEVELS].nv; v++)
		assert_true(fabs(given[v] - height[v]) <= 0x1p-11);
	assert_string_equal(q.name, "wave");
}

/* No flipped bit, and no beginning, is taken for a file of something else. */
static void
test_damage_is_seen(void **state)
{
	double height[8192];
	mr_packed_bytes file, bits;
	mr_packed p;
	size_t missing;

	(void)state;
	pack_wave(&p, height, &file);
	unsigned char *byte = MR_NEW(&ctx, file.size, unsigned char);
	memcpy(byte, file.byte, file.size);
	for (size_t i = 0; i < file.size; i += 3) {
		mr_mark mark = mr_mark_take(&ctx);
		byte[i] ^= (unsigned char)(1 << i % 8);
		assert_true(
		    mr_packed_open(&ctx, (mr_packed_bytes){ byte, file.size }, &p, &bits, &missing) < 0);
		byte[i] = file.byte[i];
		mr_mark_release(&ctx, mark);
	}
	for (size_t size = 0; size < 100; size++)
		assert_true(mr_packed_open(&ctx, (mr_packed_bytes){ byte, size }, &p, &bits, &missing) < 0);
}

static void
test_colors_come_back(void **state)
{
	mr_packed p, q;
	mr_packed_bytes file, bits;
	double height[8192];
	uint8_t color[8192][4], given[8192][4];
	size_t least;

	(void)state;
	pack_wave(&p, height, &file);
	assert_int_equal(mr_packed_put_heights(&ctx, &p, height), MR_OK);
	p.fields = 5;
	for (size_t v = 0; v < p.level[LEVELS].nv; v++)
		for (unsigned k = 0; k < 4; k++)
			color[v][k] = (uint8_t)(v * (2 * k + 37));
	mr_packed_put_colors(&ctx, &p, (const uint8_t(*)[4])color);
	assert_int_equal(mr_packed_write_fields(&ctx, &p, &bits, &least), MR_OK);
	q = p;
	mr_packed_read_fields(&ctx, &q, bits, LEVELS);
	mr_packed_colors(&q, LEVELS, given);
	for (size_t v = 0; v < p.level[LEVELS].nv; v++)
		for (int k = 0; k < 4; k++)
			assert_true(abs(given[v][k] - color[v][k]) <= 16);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_bits_come_back, setup, teardown),
		cmocka_unit_test_setup_teardown(test_bits_are_few, setup, teardown),
		cmocka_unit_test_setup_teardown(test_numbers_come_back, setup, teardown),
		cmocka_unit_test_setup_teardown(test_control_meshes_come_back, setup, teardown),
		cmocka_unit_test_setup_teardown(test_lifting_is_exact, setup, teardown),
		cmocka_unit_test_setup_teardown(test_prefixes_come_near, setup, teardown),
		cmocka_unit_test_setup_teardown(test_damage_is_seen, setup, teardown),
		cmocka_unit_test_setup_teardown(test_colors_come_back, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
