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

/* From space to tilde, and a box: nine rows of five bits, from the left and from the top, highest first. */
/* clang-format off */
static const uint64_t glyphs[] = {
	0x000000000000, 0x042108401000, 0x0a5280000000, 0x0a57d5f52800, 0x047d1c5f1000, 0x18c888898c00,
	0x0c9511593400, 0x042200000000, 0x022210820800, 0x082084222000, 0x00255d520000, 0x00213e420000,
	0x000000021100, 0x00003e000000, 0x000000001000, 0x010888884000, 0x0e8c6b18b800, 0x046108423800,
	0x0e8844447c00, 0x0e884c18b800, 0x0232a5f10800, 0x1f878218b800, 0x0e843d18b800, 0x1f0884421000,
	0x0e8c5d18b800, 0x0e8c5e10b800, 0x000100001000, 0x000100021100, 0x001110410000, 0x0007c1f00000,
	0x004104440000, 0x0e8844401000, 0x0e8deb783800, 0x045463f8c400, 0x1e8c7d18f800, 0x0e8c2108b800,
	0x1e8c6318f800, 0x1f843d087c00, 0x1f843d084000, 0x0e8c2f18b800, 0x118c7f18c400, 0x0e2108423800,
	0x071084293000, 0x119531494400, 0x108421087c00, 0x11dd6b18c400, 0x118e6b38c400, 0x0e8c6318b800,
	0x1e8c7d084000, 0x0e8c63593400, 0x1e8c7d494400, 0x0f841c10f800, 0x1f2108421000, 0x118c6318b800,
	0x118c63151000, 0x118c6b5dc400, 0x118a88a8c400, 0x118a88421000, 0x1f0888887c00, 0x0e4210843800,
	0x108208208400, 0x0e1084213800, 0x045440000000, 0x0000000003e0, 0x082000000000, 0x000382f8bc00,
	0x1087a318f800, 0x0003e1083c00, 0x010be318bc00, 0x0003a3f83c00, 0x0323c8421000, 0x0003e318bc2e,
	0x1087a318c400, 0x040308423800, 0x02018421084c, 0x1084a98a4800, 0x0c2108423800, 0x0006ab5ad400,
	0x0007a318c400, 0x0003a318b800, 0x0007a318fa10, 0x0003e318bc21, 0x0005b3084000, 0x0003e0e0f800,
	0x0427c8420c00, 0x00046318bc00, 0x000463151000, 0x00046b5aa800, 0x000454454400, 0x00046318bc2e,
	0x0007c4447c00, 0x022110420800, 0x042108421000, 0x082104422000, 0x00026b200000, 0x1f8c6318fc00,
};
/* clang-format on */

uint64_t
mr_glyph(char letter)
{
	return glyphs[letter >= ' ' && letter <= '~' ? letter - ' ' : '~' - ' ' + 1];
}

void
mr_image_text(mr_image *image, double x, double y, double unit, mr_rgb color, const char *text)
{
	for (; *text; text++, x += MR_TEXT_ADVANCE * unit)
		for (int i = 0; i < 45; i++)
			if (mr_glyph(*text) >> (44 - i) & 1)
				mr_image_fill(image, x + i % 5 * unit, y + i / 5 * unit, unit, unit, color);
}
