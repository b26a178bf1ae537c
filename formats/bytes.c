/* gzip by zlib, in and out. */
#include "formats/bytes.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/retry.h"
#include "formats/filename.h"

#include <errno.h>
#include <fcntl.h>
#include <libdeflate.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

enum { CHUNK = 1 << 18, HEAD = 1 << 24, RATIO = 1032 }; /* deflate packs no more bytes into one */

static mr_status
failed(mr_ctx *ctx, const char *path, const char *what)
{
	return mr_fail(ctx, MR_EIO, "%s: %s: %s", path, what, strerror(errno));
}

mr_status
mr_file_bytes_end(mr_file_bytes *b, mr_status status)
{
	mr_memory_free(b->memory);
	*b = (mr_file_bytes){ 0 };
	return status;
}

/* Makes room for more, by doubling; fails if memory is missing for it and for a model of the same size: a
 * pipe, or inflated data, may never end. */
static mr_status
widen(mr_ctx *ctx, unsigned char **memory, size_t *room, size_t least)
{
	size_t wanted = *room > SIZE_MAX / 2 ? SIZE_MAX : 2 * *room;
	unsigned char *p = NULL;
	char what[64];

	if (wanted < least)
		wanted = least;
	errno = ENOMEM;
	if (ctx->scratch || wanted <= HEAD || 2 * (double)wanted - (double)*room <= mr_memory_available())
		p = mr_memory(ctx, *memory, wanted);
	if (!p) {
		snprintf(what, sizeof what, "more than %zu bytes", *room ? *room : least - 1);
		return mr_no_memory(ctx, what, (double)wanted);
	}
	*memory = p;
	*room = wanted;
	return MR_OK;
}

/* All of a file; of a regular one it is known how much that is. */
static mr_status
read_all(mr_ctx *ctx, const char *path, int fd, mr_file_bytes *b)
{
	struct stat st;
	bool regular = fstat(fd, &st) == 0 && S_ISREG(st.st_mode);
	unsigned char *memory = NULL;
	size_t size = 0, room = 0, least = CHUNK + (regular ? (size_t)st.st_size : 0);
	mr_status status;
	ssize_t n = 1;

	while ((status = room - size < CHUNK ? widen(ctx, &memory, &room, size + least) : MR_OK) == MR_OK) {
		least = CHUNK;
		n = read(fd, memory + size, room - size);
		if (n > 0)
			size += (size_t)n;
		else if (n == 0 || !mr_retry(fd, POLLIN))
			break;
	}
	if (n < 0)
		status = mr_fail(ctx, MR_EIO, "cannot read: %s", strerror(errno));
	if (status < 0)
		mr_memory_free(memory);
	else
		*b = (mr_file_bytes){ .data = memory, .size = size, .memory = memory };
	return mr_prefix(ctx, status, "%s", path);
}

/* Whether these bytes begin another member, or may do so where they are cut off. */
static bool
may_be_gzip(const unsigned char *data, size_t size)
{
	static const unsigned char magic[] = { 0x1f, 0x8b };

	return size > 0 && !memcmp(data, magic, size < sizeof magic ? size : sizeof magic);
}

/* All members; the file ends with the size of what the last of them inflates to, if that can be. */
static mr_status
inflate_members(mr_ctx *ctx, struct libdeflate_decompressor *d, const mr_file_bytes *in,
    unsigned char **memory, size_t *done)
{
	size_t room = 0, at = 0, most = in->size < SIZE_MAX / RATIO ? RATIO * in->size : SIZE_MAX;
	enum libdeflate_result r = LIBDEFLATE_INSUFFICIENT_SPACE;
	size_t used, made;
	uint32_t last = 0;

	if (in->size >= sizeof last)
		memcpy(&last, in->data + in->size - sizeof last, sizeof last);
	do {
		if (r == LIBDEFLATE_INSUFFICIENT_SPACE)
			MR_TRY(widen(ctx, memory, &room, last < most ? (size_t)last + 1 : most));
		r = libdeflate_gzip_decompress_ex(
		    d, in->data + at, in->size - at, *memory + *done, room - *done, &used, &made);
		if (r == LIBDEFLATE_SUCCESS) {
			at += used;
			*done += made;
		} else if (r != LIBDEFLATE_INSUFFICIENT_SPACE)
			return mr_fail(ctx, MR_EFORMAT, "byte %zu: gzip data are damaged, or end early", at);
	} while (r == LIBDEFLATE_INSUFFICIENT_SPACE || may_be_gzip(in->data + at, in->size - at));
	return MR_OK;
}

static mr_status
gunzip(mr_ctx *ctx, mr_file_bytes *b)
{
	struct libdeflate_decompressor *d = libdeflate_alloc_decompressor();
	unsigned char *memory = NULL;
	size_t size = 0;
	mr_status status;

	if (!d)
		return mr_fail(ctx, MR_EMEM, "no memory to inflate");
	status = inflate_members(ctx, d, b, &memory, &size);
	libdeflate_free_decompressor(d);
	mr_file_bytes_end(b, MR_OK);
	if (status < 0)
		mr_memory_free(memory);
	else
		*b = (mr_file_bytes){ .data = memory, .size = size, .memory = memory };
	return status;
}

mr_status
mr_file_bytes_read(mr_ctx *ctx, const char *path, mr_file_bytes *b)
{
	const char *name = strcmp(path, "-") ? path : "stdin";
	mr_file_bytes got = { 0 };
	mr_status status;
	int fd;

	MR_TRY(mr_permit(ctx, path, false));
	fd = strcmp(path, "-") ? open(path, O_RDONLY | O_CLOEXEC) : STDIN_FILENO;
	if (fd < 0)
		return failed(ctx, path, "cannot open");
	status = read_all(ctx, name, fd, &got);
	if (fd != STDIN_FILENO)
		close(fd);
	MR_TRY(status);
	if (mr_is_gzip(got.data, got.size))
		MR_TRY(mr_prefix(ctx, gunzip(ctx, &got), "%s", name));
	*b = got;
	return MR_OK;
}

mr_status
mr_file_read(mr_ctx *ctx, const mr_file *f, mr_file_bytes *b)
{
	if (!f->data)
		return mr_file_bytes_read(ctx, f->name, b);
	*b = (mr_file_bytes){ .data = f->data, .size = f->size };
	return MR_OK;
}

mr_file
mr_file_copy(mr_ctx *ctx, const void *data, size_t size, const char *suffix)
{
	unsigned char *copy = MR_NEW(ctx, size, unsigned char);
	uint32_t sum = libdeflate_crc32(0, memcpy(copy, data, size), size);

	return (mr_file){ mr_format(ctx, "%08x-%zx%s", (unsigned)sum, size, suffix), copy, size };
}

/* ---- out ---- */

static void
write_all(mr_sink *s, const void *data, size_t bytes)
{
	const char *p = data;

	while (bytes && s->status == MR_OK) {
		ssize_t n = write(s->file.fd, p, bytes);
		if (n < 0 && !mr_retry(s->file.fd, POLLOUT))
			s->status = failed(s->ctx, s->path, "cannot write");
		if (n > 0) {
			p += n;
			bytes -= (size_t)n;
		}
	}
}

/* Deflates `bytes` and writes what comes out; with Z_FINISH all that is left. */
static void
deflate_all(mr_sink *s, void *data, size_t bytes, int flush)
{
	unsigned char out[CHUNK / 4];
	z_stream *z = s->gz;

	z->next_in = data;
	z->avail_in = (uInt)bytes;
	do {
		z->next_out = out;
		z->avail_out = sizeof out;
		deflate(z, flush);
		write_all(s, out, sizeof out - z->avail_out);
	} while (z->avail_out == 0 && s->status == MR_OK);
}

void
mr_sink_flush(mr_sink *s)
{
	if (s->memory) {
		MR_RESERVE(s->ctx, s->buffer, s->used, MR_SINK_BUFFER, &s->room);
		return;
	}
	if (s->gz)
		deflate_all(s, s->buffer, s->used, Z_NO_FLUSH);
	else
		write_all(s, s->buffer, s->used);
	s->used = 0;
}

void
mr_put(mr_sink *s, const void *data, size_t bytes)
{
	const char *p = data;

	while (bytes) {
		char *to = mr_sink_room(s);
		size_t n = bytes < MR_SINK_ROOM ? bytes : MR_SINK_ROOM;
		memcpy(to, p, n);
		mr_sink_fill(s, to + n);
		p += n;
		bytes -= n;
	}
}

void
mr_print(mr_sink *s, const char *format, ...)
{
	char *to = mr_sink_room(s);
	va_list args;
	int n;

	va_start(args, format);
	n = vsnprintf(to, MR_SINK_ROOM, format, args);
	va_end(args);
	if (n > 0)
		mr_sink_fill(s, to + (n < MR_SINK_ROOM ? n : MR_SINK_ROOM - 1));
}

/* ---- rows, by all threads ---- */

enum { ROWS = 1024, PIECES = 64 };

/* Rows in memory. */
typedef struct piece {
	mr_ctx ctx; /* its own: others are made at the same time */
	mr_sink sink;
	mr_status status;
} piece;

typedef struct pieces {
	mr_row *row;
	const void *arg;
	size_t first; /* row */
	piece of[PIECES];
} pieces;

static mr_status
put_rows(const pieces *p, piece *to, size_t begin, size_t end)
{
	MR_ENTER(&to->ctx);
	for (size_t i = begin; i < end; i++)
		p->row(&to->sink, p->arg, p->first + i);
	return MR_OK;
}

static void
put_piece(void *arg, size_t begin, size_t end)
{
	pieces *p = arg;
	piece *to = &p->of[begin / ROWS];

	to->status = put_rows(p, to, begin, end);
}

static void
write_piece(mr_sink *s, piece *p)
{
	s->status = mr_fail_as(s->ctx, &p->ctx, p->status);
	if (s->status < 0)
		return;
	if (s->gz)
		mr_put(s, p->sink.buffer, p->sink.used);
	else
		write_all(s, p->sink.buffer, p->sink.used);
	p->sink.used = 0;
}

void
mr_put_each(mr_sink *s, size_t n, mr_row *row, const void *arg)
{
	const size_t most = (size_t)ROWS * PIECES;
	MR_SCOPE(s->ctx);
	pieces *p = MR_NEW_ZERO(s->ctx, 1, pieces);

	p->row = row;
	p->arg = arg;
	for (int i = 0; i < PIECES; i++)
		p->of[i].sink = (mr_sink){ .ctx = mr_keep(s->ctx, &p->of[i].ctx), .memory = true };
	mr_sink_flush(s);
	for (; p->first < n && s->status == MR_OK; p->first += most) {
		size_t count = n - p->first < most ? n - p->first : most;
		mr_parallel(s->ctx, count, ROWS, put_piece, p);
		for (size_t i = 0; i * ROWS < count && s->status == MR_OK; i++)
			write_piece(s, &p->of[i]);
	}
	for (int i = 0; i < PIECES; i++)
		mr_ctx_free(&p->of[i].ctx);
}

static mr_status
open_target(mr_sink *s)
{
	if (!strcmp(s->path, "-")) {
		s->path = "stdout";
		s->file.fd = STDOUT_FILENO;
		return MR_OK;
	}
	return mr_outfile_open(s->ctx, s->path, &s->file);
}

static mr_status
start_gzip(mr_sink *s)
{
	z_stream *z = calloc(1, sizeof *z);

	if (!z ||
	    deflateInit2(z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
		free(z);
		return mr_fail(s->ctx, MR_EMEM, "%s: no memory to compress", s->path);
	}
	s->gz = z;
	return MR_OK;
}

mr_status
mr_sink_open(mr_ctx *ctx, const char *path, bool compress, mr_sink *s)
{
	mr_sink new = { .ctx = ctx, .path = path, .room = MR_SINK_BUFFER };

	new.buffer = mr_alloc(ctx, MR_SINK_BUFFER, 1);
	MR_TRY(open_target(&new));
	*s = new;
	if (!compress)
		return MR_OK;
	s->status = start_gzip(s);
	return s->status < 0 ? mr_sink_close(s, s->status) : MR_OK;
}

mr_status
mr_sink_close(mr_sink *s, mr_status status)
{
	if (s->status == MR_OK)
		s->status = status;
	if (s->status == MR_OK)
		mr_sink_flush(s);
	if (s->gz) {
		if (s->status == MR_OK)
			deflate_all(s, NULL, 0, Z_FINISH);
		deflateEnd(s->gz);
		free(s->gz);
	}
	if (s->status < 0)
		mr_outfile_drop(s->ctx, &s->file);
	else if (!s->hold)
		s->status = mr_outfile_keep(s->ctx, &s->file);
	return s->status;
}

mr_status
mr_put_beside(
    mr_ctx *ctx, const char *path, const char *end, const void *data, size_t bytes, const char **name)
{
	const char *beside = mr_format(ctx, "%s%s", mr_path_stem(ctx, path), end);
	mr_sink s;

	MR_TRY(mr_sink_open(ctx, beside, false, &s));
	mr_put(&s, data, bytes);
	MR_TRY(mr_sink_close(&s, MR_OK));
	*name = mr_file_name(beside);
	return MR_OK;
}
