/* Decimal to double and back, exactly, and words and lines of a text. */
#include "formats/scan.h"

#include <inttypes.h>
#include <math.h>

__extension__ typedef unsigned __int128 wide;

enum { POWERS = 28 }; /* 5^27 < 2^63 < 5^28 */

static const uint64_t five[POWERS] = { 1u, 5u, 25u, 125u, 625u, 3125u, 15625u, 78125u, 390625u, 1953125u,
	9765625u, 48828125u, 244140625u, 1220703125u, 6103515625u, 30517578125u, 152587890625u, 762939453125u,
	3814697265625u, 19073486328125u, 95367431640625u, 476837158203125u, 2384185791015625u,
	11920928955078125u, 59604644775390625u, 298023223876953125u, 1490116119384765625u,
	7450580596923828125u };

/* The double nearest to (m + something in (0, 1) if `sticky`) 2^e, ties to even; m has 62 bits at least, the
 * result is normal. */
static double
assemble(uint64_t m, bool sticky, int e)
{
	int zeros = __builtin_clzll(m);
	uint64_t rest, bits;
	double x;

	m <<= zeros;
	e -= zeros;
	rest = m & 0x7ff;
	m >>= 11; /* 53 bits */
	if (rest > 0x400 || (rest == 0x400 && (sticky || (m & 1))))
		m++; /* a carry into bit 53 is carried on into the exponent below */
	bits = ((uint64_t)(e + 11 + 52 + 1023) << 52) + (m - (UINT64_C(1) << 52));
	memcpy(&x, &bits, sizeof x);
	return x;
}

/*
 * w 10^k, correctly rounded, for w > 0 and |k| < POWERS: 10^k = 5^k 2^k, and the product or the quotient
 * with 5^|k| is taken exactly in 128 bits, its remainder deciding the ties.
 */
static double
scaled(uint64_t w, int k)
{
	if (w < UINT64_C(1) << 53 && k >= -22 &&
	    k <= 22) { /* both exact as doubles: one rounding (Clinger 1990) */
		static const double ten[] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11,
			1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
		return k < 0 ? (double)w / ten[-k] : (double)w * ten[k];
	}
	if (k >= 0) {
		wide product = (wide)w * five[k];
		uint64_t high = (uint64_t)(product >> 64), low = (uint64_t)product;
		int shift = high ? 64 - __builtin_clzll(high) : 0; /* keep the 64 leading bits */
		uint64_t m = shift ? (uint64_t)(product >> shift) : low;
		return assemble(m, shift && low << (64 - shift), k + shift);
	} else {
		int a = __builtin_clzll(w), b = __builtin_clzll(five[-k]);
		wide n = (wide)(w << a) << 63;
		uint64_t d = five[-k] << b;
		uint64_t q = (uint64_t)(n /
					d); /* w < 2^64 and d >= 2^63: below 2^64, with 63 bits at least */
		return assemble(q, n - (wide)q * d != 0, k - a - 63 + b);
	}
}

/* The slow and sure way, for exponents beyond the table. */
static double
by_strtod(const char *p, const char *end)
{
	char text[1200];
	size_t n = (size_t)(end - p);

	memcpy(text, p, n);
	text[n] = 0;
	return strtod(text, NULL);
}

const char *
mr_real_read(const char *p, const char *end, double *x)
{
	const char *start = p, *point = NULL, *digits;
	bool negative = false, cut = false;
	int64_t exponent = 0;
	size_t seen = 0, kept = 0;
	uint64_t w = 0;
	double value;

	if (p < end && (*p == '-' || *p == '+'))
		negative = *p++ == '-';
	digits = p;
	for (; p < end; p++) {
		unsigned d = (unsigned char)(*p - '0');
		if (d < 10) {
			seen++;
			if (kept < 19) {
				w = 10 * w + d;
				kept += w != 0;
				exponent -= point != NULL;
			} else {
				cut |= d != 0;
				exponent += point == NULL;
			}
		} else if (*p == '.' && !point)
			point = p;
		else
			break;
	}
	if (!seen || (size_t)(p - digits) > 1100)
		return NULL;
	if (p < end && (*p == 'e' || *p == 'E')) {
		const char *q = p + 1;
		bool down = false;
		int64_t e = 0;
		if (q < end && (*q == '-' || *q == '+'))
			down = *q++ == '-';
		if (q == end || !mr_is_digit(*q))
			return NULL;
		for (; q < end && mr_is_digit(*q); q++)
			if (e < 100000)
				e = 10 * e + (*q - '0');
		exponent += down ? -e : e;
		if (q - p > 40)
			return NULL;
		p = q;
	}
	if (w == 0)
		value = 0;
	else if (exponent <= -POWERS || exponent >= POWERS ||
		 (cut && (w == UINT64_MAX || scaled(w, (int)exponent) != scaled(w + 1, (int)exponent)))) {
		*x = by_strtod(start, p);
		return p;
	} else
		value = scaled(w, (int)exponent);
	*x = negative ? -value : value;
	return p;
}

char *
mr_count_write(char *to, uint64_t n)
{
	char digit[20];
	size_t count = 0;

	do
		digit[count++] = (char)('0' + n % 10);
	while (n /= 10);
	while (count)
		*to++ = digit[--count];
	return to;
}

/* round(x 10^s), exactly, for positive normal x and 0 <= s < POWERS, where it is below 2^63. */
static uint64_t
rounded(double x, int s)
{
	uint64_t bits, m;
	wide product;
	int shift;

	memcpy(&bits, &x, sizeof bits);
	m = (bits & ((UINT64_C(1) << 52) - 1)) | UINT64_C(1) << 52;
	shift = 1075 - (int)(bits >> 52) - s; /* x 10^s = m 5^s 2^-shift */
	product = (wide)m * five[s];
	if (shift <= 0)
		return (uint64_t)(product << -shift);
	if (shift > 120)
		return 0;
	return (uint64_t)((product + ((wide)1 << (shift - 1))) >> shift);
}

/* n 10^-s with its trailing zeros removed, in plain or in scientific notation. */
static char *
write_decimal(char *to, uint64_t n, int s)
{
	char digit[20];
	int count, point;

	while (n % 10 == 0) {
		n /= 10;
		s--;
	}
	count = (int)(mr_count_write(digit, n) - digit);
	point = count - s; /* digits before the point */
	if (point > 17 || point < -4) {
		*to++ = digit[0];
		if (count > 1)
			*to++ = '.';
		memcpy(to, digit + 1, (size_t)count - 1);
		to += count - 1;
		*to++ = 'e';
		if (point < 1)
			*to++ = '-';
		return mr_count_write(to, (uint64_t)(point < 1 ? 1 - point : point - 1));
	}
	if (point <= 0) {
		*to++ = '0';
		*to++ = '.';
		for (; point < 0; point++)
			*to++ = '0';
		memcpy(to, digit, (size_t)count);
		return to + count;
	}
	for (int i = 0; i < (point > count ? point : count); i++) {
		if (i == point)
			*to++ = '.';
		*to++ = i < count ? digit[i] : '0';
	}
	return to;
}

static char *
by_printf(char *to, double x)
{
	int n = 0;

	for (int digits = 15; digits <= 17; digits++) {
		n = snprintf(to, MR_REAL_MAX, "%.*g", digits, x);
		if (strtod(to, NULL) == x)
			break;
	}
	return to + n;
}

char *
mr_real_write(char *to, double x)
{
	int exponent;

	if (signbit(x)) {
		*to++ = '-';
		x = -x;
	}
	if (x == 0) {
		*to++ = '0';
		return to;
	}
	if (!(x >= 1e-9 && x < 1e15))
		return by_printf(to, x);
	if (x < 1e9 && x == (double)(uint64_t)x)
		return mr_count_write(to, (uint64_t)x);
	exponent = (int)floor(log10(x)) + 1; /* digits before the point, or one off beside a power of ten */
	if (exponent > 15)
		exponent = 15; /* as below 1e15 */
	for (int digits = 15; digits <= 17; digits++) {
		int s = digits - exponent;
		uint64_t n = rounded(x, s);
		if (n && scaled(n, -s) == x)
			return write_decimal(to, n, s);
	}
	return by_printf(to, x);
}

/* ---- the cursor ---- */

size_t
mr_line_number(const mr_scan *t, const char *where)
{
	size_t lines = 1;

	for (const char *p = t->start; p < where && (p = memchr(p, '\n', (size_t)(where - p))); p++)
		lines++;
	return lines;
}

/* In brackets: for make lint there is a macro of this name. */
mr_status(mr_scan_fail)(const mr_scan *t, const char *where, const char *format, ...)
{
	char sentence[MR_ERROR_MAX / 2];
	va_list args;

	va_start(args, format);
	vsnprintf(sentence, sizeof sentence, format, args);
	va_end(args);
	return mr_fail(t->ctx, MR_EFORMAT, "line %zu: %s", mr_line_number(t, where), sentence);
}

bool
mr_scan_line(mr_scan *t, mr_scan *line)
{
	const char *e;

	if (t->p == t->end)
		return false;
	e = memchr(t->p, '\n', (size_t)(t->end - t->p));
	*line = (mr_scan){ t->ctx, t->start, t->p, e ? e : t->end };
	t->p = e ? e + 1 : t->end;
	if (line->end > line->p && line->end[-1] == '\r')
		line->end--;
	return true;
}

bool
mr_scan_word(mr_scan *t, const char **word, size_t *bytes)
{
	mr_skip_space(t);
	*word = t->p;
	while (t->p < t->end && !mr_is_blank(*t->p) && *t->p != '\n')
		t->p++;
	*bytes = (size_t)(t->p - *word);
	return *bytes > 0;
}

static char
lower(char c)
{
	return (char)(c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c);
}

bool
mr_word_is(const char *text, size_t n, const char *word)
{
	size_t i = 0;

	while (i < n && word[i] && lower(text[i]) == lower(word[i]))
		i++;
	return i == n && !word[i];
}

bool
mr_scan_accept(mr_scan *t, const char *word)
{
	mr_scan ahead = *t;
	const char *w;
	size_t n;

	if (!mr_scan_word(&ahead, &w, &n) || !mr_word_is(w, n, word))
		return false;
	*t = ahead;
	return true;
}

/* Skips what the text begins with, in either case of letters. */
static bool
begins(const char **p, const char *end, const char *what)
{
	size_t n = strlen(what);

	if ((size_t)(end - *p) < n)
		return false;
	for (size_t i = 0; i < n; i++)
		if (lower((*p)[i]) != what[i])
			return false;
	*p += n;
	return true;
}

/* Behind the sign: nan, 1.#IND and the like. */
static bool
is_nan(const char *w, const char *end)
{
	if (begins(&w, end, "nan"))
		return w == end || (*w == '(' && end[-1] == ')');
	if (!begins(&w, end, "1.#") ||
	    (!begins(&w, end, "ind") && !begins(&w, end, "qnan") && !begins(&w, end, "snan")))
		return false;
	while (w < end && *w == '0') /* of Windows */
		w++;
	return w == end;
}

static bool
is_infinity(const char *w, const char *end)
{
	if (begins(&w, end, "1.#inf"))
		while (w < end && *w == '0')
			w++;
	else if (!begins(&w, end, "inf") || (w < end && !begins(&w, end, "inity")))
		return false;
	return w == end;
}

bool
mr_word_not_finite(const char *w, size_t n, double *x)
{
	const char *end = w + n;
	bool minus = n && *w == '-', infinite;

	w += n && (*w == '-' || *w == '+');
	infinite = is_infinity(w, end);
	*x = !infinite ? (double)NAN : minus ? -(double)INFINITY : (double)INFINITY;
	return infinite || is_nan(w, end);
}

const char *
mr_word_shown(const char *w, size_t n, char text[MR_SHOWN])
{
	size_t i;

	for (i = 0; i < n && i < 30; i++)
		text[i] = (char)(w[i] >= ' ' && w[i] < 127 ? w[i] : '?');
	snprintf(text + i, MR_SHOWN - i, "%s", n > 30 ? "..." : "");
	return text;
}

/* A comment may stand right behind a number, but 1.#INF is none with one. */
static bool
ends_word(const char *p, const char *end)
{
	return p == end || mr_is_blank(*p) || *p == '\n' || (*p == '#' && p[-1] != '.');
}

mr_status
mr_scan_real(mr_scan *t, const char *what, double *x)
{
	char shown[MR_SHOWN];
	const char *w, *e;
	size_t n;

	mr_skip_space(t);
	e = mr_real_read(t->p, t->end, x);
	if (e && ends_word(e, t->end)) {
		t->p = e;
		return MR_OK;
	}
	if (!mr_scan_word(t, &w, &n))
		return mr_scan_fail(t, t->p, "%s is missing", what);
	if (!mr_word_not_finite(w, n, x))
		return mr_scan_fail(t, w, "%s is '%s', not a number", what, mr_word_shown(w, n, shown));
	return MR_OK;
}

mr_status
mr_scan_count(mr_scan *t, const char *what, uint64_t most, uint64_t *n)
{
	char shown[MR_SHOWN];
	const char *p, *w;
	uint64_t value = 0;
	size_t bytes;

	mr_skip_space(t);
	for (p = t->p; p < t->end && mr_is_digit(*p) && value <= most; p++)
		value = 10 * value + (uint64_t)(*p - '0');
	if (p > t->p && value <= most && ends_word(p, t->end)) {
		t->p = p;
		*n = value;
		return MR_OK;
	}
	if (!mr_scan_word(t, &w, &bytes))
		return mr_scan_fail(t, t->p, "%s is missing", what);
	return mr_scan_fail(t, w, "%s is '%s', not a whole number from 0 to %" PRIu64, what,
	    mr_word_shown(w, bytes, shown), most);
}

void
mr_skip_comments(mr_scan *t)
{
	for (mr_skip_space(t); t->p < t->end && *t->p == '#'; mr_skip_space(t)) {
		const char *e = memchr(t->p, '\n', (size_t)(t->end - t->p));
		t->p = e ? e : t->end;
	}
}

void
mr_scan_rest(mr_scan *t)
{
	const char *p = t->p;

	while (p < t->end && (!*p || *p == '\n' || mr_is_blank(*p)))
		p++;
	mr_lost(t->ctx, NULL, (size_t)(t->end - p), "bytes behind the last row");
}

mr_status
mr_scan_position(mr_scan *t, mr_v3 *p)
{
	const char *where;
	mr_v3 q;

	mr_skip_space(t);
	where = t->p;
	MR_TRY(mr_scan_real(t, "a coordinate", &q.x));
	MR_TRY(mr_scan_real(t, "a coordinate", &q.y));
	MR_TRY(mr_scan_real(t, "a coordinate", &q.z));
	if (!mr_finite(q))
		return mr_scan_fail(t, where, "a coordinate is not finite");
	*p = q;
	return MR_OK;
}
