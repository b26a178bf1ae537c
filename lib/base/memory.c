/* Memory: from malloc, or a file where it is large and that is wanted. */
#define _GNU_SOURCE /* MADV_HUGEPAGE */
#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

enum { ALIGN = 64, LARGE = 1 << 26, HUGE = 1 << 21 };

/* The header before the memory. */
typedef struct head {
	void *begin; /* what to free, or to unmap */
	size_t size; /* of the memory */
	int file;    /* -1: from malloc */
} head;

static head *
head_of(void *memory)
{
	return (head *)(void *)((char *)memory - ALIGN);
}

/* Aligned here: what posix_memalign gave and got back it cannot always give again. */
static char *
aligned(void *begin)
{
	return (char *)begin + ALIGN + (ALIGN - (uintptr_t)begin % ALIGN) % ALIGN;
}

static void *
headed(void *begin, size_t size, int file)
{
	void *memory = aligned(begin);

	*head_of(memory) = (head){ begin, size, file };
	return memory;
}

/* The system gives more than it has, and ends whoever then uses it: large requests are checked first. */
static bool
is_there(size_t bytes)
{
	return bytes <= LARGE || (double)bytes <= mr_memory_available();
}

/* Touched for the first time, pages of 2 MB cost a quarter of what as much of 4 kB does. */
static void
ask_for_huge_pages(char *begin, size_t size)
{
#ifdef MADV_HUGEPAGE
	uintptr_t first = ((uintptr_t)begin + HUGE - 1) / HUGE * HUGE,
		  end = ((uintptr_t)begin + size) / HUGE * HUGE;

	if (size >= 2 * (size_t)HUGE)
		madvise((void *)first, end - first, MADV_HUGEPAGE);
#else
	(void)begin;
	(void)size;
#endif
}

/* Large blocks go back to the system when they are freed: glibc would learn to keep ever larger ones.  But to
 * have a page from the system again takes longer than to work through it, so that some are kept, and the heap
 * begins with room for them. */
void
mr_memory_begin(void)
{
#ifdef M_MMAP_THRESHOLD
	enum { BLOCKS = 3, SIZE = 31 << 20 }; /* below the threshold: on the heap */
	char *volatile block[BLOCKS];

	mallopt(M_MMAP_THRESHOLD, 1 << 25);
	mallopt(M_TRIM_THRESHOLD, 1 << 27);
	for (int i = 0; i < BLOCKS; i++) {
		block[i] = malloc(SIZE);
		if (block[i])
			ask_for_huge_pages(block[i], SIZE);
	}
	for (int i = BLOCKS; i-- > 0;)
		free(block[i]);
#endif
}

/* By malloc: the system moves large blocks without copying, so a growing array never exists twice. */
static void *
on_heap(void *old, size_t size)
{
	head was = old ? *head_of(old) : (head){ 0 };
	size_t shift = old ? (size_t)((char *)old - (char *)was.begin) : 0;
	char *begin = is_there(size > was.size ? size - was.size : 0) ? realloc(was.begin, size + 2 * ALIGN)
	                                                              : NULL;

	if (!begin) {
		errno = ENOMEM;
		return NULL;
	}
	ask_for_huge_pages(begin, size);
	if (old && aligned(begin) != begin + shift)
		memmove(aligned(begin), begin + shift, was.size < size ? was.size : size);
	return headed(begin, size, -1);
}

/* Reserved as a whole, so that later writes never find the disk full. */
static void *
map_file(int file, size_t size)
{
	void *begin;
	int error = posix_fallocate(file, 0, (off_t)(size + ALIGN));

	if (error) {
		errno = error;
		return NULL;
	}
	begin = mmap(NULL, size + ALIGN, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
	return begin == MAP_FAILED ? NULL : headed(begin, size, file);
}

static void *
in_new_file(const char *folder, size_t size)
{
	char name[4096];
	void *memory = NULL;
	int file, error;

	if (snprintf(name, sizeof name, "%s/mr-scratch-XXXXXX", folder) >= (int)sizeof name) {
		errno = ENAMETOOLONG;
		return NULL;
	}
	file = mkstemp(name);
	if (file < 0)
		return NULL;
	if (unlink(name) == 0 && fcntl(file, F_SETFD, FD_CLOEXEC) == 0)
		memory = map_file(file, size);
	if (!memory) {
		error = errno;
		close(file);
		errno = error;
	}
	return memory;
}

/* The file keeps the bytes while it is mapped anew. */
static void *
in_file_again(void *old, size_t size)
{
	head was = *head_of(old);
	void *memory = map_file(was.file, size);

	if (memory)
		munmap(was.begin, was.size + ALIGN);
	return memory;
}

void *
mr_memory(const mr_ctx *ctx, void *old, size_t size)
{
	bool filed = old && head_of(old)->file >= 0;
	void *memory;

	if (size > SIZE_MAX / 2) {
		errno = ENOMEM;
		return NULL;
	}
	if (filed)
		return in_file_again(old, size);
	if (!ctx->scratch || size < LARGE)
		return on_heap(old, size);
	memory = in_new_file(ctx->scratch, size);
	if (memory && old) {
		memcpy(memory, old, head_of(old)->size < size ? head_of(old)->size : size);
		mr_memory_free(old);
	}
	return memory;
}

mr_status
mr_no_memory(mr_ctx *ctx, const char *what, double bytes)
{
	if (ctx->scratch && errno != ENOMEM)
		return mr_fail(ctx, MR_EMEM, "no room for %s in %s: %s", what, ctx->scratch, strerror(errno));
	return mr_advise(ctx, !ctx->scratch && bytes > LARGE ? MR_SCRATCH : MR_NO_REMEDY,
	    mr_fail(ctx, MR_EMEM, "no memory for %s", what));
}

void
mr_memory_free(void *memory)
{
	head h;

	if (!memory)
		return;
	h = *head_of(memory);
	if (h.file < 0) {
		free(h.begin);
		return;
	}
	munmap(h.begin, h.size + ALIGN);
	close(h.file);
}
