/*
 * place.h -- whether names lead to one file, and what is there.
 *
 * Layer rule: cmd.
 */
#ifndef PLACE_H
#define PLACE_H

#include "base/string_set.h"

/* The name of standard input, or output. */
static inline bool
place_is_dash(const char *path)
{
	return !strcmp(path, "-");
}

/* Whether both names lead to one file, there or not yet; never for a device. */
bool place_same(const char *a, const char *b);

/* The same of a descriptor. */
bool place_is(int fd, const char *name);

/* Whether there is a file with the name of a model that is no stream. */
bool place_is_model(const char *path);

/* Whether there is a file that is a stream. */
bool place_is_stream(const char *path);

/* MR_EUSAGE where a stream would take the place, or the name, of anything but a stream. */
mr_status place_for_stream(mr_ctx *ctx, const char *path) MR_WARN_UNUSED;

/* MR_EUSAGE where the text that `option` asks for would take the name of a model that is no columns of text.
 */
mr_status place_for_text(mr_ctx *ctx, const char *option, const char *path) MR_WARN_UNUSED;

/* MR_EUSAGE where several of the names from `first` to before `end` are "-". */
mr_status place_stdin_once(mr_ctx *ctx, char *const *name, size_t first, size_t end) MR_WARN_UNUSED;

/* The files that a command reads, and those that it writes; starts zeroed. */
typedef struct place_guard {
	mr_string_set read, written;
} place_guard;

void place_guard_free(place_guard *g);

/* MR_EUSAGE where a file is to be written that is read, or written already, or read that is written. */
mr_status place_claim(mr_ctx *ctx, place_guard *g, const char *path, bool writes) MR_WARN_UNUSED;

/* Of a stream that is read, whose place may have been taken by the one that is made of it. */
mr_status place_claim_stream(mr_ctx *ctx, place_guard *g, const char *path) MR_WARN_UNUSED;

#endif
