/* fingerprint.h -- 64 bits by which a writer knows a column again: other bytes have others but for a chance
 * of 2^-64.  Not for use against an adversary.  Private to this room. */
#ifndef MR_STREAM_FINGERPRINT_H
#define MR_STREAM_FINGERPRINT_H

#include "base/ctx.h"

static inline uint64_t
mr_print_word(uint64_t print, uint64_t word)
{
	print = (print ^ word) * 0xa0761d6478bd642fu;
	return print ^ print >> 32;
}

/* The print of n bytes: of four rows of words, which the machine works on at the same time. */
static inline uint64_t
mr_fingerprint(const void *data, size_t n)
{
	uint64_t print[4] = { ~(uint64_t)n, 1, 2, 3 }, word[4] = { 0 };
	const char *p = data;

	for (; n >= sizeof word; p += sizeof word, n -= sizeof word) {
		memcpy(word, p, sizeof word);
		for (int k = 0; k < 4; k++)
			print[k] = mr_print_word(print[k], word[k]);
	}
	memset(word, 0, sizeof word);
	if (n)
		memcpy(word, p, n);
	for (int k = 0; k < 4; k++)
		print[0] = mr_print_word(print[0], mr_print_word(print[k], word[k]));
	return print[0];
}

#endif
