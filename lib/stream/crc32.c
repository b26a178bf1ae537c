/* The CRC-32 of zlib and PNG, by carry-less products where the processor has them (Gopal, Ozturk, Guilford et
 * al. 2009: Fast CRC computation for generic polynomials using PCLMULQDQ instruction). */
#include "stream/crc32.h"

#include <zlib.h>

#ifdef __x86_64__
#include <immintrin.h>

enum { STEP = 64 };

#define FAST __attribute__((target("pclmul,sse4.1")))

/* x, by as many bits further on as the two constants say, plus what stands there. */
FAST static inline __m128i
fold(__m128i x, __m128i by, __m128i y)
{
	__m128i low = _mm_clmulepi64_si128(x, by, 0x00), high = _mm_clmulepi64_si128(x, by, 0x11);

	return _mm_xor_si128(_mm_xor_si128(low, high), y);
}

/* 128 bits to 32: by halves, then by Barrett's reduction. */
FAST static uint32_t
reduce(__m128i x, __m128i by_16)
{
	const __m128i by_8 = _mm_set_epi64x(0, 0x163cd6124), poly = _mm_set_epi64x(0x1f7011641, 0x1db710641);
	const __m128i low = _mm_set_epi32(0, -1, 0, -1);
	__m128i y;

	x = _mm_xor_si128(_mm_srli_si128(x, 8), _mm_clmulepi64_si128(x, by_16, 0x10));
	x = _mm_xor_si128(_mm_srli_si128(x, 4), _mm_clmulepi64_si128(_mm_and_si128(x, low), by_8, 0x00));
	y = _mm_clmulepi64_si128(_mm_and_si128(x, low), poly, 0x10);
	y = _mm_clmulepi64_si128(_mm_and_si128(y, low), poly, 0x00);
	return (uint32_t)_mm_extract_epi32(_mm_xor_si128(x, y), 1);
}

/* Of n bytes, a multiple of STEP and not 0; crc and what is returned have all bits turned. */
FAST static uint32_t
by_products(uint32_t crc, const unsigned char *p, size_t n)
{
	const __m128i by_64 = _mm_set_epi64x(0x1c6e41596, 0x154442bd4);
	const __m128i by_16 = _mm_set_epi64x(0x0ccaa009e, 0x1751997d0);
	const __m128i *from = (const __m128i *)(const void *)p, *end = (const __m128i *)(const void *)(p + n);
	__m128i x[4];

	for (int k = 0; k < 4; k++)
		x[k] = _mm_loadu_si128(from++);
	x[0] = _mm_xor_si128(x[0], _mm_cvtsi32_si128((int)crc));
	while (from < end)
		for (int k = 0; k < 4; k++)
			x[k] = fold(x[k], by_64, _mm_loadu_si128(from++));
	for (int k = 1; k < 4; k++)
		x[k] = fold(x[k - 1], by_16, x[k]);
	return reduce(x[3], by_16);
}

uint32_t
mr_crc32(uint32_t crc, const void *bytes, size_t n)
{
	const unsigned char *p = bytes;
	size_t whole = n / STEP * STEP;

	if (whole == 0 || !__builtin_cpu_supports("pclmul") || !__builtin_cpu_supports("sse4.1"))
		whole = 0;
	else
		crc = ~by_products(~crc, p, whole);
	return (uint32_t)crc32_z(crc, p + whole, n - whole);
}
#else
uint32_t
mr_crc32(uint32_t crc, const void *bytes, size_t n)
{
	return (uint32_t)crc32_z(crc, bytes, n);
}
#endif
