/* An image as a file: PNG is png.c's, PPM is a line and the bytes. */
#include "formats/picture.h"

#include "formats/bytes.h"
#include "formats/png.h"

const char *
mr_picture_suffix(mr_picture_kind kind)
{
	return kind == MR_PICTURE_PPM ? ".ppm" : ".png";
}

static mr_status
put_ppm(mr_sink *s, const mr_image *image)
{
	mr_print(s, "P6\n%zu %zu\n255\n", image->width, image->height);
	mr_put(s, image->pixel, image->width * image->height * sizeof *image->pixel);
	return s->status;
}

mr_status
mr_picture_write(mr_ctx *ctx, const char *path, mr_picture_kind kind, const mr_image *image)
{
	mr_sink sink;

	if (kind == MR_PICTURE_PNG)
		return mr_png_write(ctx, path, image);
	MR_TRY(mr_sink_open(ctx, path, false, &sink));
	return mr_sink_close(&sink, put_ppm(&sink, image));
}
