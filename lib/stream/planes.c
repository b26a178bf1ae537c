/* Differences of rows and sums of them, byte by byte. */
#include "stream/planes.h"

#include <stdint.h>
#include <string.h>

/* Component after component of n rows: differences of its values, their bytes in planes.  `size` is a
 * constant wherever this is inlined. */
static inline void
split_sized(const unsigned char *rows, size_t n, size_t components, unsigned char *planes, size_t size)
{
	for (size_t c = 0; c < components; c++, planes += n * size) {
		uint64_t before = 0;
		for (size_t i = 0; i < n; i++) {
			uint64_t v = 0, d;
			memcpy(&v, rows + (i * components + c) * size, size); /* little-endian, as the wire */
			d = v - before;
			for (size_t b = 0; b < size; b++)
				planes[b * n + i] = (unsigned char)(d >> 8 * b);
			before = v;
		}
	}
}

/* The inverse: sums of what the planes hold. */
static inline void
join_sized(const unsigned char *planes, size_t n, size_t components, unsigned char *rows, size_t size)
{
	for (size_t c = 0; c < components; c++, planes += n * size) {
		uint64_t v = 0;
		for (size_t i = 0; i < n; i++) {
			uint64_t d = 0;
			for (size_t b = 0; b < size; b++)
				d |= (uint64_t)planes[b * n + i] << 8 * b;
			v += d;
			memcpy(rows + (i * components + c) * size, &v, size);
		}
	}
}

void
mr_planes_split(const unsigned char *rows, size_t n, size_t components, size_t size, unsigned char *planes)
{
	if (size == 8)
		split_sized(rows, n, components, planes, 8);
	else if (size == 4)
		split_sized(rows, n, components, planes, 4);
	else
		split_sized(rows, n, components, planes, 1);
}

void
mr_planes_join(const unsigned char *planes, size_t n, size_t components, size_t size, unsigned char *rows)
{
	if (size == 8)
		join_sized(planes, n, components, rows, 8);
	else if (size == 4)
		join_sized(planes, n, components, rows, 4);
	else
		join_sized(planes, n, components, rows, 1);
}
