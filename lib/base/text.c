/* Formatted text in the arena, its room doubled as it grows, and strings and numbers as JSON has them. */
#include "base/text.h"

#include "base/utf8.h"

#include <math.h>

void
mr_text_bytes(mr_text *t, const char *s, size_t n)
{
	MR_RESERVE(t->ctx, t->s, t->n, n + 1, &t->room);
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
	MR_RESERVE(t->ctx, t->s, t->n, (size_t)n + 1, &t->room);
	vsnprintf(t->s + t->n, (size_t)n + 1, format, again);
	t->n += (size_t)n;
	va_end(again);
	va_end(args);
}

void
mr_text_json(mr_text *t, const char *s, size_t n)
{
	const unsigned char *p = (const unsigned char *)s;
	uint32_t code;

	mr_text_bytes(t, "\"", 1);
	for (size_t i = 0, length; i < n; i += length) {
		length = mr_utf8(p + i, n - i, &code);
		if (length == 0) {
			mr_text_bytes(t, "\\ufffd", 6);
			length = 1;
		} else if (p[i] == '"' || p[i] == '\\') {
			mr_text_add(t, "\\%c", p[i]);
		} else if (p[i] < 0x20 || p[i] == 0x7f) {
			mr_text_add(t, "\\u%04x", p[i]);
		} else {
			mr_text_bytes(t, s + i, length);
		}
	}
	mr_text_bytes(t, "\"", 1);
}

void
mr_text_line(mr_text *t, const char *s, size_t n)
{
	const unsigned char *p = (const unsigned char *)s;
	uint32_t code;

	for (size_t i = 0, length; i < n; i += length) {
		length = mr_utf8(p + i, n - i, &code);
		if (length == 0 || mr_is_control(code)) {
			mr_text_bytes(t, "?", 1);
			length = length ? length : 1;
		} else {
			mr_text_bytes(t, s + i, length);
		}
	}
}

enum { NAMED = 12 };

void
mr_text_name(mr_text *t, size_t *n, const char *name)
{
	if (*n < NAMED)
		mr_text_add(t, "%s%s", *n ? ", " : "", name);
	else if (*n == NAMED)
		mr_text_add(t, ", ...");
	++*n;
}

void
mr_text_number(mr_text *t, double x)
{
	if (isfinite(x))
		mr_text_add(t, "%.17g", x);
	else
		mr_text_add(t, "null");
}

void
mr_text_figure(mr_text *t, const char *before, int digits, double x)
{
	if (isfinite(x))
		mr_text_add(t, "%s%.*g", before, digits, x);
	else
		mr_text_add(t, "%s-", before);
}
