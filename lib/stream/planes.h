/* planes.h -- the differences of rows, their bytes apart (man/mr-stream.5, codec 1): for each block of rows,
 * component and byte, the least significant first, that byte of all.  Deflate does the rest. */
#ifndef MR_STREAM_PLANES_H
#define MR_STREAM_PLANES_H

#include <stddef.h>

enum { MR_PLANE_ROWS = 32768 };

/* The planes of n rows, of so many components of 8, 4 or 1 bytes, and back. */
void
mr_planes_split(const unsigned char *rows, size_t n, size_t components, size_t size, unsigned char *planes);
void
mr_planes_join(const unsigned char *planes, size_t n, size_t components, size_t size, unsigned char *rows);

#endif
