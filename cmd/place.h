/* place.h -- whether names lead to one file, and what kind it is.  Layer rule: cmd. */
#ifndef PLACE_H
#define PLACE_H

#include "base/name_table.h"

/* The name of standard input, or output. */
static inline bool
place_is_dash(const char *path)
{
	return !strcmp(path, "-");
}

/* Whether a name leads to the file of a descriptor; never for a device. */
bool place_is(int fd, const char *name);

/* Whether there is a file with the name of a model that is no stream. */
bool place_is_model(const char *path);

/* A command's use of a file. */
typedef enum place_use { PLACE_READ, PLACE_WRITE, PLACE_STREAM /* a stream is written */ } place_use;

/* MR_EUSAGE where a stream, or the text that `option` asks for, would take the name of a model. */
mr_status place_check_name(mr_ctx *ctx, const char *option, const char *path, place_use use) MR_WARN_UNUSED;

/* MR_EUSAGE where several of the names from `first` to before `end` are "-". */
mr_status place_stdin_once(mr_ctx *ctx, char *const *name, size_t first, size_t end) MR_WARN_UNUSED;

/* The files that a command reads, and those that it writes; starts zeroed. */
typedef struct place_guard {
	mr_string_set read, written;
} place_guard;

void place_guard_free(place_guard *g);

/* MR_EUSAGE where a file is to be written that is read, or written already, or read that is written; or where
 * a stream and another kind of file would overwrite each other. */
mr_status place_claim(mr_ctx *ctx, place_guard *g, const char *path, place_use use) MR_WARN_UNUSED;

#endif
