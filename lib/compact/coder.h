/* coder.h -- adaptive binary arithmetic coding in integers alone, so that all machines agree: a range coder
 * (Martin 1979) whose carries wait, as in LZMA (man/mr-compact.5, "Bits").  The same functions write and
 * read: they write their argument, or ignore it and return the value read. */
#ifndef MR_COMPACT_CODER_H
#define MR_COMPACT_CODER_H

#include "base/ctx.h"

/* An adaptive bit model: the probability of a 1 is (32,768 + lean) / 65,536, learnt from `seen` bits. */
typedef struct mr_odds {
	int16_t lean;
	uint16_t seen;
} mr_odds;

typedef struct mr_coder {
	mr_ctx *ctx;
	bool reading;
	bool ended; /* reading: past the last byte; bits read before are valid */
	unsigned char *byte;
	size_t count, room; /* bytes read, and their number; or bytes written, and room for them */
	uint64_t low;       /* writing */
	uint32_t range, code;
	size_t waiting; /* bytes 0xff written after `last`, which a carry would change */
	unsigned char last;
	bool begun;
} mr_coder;

/* Writes to the arena of ctx. */
void mr_coder_write(mr_ctx *ctx, mr_coder *c);

/* Reads `size` bytes, all there are, or the first ones of them. */
void mr_coder_read(const void *byte, size_t size, mr_coder *c);

enum { MR_CODER_AHEAD = 5 }; /* the reader is at most so many bytes ahead of the writer */

/* Flushes the writer: c->byte has c->count bytes. */
void mr_coder_finish(mr_coder *c);

/* Renormalizes the range by a byte. */
void mr_coder_shift(mr_coder *c);

enum { MR_ODDS_SEEN = 254 };
extern const uint16_t mr_odds_rate[MR_ODDS_SEEN + 1]; /* 65,536 / (bits seen + 1.6) */

static inline void
mr_odds_learn(mr_odds *o, bool bit)
{
	int32_t rest = (bit ? 32704 : -32704) - o->lean;

	o->lean = (int16_t)(o->lean + (rest * (int32_t)mr_odds_rate[o->seen] + 32768) / 65536);
	o->seen = (uint16_t)(o->seen + (o->seen < MR_ODDS_SEEN));
}

static inline bool
mr_code_bit(mr_coder *c, mr_odds *o, bool bit)
{
	uint32_t bound = (c->range >> 16) * (uint32_t)(32768 + o->lean);

	if (c->reading)
		bit = c->code < bound;
	if (bit) {
		c->range = bound;
	} else {
		c->low += bound;
		c->code -= bound;
		c->range -= bound;
	}
	mr_odds_learn(o, bit);
	while (c->range < 1u << 24)
		mr_coder_shift(c);
	return bit;
}

/* Codes n <= 32 equiprobable bits, the highest first: value < 2^n. */
uint32_t mr_code_plain(mr_coder *c, unsigned n, uint32_t value);

/* Models of signed numbers: of their length, their highest bits, their sign. */
typedef struct mr_number_odds {
	mr_odds length[33], high[33][4], sign;
} mr_number_odds;

/* |value| < 2^31. */
int32_t mr_code_number(mr_coder *c, mr_number_odds *o, int32_t value);

#endif
