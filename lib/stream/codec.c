/* Differences of rows, their bytes apart, deflated (man/mr-stream.5, codec 1). */
#include "stream/planes.h"
#include "stream/stored.h"

#include <libdeflate.h>
#include <limits.h>
#include <zlib.h>

/* zlib's memory is the arena's. */
static voidpf
z_alloc(voidpf ctx, uInt count, uInt size)
{
	return mr_alloc(ctx, count, size);
}

static void
z_free(voidpf ctx, voidpf p)
{
	(void)ctx;
	(void)p;
}

static uInt
piece(size_t n)
{
	return n < UINT_MAX ? (uInt)n : UINT_MAX;
}

/* Deflates n bytes into fewer than *room, of which *room are left; false where they are no fewer. */
static bool
deflate_all(z_stream *z, size_t n, size_t *room)
{
	int code = Z_OK;

	while (code == Z_OK && *room > 0) {
		uInt in = z->avail_in = piece(n), out = z->avail_out = piece(*room);
		code = deflate(z, n > in ? Z_NO_FLUSH : Z_FINISH);
		n -= in - z->avail_in;
		*room -= out - z->avail_out;
	}
	return code == Z_STREAM_END && *room > 0;
}

/* Between rows and the planes of all their blocks. */
static void
change_blocks(const mr_record *h, const unsigned char *from, unsigned char *to,
    void (*change)(const unsigned char *, size_t, size_t, size_t, unsigned char *))
{
	size_t size = mr_type_size(h->shape.type), row = size * h->shape.components;

	for (size_t i = 0, n; i < h->rows; i += n) {
		n = h->rows - i < MR_PLANE_ROWS ? (size_t)h->rows - i : MR_PLANE_ROWS;
		change(from + i * row, n, h->shape.components, size, to + i * row);
	}
}

mr_status
mr_pack(mr_ctx *ctx, const mr_record *h, const void *data, const void **packed, size_t *size)
{
	size_t all = (size_t)h->size, room = all;
	unsigned char *out = MR_NEW(ctx, all, unsigned char);
	MR_SCOPE(ctx);
	unsigned char *planes = MR_NEW(ctx, all, unsigned char);
	z_stream z = {
		.zalloc = z_alloc, .zfree = z_free, .opaque = ctx, .next_in = planes, .next_out = out
	};

	if (deflateInit(&z, 1) != Z_OK)
		return mr_fail(ctx, MR_EFORMAT, "packing: zlib fails");
	change_blocks(h, data, planes, mr_planes_split);
	*size = deflate_all(&z, all, &room) ? all - room : 0;
	deflateEnd(&z);
	*packed = out;
	return MR_OK;
}

mr_status
mr_unpack(mr_ctx *ctx, const mr_record *h, const void *packed, void *data)
{
	MR_SCOPE(ctx);
	unsigned char *planes = MR_NEW(ctx, (size_t)h->size, unsigned char);
	struct libdeflate_decompressor *d = libdeflate_alloc_decompressor();
	enum libdeflate_result result;
	size_t used = 0;

	if (!d)
		return mr_fail(ctx, MR_EMEM, "no memory to unpack");
	result = libdeflate_zlib_decompress_ex(
	    d, packed, (size_t)h->stored, planes, (size_t)h->size, &used, NULL);
	libdeflate_free_decompressor(d);
	if (result != LIBDEFLATE_SUCCESS || used != h->stored)
		return mr_fail(ctx, MR_EFORMAT, "%s%s%s: packed bytes are damaged, or not those of %llu rows",
		    h->layer, *h->layer ? ": " : "", h->name, (unsigned long long)h->rows);
	change_blocks(h, planes, data, mr_planes_join);
	return MR_OK;
}
