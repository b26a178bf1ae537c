/*
 * place.h -- files that get their name when they are whole: until then they stand beside it, and are removed
 * where the command fails or is interrupted.
 *
 * Layer rule: cmd; includes base only.
 */
#ifndef PLACE_H
#define PLACE_H

#include "base/ctx.h"

typedef struct place {
	const char *name; /* what the file is to be called */
	char *beside;     /* what it is called until then; NULL: it has its name already */
} place;

/*
 * Opens `name` for writing: what is there and is no file, a device or a pipe, directly; else a file beside
 * it, or beside what a link of that name leads to.  The strings are in the arena of ctx.
 */
mr_status place_open(mr_ctx *ctx, const char *name, place *p, int *fd) MR_WARN_UNUSED;

/* Takes over `file`, which is whole and is to be called `name`: both are copied to the arena of ctx. */
mr_status place_take(mr_ctx *ctx, const char *file, const char *name, place *p) MR_WARN_UNUSED;

/* Gives the file its name. */
mr_status place_keep(mr_ctx *ctx, place *p) MR_WARN_UNUSED;

/* Removes what has not got its name. */
void place_drop(place *p);

/* From now on an interrupt removes this file too, one at a time; NULL: none. */
void place_unfinished(void *user, const char *file);

/* Whether both names lead to one file, there or not yet; never for a device. */
bool place_same(const char *a, const char *b);

/* The same of a descriptor. */
bool place_is(int fd, const char *name);

#endif
