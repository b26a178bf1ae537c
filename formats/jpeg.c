/* libjpeg, whose failures jump. */
#include "formats/image.h"

#include <setjmp.h>
#include <stdio.h>

#include <jpeglib.h>

#include <jerror.h>

_Static_assert(sizeof(mr_rgb) == 3, "rows of pixels are rows of bytes");

typedef struct failure {
	struct jpeg_error_mgr manager; /* first: libjpeg knows only this */
	jmp_buf back;
	char sentence[JMSG_LENGTH_MAX];
} failure;

static void
on_error(j_common_ptr info)
{
	failure *f = (failure *)(void *)info->err;

	info->err->format_message(info, f->sentence);
	longjmp(f->back, 1);
}

/* Some good pictures have meaningless bytes before a marker: cameras write 1 to 20 of them.  A changed bit
 * leaves over 35 and more. */
static bool
is_harmless(const struct jpeg_error_mgr *e)
{
	enum { PADDING = 32 };

	return e->msg_code == JWRN_ADOBE_XFORM || e->msg_code == JWRN_JFIF_MAJOR ||
	       e->msg_code == JWRN_NOT_SEQUENTIAL ||
	       (e->msg_code == JWRN_EXTRANEOUS_DATA && e->msg_parm.i[0] <= PADDING);
}

/* libjpeg continues after damage, with grey for missing pixels. */
static void
on_message(j_common_ptr info, int level)
{
	if (level < 0 && !is_harmless(info->err))
		on_error(info);
}

static mr_status
decode(mr_ctx *ctx, struct jpeg_decompress_struct *info, failure *f, const unsigned char *data, size_t size,
    mr_image *image)
{
	MR_ENTER(ctx);
	if (setjmp(f->back))
		return mr_fail(ctx, MR_EFORMAT, "%s", f->sentence);
	jpeg_mem_src(info, data, size);
	jpeg_read_header(info, TRUE);
	MR_TRY(mr_image_fits(ctx, info->image_width, info->image_height, size, MR_JPEG_MOST));
	info->out_color_space = JCS_RGB;
	jpeg_start_decompress(info);
	MR_TRY(mr_image_new(ctx, info->output_width, info->output_height, (mr_rgb){ 0, 0, 0 }, image));
	while (info->output_scanline < info->output_height) {
		JSAMPROW row = &image->pixel[info->output_scanline * image->width].r;
		jpeg_read_scanlines(info, &row, 1);
	}
	jpeg_finish_decompress(info);
	return MR_OK;
}

mr_status
mr_jpeg_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_image *image)
{
	struct jpeg_decompress_struct info = { 0 };
	failure f;
	mr_image made;
	mr_status status;

	info.err = jpeg_std_error(&f.manager);
	f.manager.error_exit = on_error;
	f.manager.emit_message = on_message;
	jpeg_create_decompress(&info);
	status = decode(ctx, &info, &f, data, size, &made);
	jpeg_destroy_decompress(&info);
	if (status == MR_OK)
		*image = made;
	return status;
}
