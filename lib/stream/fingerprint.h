/*
 * fingerprint.h -- a fingerprint of bytes: 64 bits by which a writer knows that it has sent a column before.
 *
 * Contract: equal bytes have equal prints; others differ but for a chance of about 2^-64.  Not for use
 * against an adversary. Private to this room.
 */
#ifndef MR_STREAM_FINGERPRINT_H
#define MR_STREAM_FINGERPRINT_H

#include "base/ctx.h"

static inline uint64_t
mr_print_word(uint64_t print, uint64_t word)
{
	print = (print ^ word) * 0xa0761d6478bd642fu;
	return print ^ print >> 32;
}

/* The print of n bytes, word by word. */
static inline uint64_t
mr_fingerprint(const void *data, size_t n)
{
	uint64_t print = ~(uint64_t)n, word;
	const char *p = data;

	for (; n >= 8; p += 8, n -= 8) {
		memcpy(&word, p, 8);
		print = mr_print_word(print, word);
	}
	word = 0;
	if (n)
		memcpy(&word, p, n);
	return mr_print_word(print, word);
}

#endif
