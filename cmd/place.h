/*
 * place.h -- whether names lead to one file.
 *
 * Layer rule: cmd; includes base only.
 */
#ifndef PLACE_H
#define PLACE_H

#include "base/ctx.h"

/* Whether both names lead to one file, there or not yet; never for a device. */
bool place_same(const char *a, const char *b);

/* The same of a descriptor. */
bool place_is(int fd, const char *name);

#endif
