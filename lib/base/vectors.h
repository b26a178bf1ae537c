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

/* Four numbers side by side: two registers where a machine has no wider ones, to the same bits.  Not to be
 * passed by value. */
typedef double mr_wide __attribute__((vector_size(4 * sizeof(double))));

#endif
