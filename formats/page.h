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

/* Adds what a page shows of the layers in the list (NULL: all), doubles rounded to 24 bits.  MR_EMISSING: a
 * layer is not there; MR_ERANGE: the page is too large; MR_EFORMAT: a texture is no picture. */
mr_status mr_page_add(mr_ctx *ctx, mr_page *page, mr_frame *frame, const char *layers) MR_WARN_UNUSED;

/* Writes `html` with the frames in place of the line <!-- stream -->.  held: the file, the caller's to keep
 * or to drop.  MR_EMISSING where pictures are asked for and no layer wears any. */
mr_status mr_page_write(
    mr_ctx *ctx, mr_page *page, const char *html, const char *path, mr_outfile *held) MR_WARN_UNUSED;

/* Frees what it holds; accepts a zeroed one. */
void mr_page_free(mr_page *page);

#endif
