/* vectors.h -- functions that are compiled twice, for processors with AVX2 and for any, to the same bits. */
#ifndef MR_BASE_VECTORS_H
#define MR_BASE_VECTORS_H

/* MR_VECTORS before a static function (the clones' resolvers would be visible outside of the library), and
 * MR_INLINED before those that it calls. */
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&    \
    !defined(__SANITIZE_THREAD__)
#define MR_VECTORS __attribute__((target_clones("avx2", "default")))
#define MR_INLINED inline __attribute__((always_inline))
#else
#define MR_VECTORS
#define MR_INLINED inline
#endif

#include <stddef.h>
#include <stdint.h>

/* Prefetches the rows, of size bytes, of the corners of a face that comes soon. */
static inline void
mr_soon(const void *rows, size_t size, const uint32_t v[3])
{
	for (int k = 0; k < 3; k++) {
		const char *row = (const char *)rows + size * v[k];
		__builtin_prefetch(row);
		__builtin_prefetch(row + size - 1);
	}
}

/* Four numbers side by side: two registers where a machine has no wider ones, to the same bits.  Not to be
 * passed by value. */
typedef double mr_wide __attribute__((vector_size(4 * sizeof(double))));

#endif
