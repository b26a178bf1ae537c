/* Bytes from a descriptor: a file is mapped, a pipe read into blocks. */
#define _GNU_SOURCE /* F_SETPIPE_SZ, MADV_DONTNEED */

#include "base/retry.h"
#include "stream/stored.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BLOCK = 1 << 18, FIRST = 1 << 20 };

void *
mr_heap(mr_ctx *ctx, void *old, size_t size)
{
	char what[32];
	void *p;

	errno = ENOMEM;
	p = ctx->fail_at && --ctx->fail_at == 0 ? NULL : mr_memory(ctx, old, size);
	if (!p) {
		snprintf(what, sizeof what, "%zu bytes", size);
		mr_no_memory(ctx, what, (double)size);
	}
	return p;
}

mr_status
mr_heap_room(mr_ctx *ctx, void *array, size_t size, size_t count, size_t *room)
{
	void *p;

	if (count <= *room)
		return MR_OK;
	memcpy(&p, array, sizeof p); /* a pointer of any type */
	if (!(p = mr_heap(ctx, p, 2 * count * size)))
		return MR_EMEM;
	memcpy(array, &p, sizeof p);
	*room = 2 * count;
	return MR_OK;
}

/* Maps the rest of a regular file if that is aligned; else it is read like a pipe. */
static void
map_rest(mr_input *in)
{
	struct stat st;
	off_t at;
	void *p;

	if (fstat(in->fd, &st) || !S_ISREG(st.st_mode) || (at = lseek(in->fd, 0, SEEK_CUR)) < 0)
		return;
	in->offset = (uint64_t)at;
	if (st.st_size <= at || at % MR_ALIGN || (uintmax_t)st.st_size > SIZE_MAX)
		return;
	p = mmap(NULL, (size_t)st.st_size, PROT_READ, MAP_PRIVATE, in->fd, 0);
	if (p == MAP_FAILED)
		return;
	posix_madvise(p, (size_t)st.st_size, POSIX_MADV_SEQUENTIAL);
	in->map = p;
	in->size = (size_t)st.st_size;
}

/* A wide pipe halves the time of reading a large column from it; where it cannot be had nothing is lost. */
static void
widen(int fd)
{
#ifdef F_SETPIPE_SZ
	fcntl(fd, F_SETPIPE_SZ, 1 << 20);
#else
	(void)fd;
#endif
}

mr_status
mr_input_open(mr_ctx *ctx, int fd, mr_input *in)
{
	mr_input i = { .fd = fd };

	map_rest(&i);
	if (!i.map) {
		widen(fd);
		i.block = mr_heap(ctx, NULL, BLOCK);
		if (!i.block)
			return MR_EMEM;
	}
	*in = i;
	return MR_OK;
}

void
mr_input_forget(const unsigned char *record, uint64_t n)
{
#ifdef MADV_DONTNEED
	const uintptr_t page = 65536, begin = ((uintptr_t)record + page - 1) / page * page;
	const uintptr_t end = ((uintptr_t)record + (uintptr_t)n) / page * page;

	if (begin < end) /* a later read comes from the file again */
		madvise((void *)begin, end - begin, MADV_DONTNEED);
#else
	(void)record;
	(void)n;
#endif
}

void
mr_input_end(const mr_input *in)
{
	if (in->map)
		lseek(in->fd, (off_t)in->offset, SEEK_SET);
}

void
mr_input_close(mr_input *in)
{
	if (in->map)
		munmap((void *)(uintptr_t)in->map, in->size);
	mr_memory_free(in->block);
	*in = (mr_input){ .fd = -1 };
}

/* One read of at most n bytes; *got 0 at the end. */
static mr_status
read_some(mr_ctx *ctx, int fd, unsigned char *to, size_t n, size_t *got)
{
	const size_t most = 1 << 30;
	ssize_t r;

	do
		r = read(fd, to, n < most ? n : most);
	while (r < 0 && mr_retry(fd, POLLIN));
	if (r < 0)
		return mr_fail(ctx, MR_EIO, "cannot read: %s", strerror(errno));
	*got = (size_t)r;
	return MR_OK;
}

/* Takes up to n bytes out of the block, filling it when it is empty; large wishes are read in place. */
static mr_status
take(mr_ctx *ctx, mr_input *in, unsigned char *to, size_t n, size_t *got)
{
	size_t have = in->end - in->begin;

	if (have == 0 && n >= BLOCK) {
		MR_TRY(read_some(ctx, in->fd, to, n, got));
		in->offset += *got;
		return MR_OK;
	}
	if (have == 0) {
		MR_TRY(read_some(ctx, in->fd, in->block, BLOCK, &have));
		in->begin = 0;
		in->end = have;
	}
	*got = n < have ? n : have;
	memcpy(to, in->block + in->begin, *got);
	in->begin += *got;
	in->offset += *got;
	return MR_OK;
}

mr_status
mr_input_header(mr_ctx *ctx, mr_input *in, unsigned char header[MR_HEADER], size_t *got)
{
	size_t n = 0, step = 1;

	if (in->map) {
		n = in->size - (size_t)in->offset < MR_HEADER ? in->size - (size_t)in->offset : MR_HEADER;
		memcpy(header, in->map + in->offset, n);
		in->offset += n;
	}
	for (; !in->map && n < MR_HEADER && step; n += step)
		MR_TRY(take(ctx, in, header + n, MR_HEADER - n, &step));
	*got = n;
	return MR_OK;
}

/* The bytes of a pipe: memory grows as they arrive, whatever the header says. */
static mr_status
collect(mr_ctx *ctx, mr_input *in, size_t all, unsigned char **bytes)
{
	size_t used = MR_HEADER, room = all < FIRST ? all : FIRST, step;

	while (used < all) {
		if (used == room) {
			room = all / 2 < used ? all : 2 * used;
			unsigned char *grown = mr_heap(ctx, *bytes, room);
			if (!grown)
				return MR_EMEM;
			*bytes = grown;
		}
		MR_TRY(take(ctx, in, *bytes + used, room - used, &step));
		if (step == 0)
			return MR_END;
		used += step;
	}
	return MR_OK;
}

mr_status
mr_input_payload(mr_ctx *ctx, mr_input *in, const unsigned char header[MR_HEADER], uint64_t n,
    const unsigned char **record, void **heap)
{
	unsigned char *bytes;
	mr_status status;

	if (in->map) {
		if (n > in->size - in->offset)
			return MR_END;
		*record = in->map + in->offset - MR_HEADER;
		*heap = NULL;
		in->offset += n;
		return MR_OK;
	}
	if (n > SIZE_MAX - 2 * MR_HEADER)
		return mr_fail(ctx, MR_EMEM, "no memory for %llu bytes", (unsigned long long)n);
	bytes = mr_heap(ctx, NULL, n + MR_HEADER < FIRST ? (size_t)n + MR_HEADER : FIRST);
	if (!bytes)
		return MR_EMEM;
	memcpy(bytes, header, MR_HEADER);
	status = collect(ctx, in, (size_t)n + MR_HEADER, &bytes);
	if (status != MR_OK) {
		mr_memory_free(bytes);
		return status;
	}
	*record = *heap = bytes;
	return MR_OK;
}
