/* text.h -- a text that grows in the arena, and JSON in it. */
#ifndef MR_BASE_TEXT_H
#define MR_BASE_TEXT_H

#include "base/ctx.h"

typedef struct mr_text {
	mr_ctx *ctx;
	char *s; /* NUL-terminated; NULL while empty */
	size_t n, room;
} mr_text;

/* Appends, as by printf. */
void mr_text_add(mr_text *t, const char *format, ...) MR_PRINTF(2, 3);

/* Appends n bytes as they are. */
void mr_text_bytes(mr_text *t, const char *s, size_t n);

/* Appends n bytes as a JSON string, quotes and all; bytes that are not UTF-8 become U+FFFD. */
void mr_text_json(mr_text *t, const char *s, size_t n);

/* Appends n bytes for people to read in a line: invalid UTF-8 and control characters become '?'. */
void mr_text_line(mr_text *t, const char *s, size_t n);

/* Appends a name to a list of *n so far, at first 0, with a comma between two; for the 13th and later three
 * dots stand. */
void mr_text_name(mr_text *t, size_t *n, const char *name);

/* Appends a number with all its digits, or null where it is not finite. */
void mr_text_number(mr_text *t, double x);

/* Appends `before`, then the number with so many digits, for people, or "-" where it is not finite. */
void mr_text_figure(mr_text *t, const char *before, int digits, double x);

/* The plural ending after "%zu part", and the like. */
static inline const char *
mr_plural(size_t n)
{
	return n == 1 ? "" : "s";
}

/* Whether a list that NULL ends has the name. */
static inline bool
mr_is_one_of(const char *name, const char *const *names)
{
	while (*names && strcmp(name, *names))
		names++;
	return *names;
}

#endif
