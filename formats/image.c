/* Pictures by their bytes. */
#include "formats/image.h"

bool
mr_is_png(const unsigned char *data, size_t size)
{
	return size > 8 && !memcmp(data, "\x89PNG\r\n\x1a\n", 8);
}

bool
mr_is_jpeg(const unsigned char *data, size_t size)
{
	return size > 3 && !memcmp(data, "\xff\xd8\xff", 3);
}

mr_status
mr_image_fits(mr_ctx *ctx, size_t width, size_t height, size_t bytes, size_t most)
{
	return width == 0 || height <= (bytes + 1) * most / width
	           ? MR_OK
	           : mr_fail(ctx, MR_EFORMAT, "a picture of %zux%zu pixels cannot be in %zu bytes", width,
			 height, bytes);
}

mr_status
mr_image_decode(mr_ctx *ctx, const unsigned char *data, size_t size, mr_image *image)
{
	if (mr_is_png(data, size))
		return mr_png_read(ctx, data, size, image);
	if (mr_is_jpeg(data, size))
		return mr_jpeg_read(ctx, data, size, image);
	return mr_fail(ctx, MR_EFORMAT, "neither a PNG nor a JPEG");
}

mr_status
mr_image_read(mr_ctx *ctx, const mr_file *file, mr_image *image)
{
	mr_file_bytes b = { 0 };

	MR_TRY(mr_file_read(ctx, file, &b));
	return mr_prefix(
	    ctx, mr_file_bytes_end(&b, mr_image_decode(ctx, b.data, b.size, image)), "%s", file->name);
}
