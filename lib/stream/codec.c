/* Differences of rows, their bytes apart, deflated (man/mr-stream.5, codec 1). */
#include "stream/planes.h"
#include "stream/stored.h"

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

static mr_status
z_failed(mr_ctx *ctx, const char *what, int code)
{
	return mr_fail(ctx, MR_EFORMAT, "%s: zlib says %d", what, code);
}

static uInt
piece(size_t n)
{
	return n < UINT_MAX ? (uInt)n : UINT_MAX;
}

/* Deflates n bytes into what is left of `out`; false when that does not hold them. */
static bool
deflate_all(z_stream *z, const unsigned char *in, size_t n, size_t *room, int flush)
{
	uInt had;
	int code = Z_OK;

	z->next_in = (unsigned char *)(uintptr_t)in;
	z->avail_in = (uInt)n;
	while (z->avail_in || (flush == Z_FINISH && code != Z_STREAM_END)) {
		if (*room == 0)
			return false;
		had = z->avail_out = piece(*room);
		code = deflate(z, flush);
		*room -= had - z->avail_out;
	}
	return true;
}

/* All blocks of the column through one deflate stream. */
static bool
deflate_blocks(
    z_stream *z, const mr_record *h, const unsigned char *data, unsigned char *planes, size_t *room)
{
	size_t size = mr_type_size(h->shape.type), row = size * h->shape.components;

	for (uint64_t first = 0; first < h->rows; first += MR_PLANE_ROWS) {
		size_t n = h->rows - first < MR_PLANE_ROWS ? (size_t)(h->rows - first) : MR_PLANE_ROWS;
		mr_planes_split(data + first * row, n, h->shape.components, size, planes);
		if (!deflate_all(z, planes, n * row, room, Z_NO_FLUSH))
			return false;
	}
	return deflate_all(z, planes, 0, room, Z_FINISH);
}

static size_t
block_bytes(const mr_record *h)
{
	return (size_t)(h->rows < MR_PLANE_ROWS ? h->rows : MR_PLANE_ROWS) * h->shape.components *
	       mr_type_size(h->shape.type);
}

mr_status
mr_pack(mr_ctx *ctx, const mr_record *h, const void *data, const void **packed, size_t *size)
{
	z_stream z = { .zalloc = z_alloc, .zfree = z_free, .opaque = ctx };
	size_t room = (size_t)h->size;
	unsigned char *out = MR_NEW(ctx, room, unsigned char), *planes;
	mr_mark mark = mr_mark_take(ctx);
	bool fits;
	int code;

	planes = MR_NEW(ctx, block_bytes(h), unsigned char);
	code = deflateInit(&z, 1);
	if (code != Z_OK) {
		mr_mark_release(ctx, mark);
		return z_failed(ctx, "packing", code);
	}
	z.next_out = out;
	fits = deflate_blocks(&z, h, data, planes, &room);
	deflateEnd(&z);
	mr_mark_release(ctx, mark);
	*packed = out;
	*size = fits && room > 0 ? (size_t)h->size - room : 0;
	return MR_OK;
}

/* Inflates n bytes exactly; code is zlib's last. */
static bool
inflate_all(z_stream *z, size_t *left, unsigned char *out, size_t n, int *code)
{
	uInt had;

	z->next_out = out;
	z->avail_out = (uInt)n;
	while (z->avail_out) {
		had = z->avail_in = piece(*left);
		*code = inflate(z, Z_NO_FLUSH);
		*left -= had - z->avail_in;
		if (*code != Z_OK)
			break;
	}
	return z->avail_out == 0;
}

/* True where the stream ends here: no more bytes come out of it, and none are left over. */
static bool
at_end(z_stream *z, size_t *left, int *code)
{
	unsigned char more;

	if (*code == Z_OK)
		inflate_all(z, left, &more, 1, code);
	else
		z->avail_out = 1;
	return *code == Z_STREAM_END && z->avail_out == 1 && *left == 0;
}

static mr_status
inflate_blocks(mr_ctx *ctx, z_stream *z, const mr_record *h, unsigned char *planes, unsigned char *data)
{
	size_t size = mr_type_size(h->shape.type), row = size * h->shape.components, left = (size_t)h->stored;
	int code = Z_OK;

	for (uint64_t first = 0; first < h->rows; first += MR_PLANE_ROWS) {
		size_t n = h->rows - first < MR_PLANE_ROWS ? (size_t)(h->rows - first) : MR_PLANE_ROWS;
		if (!inflate_all(z, &left, planes, n * row, &code))
			return mr_fail(ctx, MR_EFORMAT,
			    "%s%s%s: packed bytes break off or are damaged in row %llu of %llu", h->layer,
			    *h->layer ? ": " : "", h->name, (unsigned long long)first,
			    (unsigned long long)h->rows);
		mr_planes_join(planes, n, h->shape.components, size, data + first * row);
	}
	if (!at_end(z, &left, &code))
		return mr_fail(ctx, MR_EFORMAT, "%s%s%s: packed bytes do not end with row %llu", h->layer,
		    *h->layer ? ": " : "", h->name, (unsigned long long)h->rows);
	return MR_OK;
}

mr_status
mr_unpack(mr_ctx *ctx, const mr_record *h, const void *packed, void *data)
{
	z_stream z = { .zalloc = z_alloc,
		.zfree = z_free,
		.opaque = ctx,
		.next_in = (unsigned char *)(uintptr_t)packed };
	MR_SCOPE(ctx);
	unsigned char *planes = MR_NEW(ctx, block_bytes(h), unsigned char);
	mr_status status;
	int code;

	code = inflateInit(&z);
	status = code == Z_OK ? inflate_blocks(ctx, &z, h, planes, data) : z_failed(ctx, "unpacking", code);
	inflateEnd(&z);
	return status;
}
