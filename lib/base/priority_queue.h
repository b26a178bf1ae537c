/* priority_queue.h -- a binary heap in an array of elements of any type (Williams 1964: Algorithm 232,
 * Heapsort).  No element is before the first; what comes first of equal ones is fixed. */
#ifndef MR_BASE_PRIORITY_QUEUE_H
#define MR_BASE_PRIORITY_QUEUE_H

#include "base/ctx.h"

typedef bool (*mr_before)(const void *a, const void *b);

/* Adds *x to the n elements of `size` bytes, with room for one more. */
static inline void
mr_queue_push(void *queue, size_t n, size_t size, const void *x, mr_before before)
{
	char *q = queue;

	for (; n > 0 && before(x, q + (n - 1) / 2 * size); n = (n - 1) / 2)
		memcpy(q + n * size, q + (n - 1) / 2 * size, size);
	memcpy(q + n * size, x, size);
}

/* Moves the first of n > 0 elements to *first: n - 1 are left. */
static inline void
mr_queue_pop(void *queue, size_t n, size_t size, void *first, mr_before before)
{
	char *q = queue;
	const char *last = q + --n * size;
	size_t i = 0;

	memcpy(first, q, size);
	for (size_t k = 1; k < n; k = 2 * i + 1) {
		if (k + 1 < n && before(q + (k + 1) * size, q + k * size))
			k++;
		if (!before(q + k * size, last))
			break;
		memcpy(q + i * size, q + k * size, size);
		i = k;
	}
	memmove(q + i * size, last, size);
}

#endif
