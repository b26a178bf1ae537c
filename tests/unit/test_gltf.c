/* glTF: what each kind of accessor, primitive and node gives; what is refused, and with which words; what is
 * written is read back. */
#include "gltf_text.h"
#include "heard.h"
#include "model_seeds.h"

#include <setjmp.h>
#include <stddef.h>

#include <cmocka.h>

static void
begin(mr_ctx *ctx)
{
	mr_ctx_init(ctx, 1);
	listen_to(ctx);
}

static mr_status
parse(mr_ctx *ctx, const char *json, const bytes *bin, mr_model *m)
{
	bytes glb = make_glb(json, bin);
	mr_status status = mr_model_parse(ctx, "", NULL, glb.data, glb.size, m);

	free(glb.data);
	return status;
}

/* JSON of one mesh whose primitives, accessors and views are given; a scene of `nodes`. */
static char *
document(mr_ctx *ctx, const char *nodes, const char *primitives, const char *accessors, const char *views,
    size_t bytes_of_buffer)
{
	return mr_format(ctx,
	    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[%s],\"meshes\":"
	    "[{\"primitives\":[%s]}],\"accessors\":[%s],\"bufferViews\":[%s],\"buffers\":[{\"byteLength\":%"
	    "zu}]}",
	    nodes, primitives, accessors, views, bytes_of_buffer);
}

/* Vertices of a row (i, i % 2, 0), and a primitive of them. */
static mr_model
row_of(mr_ctx *ctx, size_t n, const char *mode, const char *node)
{
	bytes bin = { 0 };
	mr_model m;
	char *json;

	for (size_t i = 0; i < n; i++)
		add_floats(&bin, 3, (double)i, (double)(i % 2), 0.);
	json = document(ctx, node, mr_format(ctx, "{\"attributes\":{\"POSITION\":0}%s}", mode),
	    mr_format(ctx, "{\"bufferView\":0,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\"}", n),
	    mr_format(ctx, "{\"buffer\":0,\"byteLength\":%zu}", bin.size), bin.size);
	assert_int_equal(parse(ctx, json, &bin, &m), MR_OK);
	free(bin.data);
	return m;
}

static void
assert_face(const mr_model *m, size_t f, uint32_t i, uint32_t j, uint32_t k)
{
	assert_int_equal(m->t[f].v[0], i);
	assert_int_equal(m->t[f].v[1], j);
	assert_int_equal(m->t[f].v[2], k);
}

static void
assert_v3(mr_v3 a, double x, double y, double z)
{
	assert_true(fabs(a.x - x) < 1e-12 && fabs(a.y - y) < 1e-12 && fabs(a.z - z) < 1e-12);
}

static void
modes(void **state)
{
	mr_ctx ctx;
	mr_model m;

	(void)state;
	begin(&ctx);
	m = row_of(&ctx, 6, "", "{\"mesh\":0}");
	assert_int_equal(m.nf, 2);
	assert_face(&m, 1, 3, 4, 5);
	m = row_of(&ctx, 5, ",\"mode\":5", "{\"mesh\":0}");
	assert_int_equal(m.nf, 3);
	assert_face(&m, 0, 0, 1, 2);
	assert_face(&m, 1, 1, 3, 2);
	assert_face(&m, 2, 2, 3, 4);
	m = row_of(&ctx, 5, ",\"mode\":6", "{\"mesh\":0}");
	assert_int_equal(m.nf, 3);
	assert_face(&m, 0, 1, 2, 0);
	assert_face(&m, 2, 3, 4, 0);
	m = row_of(&ctx, 5, ",\"mode\":0", "{\"mesh\":0}");
	assert_int_equal(m.nv, 5);
	assert_int_equal(m.nf, 0);
	assert_string_equal(heard, "");
	mr_ctx_free(&ctx);
}

/* A strip goes on elsewhere by faces with a vertex twice. */
static void
strip_with_stitches(void **state)
{
	static const unsigned char index[] = { 0, 1, 2, 2, 3, 3, 4, 5 };
	bytes bin = { 0 };
	mr_ctx ctx;
	mr_model m;
	char *json;

	(void)state;
	begin(&ctx);
	for (size_t i = 0; i < 6; i++)
		add_floats(&bin, 3, (double)i, (double)(i * i), 0.);
	add(&bin, index, sizeof index);
	json = document(&ctx, "{\"mesh\":0}", "{\"attributes\":{\"POSITION\":0},\"indices\":1,\"mode\":5}",
	    "{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"},"
	    "{\"bufferView\":0,\"byteOffset\":72,\"componentType\":5121,\"count\":8,\"type\":\"SCALAR\"}",
	    "{\"buffer\":0,\"byteLength\":80}", 80);
	assert_int_equal(parse(&ctx, json, &bin, &m), MR_OK);
	assert_int_equal(m.nf, 2);
	assert_face(&m, 0, 0, 1, 2);
	assert_face(&m, 1, 3, 5, 4);
	free(bin.data);
	mr_ctx_free(&ctx);
}

/* Maps of nodes above a mesh are composed; one that mirrors turns the faces over. */
static void
nodes(void **state)
{
	mr_ctx ctx;
	mr_model m;

	(void)state;
	begin(&ctx);
	m = row_of(&ctx, 3, "",
	    "{\"children\":[1],\"translation\":[10,0,0]},{\"children\":[2],\"rotation\":"
	    "[0,0,0.7071067811865476,0.7071067811865476]},{\"mesh\":0,\"scale\":[2,1,1]}");
	assert_v3(m.p[0], 10, 0, 0);
	assert_v3(m.p[1], 9, 2, 0);
	assert_v3(m.p[2], 10, 4, 0);
	assert_face(&m, 0, 0, 1, 2);
	m = row_of(&ctx, 3, "", "{\"mesh\":0,\"matrix\":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}");
	assert_v3(m.p[1], 4, 7, 7);
	assert_face(&m, 0, 0, 2, 1);
	m = row_of(
	    &ctx, 3, "", "{\"mesh\":0,\"children\":[1]},{\"mesh\":0,\"name\":\"b\",\"scale\":[1,1,2]}");
	assert_int_equal(m.nv, 6); /* meshes are not joined to each other */
	assert_int_equal(m.nf, 2);
	assert_int_equal(m.object[1], 1);
	assert_memory_equal(m.objects.text, "\nb", m.objects.bytes);
	mr_ctx_free(&ctx);
}

/* The seam's vertices are one each, and its corners keep what they have; v is turned over. */
static void
seam(void **state)
{
	static const double uv[] = { 0, 0, 0.5, 0, 0.5, 0.5, 0.5, 0.5, 1, 1, 0.5, 1 };
	bytes glb = square_glb();
	mr_ctx ctx;
	mr_model m;

	(void)state;
	begin(&ctx);
	assert_int_equal(mr_model_parse(&ctx, "", NULL, glb.data, glb.size, &m), MR_OK);
	assert_int_equal(m.nv, 4);
	assert_face(&m, 0, 0, 1, 2);
	assert_face(&m, 1, 0, 2, 3);
	assert_null(m.texcoord);
	assert_memory_equal(m.corner_texcoord, uv, sizeof uv);
	assert_int_equal(m.counts.seam_vertices, 2);
	assert_int_equal(m.materials.bytes, 5);
	assert_memory_equal(m.materials.text, "paper", 5);
	assert_memory_equal(m.objects.text, "square", 6);
	free(glb.data);
	mr_ctx_free(&ctx);
}

static void
text_with_uri(void **state)
{
	mr_ctx ctx;
	mr_model m;

	(void)state;
	begin(&ctx);
	assert_int_equal(
	    mr_model_parse(&ctx, "", NULL, (const unsigned char *)triangle_gltf, strlen(triangle_gltf), &m),
	    MR_OK);
	assert_int_equal(m.nv, 3);
	assert_v3(m.p[2], 0, 1, 0);
	assert_memory_equal(m.objects.text, "\xe2\x96\xb3", m.objects.bytes);
	mr_ctx_free(&ctx);
}

/* Normalised whole numbers with a stride, colours that are linear. */
static void
accessors(void **state)
{
	static const unsigned char position[] = { 0, 0, 0, 9, 127, 0, 0, 9, 0, 0x80, 0, 9 };
	static const unsigned char color[] = { 255, 0, 0, 255, 0, 55, 0, 128, 0, 0, 255, 0 };
	bytes bin = { 0 };
	mr_ctx ctx;
	mr_model m;
	char *json;

	(void)state;
	begin(&ctx);
	add(&bin, position, sizeof position);
	add(&bin, color, sizeof color);
	json = document(&ctx, "{\"mesh\":0}", "{\"attributes\":{\"POSITION\":0,\"COLOR_0\":1}}",
	    "{\"bufferView\":0,\"componentType\":5120,\"normalized\":true,\"count\":3,\"type\":\"VEC3\"},"
	    "{\"bufferView\":1,\"componentType\":5121,\"normalized\":true,\"count\":3,\"type\":\"VEC4\"}",
	    "{\"buffer\":0,\"byteLength\":12,\"byteStride\":4},{\"buffer\":0,\"byteOffset\":12,"
	    "\"byteLength\":12}",
	    24);
	assert_int_equal(parse(&ctx, json, &bin, &m), MR_OK);
	assert_v3(m.p[1], 1, 0, 0);
	assert_v3(m.p[2], 0, -1, 0);
	assert_int_equal(m.color[0], 255);
	assert_int_equal(m.color[5], 128); /* 55 / 255 is 0.216, of which sRGB makes 0.502 */
	assert_int_equal(m.color[7], 128);
	free(bin.data);
	mr_ctx_free(&ctx);
}

/* What a model has no place for is named. */
static void
left_out(void **state)
{
	char json[4096];
	bytes bin = square_bin();
	mr_ctx ctx;
	mr_model m;

	(void)state;
	begin(&ctx);
	snprintf(json, sizeof json,
	    "%.*s,\"images\":[{},{}],\"skins\":[{}],\"animations\":[{}],\"cameras\":[{}],"
	    "\"extensionsRequired\":[\"KHR_texture_basisu\"]}",
	    (int)strlen(square_json) - 1, square_json);
	assert_int_equal(parse(&ctx, json, &bin, &m), MR_OK);
	assert_string_equal(heard, "2 images\n1 skins\n1 animations\n1 cameras\n");
	free(bin.data);
	mr_ctx_free(&ctx);
}

/* ---- what is refused ---- */

/* The square's JSON with one piece of it replaced. */
static void
refuses(const char *from, const char *to, const char *sentence)
{
	const char *at = strstr(square_json, from);
	char json[4096];
	bytes bin = square_bin();
	mr_ctx ctx;
	mr_model m;

	assert_non_null(at);
	begin(&ctx);
	snprintf(json, sizeof json, "%.*s%s%s", (int)(at - square_json), square_json, to, at + strlen(from));
	assert_true(parse(&ctx, json, &bin, &m) < 0);
	assert_string_equal(ctx.error, sentence);
	free(bin.data);
	mr_ctx_free(&ctx);
}

static void
refused(void **state)
{
	(void)state;
	refuses("\"2.0\"", "\"1.0\"", "version 1.0 of glTF is not read, 2.0 is");
	refuses("\"asset\"", "\"assets\"", "version none of glTF is not read, 2.0 is");
	refuses("[0]", "[0,]", "JSON, line 1: unexpected token near ']'");
	refuses("\"scene\":0", "\"extensionsRequired\":[\"KHR_gaussian_splatting\"]",
	    "the file needs the extension KHR_gaussian_splatting, which is not read");
	refuses("\"scene\":0", "\"scene\":1", "scene names number 1 of 1 scenes");
	refuses("{\"mesh\":0,", "{\"children\":[0],\"mesh\":0,",
	    "node 0 hangs from more than one, or from itself");
	refuses(
	    "{\"mesh\":0,", "{\"children\":[7],\"mesh\":0,", "a scene or a node names none of the 1 nodes");
	refuses("{\"mesh\":0,", "{\"mesh\":3,", "node 0: mesh names number 3 of 1 meshes");
	refuses("{\"mesh\":0,", "{\"scale\":[1,2],\"mesh\":0,", "node 0: scale has 2 numbers, not 3");
	refuses("\"POSITION\":0", "\"POSITION\":9",
	    "mesh 0, primitive 0: POSITION names number 9 of 3 accessors");
	refuses("\"POSITION\":0", "\"POSITION\":-1",
	    "mesh 0, primitive 0: POSITION is no whole number of 0 to 18446744073709551614");
	refuses("\"byteLength\":126", "\"byteLength\":126,\"uri\":\"square.bin\"",
	    "mesh 0, primitive 0: accessor 0: buffer 0: the file square.bin is missing");
	refuses("\"byteLength\":126", "\"byteLength\":400",
	    "mesh 0, primitive 0: accessor 0: buffer 0 should have 400 bytes, and has 128");
	refuses("\"byteLength\":72", "\"byteLength\":200",
	    "mesh 0, primitive 0: accessor 0: buffer view 0 is outside its buffer of 126 bytes");
	refuses("\"byteLength\":72", "\"byteLength\":60",
	    "mesh 0, primitive 0: accessor 0: 6 rows cannot be in 60 bytes from 0 on");
	refuses("\"byteLength\":72", "\"byteLength\":72,\"byteStride\":8",
	    "mesh 0, primitive 0: accessor 0: rows of 12 bytes follow each other after 8");
	refuses("\"count\":6,\"type\":\"VEC2\"", "\"count\":5,\"type\":\"VEC2\"",
	    "mesh 0, primitive 0: accessor 1 has 5 rows, not 6");
	refuses("\"count\":6,\"type\":\"SCALAR\"", "\"count\":5,\"type\":\"SCALAR\"",
	    "mesh 0, primitive 0: triangles of 5 corners");
	refuses("\"byteOffset\":120", "\"byteOffset\":63", "accessor 2: index 3 is vertex 128 of 6");
	refuses("\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"",
	    "\"componentType\":5130,\"count\":6,\"type\":\"VEC3\"",
	    "mesh 0, primitive 0: accessor 0: componentType is no whole number of 0 to 5126");
	refuses("\"bufferView\":0,\"componentType\":5126,\"count\":6",
	    "\"componentType\":5126,\"count\":4000000000",
	    "mesh 0, primitive 0: accessor 0 has no buffer view: an extension may have packed it");
}

static void
chunks_refused(void **state)
{
	bytes glb = square_glb(), bare = make_glb(square_json, NULL);
	mr_ctx ctx;
	mr_model m;

	(void)state;
	begin(&ctx);
	assert_int_equal(mr_model_parse(&ctx, "", NULL, glb.data, glb.size - 4, &m), MR_EFORMAT);
	assert_non_null(strstr(ctx.error, "byte 8: the file should have "));
	assert_int_equal(mr_model_parse(&ctx, "", NULL, glb.data, 11, &m), MR_EFORMAT);
	assert_string_equal(ctx.error, "byte 8: the file should have 12 bytes, and has 11");
	assert_int_equal(mr_model_parse(&ctx, "", NULL, bare.data, bare.size, &m), MR_EFORMAT);
	assert_string_equal(ctx.error, "mesh 0, primitive 0: accessor 0: buffer 0 is not in the file");
	glb.data[4] = 1;
	assert_int_equal(mr_model_parse(&ctx, "", NULL, glb.data, glb.size, &m), MR_EFORMAT);
	assert_string_equal(ctx.error, "byte 4: version 1 of glTF is not read, 2 is");
	glb.data[4] = 2;
	glb.data[12] ^= 0x40; /* the chunk of JSON is longer than the file, or ends inside it */
	assert_int_equal(mr_model_parse(&ctx, "", NULL, glb.data, glb.size, &m), MR_EFORMAT);
	free(glb.data);
	free(bare.data);
	mr_ctx_free(&ctx);
}

/* ---- written and read back ---- */

static mr_model
there_and_back(mr_ctx *ctx, const mr_model *m)
{
	mr_model back;

	assert_int_equal(mr_model_write(ctx, "back.glb", NULL, m, NULL), MR_OK);
	assert_int_equal(mr_model_read(ctx, "back.glb", NULL, &back), MR_OK);
	return back;
}

/* Two objects of two materials, corners with and without coordinates, an isolated vertex. */
static void
seams_come_back(void **state)
{
	static const mr_v3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 9, 9, 9 },
		{ 5, 0, 0 }, { 6, 0, 0 }, { 5, 1, 0 } };
	static const mr_tri t[] = { { { 0, 1, 2 } }, { { 0, 2, 3 } }, { { 5, 6, 7 } } };
	static const mr_v3 normal[] = { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 }, { 0, 1, 0 }, { 0, 0, 1 },
		{ 0, 0, 1 }, { 1, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 } };
	static const uint32_t material[] = { 1, 0, 2 }, object[] = { 0, 0, 1 };
	const double uv[] = { 0, 0, 0.5, 0, 0.5, 0.25, 0.75, 0, 0.5, 0.25, 0, 1, NAN, NAN, NAN, NAN, NAN,
		NAN };
	const mr_model m = { .p = p,
		.nv = 8,
		.t = t,
		.nf = 3,
		.corner_texcoord = uv,
		.corner_normal = normal,
		.material = material,
		.materials = { "red\nblue\n", 9 },
		.object = object,
		.objects = { "sheet\nflag", 10 } };
	mr_ctx ctx;
	mr_model b;

	(void)state;
	begin(&ctx);
	b = there_and_back(&ctx, &m);
	assert_int_equal(b.nv, 8);
	assert_int_equal(b.nf, 3);
	assert_face(&b, 0, 0, 2, 3); /* red comes first */
	assert_face(&b, 1, 0, 1, 2);
	assert_face(&b, 2, 5, 6, 7);
	assert_memory_equal(b.p, p, sizeof p);
	assert_memory_equal(b.corner_texcoord, uv + 6, 6 * sizeof *uv);
	assert_memory_equal(b.corner_texcoord + 6, uv, 6 * sizeof *uv);
	assert_true(isnan(b.corner_texcoord[12]));
	assert_memory_equal(b.corner_normal, normal + 3, 3 * sizeof *normal);
	assert_memory_equal(b.materials.text, "red\nblue\n", b.materials.bytes);
	assert_int_equal(b.material[0], 0);
	assert_int_equal(b.material[1], 1);
	assert_int_equal(b.material[2], 2); /* an empty name */
	assert_memory_equal(b.objects.text, "sheet\nflag", b.objects.bytes);
	assert_int_equal(b.object[2], 1);
	mr_ctx_free(&ctx);
}

/* Every byte of a colour comes back through linear values; vertices keep their order. */
static void
colors_come_back(void **state)
{
	unsigned char color[4 * 256];
	mr_v3 p[256];
	mr_tri t[254];
	mr_model m = { .p = p, .nv = 256, .t = t, .nf = 254, .color = color }, b;
	mr_ctx ctx;

	(void)state;
	begin(&ctx);
	for (int i = 0; i < 256; i++) {
		p[i] = mr_vec(i, i % 2, i % 3);
		for (int k = 0; k < 4; k++)
			color[4 * i + k] = (unsigned char)(k % 2 ? 255 - i : i);
	}
	for (uint32_t f = 0; f < 254; f++)
		t[f] = (mr_tri){ { 253 - f, 254 - f, 255 - f } };
	b = there_and_back(&ctx, &m);
	assert_int_equal(b.nv, 256);
	assert_memory_equal(b.p, p, sizeof p);
	assert_memory_equal(b.color, color, sizeof color);
	assert_memory_equal(b.t, t, sizeof t);
	assert_null(b.material);
	assert_null(b.object);
	mr_ctx_free(&ctx);
}

static void
too_large_for_floats(void **state)
{
	const mr_v3 p[] = { { 0, 0, 0 }, { 1e39, 0, 0 }, { 0, 1, 0 } };
	const mr_tri t = { { 0, 1, 2 } };
	const double uv[] = { 0, 0, 1e39, 0, 0, 1 };
	mr_model m = { .p = p, .nv = 3, .t = &t, .nf = 1 };
	mr_ctx ctx;

	(void)state;
	begin(&ctx);
	assert_int_equal(mr_model_write(&ctx, "large.glb", NULL, &m, NULL), MR_ERANGE);
	m.nv = m.nf = 1;
	m.t = &(mr_tri){ { 0, 0, 0 } };
	m.corner_texcoord = uv;
	assert_int_equal(mr_model_write(&ctx, "large.glb", NULL, &m, NULL), MR_ERANGE);
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(modes), cmocka_unit_test(strip_with_stitches),
		cmocka_unit_test(nodes), cmocka_unit_test(seam), cmocka_unit_test(text_with_uri),
		cmocka_unit_test(accessors), cmocka_unit_test(left_out), cmocka_unit_test(refused),
		cmocka_unit_test(chunks_refused), cmocka_unit_test(seams_come_back),
		cmocka_unit_test(colors_come_back), cmocka_unit_test(too_large_for_floats) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
