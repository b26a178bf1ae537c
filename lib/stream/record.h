/* record.h -- the record that a stream consists of: its 64-byte header (man/mr-stream.5).  Parsing checks all
 * that a header shows, so that sizes fit; the checksum is the caller's to ask for. */
#ifndef MR_STREAM_RECORD_H
#define MR_STREAM_RECORD_H

#include "stream/frame.h"

enum {
	MR_ALIGN = 64,           /* payloads begin at multiples of it */
	MR_NAME_MAX = 255,       /* bytes of a frame's name */
	MR_FRAME_COLUMNS = 4096, /* columns of a frame, at most */
	MR_RATIO = 1032          /* deflate packs no more than this many bytes into one */
};

/* The bytes that a stream begins with. */
enum { MR_MAGIC_BYTES = 8 };
static const char MR_MAGIC[] = "mrmesh1\n";

typedef enum mr_kind { MR_COLUMN, MR_START, MR_FRAME, MR_DROP, MR_ENDFRAME, MR_STOP } mr_kind;

typedef enum mr_codec { MR_RAW = 0, MR_PACKED = 1 } mr_codec;

typedef struct mr_record {
	mr_kind kind;
	char layer[MR_LAYER_MAX + 1], name[MR_COLUMN_MAX + 1];
	mr_shape shape;
	mr_codec codec;
	uint64_t rows, stored; /* stored: bytes of the payload, without padding */
	uint64_t size;         /* bytes of the values: rows x components x size of one */
} mr_record;

/* A structural record, START to END, whose payload is `stored` bytes of text. */
mr_record mr_record_of(mr_kind kind, const char *layer, size_t stored);

/* Parses a header found at byte `offset` of the input, for the sentence of MR_EFORMAT. */
mr_status
mr_record_parse(mr_ctx *ctx, const unsigned char header[MR_HEADER], uint64_t offset, mr_record *record);

/* Writes the header, checksum included, of a record with the payload. */
void mr_record_encode(const mr_record *record, const void *payload, unsigned char header[MR_HEADER]);

/* MR_EFORMAT unless the checksum in the header matches header and payload. */
mr_status mr_record_verify(
    mr_ctx *ctx, const unsigned char header[MR_HEADER], const void *payload, size_t stored, uint64_t offset);

/* Payload and padding, in bytes. */
static inline uint64_t
mr_record_padded(uint64_t stored)
{
	return (stored + MR_ALIGN - 1) / MR_ALIGN * MR_ALIGN;
}

/* Bytes of rows x components values; false where the shape is none or the product does not fit. */
bool mr_shape_size(mr_shape shape, uint64_t rows, uint64_t *size);

/* True for 1 to `most` printable ASCII characters without blanks, no kind of record among columns. */
bool mr_name_valid(const char *name, size_t most);

/* True for 1 to MR_NAME_MAX bytes of UTF-8 without control characters and '/', neither "." nor "..". */
bool mr_frame_name_valid(const char *name, size_t length);

#endif
