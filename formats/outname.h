/* outname.h -- names of output files made from a pattern: %s the frame's name, %d its number (%03d with
 * zeros), %% a per cent.  Layer rule: formats. */
#ifndef MR_OUTNAME_H
#define MR_OUTNAME_H

#include "base/ctx.h"

/* The name for a frame, in the arena.  MR_EUSAGE where the pattern has another % in it. */
mr_status mr_outname(mr_ctx *ctx, const char *pattern, const char *frame, uint64_t number, char **name);

/* True where names differ from frame to frame. */
bool mr_outname_varies(const char *pattern);

#endif
