/* Words, numbers and lines of a text. */
#include "formats/scan.h"

#include <inttypes.h>
#include <math.h>

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
mr_status(mr_scan_fail)(const mr_scan *t, const void *where, const char *format, ...)
{
	char sentence[MR_ERROR_MAX / 2];
	va_list args;

	va_start(args, format);
	vsnprintf(sentence, sizeof sentence, format, args);
	va_end(args);
	return mr_fail(t->ctx, MR_EFORMAT, "%s %zu: %s", t->binary ? "byte" : "line",
	    t->binary ? (size_t)((const char *)where - t->start) : mr_line_number(t, where), sentence);
}

bool
mr_scan_line(mr_scan *t, mr_scan *line)
{
	const char *e;

	if (t->p == t->end)
		return false;
	e = memchr(t->p, '\n', (size_t)(t->end - t->p));
	*line = *t;
	line->end = e ? e : t->end;
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

bool
mr_word_not_finite(const char *w, size_t n, double *x)
{
	bool minus = n && *w == '-';
	size_t sign = n && (*w == '-' || *w == '+');

	*x = NAN;
	if (mr_word_is(w + sign, n - sign, "nan") || mr_word_is(w + sign, n - sign, "nan(ind)"))
		return true;
	*x = minus ? -(double)INFINITY : (double)INFINITY;
	return mr_word_is(w + sign, n - sign, "inf") || mr_word_is(w + sign, n - sign, "infinity");
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

/* A comment may follow a number without a blank, but 1.#INF is none with one. */
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
mr_scan_reals(mr_scan *line, const char *what, size_t least, size_t most, double *x, size_t *count)
{
	size_t n = 0;

	for (; mr_skip_blanks(line), line->p < line->end && *line->p != '#'; n++) {
		if (n == most)
			return mr_scan_fail(line, line->p, "%s has more than %zu numbers", what, most);
		MR_TRY(mr_scan_real(line, what, &x[n]));
	}
	if (n < least)
		return mr_scan_fail(line, line->p, "%s has %zu numbers, not %zu", what, n, least);
	*count = n;
	return MR_OK;
}

mr_status
mr_scan_position(mr_scan *t, mr_v3 *p)
{
	MR_TRY(mr_scan_real(t, "a coordinate", &p->x));
	MR_TRY(mr_scan_real(t, "a coordinate", &p->y));
	return mr_scan_real(t, "a coordinate", &p->z);
}
