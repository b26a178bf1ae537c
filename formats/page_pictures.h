/* page_pictures.h -- pictures on the surfaces of a page, by the rules of mr-render.  Layer rule: formats
 * includes lib. */
#ifndef MR_PAGE_PICTURES_H
#define MR_PAGE_PICTURES_H

#include "base/text.h"
#include "formats/bytes.h"
#include "stream/frame.h"

/* One file, as it stands in the page. */
typedef struct mr_page_picture {
	const char *path;
	unsigned char *data;
	size_t size;
} mr_page_picture;

/* What surfaces wear, and the pictures so far; starts zeroed. */
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

#endif
