/* page.h -- a page for browsers: frames as a packed stream, in one HTML file.  Layer rule: formats includes
 * lib. */
#ifndef MR_PAGE_H
#define MR_PAGE_H

#include "base/outfile.h"
#include "formats/page_pictures.h"
#include "stream/frame.h"

#include <stdio.h>

/* A page in the making; starts zeroed. */
typedef struct mr_page {
	FILE *file; /* without a name: the stream, until the page is written */
	mr_writer *writer;
	size_t frames;
	mr_page_pictures pictures;
	const char *from; /* the caller's to set: the file that frames come from now; NULL: none to be told */
} mr_page;

/* Adds a frame: of the layers in the list (NULL: all that have positions) what a page shows, doubles rounded
 * to 24 bits.  MR_EMISSING for a layer that the frame has not; MR_ERANGE where the page is too large for a
 * browser; MR_EFORMAT for a texture that is no picture. */
mr_status mr_page_add(mr_ctx *ctx, mr_page *page, mr_frame *frame, const char *layers) MR_WARN_UNUSED;

/* Writes the page: the text of `html`, in which the frames take the place of the line <!-- stream -->.  held:
 * the file, which is the caller's to keep or to drop.  MR_EMISSING where pictures are asked for and no layer
 * wears any. */
mr_status mr_page_write(
    mr_ctx *ctx, mr_page *page, const char *html, const char *path, mr_outfile *held) MR_WARN_UNUSED;

/* Frees what it holds; accepts a zeroed one. */
void mr_page_free(mr_page *page);

#endif
