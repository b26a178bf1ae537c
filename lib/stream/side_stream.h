/* side_stream.h -- a stream read beside another: for each frame of the first, its frame of the same number,
 * or its only one.  Contract: every sentence names the path. */
#ifndef MR_STREAM_SIDE_STREAM_H
#define MR_STREAM_SIDE_STREAM_H

#include "stream/frame.h"

typedef struct mr_side {
	const char *path; /* the caller's */
	mr_reader *reader;
	mr_frame *frame; /* the last one read; NULL: none yet */
	int fd;
	bool ended;
} mr_side;

/* Opens a file ("-": stdin).  MR_EIO, or what the reader says. */
mr_status mr_side_open(mr_ctx *ctx, const char *path, mr_side *s) MR_WARN_UNUSED;

/* s->frame becomes the one that goes with frame `number` (growing from call to call) of the first stream.
 * MR_ERANGE where there are too few, but not one alone. */
mr_status mr_side_take(mr_ctx *ctx, mr_side *s, uint64_t number) MR_WARN_UNUSED;

/* Reads the rest, which must end well, and closes.  MR_ERANGE where it holds more than the `frames` of the
 * first stream, of which it need not have been asked for all. */
mr_status mr_side_end(mr_ctx *ctx, mr_side *s, uint64_t frames) MR_WARN_UNUSED;

#endif
