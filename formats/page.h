/* page.h -- a page for browsers: frames as a packed stream, in one HTML file.  Layer rule: formats includes
 * lib. */
#ifndef MR_PAGE_H
#define MR_PAGE_H

#include "base/outfile.h"
#include "base/text.h"
#include "formats/bytes.h"
#include "stream/frame.h"

#include <stdio.h>

/* One file, as it stands in the page. */
typedef struct mr_page_picture {
	const char *path;
	unsigned char *data;
	size_t size;
} mr_page_picture;

/* The looks and pictures collected so far; starts zeroed. */
typedef struct mr_page_pictures {
	const char *texture;   /* the caller's: a picture for all that have texture coordinates, or NULL */
	const char *materials; /* the caller's: the folder of the files of materials, or NULL */
	mr_ctx *keep;          /* the caller's: whose arena holds the pictures until the page is written */
	mr_page_picture *picture;
	size_t count, room, bytes; /* bytes: of all pictures */
	bool worn;                 /* whether any layer wears a picture or its materials' colours */
} mr_page_pictures;

/* Whether the layer has what it needs to wear what is asked for. */
bool mr_page_can_wear(const mr_page_pictures *p, const mr_frame *f, const char *layer);

/* Reads what the layer wears, each file once.  Lines in `notes` tell the page; *coordinates: the column that
 * places it, or NULL.  MR_EFORMAT: a texture is no picture; of a material that is a finding. */
mr_status mr_page_wear(mr_ctx *ctx, mr_page_pictures *p, mr_frame *f, const char *layer, mr_text *notes,
    const char **coordinates) MR_WARN_UNUSED;

/* MR_EMISSING where pictures are asked for and no layer wears any. */
mr_status mr_page_pictures_check(mr_ctx *ctx, const mr_page_pictures *p) MR_WARN_UNUSED;

/* Writes them as elements of the page. */
mr_status mr_page_pictures_put(mr_sink *s, const mr_page_pictures *p) MR_WARN_UNUSED;

/* n bytes as text; only the last ones of an element may be no multiple of 3. */
void mr_put_base64(mr_sink *s, const unsigned char *p, size_t n);

/* A stream on the way, in a file without a name. */
typedef struct mr_page_stream {
	FILE *file;
	mr_writer *writer;
} mr_page_stream;

/* A page in the making; starts zeroed. */
typedef struct mr_page {
	double pack; /* the caller's: mean error of displaced surfaces, as a share of the diagonal; 0: none */
	bool packed; /* whether there was one */
	const char
	    *beside; /* the caller's: the page's path, beside which models but the first go; NULL: in it */
	mr_page_stream stream, other; /* of the page; of the model that goes beside it */
	size_t frames, models;
	mr_page_pictures pictures;
	const char *title, *caption; /* the caller's, or NULL */
	const char *from; /* the caller's to set: the file that frames come from now; NULL: none to be told */
} mr_page;

/* Adds what a page shows of the layers in the list (NULL: all), doubles rounded to 24 bits.  MR_EMISSING: a
 * layer is not there; MR_ERANGE: the page is too large; MR_EFORMAT: a texture is no picture. */
mr_status mr_page_add(mr_ctx *ctx, mr_page *page, mr_frame *frame, const char *layers) MR_WARN_UNUSED;

/* Writes `html` with the frames in place of the line <!-- stream -->.  held: the file, the caller's to keep
 * or to drop.  MR_EMISSING where pictures or packed surfaces are asked for, and there are none. */
mr_status mr_page_write(
    mr_ctx *ctx, mr_page *page, const char *html, const char *path, mr_outfile *held) MR_WARN_UNUSED;

/* Frees what it holds; accepts a zeroed one. */
void mr_page_free(mr_page *page);

#endif
