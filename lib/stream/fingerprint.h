/*
 * fingerprint.h -- a fingerprint of bytes: 128 bits by which a writer knows that it has sent a column before.
 *
 * Contract: equal bytes have equal prints; others differ but for a chance of
 * about 2^-64.  Not for use against an adversary.  The value is the same on
 * all machines, but is written nowhere.
 * Private to this room.
 */
#ifndef MR_STREAM_FINGERPRINT_H
#define MR_STREAM_FINGERPRINT_H

#include "base/ctx.h"

typedef struct mr_fingerprint {
	uint64_t a, b;
} mr_fingerprint;

/* The print of n bytes. */
mr_fingerprint mr_fingerprint_of(const void *data, size_t n);

#endif
