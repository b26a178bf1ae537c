#include "base/text.h"

#include <math.h>

static bool
reserve(mr_text *t, size_t more)
{
	char *s;

	if (t->failed || t->n + more + 1 <= t->room)
		return !t->failed;
	s = mr_grow(t->ctx, t->s, t->n, 2 * (t->n + more) + 256, 1);
	t->failed = !s;
	if (s) {
		t->s = s;
		t->room = 2 * (t->n + more) + 256;
	}
	return s;
}

static void
add_bytes(mr_text *t, const char *s, size_t n)
{
	if (!reserve(t, n))
		return;
	memcpy(t->s + t->n, s, n);
	t->n += n;
	t->s[t->n] = '\0';
}

void
mr_text_add(mr_text *t, const char *format, ...)
{
	va_list args, again;
	int n;

	va_start(args, format);
	va_copy(again, args);
	n = vsnprintf(NULL, 0, format, args);
	if (n >= 0 && reserve(t, (size_t)n)) {
		vsnprintf(t->s + t->n, (size_t)n + 1, format, again);
		t->n += (size_t)n;
	}
	va_end(again);
	va_end(args);
}

/* Bytes of the UTF-8 character that begins here; 0: none does. */
static size_t
character(const unsigned char *s, size_t n)
{
	static const uint32_t least[] = { 0, 0, 0x80, 0x800, 0x10000 };
	size_t length = s[0] < 0x80   ? 1
	                : s[0] < 0xc2 ? 0
	                : s[0] < 0xe0 ? 2
	                : s[0] < 0xf0 ? 3
	                : s[0] < 0xf5 ? 4
	                              : 0;
	uint32_t code;

	if (length < 2)
		return length;
	if (length > n)
		return 0;
	code = s[0] & (0x7fu >> length);
	for (size_t i = 1; i < length; i++) {
		if ((s[i] & 0xc0) != 0x80)
			return 0;
		code = code << 6 | (s[i] & 0x3fu);
	}
	return code < least[length] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000) ? 0 : length;
}

void
mr_text_json(mr_text *t, const char *s, size_t n)
{
	const unsigned char *p = (const unsigned char *)s;

	add_bytes(t, "\"", 1);
	for (size_t i = 0, length; i < n; i += length) {
		length = character(p + i, n - i);
		if (length == 0) {
			add_bytes(t, "\\ufffd", 6);
			length = 1;
		} else if (p[i] == '"' || p[i] == '\\') {
			mr_text_add(t, "\\%c", p[i]);
		} else if (p[i] < 0x20 || p[i] == 0x7f) {
			mr_text_add(t, "\\u%04x", p[i]);
		} else {
			add_bytes(t, s + i, length);
		}
	}
	add_bytes(t, "\"", 1);
}

void
mr_text_number(mr_text *t, double x)
{
	if (isfinite(x))
		mr_text_add(t, "%.17g", x);
	else
		mr_text_add(t, "null");
}

mr_status
mr_text_done(const mr_text *t)
{
	return t->failed ? MR_EMEM : MR_OK;
}
