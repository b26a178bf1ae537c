/* utf8.h -- the characters of a text. */
#ifndef MR_BASE_UTF8_H
#define MR_BASE_UTF8_H

#include "base/ctx.h"

/* Bytes of the character that the n bytes at s begin with, and its code; 0: they begin with none. */
size_t mr_utf8(const unsigned char *s, size_t n, uint32_t *code);

/* True for the control characters of ASCII and of Latin 1. */
static inline bool
mr_is_control(uint32_t code)
{
	return code < ' ' || (code >= 0x7f && code < 0xa0);
}

#endif
