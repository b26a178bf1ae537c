/* A hash of multiplications. */
#include "stream/fingerprint.h"

/*
 * Multiply and fold, after wyhash (Wang Yi 2019): a 64 x 64 bit product whose
 * halves are combined spreads each bit of both factors over the result.  Eight
 * lanes take turns, four for each half of the print, so that the multiplier is never idle.
 */
enum { LANES = 8, STRIPE = 64 };

__extension__ typedef unsigned __int128 u128;

static const uint64_t keys[LANES] = { 0xa0761d6478bd642fu, 0xe7037ed1a0b428dbu, 0x8ebc6af09c88c6e3u,
	0x589965cc75374cc3u, 0x1d8e4e27c47d124fu, 0xeb44accab455d165u, 0x9c6e6877736c46e3u,
	0x2d358dccaa6c78a5u };

static inline uint64_t
fold(uint64_t x, uint64_t y)
{
	u128 p = (u128)x * y;

	return (uint64_t)p ^ (uint64_t)(p >> 64);
}

static inline void
stripe(uint64_t lane[LANES], const unsigned char *p)
{
	uint64_t w[8];

	memcpy(w, p, sizeof w);
	for (int i = 0; i < 4; i++) {
		lane[i] = fold(w[2 * i] ^ keys[i], w[2 * i + 1] ^ lane[i]);
		lane[4 + i] = fold(w[2 * i + 1] ^ keys[4 + i], w[2 * i] ^ lane[4 + i]);
	}
}

mr_fingerprint
mr_fingerprint_of(const void *data, size_t n)
{
	const unsigned char *p = data;
	unsigned char last[STRIPE] = { 0 };
	uint64_t lane[LANES];
	mr_fingerprint print = { n, ~(uint64_t)n };

	memcpy(lane, keys, sizeof lane);
	for (size_t left = n; left >= STRIPE; left -= STRIPE, p += STRIPE)
		stripe(lane, p);
	if (n % STRIPE) {
		memcpy(last, p, n % STRIPE);
		stripe(lane, last);
	}
	for (int i = 0; i < 4; i++) {
		print.a = fold(print.a ^ keys[i], lane[i] ^ keys[7 - i]);
		print.b = fold(print.b ^ keys[4 + i], lane[4 + i] ^ keys[3 - i]);
	}
	return print;
}
