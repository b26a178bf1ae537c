/* Pictures go into the page as the bytes of their files, but for what is said about them: cameras and places
 * are nobody's business, and turns and colour profiles mr-render does not follow. */
#include "formats/page.h"

#include "formats/image.h"
#include "formats/materials.h"
#include "formats/model.h"

/* The most pixels a side that graphics cards of some years ago take. */
static const size_t LARGEST_SIDE = 8192;

static size_t
big_endian(const unsigned char *p, size_t n)
{
	size_t x = 0;

	for (size_t i = 0; i < n; i++)
		x = x << 8 | p[i];
	return x;
}

static size_t
copy(unsigned char *out, size_t used, const unsigned char *p, size_t n)
{
	memcpy(out + used, p, n);
	return used + n;
}

/* The chunks that make the pixels: the critical ones, which begin with a capital, and transparency. */
static size_t
strip_png(const unsigned char *p, size_t n, unsigned char *out)
{
	size_t used = copy(out, 0, p, 8), at = 8;

	while (n - at >= 12) {
		size_t size = 12 + big_endian(p + at, 4);
		const unsigned char *kind = p + at + 4;
		if (size > n - at)
			break;
		if (*kind < 'a' || !memcmp(kind, "tRNS", 4))
			used = copy(out, used, p + at, size);
		at += size;
	}
	return used;
}

/* All but the comments and what applications add; Adobe's tells which colours the numbers are. */
static size_t
strip_jpeg(const unsigned char *p, size_t n, unsigned char *out)
{
	enum { SCAN = 0xda, FIRST = 0xe1, ADOBE = 0xee, LAST = 0xef, COMMENT = 0xfe };
	size_t used = copy(out, 0, p, 2), at = 2;

	while (n - at >= 4 && p[at] == 0xff && p[at + 1] != SCAN) {
		int kind = p[at + 1];
		size_t size = 2 + big_endian(p + at + 2, 2);
		if (size > n - at)
			break;
		if (kind != COMMENT && (kind < FIRST || kind > LAST || kind == ADOBE))
			used = copy(out, used, p + at, size);
		at += size;
	}
	return copy(out, used, p + at, n - at);
}

/* Refuses pictures that a browser could not decode. */
static mr_status
check_picture(mr_ctx *ctx, const mr_file_bytes *b)
{
	MR_SCOPE(ctx);
	mr_image image;

	MR_TRY(mr_image_decode(ctx, b->data, b->size, &image));
	if (image.width > LARGEST_SIDE || image.height > LARGEST_SIDE)
		mr_found(ctx,
		    &(mr_finding){ .kind = MR_LIMIT, .what = "a picture is larger than many browsers show" });
	return MR_OK;
}

static mr_status
keep_picture(mr_ctx *ctx, mr_page_pictures *p, const char *path, const mr_file_bytes *b)
{
	mr_ctx *keep = mr_keep(ctx, p->keep);
	mr_page_picture new = { .path = mr_format(keep, "%s", path),
		.data = MR_NEW(keep, b->size, unsigned char) };

	MR_TRY(check_picture(ctx, b));
	MR_RESERVE(keep, p->picture, p->count, 1, &p->room);
	new.size = (mr_is_png(b->data, b->size) ? strip_png : strip_jpeg)(b->data, b->size, new.data);
	p->bytes += new.size;
	p->picture[p->count++] = new;
	return MR_OK;
}

/* The number of the picture of a file. */
static mr_status
find_picture(mr_ctx *ctx, mr_page_pictures *p, const mr_file *file, size_t *number)
{
	mr_file_bytes b = { 0 };

	for (size_t i = 0; i < p->count; i++)
		if (!strcmp(p->picture[i].path, file->name)) {
			*number = i;
			return MR_OK;
		}
	MR_TRY(mr_file_read(ctx, file, &b));
	MR_TRY(mr_prefix(ctx, mr_file_bytes_end(&b, keep_picture(ctx, p, file->name, &b)), "%s", file->name));
	*number = p->count - 1;
	return MR_OK;
}

static unsigned
to_byte(double x)
{
	return (unsigned)(255 * x + 0.5);
}

/* The line of a material: its number, its colour or -, the number of its picture or -. */
static mr_status
wear_material(
    mr_ctx *ctx, mr_page_pictures *p, const char *layer, size_t i, const mr_material *m, mr_text *notes)
{
	const char *color = "-";
	size_t number = 0;
	mr_status status = m->file.name ? find_picture(ctx, p, &m->file, &number) : MR_OK;
	bool pictured = m->file.name && status == MR_OK;

	if (status == MR_EMEM)
		return status;
	if (status < 0)
		mr_found(ctx, &(mr_finding){ .kind = MR_MISSING, .what = m->file.name });
	if (!pictured && !m->colored)
		return MR_OK;
	if (m->colored)
		color = mr_format(
		    ctx, "%u,%u,%u", to_byte(m->color[0]), to_byte(m->color[1]), to_byte(m->color[2]));
	mr_text_add(notes, "material %s %zu %s %s\n", layer, i, color,
	    pictured ? mr_format(ctx, "%zu", number) : "-");
	return MR_OK;
}

static mr_status
wear_materials(mr_ctx *ctx, mr_page_pictures *p, const mr_model *m, const char *layer, mr_text *notes)
{
	mr_material *look;
	size_t count;

	MR_TRY(mr_materials_find(ctx, m, p->materials, &look, &count));
	for (size_t i = 0; i < count; i++)
		MR_TRY(wear_material(ctx, p, layer, i, &look[i], notes));
	p->worn = true;
	return MR_OK;
}

bool
mr_page_can_wear(const mr_page_pictures *p, const mr_frame *f, const char *layer)
{
	if (!mr_layer_has(f, layer, "triangles"))
		return false;
	if (p->texture)
		return mr_layer_has(f, layer, "texcoord") || mr_layer_has(f, layer, "corner_texcoord");
	return (p->materials || mr_frame_has_files(f)) && mr_layer_has(f, layer, "material");
}

mr_status
mr_page_wear(mr_ctx *ctx, mr_page_pictures *p, mr_frame *f, const char *layer, mr_text *notes,
    const char **coordinates)
{
	size_t number;
	mr_model m;

	*coordinates = NULL;
	if (!mr_page_can_wear(p, f, layer))
		return MR_OK;
	MR_TRY(mr_model_get(ctx, f, layer, &m));
	if (m.nf == 0 || (!p->texture && !m.material))
		return MR_OK;
	*coordinates = m.corner_texcoord ? "corner_texcoord" : m.texcoord ? "texcoord" : NULL;
	if (!p->texture)
		return wear_materials(ctx, p, &m, layer, notes);
	MR_TRY(find_picture(ctx, p, &(mr_file){ .name = p->texture }, &number));
	mr_text_add(notes, "texture %s %zu\n", layer, number);
	p->worn = true;
	return MR_OK;
}

void
mr_put_base64(mr_sink *s, const unsigned char *p, size_t n)
{
	static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	enum { PIECE = 3000 };

	for (size_t last; n > 0; n -= last) {
		char *out = mr_sink_room(s);
		last = n < PIECE ? n : PIECE;
		for (const unsigned char *end = p + last; p < end;) {
			size_t left = (size_t)(end - p), got = left < 3 ? left : 3;
			uint32_t v = (uint32_t)p[0] << 16 | (got > 1 ? (uint32_t)p[1] << 8 : 0) |
			             (got > 2 ? p[2] : 0u);
			*out++ = digit[v >> 18];
			*out++ = digit[v >> 12 & 63];
			*out++ = got > 1 ? digit[v >> 6 & 63] : '=';
			*out++ = got > 2 ? digit[v & 63] : '=';
			p += got;
		}
		mr_sink_fill(s, out);
	}
}

mr_status
mr_page_pictures_check(mr_ctx *ctx, const mr_page_pictures *p)
{
	if (!(p->texture || p->materials) || p->worn)
		return MR_OK;
	return mr_fail(ctx, MR_EMISSING, "no layer that is shown has %s",
	    p->texture ? "texture coordinates" : "materials");
}

mr_status
mr_page_pictures_put(mr_sink *s, const mr_page_pictures *p)
{
	for (size_t i = 0; i < p->count; i++) {
		mr_print(s, "<script type=\"text/plain\" class=\"picture\">");
		mr_put_base64(s, p->picture[i].data, p->picture[i].size);
		mr_print(s, "</script>\n");
	}
	return s->status;
}
