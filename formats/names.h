/*
 * names.h -- names as files have them, which are any bytes, and as a stream has them, in UTF-8.
 *
 * A byte that no name of a stream may have is written as % and two digits, and so is a % before two such
 * digits: no two names become one, and what was written gets its bytes back, but for a CR or a NUL, which a
 * name has where the file is no text, and which stays %0D or %00.  Layer rule: formats.
 */
#ifndef MR_NAMES_H
#define MR_NAMES_H

#include "formats/formats.h"

/* The names of a file, a line each, as a stream has them.  to: in the arena, or the text that came. */
mr_status mr_names_escape(mr_ctx *ctx, mr_lines from, mr_lines *to) MR_WARN_UNUSED;

/* The reverse. */
mr_status mr_names_raw(mr_ctx *ctx, mr_lines from, mr_lines *to) MR_WARN_UNUSED;

#endif
