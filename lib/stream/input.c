/* Bytes from a descriptor: a file is mapped, a pipe read into blocks. */
#define _GNU_SOURCE /* F_SETPIPE_SZ, MADV_DONTNEED */

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
	void *p = ctx->fail_at && --ctx->fail_at == 0 ? NULL : realloc(old, size ? size : 1);

	if (!p)
		mr_fail(ctx, MR_EMEM, "no memory for %zu bytes", size);
	return p;
}

mr_status
mr_heap_bytes_reserve(mr_ctx *ctx, mr_heap_bytes *b, size_t used, size_t room)
{
	size_t shift = b->heap ? (size_t)(b->p - (unsigned char *)b->heap) : 0;
	unsigned char *heap, *p;

	if (room <= b->room)
		return MR_OK;
	if (room > SIZE_MAX - MR_ALIGN)
		return mr_fail(ctx, MR_EMEM, "no memory for %zu bytes", room);
	heap = mr_heap(ctx, b->heap, room + MR_ALIGN);
	if (!heap)
		return MR_EMEM;
	p = heap + (MR_ALIGN - (uintptr_t)heap % MR_ALIGN) % MR_ALIGN;
	if (used && p != heap + shift)
		memmove(p, heap + shift, used); /* realloc moved it to another alignment */
	*b = (mr_heap_bytes){ heap, p, room };
	return MR_OK;
}

/* Maps what is left of a regular file, where that is aligned; else it is read like a pipe. */
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
		MR_TRY(mr_heap_bytes_reserve(ctx, &i.block, 0, BLOCK));
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

	if (begin < end) /* what is read all the same comes from the file again */
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
	free(in->block.heap);
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
	while (r < 0 && errno == EINTR);
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
		MR_TRY(read_some(ctx, in->fd, in->block.p, BLOCK, &have));
		in->begin = 0;
		in->end = have;
	}
	*got = n < have ? n : have;
	memcpy(to, in->block.p + in->begin, *got);
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
collect(mr_ctx *ctx, mr_input *in, size_t n, mr_heap_bytes *b)
{
	size_t used = MR_HEADER, all = MR_HEADER + n, step;

	while (used < all) {
		if (used == b->room)
			MR_TRY(mr_heap_bytes_reserve(ctx, b, used, all / 2 < used ? all : 2 * used));
		MR_TRY(take(ctx, in, b->p + used, b->room - used, &step));
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
	mr_heap_bytes b = { 0 };
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
	MR_TRY(mr_heap_bytes_reserve(ctx, &b, 0, n + MR_HEADER < FIRST ? (size_t)n + MR_HEADER : FIRST));
	memcpy(b.p, header, MR_HEADER);
	status = collect(ctx, in, (size_t)n, &b);
	if (status != MR_OK) {
		free(b.heap);
		return status;
	}
	*record = b.p;
	*heap = b.heap;
	return MR_OK;
}
