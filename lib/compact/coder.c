/* The range coder, its end, and numbers of several bits. */
#include "compact/coder.h"

#define R(n)   ((uint16_t)(65536 * 10 / (10 * (n) + 16)))
#define R4(n)  R(n), R((n) + 1), R((n) + 2), R((n) + 3)
#define R16(n) R4(n), R4((n) + 4), R4((n) + 8), R4((n) + 12)
#define R64(n) R16(n), R16((n) + 16), R16((n) + 32), R16((n) + 48)
const uint16_t mr_odds_rate[MR_ODDS_SEEN + 1] = { R64(0), R64(64), R64(128), R16(192), R16(208), R16(224),
	R4(240), R4(244), R4(248), R(252), R(253), R(254) };

void
mr_coder_write(mr_ctx *ctx, mr_coder *c)
{
	*c = (mr_coder){ .ctx = ctx, .range = UINT32_MAX };
}

void
mr_coder_read(const void *byte, size_t size, mr_coder *c)
{
	*c = (mr_coder){ .reading = true, .byte = (unsigned char *)byte, .room = size, .range = UINT32_MAX };
	for (int i = 0; i < 4; i++)
		mr_coder_shift(c);
	c->range = UINT32_MAX;
}

static void
put(mr_coder *c, unsigned char byte)
{
	MR_RESERVE(c->ctx, c->byte, c->count, 1, &c->room);
	c->byte[c->count++] = byte;
}

/* Writes the delayed byte, with its carry, and the bytes 0xff after it. */
static void
put_waiting(mr_coder *c, bool carry)
{
	if (c->begun)
		put(c, (unsigned char)(c->last + carry));
	for (; c->waiting; c->waiting--)
		put(c, (unsigned char)(0xff + carry));
}

void
mr_coder_shift(mr_coder *c)
{
	c->range <<= 8;
	if (c->reading) {
		bool there = c->count < c->room;
		c->code = c->code << 8 | (there ? c->byte[c->count] : 0u);
		c->count += there;
		c->ended |= !there;
		return;
	}
	if (c->low < 0xff000000u || c->low >> 32) {
		put_waiting(c, c->low >> 32);
		c->last = (unsigned char)(c->low >> 24);
		c->begun = true;
	} else {
		c->waiting++;
	}
	c->low = (c->low & 0x00ffffff) << 8;
}

void
mr_coder_finish(mr_coder *c)
{
	for (int i = 0; i < 5; i++)
		mr_coder_shift(c);
}

uint32_t
mr_code_plain(mr_coder *c, unsigned n, uint32_t value)
{
	uint32_t got = 0;

	while (n-- > 0) {
		mr_odds even = { 0 };
		got = got << 1 | (uint32_t)mr_code_bit(c, &even, value >> n & 1);
	}
	return got;
}

int32_t
mr_code_number(mr_coder *c, mr_number_odds *o, int32_t value)
{
	uint32_t size = value < 0 ? 0u - (uint32_t)value : (uint32_t)value, got = 1;
	unsigned n = 0, i = 0;

	while (n < 32 && size >> n)
		n++;
	while (i < 31 && mr_code_bit(c, &o->length[i], i < n))
		i++;
	if (i == 0)
		return 0;
	for (unsigned k = 1; k < i; k++) /* below the highest bit, which is 1 */
		got = got << 1 |
		      (uint32_t)(k < 3 ? mr_code_bit(c, &o->high[i][got & 3], size >> (i - 1 - k) & 1)
				       : mr_code_plain(c, 1, size >> (i - 1 - k) & 1));
	return mr_code_bit(c, &o->sign, value < 0) ? -(int32_t)got : (int32_t)got;
}
