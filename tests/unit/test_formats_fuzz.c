/*
 * Damaged files: every prefix, every byte changed, pieces cut out and put in twice, and memory that fails at
 * every allocation.  A reader gives a valid model or a sentence; a sanitizer watches the rest.
 */
#include "formats/model.h"
#include "gltf_text.h"
#include "model_seeds.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <unistd.h>

#include <cmocka.h>

static size_t accepted, rejected;

/* Every number is that of a line. */
static void
check_names(const uint32_t *of, mr_lines names, size_t nf)
{
	size_t lines = 1;

	for (size_t i = 0; i < names.bytes; i++)
		lines += names.text[i] == '\n';
	for (size_t f = 0; of && f < nf; f++)
		assert_true(of[f] < lines);
}

/* All triangles are in a polygon. */
static void
check_polygons(mr_ctx *ctx, const mr_model *m)
{
	mr_polygons p;
	size_t triangles = 0;

	mr_polygons_find(ctx, m->t, m->nf, m->polygon, &p);
	for (size_t i = 0; i < p.count; i++)
		triangles += mr_polygon_begin(&p, i + 1) - mr_polygon_begin(&p, i) - 2;
	assert_int_equal(triangles, m->nf);
}

static void
check_model(mr_ctx *ctx, const mr_model *m)
{
	assert_true(m->nv > 0);
	for (size_t i = 0; i < m->nv; i++)
		assert_true(mr_finite(m->p[i]));
	for (size_t i = 0; m->normal && i < m->nv; i++)
		assert_true(mr_finite(m->normal[i]));
	for (size_t i = 0; m->texcoord && i < 2 * m->nv; i++)
		assert_true(isfinite(m->texcoord[i]));
	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++)
			assert_true(m->t[f].v[k] < m->nv);
	check_names(m->group, m->groups, m->nf);
	check_names(m->object, m->objects, m->nf);
	check_names(m->material, m->materials, m->nf);
	for (size_t i = 0; m->corner_normal && i < 3 * m->nf; i++)
		assert_true(mr_finite(m->corner_normal[i]));
	check_polygons(ctx, m);
}

/* Reads from memory of exactly its size; by the bytes, and by the name of the format that they were. */
static void
feed(const char *format, const unsigned char *data, size_t size)
{
	unsigned char *copy = malloc(size ? size : 1);

	assert_non_null(copy);
	memcpy(copy, data, size);
	for (int named = 0; named < (format ? 2 : 1); named++) {
		mr_ctx ctx;
		mr_model m;
		mr_ctx_init(&ctx, 1);
		if (mr_model_parse(&ctx, "", named ? format : NULL, copy, size, &m) == MR_OK) {
			check_model(&ctx, &m);
			accepted++;
		} else {
			assert_true(ctx.error[0] != 0);
			rejected++;
		}
		mr_ctx_free(&ctx);
	}
	free(copy);
}

static void
damage(const char *format, const unsigned char *data, size_t size)
{
	static const unsigned char marks[] = { 0x01, 0x80, 0xff, 0x10, 0x40 };
	static const char *const words[] = { "4294967295", "-1", "1e400", "nan", "\n", " ", "#", "/", "\\",
		"\0" };
	unsigned char *copy = malloc(size + 16);

	assert_non_null(copy);
	for (size_t n = 0; n <= size; n++)
		feed(format, data, n);
	for (size_t i = 0; i < size; i++)
		for (size_t k = 0; k < sizeof marks; k++) {
			memcpy(copy, data, size);
			copy[i] = (unsigned char)(data[i] ^ marks[k]);
			feed(format, copy, size);
		}
	for (size_t i = 0; i < size; i++)
		for (size_t k = 0; k < sizeof words / sizeof *words; k++) {
			size_t n = strlen(words[k]) + (words[k][0] == 0);
			memcpy(copy, data, i);
			memcpy(copy + i, words[k], n);
			memcpy(copy + i + n, data + i, size - i);
			feed(format, copy, size + n);
		}
	for (size_t i = 0; i + 4 <= size; i++) { /* a piece is missing; a count is huge */
		memcpy(copy, data, i);
		memcpy(copy + i, data + i + 4, size - i - 4);
		feed(format, copy, size - 4);
		memcpy(copy, data, size);
		memset(copy + i, 0xff, 4);
		feed(format, copy, size);
		copy[i + 3] = 0x7f;
		feed(format, copy, size);
	}
	free(copy);
}

static void
seeds_damaged(void **state)
{
	(void)state;
	for (size_t i = 0; i < SEEDS; i++)
		damage(NULL, (const unsigned char *)seeds[i].text, seed_size(&seeds[i]));
	print_message("# %zu accepted, %zu refused\n", accepted, rejected);
	assert_true(accepted > 1000 && rejected > 1000);
}

static void
read_back(const char *path, mr_file_bytes *b)
{
	mr_ctx ctx;

	mr_ctx_init(&ctx, 1);
	assert_int_equal(mr_file_bytes_read(&ctx, path, b), MR_OK);
	mr_ctx_free(&ctx);
}

/* What the writers write, damaged. */
static void
written_damaged(void **state)
{
	static const char *const names[] = { "obj", "ply", "ply-ascii", "stl", "stl-ascii", "off", "xyz",
		"pts", "pwn", "glb" };

	(void)state;
	for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
		mr_ctx ctx;
		mr_model m;
		mr_file_bytes b = { 0 };
		mr_ctx_init(&ctx, 1);
		m = make_model(&ctx, 4, 3, true);
		assert_int_equal(mr_model_write(&ctx, "fuzz", names[i], &m, NULL), MR_OK);
		read_back("fuzz", &b);
		damage(names[i], b.data, b.size);
		mr_file_bytes_end(&b, MR_OK);
		mr_ctx_free(&ctx);
	}
}

/* A GLB whose second chunk is damaged, a bit at a time. */
static void
damage_chunk(const unsigned char *glb, size_t size, size_t chunk)
{
	unsigned char *copy = malloc(size);

	memcpy(copy, glb, size);
	for (size_t i = size - chunk; i < size; i++)
		for (int bit = 0; bit < 8; bit += 3) {
			copy[i] = (unsigned char)(glb[i] ^ 1 << bit);
			feed("glb", copy, size);
			copy[i] = glb[i];
		}
	free(copy);
}

/* A GLB that is packed, damaged. */
static void
packed_damaged(void **state)
{
	mr_ctx ctx;
	mr_scene_node node = { .frame = "", .layer = "" };
	mr_scene scene = {
		.node = &node, .nodes = 1, .folder = ".", .gltf = { .quantize = true, .compress = true }
	};
	mr_file_bytes b = { 0 };

	(void)state;
	mr_ctx_init(&ctx, 1);
	node.model = make_model(&ctx, 60, 80, true);
	node.model.groups = (mr_lines){ 0 };
	assert_int_equal(mr_scene_write(&ctx, "packed.glb", NULL, &scene, NULL), MR_OK);
	read_back("packed.glb", &b);
	damage_chunk(b.data, b.size, b.size - 28 - mr_load32(b.data + 12, false));
	mr_file_bytes_end(&b, MR_OK);
	mr_ctx_free(&ctx);
}

/* A tetrahedron that Draco has packed, damaged; where this was built without Draco, it is refused. */
static void
draco_damaged(void **state)
{
	static const char json[] =
	    "{\"asset\":{\"version\":\"2.0\"},\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
	    "\"indices\":1,\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0,\"attributes\":"
	    "{\"POSITION\":0}}}}]}],\"accessors\":[{\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
	    "{\"componentType\":5125,\"count\":12,\"type\":\"SCALAR\"}],"
	    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":76}],\"buffers\":[{\"byteLength\":76}]}";
	static const unsigned char packed[76] = { 68, 82, 65, 67, 79, 2, 2, 1, 1, 0, 0, 0, 4, 4, 0, 3, 0, 0,
		1, 47, 1, 1, 16, 1, 255, 0, 0, 1, 0, 9, 3, 0, 0, 2, 1, 1, 1, 0, 3, 3, 1, 16, 1, 48, 3, 0, 80,
		130, 36, 145, 4, 0, 0, 0, 0, 255, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 63,
		11 };
	bytes bin = { (unsigned char *)packed, sizeof packed }, glb = make_glb(json, &bin);

	(void)state;
	damage_chunk(glb.data, glb.size, sizeof packed);
	free(glb.data);
}

static void
put_file(const char *path, const unsigned char *data, size_t size)
{
	FILE *f = fopen(path, "wb");

	assert_non_null(f);
	assert_int_equal(fwrite(data, 1, size, f), size);
	assert_int_equal(fclose(f), 0);
}

/* gzip: every prefix and every byte changed; two members are one text. */
static void
gzip_damaged(void **state)
{
	mr_ctx ctx;
	mr_model m, back;
	mr_file_bytes b = { 0 };
	unsigned char raw[4096], twice[8192];
	size_t size, accepted_here = 0;
	FILE *f;

	(void)state;
	mr_ctx_init(&ctx, 1);
	m = make_model(&ctx, 6, 0, true);
	m.normal = NULL;
	m.color = NULL;
	assert_int_equal(mr_model_write(&ctx, "fuzz.xyz.gz", NULL, &m, NULL), MR_OK);
	f = fopen("fuzz.xyz.gz", "rb");
	assert_non_null(f);
	size = fread(raw, 1, sizeof raw, f);
	fclose(f);
	for (size_t n = 0; n < size; n++) {
		put_file("cut.gz", raw, n);
		assert_true(mr_file_bytes_read(&ctx, "cut.gz", &b) < 0 ||
			    n < 3); /* shorter than the signature: other bytes */
		mr_file_bytes_end(&b, MR_OK);
	}
	for (size_t i = 0; i < size; i++) {
		raw[i] ^= 0x55;
		put_file("cut.gz", raw, size);
		accepted_here += mr_model_read(&ctx, "cut.gz", NULL, &back) == MR_OK;
		raw[i] ^= 0x55;
	}
	assert_true(accepted_here <= 10); /* of the header, its time and the like may be anything */
	memcpy(twice, raw, size);
	memcpy(twice + size, raw, size);
	put_file("twice.gz", twice, 2 * size);
	assert_int_equal(mr_model_read(&ctx, "twice.gz", NULL, &back), MR_OK);
	assert_int_equal(back.nv, 12);
	mr_ctx_free(&ctx);
}

/* The k-th allocation fails, for every k: a sentence, and no leak. */
static void
memory_fails(void **state)
{
	(void)state;
	for (size_t i = 0; i < SEEDS; i++)
		for (uint64_t k = 1;; k++) {
			mr_ctx ctx;
			mr_model m;
			mr_status status;
			mr_ctx_init(&ctx, 1);
			ctx.fail_at = k;
			status = mr_model_parse(
			    &ctx, "", NULL, (const unsigned char *)seeds[i].text, seed_size(&seeds[i]), &m);
			if (status < 0)
				assert_int_equal(status, MR_EMEM);
			mr_ctx_free(&ctx);
			if (status == MR_OK)
				break;
		}
}

static mr_status
write_one(mr_ctx *ctx, const char *name, const mr_model *m)
{
	MR_ENTER(ctx);
	return mr_model_write(ctx, "memory.gz", name, m, NULL);
}

static void
memory_fails_writing(void **state)
{
	static const char *const names[] = { "obj", "ply", "stl", "off", "xyz", "ply-ascii" };
	(void)state;
	for (size_t i = 0; i < sizeof names / sizeof *names; i++)
		for (uint64_t k = 1;; k++) {
			mr_ctx ctx;
			mr_model m;
			mr_status status;
			mr_ctx_init(&ctx, 1);
			m = make_model(&ctx, 10, 10, true);
			ctx.fail_at = k;
			unlink("memory.gz");
			status = write_one(&ctx, names[i], &m);
			assert_true(status == MR_OK || status == MR_EMEM);
			assert_int_equal(access("memory.gz", F_OK), status == MR_OK ? 0 : -1);
			mr_ctx_free(&ctx);
			if (status == MR_OK)
				break;
		}
}

int
main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(seeds_damaged), cmocka_unit_test(packed_damaged),
		cmocka_unit_test(draco_damaged), cmocka_unit_test(written_damaged),
		cmocka_unit_test(gzip_damaged), cmocka_unit_test(memory_fails),
		cmocka_unit_test(memory_fails_writing) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
