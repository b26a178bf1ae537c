/* Pictures: their smaller copies, places in them; what files of materials say, and which files they may name.
 */
#include "formats/image.h"
#include "formats/materials.h"
#include "heard.h"
#include "render/texture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/stat.h>

#include <cmocka.h>

static void
levels(void **state)
{
	mr_texture t;
	mr_image image;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	assert_int_equal(mr_image_new(&ctx, 5, 3, (mr_rgb){ 10, 20, 30 }, &image), MR_OK);
	image.pixel[0] = (mr_rgb){ 50, 20, 30 };
	assert_int_equal(mr_texture_make(&ctx, &image, &t), MR_OK);
	assert_int_equal(t.levels, 4); /* 5 x 3, 3 x 2, 2 x 1, 1 x 1 */
	assert_int_equal(t.level[1].width, 3);
	assert_int_equal(t.level[1].height, 2);
	assert_int_equal(t.level[1].pixel[0].r, 20);
	assert_int_equal(t.level[1].pixel[1].r, 10);
	assert_int_equal(mr_texture_level(&t, 1, 1), 0);
	assert_int_equal(mr_texture_level(&t, 1, 100), 0);
	assert_int_equal(mr_texture_level(&t, 16, 1), 2);
	assert_int_equal(mr_texture_level(&t, 1e9, 1), 3);
	assert_int_equal(mr_texture_level(&t, 1, 0), 0);
	mr_ctx_free(&ctx);
}

static double
red_at(const mr_texture *t, double u, double v)
{
	mr_texels x = mr_texture_at(t, 0, u, v);
	double red = 0;

	for (int i = 0; i < 4; i++)
		red += x.weight[i] * x.color[i].r;
	return red;
}

/* v runs upwards; between middles of pixels values are mixed, and the picture repeats. */
static void
places(void **state)
{
	mr_texture t;
	mr_image image;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	assert_int_equal(mr_image_new(&ctx, 2, 2, (mr_rgb){ 0, 0, 0 }, &image), MR_OK);
	image.pixel[0].r = 100; /* upper left */
	image.pixel[3].r = 200; /* lower right */
	assert_int_equal(mr_texture_make(&ctx, &image, &t), MR_OK);
	assert_true(red_at(&t, 0.25, 0.75) == 100);
	assert_true(red_at(&t, 0.75, 0.25) == 200);
	assert_true(red_at(&t, 0.25, 0.25) == 0);
	assert_true(red_at(&t, 0.5, 0.75) == 50);
	assert_true(red_at(&t, 0.5, 0.5) == 75);
	assert_true(red_at(&t, 3.25, -1.25) == 100);
	assert_true(red_at(&t, 1, 0.75) == 50); /* across the edge */
	assert_true(red_at(&t, 1e300, -1e300) >= 0);
	mr_ctx_free(&ctx);
}

static void
put(const char *path, const char *text)
{
	FILE *f = fopen(path, "w");

	assert_non_null(f);
	assert_true(fputs(text, f) >= 0 && fclose(f) == 0);
}

static void
materials(void **state)
{
	static const uint32_t material[] = { 0 };
	const char names[] = "red\nblue two\ngreen\nout\nabsolute";
	mr_model m = { .nf = 1,
		.material = material,
		.materials = { names, sizeof names - 1 },
		.mtllib = { "sub\\m.mtl\ngone.mtl", 18 } };
	mr_material *look;
	size_t count;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	listen_to(&ctx);
	mkdir("folder", 0777);
	mkdir("folder/sub", 0777);
	put("outside.png", "");
	put("folder/a b.png", "");
	put("folder/absolute.png", "");
	put("folder/sub/m.mtl", "# comment\nKd 1 1 1\nnewmtl red\n  Kd 1 0.5 -2 # red\nnewmtl blue two\nKd "
				"0.25\nmap_Kd a b.png\n"
				"newmtl nobody\nKd 9 9 9\nnewmtl out\nmap_Kd "
				"../outside.png\nnewmtl absolute\n"
				"map_kd -s 2 2 -o 0 0 0 -clamp on -bm 0.1 "
				"C:\\pictures\\absolute.png\n");
	assert_int_equal(mr_materials_find(&ctx, &m, "folder", &look, &count), MR_OK);
	assert_int_equal(count, 5);
	assert_true(
	    look[0].colored && look[0].color[0] == 1 && look[0].color[1] == 0.5 && look[0].color[2] == 0);
	assert_null(look[0].file.name);
	assert_true(look[1].colored && look[1].color[2] == 0.25);
	assert_string_equal(look[1].file.name, "folder/a b.png");
	assert_false(look[2].colored);
	assert_null(look[3].file.name);
	assert_string_equal(look[4].file.name, "folder/absolute.png");
	assert_string_equal(heard, "1 ../outside.png\n1 gone.mtl\n1 material green\n");
	mr_ctx_free(&ctx);
}

/* Every prefix of a picture, and every byte of it changed: an image or a sentence. */
static void
png_damaged(void **state)
{
	static const unsigned char png[] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I',
		'H', 'D', 'R', 0, 0, 0, 1, 0, 0, 0, 1, 8, 2, 0, 0, 0, 0x90, 0x77, 0x53, 0xde, 0, 0, 0, 12,
		'I', 'D', 'A', 'T', 0x78, 0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0, 0, 3, 1, 1, 0, 0xc9, 0xfe, 0x92,
		0xef, 0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82 };
	unsigned char copy[sizeof png];
	size_t refused = 0;

	(void)state;
	for (size_t n = 0; n <= 2 * sizeof png; n++) {
		mr_image image;
		mr_ctx ctx;
		mr_ctx_init(&ctx, 1);
		memcpy(copy, png, sizeof png);
		if (n > sizeof png)
			copy[n - sizeof png - 1] ^= 0x41;
		if (mr_png_read(&ctx, copy, n < sizeof png ? n : sizeof png, &image) == MR_OK)
			assert_int_equal(image.width * image.height > 0, 1);
		else {
			assert_true(ctx.error[0] != 0);
			refused++;
		}
		if (n == sizeof png)
			assert_int_equal(image.pixel[0].r, 255);
		mr_ctx_free(&ctx);
	}
	assert_true(refused > sizeof png / 2);
}

int
main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(levels), cmocka_unit_test(places),
		cmocka_unit_test(materials), cmocka_unit_test(png_damaged) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
