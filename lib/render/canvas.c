/* Pixels set one by one, clipped to the image. */
#include "render/canvas.h"

#include "base/vec.h"

mr_status
mr_image_new(mr_ctx *ctx, size_t width, size_t height, mr_rgb color, mr_image *image)
{
	enum { MOST = 32767 };
	mr_rgb *pixel;

	if (width > MOST || height > MOST)
		return mr_fail(ctx, MR_ERANGE, "a picture of %zux%zu pixels is larger than %dx%d", width,
		    height, MOST, MOST);
	pixel = MR_NEW(ctx, width * height, mr_rgb);
	for (size_t i = 0; i < width * height; i++)
		pixel[i] = color;
	*image = (mr_image){ pixel, width, height };
	return MR_OK;
}

void
mr_image_copy(mr_image *to, size_t x, size_t y, const mr_image *from)
{
	size_t w = x < to->width ? to->width - x : 0;

	if (w > from->width)
		w = from->width;
	for (size_t j = 0; j < from->height && y + j < to->height && w; j++)
		memcpy(to->pixel + (y + j) * to->width + x, from->pixel + j * from->width,
		    w * sizeof *to->pixel);
}

/* The whole number nearest to x, brought into 0 to most. */
static size_t
clip(double x, size_t most)
{
	return x > 0 ? x < (double)most ? (size_t)(x + 0.5) : most : 0;
}

void
mr_image_fill(mr_image *image, double x, double y, double w, double h, mr_rgb color)
{
	size_t right = clip(x + w, image->width), bottom = clip(y + h, image->height);

	for (size_t j = clip(y, image->height); j < bottom; j++)
		for (size_t i = clip(x, image->width); i < right; i++)
			image->pixel[j * image->width + i] = color;
}

void
mr_image_text(mr_image *image, double x, double y, double unit, mr_rgb color, const char *text)
{
	for (; *text; text++, x += MR_TEXT_ADVANCE * unit) {
		const uint8_t *rows = mr_glyph(*text);
		for (int j = 0; j < MR_GLYPH_ROWS; j++)
			for (int i = 0; i < 5; i++)
				if (rows[j] >> (4 - i) & 1)
					mr_image_fill(image, x + i * unit, y + j * unit, unit, unit, color);
	}
}
