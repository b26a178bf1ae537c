/* signals.h -- when a signal ends the process, unfinished files are removed and cut input is reported.
 * Layer rule: cmd; includes base only. */
#ifndef SIGNALS_H
#define SIGNALS_H

#include "base/ctx.h"

/* For the whole life of the command `name`: a write beyond the limit of a file's size fails instead of ending
 * the process, and a mapped file that was cut off is an error with exit 1. */
void signals_begin(const char *name);

/* mr_ctx.unfinished: from now on, or no longer, whatever signal ends the process removes the file first. */
void signals_unfinished(void *user, const char *file, bool on);

#endif
