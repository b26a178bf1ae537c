/*
 * stream.h -- reading and writing streams of frames (man/mr-stream.5).
 *
 * Contract: a reader gives frames merged (a delta with what it keeps), each
 * valid until the next read.  A writer sends key frames whole and of a delta
 * only what differs from what it sent before.
 */
#ifndef MR_STREAM_H
#define MR_STREAM_H

#include "stream/frame.h"

typedef struct mr_reader mr_reader;
typedef struct mr_writer mr_writer;

/*
 * Reads from a descriptor, which stays the caller's, from where it stands; a regular file is mapped and must
 * not be cut meanwhile.  Free with mr_reader_free.
 */
mr_status mr_reader_open(mr_ctx *ctx, int fd, mr_reader **reader) MR_WARN_UNUSED;

/*
 * MR_OK: *frame is the next one; MR_END: all streams have ended well, and the last frame stays valid; else
 * failed, and every further call fails.
 */
mr_status mr_reader_next(mr_ctx *ctx, mr_reader *reader, mr_frame **frame) MR_WARN_UNUSED;

/* Accepts NULL. */
void mr_reader_free(mr_reader *reader);

typedef enum mr_packing { MR_KEEP, MR_PACK, MR_UNPACK } mr_packing;

/* Writes to a descriptor, which stays the caller's. */
mr_status mr_writer_open(mr_ctx *ctx, int fd, mr_packing packing, mr_writer **writer) MR_WARN_UNUSED;

/* Sends a frame; a delta that follows nothing, or a failed frame (mr_writer_skipped), is sent as a key. */
mr_status mr_writer_put(mr_ctx *ctx, mr_writer *writer, const mr_frame *frame) MR_WARN_UNUSED;

/* Says that a frame was left out: the next one is sent complete. */
void mr_writer_skipped(mr_writer *writer);

/* Writes END: call it only when all went well. */
mr_status mr_writer_end(mr_ctx *ctx, mr_writer *writer) MR_WARN_UNUSED;

/* Accepts NULL. */
void mr_writer_free(mr_writer *writer);

#endif
