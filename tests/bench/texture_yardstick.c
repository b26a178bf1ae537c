/*
 * texture_yardstick -- how much textured surfaces look like others; usage:
 *	texture_yardstick grid OUT.png       a picture to lay on them: squares, of a colour for each place
 *	texture_yardstick compare PNG...     sheets of mr-render, each of a surface and beside it the other
 *
 * compare prints the mean absolute difference of the colours, 0 to 255, of the pixels that either surface
 *covers.
 */
#include "formats/image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 512, SQUARE = 32 };

static const mr_rgb light = { 232, 230, 222 };

static mr_status
write_grid(mr_ctx *ctx, const char *path)
{
	mr_image grid;

	MR_TRY(mr_image_new(ctx, SIDE, SIDE, light, &grid));
	for (size_t i = 0; i < (size_t)SIDE * SIDE; i++) {
		size_t x = i % SIDE, y = i / SIDE;
		if ((x / SQUARE + y / SQUARE) % 2 == 0)
			grid.pixel[i] = (mr_rgb){ (unsigned char)(30 + 200 * x / SIDE),
				(unsigned char)(50 + 180 * y / SIDE), 90 };
	}
	return mr_png_write(ctx, path, &grid);
}

static bool
same(mr_rgb a, mr_rgb b)
{
	return a.r == b.r && a.g == b.g && a.b == b.b;
}

/* Adds the differences of a sheet's two panels, and how many pixels have a surface. */
static mr_status
add_sheet(mr_ctx *ctx, const char *path, double *sum, size_t *pixels)
{
	mr_image sheet;

	MR_TRY(mr_image_read(ctx, &(mr_file){ .name = path }, &sheet));
	for (size_t i = 0, half = sheet.width / 2; i < sheet.height * half; i++) {
		size_t at = i / half * sheet.width + i % half;
		mr_rgb a = sheet.pixel[at], b = sheet.pixel[at + half];
		if (same(a, sheet.pixel[0]) && same(b, sheet.pixel[0]))
			continue;
		*sum += (abs(a.r - b.r) + abs(a.g - b.g) + abs(a.b - b.b)) / 3.0;
		++*pixels;
	}
	return MR_OK;
}

static mr_status
run(mr_ctx *ctx, int argc, char **argv)
{
	double sum = 0;
	size_t pixels = 0;

	if (argc == 3 && !strcmp(argv[1], "grid"))
		return write_grid(ctx, argv[2]);
	if (argc < 3 || strcmp(argv[1], "compare"))
		return mr_fail(ctx, MR_EUSAGE, "usage: texture_yardstick grid OUT.png | compare PNG...");
	for (int k = 2; k < argc; k++)
		MR_TRY(add_sheet(ctx, argv[k], &sum, &pixels));
	printf("%.2f\n", pixels ? sum / (double)pixels : 0);
	return MR_OK;
}

int
main(int argc, char **argv)
{
	mr_ctx ctx;
	int failed = 1;

	mr_ctx_init(&ctx, 1);
	if (run(&ctx, argc, argv) < 0)
		fprintf(stderr, "texture_yardstick: %s\n", ctx.error);
	else
		failed = fflush(stdout) != 0;
	mr_ctx_free(&ctx);
	return failed;
}
