/* scan.h -- numbers as text, exactly, and a cursor over text in memory, which needs no NUL at its end.
 * Reading rounds as strtod does; writing gives the shortest decimal that reads back the same. */
#ifndef MR_SCAN_H
#define MR_SCAN_H

#include "base/vec.h"
#include "formats/numbers.h"

/* A place in a file; the line number is found when an error needs it. */
typedef struct mr_scan {
	mr_ctx *ctx;
	const char *start, *p, *end;
	bool binary; /* error messages name places by bytes */
} mr_scan;

static inline bool
mr_is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

static inline bool
mr_is_digit(char c)
{
	return (unsigned char)(c - '0') < 10;
}

/* Skips blanks of the line. */
static inline void
mr_skip_blanks(mr_scan *t)
{
	while (t->p < t->end && mr_is_blank(*t->p))
		t->p++;
}

/* Skips blanks and line ends. */
static inline void
mr_skip_space(mr_scan *t)
{
	while (t->p < t->end && (mr_is_blank(*t->p) || *t->p == '\n'))
		t->p++;
}

/* The same, and comments, which begin with # and go to the end of the line. */
void mr_skip_comments(mr_scan *t);

/* Reports data after the last row, unless it is blank or zero padding. */
void mr_scan_rest(mr_scan *t);

/* The line that begins at t->p, without its end, as a text of its own with the same start; t moves past
 * it. */
bool mr_scan_line(mr_scan *t, mr_scan *line);

/* The next word of the text, of non-blanks; false at the end.  Crosses lines where the text has any. */
bool mr_scan_word(mr_scan *t, const char **word, size_t *bytes);

/* Whether a text of n bytes is this word, in either case of letters. */
bool mr_word_is(const char *text, size_t n, const char *word);

/* True, and skips it, where the next word is this one, in either case of letters. */
bool mr_scan_accept(mr_scan *t, const char *word);

/* The next word as a number; "nan", "inf" and their kin are not finite numbers. MR_EFORMAT with the line
 * where the word is something else or missing; `what` is for the sentence. */
mr_status mr_scan_real(mr_scan *t, const char *what, double *x);

/* The next word as a whole number of at most `most`. */
mr_status mr_scan_count(mr_scan *t, const char *what, uint64_t most, uint64_t *n);

/* The numbers of a line that mr_scan_line gave, or of the rest of it, up to a comment: `least` to `most`. */
mr_status mr_scan_reals(mr_scan *line, const char *what, size_t least, size_t most, double *x, size_t *count);

/* Three numbers. */
mr_status mr_scan_position(mr_scan *t, mr_v3 *p);

/* True for "nan", "-nan(ind)", "inf" and "Infinity" in any case of letters.  *x: that value. */
bool mr_word_not_finite(const char *word, size_t bytes, double *x);

/* The word as a sentence may show it: printable and not too long. */
enum { MR_SHOWN = 40 };
const char *mr_word_shown(const char *word, size_t bytes, char text[MR_SHOWN]);

/* "line N: sentence" for the line of `where`, or "byte N: sentence". */
mr_status mr_scan_fail(const mr_scan *t, const void *where, const char *format, ...) MR_PRINTF(3, 4);

/* The number of the line, from 1. */
size_t mr_line_number(const mr_scan *t, const char *where);

#endif
