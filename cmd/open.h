/* open.h -- shows a file in the program that the user's desktop has for it.  Of mr-view alone: man 7
 * mr-promises. */
#ifndef OPEN_H
#define OPEN_H

#include "base/ctx.h"

/* Runs xdg-open on the file, and waits for it.  MR_EIO where it is not there or fails. */
mr_status open_file(mr_ctx *ctx, const char *path) MR_WARN_UNUSED;

#endif
