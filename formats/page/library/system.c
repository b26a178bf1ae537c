/* The system calls of the library in a browser: memory from malloc, and one thread. */
#include "base/memory.h"
#include "base/parallel.h"

#include <time.h>

enum { ALIGN = 64 };

/* The header before the memory. */
typedef struct head {
	void *begin;
	size_t size;
} head;

static head *
head_of(void *memory)
{
	return (head *)memory - 1;
}

void *
mr_memory(const mr_ctx *ctx, void *old, size_t size)
{
	char *begin = size < SIZE_MAX / 2 ? malloc(size + 2 * ALIGN) : NULL, *memory;

	(void)ctx;
	if (!begin)
		return NULL;
	memory = begin + ALIGN + (ALIGN - (uintptr_t)begin % ALIGN) % ALIGN;
	*head_of(memory) = (head){ begin, size };
	if (old)
		memcpy(memory, old, head_of(old)->size < size ? head_of(old)->size : size);
	mr_memory_free(old);
	return memory;
}

void
mr_memory_free(void *memory)
{
	if (memory)
		free(head_of(memory)->begin);
}

mr_status
mr_no_memory(mr_ctx *ctx, const char *what, double bytes)
{
	return mr_fail(ctx, MR_EMEM, "no memory for %s: %.0f bytes", what, bytes);
}

/* The pieces are those of many threads: results go by them. */
void
mr_parallel(const mr_ctx *ctx, size_t count, size_t grain, mr_body body, void *arg)
{
	(void)ctx;
	for (size_t begin = 0; begin < count; begin += grain)
		body(arg, begin, count - begin < grain ? count : begin + grain);
}

double
mr_parallel_sum(const mr_ctx *ctx, size_t count, double (*term)(void *arg, size_t i), void *arg)
{
	double sum = 0;

	(void)ctx;
	for (size_t i = 0; i < count; i++)
		sum += term(arg, i);
	return sum;
}

/* Nobody asks how long it takes. */
int
clock_gettime(clockid_t clock, struct timespec *t)
{
	(void)clock;
	*t = (struct timespec){ 0 };
	return 0;
}

/* Sentences of failures as they are written, without their numbers: nobody reads them, and printing is half
 * of a small library. */
int
vsnprintf(char *s, size_t n, const char *format, va_list args)
{
	size_t length = strlen(format), kept = length < n ? length : n - 1;

	(void)args;
	if (n) {
		memcpy(s, format, kept);
		s[kept] = '\0';
	}
	return (int)length;
}

int
snprintf(char *s, size_t n, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	int length = vsnprintf(s, n, format, args);
	va_end(args);
	return length;
}
