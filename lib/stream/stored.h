/* stored.h -- a reader's input, and the columns it keeps, on the heap, since they outlive the arena of a
 * frame; by one function, so that tests can make it fail.  Private to this room. */
#ifndef MR_STREAM_STORED_H
#define MR_STREAM_STORED_H

#include "base/memory.h"
#include "stream/frame.h"
#include "stream/record.h"

/* A column as the reader keeps it until it is replaced or dropped. */
typedef struct mr_stored {
	mr_record head;
	const mr_reader *owner;
	uint64_t serial;                 /* from 1; another for every payload of the owner */
	uint64_t offset;                 /* of the header in the input */
	uint64_t frame;                  /* number of the frame that sent it */
	unsigned char header[MR_HEADER]; /* as read */
	const unsigned char *payload;    /* with its padding, 64-byte aligned, in the map or in `heap` */
	void *heap; /* NULL where mapped; columns of equal payloads have the same, the last one frees it */
	const void *data; /* the values, once decoded */
	void *inflated;   /* the memory of `data` where it was packed */
} mr_stored;

/* mr_memory; the sentence is set where it fails.  Counts as an allocation for ctx->fail_at. */
void *mr_heap(mr_ctx *ctx, void *old, size_t size) MR_WARN_UNUSED;

/* Room for `count` objects in an array of the heap: twice as many where it grows. */
mr_status mr_heap_room(mr_ctx *ctx, void *array, size_t size, size_t count, size_t *room) MR_WARN_UNUSED;

/* Bytes from a descriptor: a map of a regular file, or blocks. */
typedef struct mr_input {
	int fd;
	uint64_t offset;          /* of the next byte, in the file, or from the first byte read */
	const unsigned char *map; /* NULL: not mapped */
	size_t size;              /* of the map */
	unsigned char *block;     /* bytes read and not yet taken: begin to end */
	size_t begin, end;
} mr_input;

mr_status mr_input_open(mr_ctx *ctx, int fd, mr_input *in);

/* Says that a record in the map is not needed any more: a long stream does not pile up in memory. */
void mr_input_forget(const unsigned char *record, uint64_t n);

/* Leaves the descriptor at the end of the read bytes, mapped or not. */
void mr_input_end(const mr_input *in);
void mr_input_close(mr_input *in);

/* The next header.  *got: its bytes; less than MR_HEADER only where the input ends. */
mr_status mr_input_header(mr_ctx *ctx, mr_input *in, unsigned char header[MR_HEADER], size_t *got);

/* The `n` bytes after the header just taken.  *record: header and bytes, in the map or in *heap, which is the
 * caller's to free.  MR_END if the input ends before. */
mr_status mr_input_payload(mr_ctx *ctx, mr_input *in, const unsigned char header[MR_HEADER], uint64_t n,
    const unsigned char **record, void **heap) MR_WARN_UNUSED;

/* Codec 1.  Packs `head->size` bytes of values; *size 0 where that would not make them fewer.  *packed: in
 * the arena. */
mr_status mr_pack(mr_ctx *ctx, const mr_record *head, const void *data, const void **packed, size_t *size);

/* Unpacks head->stored bytes into `data`, which has room for head->size. */
mr_status mr_unpack(mr_ctx *ctx, const mr_record *head, const void *packed, void *data);

/* The first v (f) column of a layer fixes the rows of all: `status` with a sentence where columns differ. */
mr_status mr_frame_check_rows(mr_ctx *ctx, const mr_frame *frame, mr_status status);

#endif
