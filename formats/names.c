/* Names, byte by byte, in the digits of RFC 3986. */
#include "formats/names.h"

#include "base/utf8.h"

static int
digit(char c)
{
	return c >= '0' && c <= '9' ? c - '0' : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* The byte that % and two digits at p stand for; -1 where they do not, or for one that would end a line, or
 * what is text, in a file: it has no other form than this. */
static int
escaped(const char *p, const char *end)
{
	int byte;

	if (end - p < 3 || *p != '%' || digit(p[1]) < 0 || digit(p[2]) < 0)
		return -1;
	byte = 16 * digit(p[1]) + digit(p[2]);
	if (byte == 0 || byte == '\n' || byte == '\r')
		return -1;
	return byte < ' ' || byte >= 0x7f || byte == '%' ? byte : -1;
}

/* Bytes at p that stand as they are; 0: the first does not. */
static size_t
plain(const char *p, const char *end)
{
	uint32_t code;
	size_t n;

	if (*p == '\n')
		return 1;
	n = mr_utf8((const unsigned char *)p, (size_t)(end - p), &code);
	return n && !mr_is_control(code) && escaped(p, end) < 0 ? n : 0;
}

mr_status
mr_names_escape(mr_ctx *ctx, mr_lines from, mr_lines *to)
{
	static const char digits[] = "0123456789ABCDEF";
	const char *p = from.text, *end = from.bytes ? p + from.bytes : p;
	size_t n, bytes = 0;
	char *text;

	*to = from;
	while (p < end && (n = plain(p, end)) > 0)
		p += n;
	if (p == end)
		return MR_OK;
	text = MR_NEW(ctx, 3 * from.bytes, char);
	if (!text)
		return MR_EMEM;
	for (p = from.text; p < end; p += n ? n : 1) {
		n = plain(p, end);
		if (n) {
			memcpy(text + bytes, p, n);
			bytes += n;
		} else {
			text[bytes++] = '%';
			text[bytes++] = digits[(unsigned char)*p >> 4];
			text[bytes++] = digits[*p & 15];
		}
	}
	*to = (mr_lines){ text, bytes };
	return MR_OK;
}

mr_status
mr_names_raw(mr_ctx *ctx, mr_lines from, mr_lines *to)
{
	const char *p = from.text, *end = from.bytes ? p + from.bytes : p;
	size_t bytes = 0;
	char *text;

	*to = from;
	if (p == end || !memchr(p, '%', from.bytes))
		return MR_OK;
	text = MR_NEW(ctx, from.bytes, char);
	if (!text)
		return MR_EMEM;
	while (p < end) {
		int byte = escaped(p, end);
		text[bytes++] = byte < 0 ? *p : (char)byte;
		p += byte < 0 ? 1 : 3;
	}
	*to = (mr_lines){ text, bytes };
	return MR_OK;
}
