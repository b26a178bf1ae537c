/*
 * A preloaded library: of all allocations of the process, its libraries' included, the one that $FAIL_AT says
 * fails, from 1; at its end it writes to the file $ALLOCATIONS how many there were.
 */
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

void *__libc_malloc(size_t n);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t n);
void *__libc_memalign(size_t alignment, size_t n);

static atomic_ulong count;
static unsigned long fail_at;

__attribute__((constructor)) static void
begin(void)
{
	const char *at = getenv("FAIL_AT");

	fail_at = at ? strtoul(at, NULL, 10) : 0;
	atomic_store(&count, 0);
}

__attribute__((destructor)) static void
end(void)
{
	unsigned long n = atomic_load(&count);
	const char *path = getenv("ALLOCATIONS");
	char text[32];
	int fd = path ? open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;

	if (fd >= 0 && write(fd, text, (size_t)snprintf(text, sizeof text, "%lu\n", n)) > 0)
		close(fd);
}

static bool
fails(void)
{
	if (atomic_fetch_add(&count, 1) + 1 != fail_at)
		return false;
	errno = ENOMEM;
	return true;
}

void *
malloc(size_t n)
{
	return fails() ? NULL : __libc_malloc(n);
}

void *
calloc(size_t n, size_t size)
{
	return fails() ? NULL : __libc_calloc(n, size);
}

void *
realloc(void *p, size_t n)
{
	return fails() ? NULL : __libc_realloc(p, n);
}

void *
memalign(size_t alignment, size_t n)
{
	return fails() ? NULL : __libc_memalign(alignment, n);
}

void *
aligned_alloc(size_t alignment, size_t n)
{
	return memalign(alignment, n);
}

int
posix_memalign(void **p, size_t alignment, size_t n)
{
	void *got = memalign(alignment, n);

	if (!got)
		return ENOMEM;
	*p = got;
	return 0;
}
