/* stream.h -- what the tests of the stream share: streams in temporary files, records made by hand. */
#ifndef TEST_STREAM_H
#define TEST_STREAM_H

#include "stream/frame.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <unistd.h>
#include <zlib.h>

static const mr_shape POSITION = { 'v', 'd', 3 }, TRIANGLES = { 'f', 'u', 3 }, REGION = { 'v', 'u', 1 },
		      TEXT = { '-', 't', 1 };

/* An anonymous file with the bytes, at its beginning. */
static inline int
file_of(const void *bytes, size_t n)
{
	FILE *f = tmpfile();
	int fd;

	assert_non_null(f);
	fd = dup(fileno(f));
	fclose(f);
	assert_true(fd >= 0);
	assert_int_equal(write(fd, bytes, n), (ssize_t)n);
	assert_int_equal(lseek(fd, 0, SEEK_SET), 0);
	return fd;
}

/* A pipe that holds the bytes, of which there are no more than a pipe takes. */
static inline int
pipe_of(const void *bytes, size_t n)
{
	int fd[2];

	assert_int_equal(pipe(fd), 0);
	assert_true(n <= 65536);
	assert_int_equal(write(fd[1], bytes, n), (ssize_t)n);
	close(fd[1]);
	return fd[0];
}

/* All bytes of a file, to be freed. */
static inline unsigned char *
bytes_of(int fd, size_t *n)
{
	off_t end = lseek(fd, 0, SEEK_END);
	unsigned char *p = malloc((size_t)end + 1);

	assert_non_null(p);
	assert_int_equal(pread(fd, p, (size_t)end, 0), end);
	*n = (size_t)end;
	return p;
}

static inline void
ok(const mr_ctx *ctx, mr_status status)
{
	if (status != MR_OK)
		fail_msg("status %d: %s", status, ctx->error);
}

/* A writer on a new file. */
static inline mr_writer *
writer_on(mr_ctx *ctx, int fd, mr_packing packing)
{
	mr_writer *w;

	ok(ctx, mr_writer_open(ctx, fd, packing, &w));
	return w;
}

static inline int
new_file(void)
{
	return file_of("", 0);
}

/* A record with a good checksum, whatever the fields say; its length. */
static inline size_t
record(unsigned char *to, const char *layer, const char *name, const char *shape, int components, int codec,
    uint64_t rows, const void *payload, uint64_t stored)
{
	uint32_t crc;

	memset(to, 0, 64);
	memcpy(to, layer, strlen(layer));
	memcpy(to + 16, name, strlen(name));
	to[40] = (unsigned char)shape[0];
	to[41] = (unsigned char)shape[1];
	to[42] = (unsigned char)components;
	to[43] = (unsigned char)codec;
	memcpy(to + 48, &rows, 8);
	memcpy(to + 56, &stored, 8);
	crc = (uint32_t)crc32(crc32(0, to, 64), payload, (unsigned)stored);
	memcpy(to + 44, &crc, 4);
	memset(to + 64, 0, (stored + 63) / 64 * 64);
	memcpy(to + 64, payload, stored);
	return 64 + (stored + 63) / 64 * 64;
}

/* A structural record. */
static inline size_t
mark(unsigned char *to, const char *kind, const char *layer, const char *text)
{
	return record(to, layer, kind, "-t", 1, 0, strlen(text), text, strlen(text));
}

#endif
