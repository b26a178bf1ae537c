/* planes.h -- the differences of rows, their bytes apart (man/mr-stream.5, codec 1). Smooth data differ
 * little from row to row, and then the high bytes of the differences are alike.  A block of 32,768 rows is
 * turned into planes: for each component, for each byte of its differences, the least significant first, that
 * byte of all rows.  deflate, level 1, does the rest. */
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
