/* Pyramids of pictures, and places in them. */
#include "render/texture.h"

#include <math.h>

static uint8_t
mean(unsigned a, unsigned b, unsigned c, unsigned d)
{
	return (uint8_t)((a + b + c + d + 2) / 4);
}

/* Half as wide and high, rounded up. */
static mr_status
halve(mr_ctx *ctx, const mr_image *from, mr_image *to)
{
	MR_TRY(mr_image_new(ctx, (from->width + 1) / 2, (from->height + 1) / 2, (mr_rgb){ 0, 0, 0 }, to));
	for (size_t y = 0; y < to->height; y++) {
		const mr_rgb *upper = from->pixel + 2 * y * from->width;
		const mr_rgb *lower = 2 * y + 1 < from->height ? upper + from->width : upper;
		for (size_t x = 0; x < to->width; x++) {
			size_t i = 2 * x, j = 2 * x + 1 < from->width ? i + 1 : i;
			mr_rgb a = upper[i], b = upper[j], c = lower[i], d = lower[j];
			to->pixel[y * to->width + x] = (mr_rgb){ mean(a.r, b.r, c.r, d.r),
				mean(a.g, b.g, c.g, d.g), mean(a.b, b.b, c.b, d.b) };
		}
	}
	return MR_OK;
}

mr_status
mr_texture_make(mr_ctx *ctx, const mr_image *image, mr_texture *texture)
{
	mr_texture made = { .level = { *image }, .levels = 1 };

	while (made.levels < MR_TEXTURE_LEVELS &&
	       (made.level[made.levels - 1].width > 1 || made.level[made.levels - 1].height > 1)) {
		MR_TRY(halve(ctx, &made.level[made.levels - 1], &made.level[made.levels]));
		made.levels++;
	}
	*texture = made;
	return MR_OK;
}

int
mr_texture_level(const mr_texture *texture, double texels, double samples)
{
	double level = samples > 0 && texels > samples ? 0.5 * log2(texels / samples) : 0;

	return level < texture->levels - 1 ? (int)(level + 0.5) : texture->levels - 1;
}

/* The pixel left of, or above, a share of n pixels, and how far past its middle that is. */
static size_t
split(double share, size_t n, double *rest)
{
	double x = (share - floor(share)) * (double)n - 0.5, whole = floor(x);

	*rest = x - whole;
	return whole < 0 ? n - 1 : whole < (double)n ? (size_t)whole : 0;
}

mr_texels
mr_texture_at(const mr_texture *texture, int level, double u, double v)
{
	const mr_image *image = &texture->level[level];
	double a, b;
	size_t x = split(u, image->width, &a), y = split(1 - v, image->height, &b);
	size_t right = x + 1 < image->width ? x + 1 : 0, below = y + 1 < image->height ? y + 1 : 0;
	const mr_rgb *upper = image->pixel + y * image->width, *lower = image->pixel + below * image->width;

	return (mr_texels){ .color = { upper[x], upper[right], lower[x], lower[right] },
		.weight = { (1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b } };
}
